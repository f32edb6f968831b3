"""Draws docs/pictures/track.webp: the sample's film with a detector's points, and the avatar that `track` moves by it.

    python docs/figures/track.py

The film is docs/samples/acting-avatar.webm; the face of its first second, at rest, is the neutral one. Needs Chromium,
Node with what `npm ci` brings into web/, and the rig; MediaPipe's model file is fetched where it is not there yet.
"""

import subprocess
import sys
import tempfile
from pathlib import Path

import cv2
import numpy as np
from PIL import Image

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT), str(ROOT / "docs/samples")]

from acting import ANGLES, FPS, REST_S, filmed  # noqa: E402

from facegen.conventions import BLENDSHAPES  # noqa: E402
from facegen.formats.film import encode_film  # noqa: E402
from regress.runtime.sample import Sample  # noqa: E402
from track.detectors import open_detector  # noqa: E402
from track.sources import Pace, open_source  # noqa: E402

FILM = ROOT / "docs/samples/acting-avatar.webm"
SIDE, GAP, STEP, FRAMES = 240, 4, 3, 80
"""Pixels of each picture and between them; every which frame is shown, and how many of them."""
FACE = 0.75
"""Share of the film's height that the head moves in."""
POINT = (60, 230, 200)
"""RGB."""


def seen_frames() -> list[np.ndarray]:
    """The film's pictures, RGB (h, w, 3)."""
    source, pictures = open_source(str(FILM), Pace(fast=True)), []
    while (picture := source.read()) is not None:
        pictures.append(picture.pixels[..., ::-1])
    source.close()
    return pictures


def followed(film: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Weights (n, 52) and angles (n, 7) in radians that `track` finds, with the film's rest as neutral face."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        encode_film(folder / "rest.webm", film[: int(REST_S * FPS)] * 6, fps=FPS)
        wishes = ["--fast", "--profile", str(folder / "actor.toml")]
        track = [sys.executable, "-m", "track"]
        rest = ["--camera", str(folder / "rest.webm"), *wishes]
        subprocess.run([*track, "calibrate", "neutral", *rest], check=True, cwd=ROOT)
        run = ["--camera", str(FILM), "--no-page", "--record", str(folder / "answers.csv"), *wishes]
        subprocess.run([*track, "run", *run], check=True, cwd=ROOT)
        table = np.genfromtxt(folder / "answers.csv", delimiter=",", names=True)
    angles = np.stack([table[f"{name}_deg"] for name in ANGLES], axis=1)
    return np.stack([table[name] for name in BLENDSHAPES], axis=1), np.radians(angles)


def pointed(film: list[np.ndarray]) -> list[np.ndarray]:
    """Each picture with what the detector sees in it, RGB."""
    detector, drawn = open_detector("mediapipe"), []
    for number, picture in enumerate(film):
        sample = Sample(time_s=number / FPS, pictures={"camera": np.ascontiguousarray(picture[..., ::-1])})
        points = detector.step(sample).points
        large = cv2.resize(picture, None, fx=2, fy=2, interpolation=cv2.INTER_CUBIC)
        for x, y in 2 * points + 0.5:
            cv2.circle(large, (round(x), round(y)), 4, POINT, -1, cv2.LINE_AA)
        drawn.append(large)
    detector.close()
    return drawn


def face_of(picture: np.ndarray) -> np.ndarray:
    """The head, cut from a picture of the film's proportions, (SIDE, SIDE, 3)."""
    height, width = picture.shape[:2]
    side = round(FACE * height)
    top, left = round(0.08 * height), (width - side) // 2
    return cv2.resize(
        picture[top : top + side, left : left + side], (SIDE, SIDE), interpolation=cv2.INTER_AREA
    )


def main() -> None:
    """Let `track` follow the film, draw the avatar that it moves, and put both beside one another."""
    film = seen_frames()
    shown = slice(int(REST_S * FPS), int(REST_S * FPS) + STEP * FRAMES, STEP)
    weights, angles = followed(film)
    avatars = filmed(weights[shown], angles[shown], width=800, height=600)
    gap = np.full((SIDE, GAP, 3), 255, dtype=np.uint8)
    first, *others = (
        Image.fromarray(np.hstack([face_of(left), gap, face_of(right)]))
        for left, right in zip(pointed(film)[shown], avatars, strict=True)
    )
    first.save(
        ROOT / "docs/pictures/track.webp",
        save_all=True,
        append_images=others,
        duration=round(1000 * STEP / FPS),
        loop=0,
        quality=45,
        method=6,
    )


if __name__ == "__main__":
    main()
