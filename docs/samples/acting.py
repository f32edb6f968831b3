"""Make acting-avatar.webm and acting-avatar.csv: ``python docs/samples/acting.py``, after ``facegen rig build``.

The avatar that ``facegen rig export`` writes acts before a camera in a headless Chromium (``npm ci`` in web/ brings
what draws it), and the table says what it did: 52 weights, gaze and head in each picture. It rests for a second; then
each expression comes and goes, some together, while head and eyes wander. 400 pictures take some minutes.
"""

import asyncio
import base64
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
from aiohttp import web

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT))

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES  # noqa: E402
from facegen.formats.film import encode_film  # noqa: E402
from regress.runtime.stages.gaze import LOOKS, look_weights  # noqa: E402
from tests.browser import chromium  # noqa: E402

FOLDER = Path(__file__).parent
FPS, REST_S, EACH_S, BEHIND_S = 30, 1.0, 1.1, 0.42
WIDTH, HEIGHT = 400, 300
ANGLES = (
    "left_eye_yaw",
    "left_eye_pitch",
    "right_eye_yaw",
    "right_eye_pitch",
    "head_yaw",
    "head_pitch",
    "head_roll",
)
SEED = 20261123

EXPRESSIONS: tuple[dict[str, float], ...] = (
    {"mouthSmile*": 0.8, "cheekSquint*": 0.5},
    {"eyeBlink*": 1.0},
    {"jawOpen": 0.7},
    {"browInnerUp": 0.8, "browOuterUp*": 0.8, "eyeWide*": 0.4},
    {"mouthPucker": 0.8},
    {"browDown*": 0.8, "eyeSquint*": 0.5},
    {"mouthFunnel": 0.7, "jawOpen": 0.25},
    {"eyeBlinkLeft": 1.0},
    {"mouthLeft": 0.6},
    {"mouthRight": 0.6},
    {"eyeBlink*": 1.0},
    {"mouthStretch*": 0.7, "mouthLowerDown*": 0.4},
    {"mouthUpperUp*": 0.7, "noseSneer*": 0.5},
    {"mouthFrown*": 0.7, "mouthShrugLower": 0.5},
    {"jawLeft": 0.6},
    {"eyeBlinkRight": 1.0},
    {"jawRight": 0.6},
    {"mouthRollLower": 0.7, "mouthRollUpper": 0.6},
    {"mouthPress*": 0.6, "mouthDimple*": 0.5},
    {"mouthSmileLeft": 0.7},
    {"eyeBlink*": 1.0},
    {"mouthSmileRight": 0.7},
    {"mouthShrugUpper": 0.6, "mouthLowerDown*": 0.3},
    {"cheekPuff": 0.7},
    {"jawOpen": 0.4, "mouthSmile*": 0.5, "browInnerUp": 0.4},
    {"eyeSquint*": 0.6},
    {"jawForward": 0.6},
    {"jawOpen": 0.5, "mouthClose": 0.4},
)
"""In their order; ``*`` is Left and Right."""


def acting() -> tuple[np.ndarray, np.ndarray]:
    """Weights (n, 52), and angles (n, 7) in radians in the order of `ANGLES`."""
    count = round(FPS * (REST_S + EACH_S + BEHIND_S * len(EXPRESSIONS)))
    time_s = np.arange(count) / FPS
    weights = np.zeros((count, len(BLENDSHAPES)))
    for number, expression in enumerate(EXPRESSIONS):
        phase = np.clip((time_s - REST_S - BEHIND_S * number) / EACH_S, 0, 1)
        amount = np.sin(np.pi * phase) ** 2
        for name, most in expression.items():
            for side in ("Left", "Right") if name.endswith("*") else ("",):
                column = BLENDSHAPE_INDEX[name.removesuffix("*") + side]
                weights[:, column] = np.maximum(weights[:, column], most * amount)
    rng = np.random.default_rng(SEED)
    acted = np.clip(time_s - REST_S, 0, None)[:, None]
    most_rad = np.radians([16, 9, 16, 9, 18, 9, 6])
    periods_s, begun = np.array([2.7, 3.7, 2.7, 3.7, 5.1, 4.3, 6.7]), np.minimum(acted, 1)
    aside = rng.uniform(0, 0.4, len(ANGLES))
    aside[2:4] = aside[:2]  # both eyes look at one place
    angles = most_rad * begun * np.sin(2 * np.pi * acted / periods_s + aside * begun)
    weights[:, LOOKS] = [look_weights(gaze) for gaze in angles[:, :4]]
    return weights, angles


def filmed(weights: np.ndarray, angles: np.ndarray, *, width: int, height: int) -> list[np.ndarray]:
    """What a camera sees of the avatar that acts so, RGB (height, width, 3) each."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        export = [sys.executable, "-m", "facegen", "rig", "export", "anny", "--out", folder / "head.glb"]
        subprocess.run(export, check=True)
        bundle = ["node_modules/.bin/esbuild", FOLDER / "acting.ts", "--bundle", "--format=esm"]
        # what the page imports lies in web/, and this file does not
        environment = {
            "NODE_PATH": str(ROOT / "web" / "node_modules"),
            "PATH": "/usr/local/bin:/usr/bin:/bin",
        }
        subprocess.run(
            [*bundle, f"--outfile={folder / 'acting.js'}"], cwd=ROOT / "web", check=True, env=environment
        )
        canvas = f'<canvas style="width: {width}px; height: {height}px"></canvas>'
        (folder / "acting.html").write_text(
            f'<!doctype html>{canvas}<script type="module" src="acting.js"></script>'
        )
        return asyncio.run(_pictures(weights, angles, folder))


async def _pictures(weights: np.ndarray, angles: np.ndarray, folder: Path) -> list[np.ndarray]:
    app = web.Application()
    app.router.add_static("/", folder)
    runner = web.AppRunner(app)
    await runner.setup()
    await web.TCPSite(runner, "127.0.0.1", 0).start()
    address = f"http://127.0.0.1:{runner.addresses[0][1]}/acting.html"
    seen = []
    async with chromium() as browser, browser.open(address) as tab:
        await tab.until("window.act", seconds=60)
        for row, turn in zip(weights.round(4).tolist(), angles.round(5).tolist(), strict=True):
            drawn = await tab.ask(f"act({json.dumps(row)}, {json.dumps(turn[:4])}, {json.dumps(turn[4:])})")
            content = np.frombuffer(base64.b64decode(drawn), dtype=np.uint8)
            seen.append(cv2.imdecode(content, cv2.IMREAD_COLOR)[..., ::-1])
    await runner.cleanup()
    return seen


def main() -> None:
    """Film the avatar, and write the table of what it did."""
    weights, angles = acting()
    seen = filmed(weights, angles, width=WIDTH, height=HEIGHT)
    encode_film(FOLDER / "acting-avatar.webm", seen, fps=FPS)
    header = ["frame", "time_s", *BLENDSHAPES, *(f"{name}_deg" for name in ANGLES)]
    lines = [",".join(header)]
    for number, (row, turn) in enumerate(zip(weights, np.degrees(angles), strict=True)):
        cells = [f"{value:.4g}" for value in (*row, *turn.round(2))]
        lines.append(",".join([str(number), f"{number / FPS:.4f}", *cells]))
    (FOLDER / "acting-avatar.csv").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
