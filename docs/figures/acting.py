"""Makes the film of our avatar acting, tracks it, and judges and draws what comes out (docs/track.md).

    (cd web && npm ci)
    python docs/figures/acting.py OUT

OUT/acting.mp4 is the film, OUT/acting.npz the weights, gaze and head of each frame, OUT/answers.csv what `track` makes
of it with a neutral face from its first two seconds, OUT/track.webp both beside one another. Frames are drawn one by
one in headless Chromium, by software where there is no graphics card: 1 to 2 s each.
"""

import argparse
import asyncio
import base64
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import AsyncIterator, Iterable
from contextlib import asynccontextmanager
from pathlib import Path

import aiohttp
import cv2
import numpy as np
from aiohttp import web
from PIL import Image

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.runtime.inputs import read_frames
from regress.runtime.model import load_model
from regress.runtime.ready_made import LANDMARKS, model_folder
from regress.runtime.sample import Sample
from track.detectors import open_detector

ROOT = Path(__file__).resolve().parents[2]
FPS, SECONDS, REST_S = 15, 12.5, 2.0
CHROMIUM = (
    "chromium --headless --no-sandbox --disable-quic --no-first-run --disable-background-networking "
    "--disable-component-update --disable-sync --use-angle=swiftshader --enable-unsafe-swiftshader "
    "--remote-debugging-port=9377"
).split()

ACTED = (
    (("mouthSmileLeft", "mouthSmileRight"), 0.8, 5.6, 7.2),
    (("cheekSquintLeft", "cheekSquintRight"), 0.5, 5.6, 7.2),
    (("browInnerUp", "browOuterUpLeft", "browOuterUpRight"), 0.9, 7.8, 9.2),
    (("eyeWideLeft", "eyeWideRight"), 0.4, 7.8, 9.2),
    (("jawOpen",), 0.75, 9.4, 10.4),
    (("mouthPucker",), 0.8, 10.7, 12.0),
)
"""Shapes, how far, and from when to when in seconds."""

BLINKS_S = (3.2, 5.1, 7.6, 9.0, 11.2)


def acting() -> dict[str, np.ndarray]:
    """Weights (n, 52), gaze (n, 4) and head's yaw, pitch and roll (n, 3) of the film's frames."""
    time_s = np.arange(int(SECONDS * FPS)) / FPS
    take = read_frames(ROOT / "docs" / "samples" / "talking-face.csv")
    talk = load_model(model_folder(LANDMARKS)).calibrate(take.points[:30]).predict(take.points[60:])
    smooth = np.hanning(9)[1:-1] / np.hanning(9).sum()
    talk = np.apply_along_axis(lambda column: np.convolve(column, smooth, "same"), 0, talk)
    weights = np.clip(1.25 * talk[(time_s * 30).astype(int)], 0, 1)
    weights[:, [index for name, index in BLENDSHAPE_INDEX.items() if name.startswith("eyeLook")]] = 0
    begun = np.clip((time_s - REST_S) / 0.5, 0, 1)
    weights *= begun[:, None]
    for blink_s in BLINKS_S:
        shut = np.clip(1.3 - np.abs(time_s - blink_s) / 0.09, 0, 1)
        for name in ("eyeBlinkLeft", "eyeBlinkRight"):
            weights[:, BLENDSHAPE_INDEX[name]] = np.maximum(weights[:, BLENDSHAPE_INDEX[name]], shut)
    for names, far, begin_s, end_s in ACTED:
        shown = far * np.clip(np.minimum(time_s - begin_s, end_s - time_s) / 0.35, 0, 1)
        for name in names:
            weights[:, BLENDSHAPE_INDEX[name]] = np.maximum(weights[:, BLENDSHAPE_INDEX[name]], shown)

    def sway(far: float, period_s: float) -> np.ndarray:
        return far * np.sin(2 * np.pi * (time_s - REST_S) / period_s) * begun

    aside, up = sway(0.25, 2.7), sway(0.1, 3.7)
    head = np.stack([sway(0.30, 4.5), sway(0.10, 3.1), sway(0.07, 5.3)], axis=1)
    return {"weights": weights, "gaze": np.stack([aside, up, aside, up], axis=1), "head": head}


