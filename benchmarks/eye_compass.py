"""Counts how often the compass tells how an eye lies: in takes of drawn headsets, and in two films of real eyes.

    python -m benchmarks.eye_compass --data datasets/out/headset-any-test-arrays --real RECORDINGS

Takes are those of each eye's camera of a headset (or of a person); each is seen in all eight orientations. The films
come as other cameras would show them (`benchmarks/changed_eyes.py`), whole, on their right side and on the wrong one.
Margins are logarithms: of an eye upright, by how much its share is above that of the best other orientation, so that
less than 0 is wrong; of one on the wrong side the best other one's share above that of an eye upright. Prints Markdown,
which stands in docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np

from benchmarks.any_headset import headset_of_rows
from benchmarks.changed_eyes import changes
from benchmarks.real_eyes import FILMS, read_film
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.runtime.headset.network.parts import is_of_one_eye, side_of
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.compass import ORIENTATIONS, eye_compass

OF_RIGHT_EYE = {"film_a": True, "film_b": False}
"""Whether a film shows a right eye, by the look of its inner corner."""

TURNED = {"upside down": (4, 4), "on its side": (2, 6), "on its other side": (6, 2)}
"""Orientations of films that do not stand upright any more: of a left eye, and of a right one, seen in a mirror."""

VIEW = 96


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--data", action="append", default=[], help="Arrays; again for more.")
    parser.add_argument("--real", type=Path, help="Folder with eyes/film_a and eyes/film_b.")
    arguments = parser.parse_args()
    if arguments.data:
        print("| takes | orientations told right | smallest margin of an eye upright |\n|---|---|---|")
    for folder in arguments.data:
        print(row_of_takes(folder, read_arrays(folder)), flush=True)
    if arguments.real:
        films = [read_film(arguments.real / "eyes" / name) for name in FILMS]
        cells = " | ".join(f"{film.name}: right side | wrong side" for film in films)
        print(f"\n| change | {cells} |\n|{'---|' * (1 + 2 * len(films))}")
        for what, (_, change) in changes().items():
            if what == "mirrored" or what in TURNED:
                continue
            margins = [margin for film in films for margin in film_margins(change(film).pictures, film.name)]
            print(f"| {what} | {' | '.join(f'{margin:.1f}' for margin in margins)} |", flush=True)
        for what, true in TURNED.items():
            for film in films:
                of_right_eye = OF_RIGHT_EYE[film.name]
                shares = shares_of(changes()[what][1](film).pictures, of_right_eye=of_right_eye)
                told = "right" if np.argmax(shares) == true[of_right_eye] else f"wrong ({np.argmax(shares)})"
                print(f"{film.name}, {what}: {told}")


def row_of_takes(folder: str, arrays: HeadsetArrays) -> str:
    """A line of the first table."""
    rows = arrays.rows("test")
    groups = headset_of_rows(arrays, rows) if arrays.drawn else arrays.person[rows]
    right, margins = [], []
    for group in np.unique(groups):
        for camera in filter(is_of_one_eye, arrays.pictures):
            seen = np.array(arrays.pictures[camera][rows[groups == group]])
            eye = seen[:, :, ::-1] if side_of(camera) == "right" else seen
            for orientation in range(ORIENTATIONS):
                quarter, mirrored = divmod(orientation, 2)
                turned = np.rot90(eye, quarter, axes=(1, 2))
                turned = turned[:, :, ::-1] if mirrored else turned
                shares = eye_compass().log_shares(np.ascontiguousarray(turned), of_right_eye=False)
                right.append(int(np.argmax(shares)) == orientation)
                if orientation == 0:
                    margins.append(shares[0] - shares[1:].max())
    name = Path(folder).name.removesuffix("-arrays")
    return f"| {len(margins)} of {name} | {sum(right)} of {len(right)} | {min(margins):.1f} |"


def film_margins(pictures: np.ndarray, name: str) -> tuple[float, float]:
    """On the right side and on the wrong one."""
    shares = shares_of(pictures, of_right_eye=OF_RIGHT_EYE[name])
    wrong = shares_of(pictures, of_right_eye=not OF_RIGHT_EYE[name])
    return float(shares[0] - shares[1:].max()), float(wrong[1:].max() - wrong[0])


def shares_of(pictures: np.ndarray, *, of_right_eye: bool) -> np.ndarray:
    """(8,) mean logarithms of squares as wide as the pictures."""
    views = np.stack([CameraPlacement().view(one, width=VIEW, height=VIEW) for one in pictures])
    return eye_compass().log_shares(views, of_right_eye=of_right_eye)


if __name__ == "__main__":
    main()
