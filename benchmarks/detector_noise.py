"""Measures the jitter of a detector on a recording, region by region: the row of `regress/data/detectors.json`.

    python benchmarks/detector_noise.py RECORDINGS/landmarks/openface_sequence.csv

Faces are laid upon their mean by a similarity. Second differences from frame to frame take off what moves slowly: their
standard deviation (by the median, so blinks do not count) over the root of 6 is the jitter of a coordinate where frames
have nothing in common, and a lower bound where they have. `memory` says how much they have: the correlation of one
second difference with the next is -0.67 for noise without memory, and rises with it.
"""

import argparse
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from regress.learning.training.noise import OUTER_EYES
from regress.runtime.inputs import read_frames


def laid(points: np.ndarray) -> np.ndarray:
    """Faces (n, 68, 2) turned, scaled and shifted onto their mean, outer-eye distances."""
    centred = points - points.mean(axis=1, keepdims=True)
    mean = centred.mean(axis=0)
    right, left = OUTER_EYES
    laid_on = []
    for face in centred:
        u, spread, vt = np.linalg.svd(face.T @ mean)
        laid_on.append(face @ (u @ vt) * spread.sum() / np.square(face).sum())
    return np.array(laid_on) / np.linalg.norm(mean[left] - mean[right])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("recording", type=Path)
    faces = laid(read_frames(parser.parse_args().recording).points)
    change = np.diff(faces, n=2, axis=0)
    print(
        f"{len(faces)} frames\n\n| region | jitter of a coordinate, % of the outer eyes' distance | memory |"
        "\n|---|---|---|"
    )
    for group, numbers in LANDMARK_GROUPS.items():
        mine = change[:, list(numbers)].reshape(len(change), -1)
        jitter = 1.4826 * np.median(np.abs(mine)) / np.sqrt(6)
        memory = np.mean([np.corrcoef(course[:-1], course[1:])[0, 1] for course in mine.T])
        print(f"| {group} | {100 * jitter:.3f} | {memory:.2f} |")


if __name__ == "__main__":
    main()