@asynccontextmanager
async def drawing(width: int, height: int) -> AsyncIterator[aiohttp.ClientWebSocketResponse]:
    """A browser with the avatar, spoken to by its debugging protocol."""
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        modules = ROOT / "web" / "node_modules"
        source, bundle = ROOT / "docs" / "figures" / "acting.ts", place / "acting.js"
        subprocess.run(
            [modules / ".bin" / "esbuild", source, "--bundle", "--format=esm", f"--outfile={bundle}"],
            check=True,
            env={**os.environ, "NODE_PATH": str(modules)},
        )
        (place / "head.glb").write_bytes((ROOT / "track" / "page" / "static" / "head.glb").read_bytes())
        (place / "index.html").write_text(
            f"<!doctype html><style>body{{margin:0}}canvas{{width:{width}px;height:{height}px;display:block}}</style>"
            '<canvas></canvas><script type="module" src="acting.js"></script>'
        )
        app = web.Application()
        app.router.add_static("/", place)
        runner = web.AppRunner(app)
        await runner.setup()
        await web.TCPSite(runner, "127.0.0.1", 0).start()
        address = f"http://127.0.0.1:{runner.addresses[0][1]}/index.html"
        browser = subprocess.Popen(
            [*CHROMIUM, f"--user-data-dir={place / 'user'}", address],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            async with aiohttp.ClientSession() as client:
                async with client.ws_connect(await _page(client), max_msg_size=0) as socket:
                    yield socket
        finally:
            browser.terminate()
            browser.wait()
            await runner.cleanup()


async def _page(client: aiohttp.ClientSession) -> str:
    for _ in range(150):
        await asyncio.sleep(0.2)
        try:
            async with client.get("http://127.0.0.1:9377/json") as answer:
                pages = await answer.json()
        except aiohttp.ClientConnectionError:
            continue
        for page in pages:
            if page["url"].endswith("/index.html"):
                return page["webSocketDebuggerUrl"]
    raise SystemExit("Chromium did not start")


async def drawn(faces: Iterable[dict[str, list[float]]], *, width: int, height: int) -> list[np.ndarray]:
    """A picture (h, w, 3) uint8 of each face."""
    pictures = []
    async with drawing(width, height) as socket:
        await asyncio.sleep(5)
        for number, face in enumerate(faces):
            asked = {"expression": f"act({json.dumps(face)})", "awaitPromise": True, "returnByValue": True}
            await socket.send_json({"id": number, "method": "Runtime.evaluate", "params": asked})
            while (answer := await socket.receive_json()).get("id") != number:
                continue
            content = base64.b64decode(answer["result"]["result"]["value"].partition(",")[2])
            pictures.append(cv2.imdecode(np.frombuffer(content, dtype=np.uint8), cv2.IMREAD_COLOR))
    return pictures


def faces_of(acted: dict[str, np.ndarray]) -> list[dict[str, list[float]]]:
    """Each frame as the avatar takes it."""
    columns = zip(acted["weights"], acted["gaze"], acted["head"], strict=True)
    return [{"weights": w.round(4).tolist(), "gaze": g.tolist(), "head": h.tolist()} for w, g, h in columns]


def write_film(path: Path, pictures: list[np.ndarray], *, times: int = 1) -> None:
    """A film of pictures, several times over."""
    film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"mp4v"), FPS, pictures[0].shape[1::-1])
    for picture in pictures * times:
        film.write(picture)
    film.release()


def tracked(out: Path) -> dict[str, np.ndarray]:
    """What `track` makes of the film, with the neutral face of its rest."""
    track = [sys.executable, "-m", "track"]
    wishes = ["--fast", "--profile", str(out / "actor.toml")]
    subprocess.run([*track, "calibrate", "neutral", "--camera", str(out / "rest.mp4"), *wishes], check=True)
    answers = out / "answers.csv"
    run = ["--camera", str(out / "acting.mp4"), "--no-page", "--record", str(answers)]
    subprocess.run([*track, *run, *wishes], check=True)
    table = np.genfromtxt(answers, delimiter=",", names=True)

    def columns(names: Iterable[str]) -> np.ndarray:
        return np.stack([table[name] for name in names], axis=1)

    gaze = [f"{side}_eye_{angle}_deg" for side in ("left", "right") for angle in ("yaw", "pitch")]
    return {
        "weights": columns(BLENDSHAPES),
        "gaze": np.radians(columns(gaze)),
        "head": np.radians(columns(f"head_{angle}_deg" for angle in ("yaw", "pitch", "roll"))),
    }


def judge(acted: dict[str, np.ndarray], answers: dict[str, np.ndarray]) -> None:
    """Print the correlation of everything that moves."""
    found = []
    for column, name in enumerate(BLENDSHAPES):
        truth, answer = acted["weights"][:, column], answers["weights"][:, column]
        if truth.std() > 0.04:
            found.append(np.corrcoef(truth, answer)[0, 1])
            print(f"{name:<20} r {found[-1]:.2f}  mae {np.abs(truth - answer).mean():.3f}")
    print(f"median r {np.median(found):.2f} of {len(found)} shapes")
    for what in ("gaze", "head"):
        pairs = zip(acted[what].T, answers[what].T, strict=True)
        print(what, " ".join(f"{np.corrcoef(truth, answer)[0, 1]:.3f}" for truth, answer in pairs))


def side_by_side(film: list[np.ndarray], avatar: list[np.ndarray]) -> list[Image.Image]:
    """The film with its points, and the avatar, 604 x 300 pixels each."""
    detector, pictures = open_detector("mediapipe"), []
    for number, (picture, answer) in enumerate(zip(film, avatar, strict=True)):
        points = detector.step(Sample(time_s=number / FPS, pictures={"camera": picture})).points
        large = cv2.resize(picture, None, fx=2, fy=2, interpolation=cv2.INTER_CUBIC)
        for x, y in points:
            cv2.circle(large, (round(2 * x + 1), round(2 * y + 1)), 5, (200, 230, 60), -1, cv2.LINE_AA)
        left = cv2.resize(large[:, 160:1120], (300, 300), interpolation=cv2.INTER_AREA)
        right = cv2.resize(answer, (300, 300), interpolation=cv2.INTER_AREA)
        both = np.hstack([left, np.full((300, 4, 3), 255, dtype=np.uint8), right])
        pictures.append(Image.fromarray(both[..., ::-1]))
    detector.close()
    return pictures


def main() -> None:
    """Make all of it."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("out", type=Path)
    out = parser.parse_args().out
    out.mkdir(parents=True, exist_ok=True)
    acted = acting()
    np.savez(out / "acting.npz", **acted)
    film = asyncio.run(drawn(faces_of(acted), width=640, height=480))
    write_film(out / "acting.mp4", film)
    write_film(out / "rest.mp4", film[: int(REST_S * FPS)], times=6)
    answers = tracked(out)
    judge(acted, answers)
    avatar = asyncio.run(drawn(faces_of(answers), width=320, height=320))
    first, *others = side_by_side(film, avatar)[FPS:]
    first.save(
        out / "track.webp",
        save_all=True,
        append_images=others,
        duration=round(1000 / FPS),
        loop=0,
        quality=62,
    )


if __name__ == "__main__":
    main()
