"""Counts how often `regress headset predict` takes pictures for turned, mirrored or another camera's.

    python benchmarks/headset_orientation.py models/headset --data test=datasets/out/headset-test-arrays --data rig=...

One camera of a person is changed at a time; cells are percentages of takes of which it is said. Where nothing is done
it should not be. Prints Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from collections.abc import Callable
from pathlib import Path

import numpy as np

from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.runtime.headset.network.parts import mirror_partner
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.placing.orientation import told_orientation
from regress.runtime.headset.recordings.footage import Footage

TURNS: dict[str, Callable[[np.ndarray], np.ndarray]] = {
    "nothing": lambda pictures: pictures,
    "turned by 90° to the left": lambda pictures: np.rot90(pictures, 1, (1, 2)),
    "turned by 90° to the right": lambda pictures: np.rot90(pictures, -1, (1, 2)),
    "turned by 180°": lambda pictures: pictures[:, ::-1, ::-1],
    "upside down in a mirror": lambda pictures: pictures[:, ::-1],
    "in a mirror": lambda pictures: pictures[:, :, ::-1],
}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("--data", required=True, action="append", metavar="NAME=ARRAYS")
    arguments = parser.parse_args()
    typical = load_headset_predictor(arguments.model).typical
    if not typical:
        parser.error(f"{arguments.model} was trained before models had typical pictures")
    found: dict[tuple[str, str], dict[str, str]] = {}
    people = {}
    for pair in arguments.data:
        name, _, folder = pair.partition("=")
        arrays = read_arrays(Path(folder))
        people[name] = len(np.unique(arrays.person))
        for key, told in shares_told(arrays, typical).items():
            found.setdefault(key, {})[name] = f"{100 * told:.0f}"
    head = "".join(f" {name} ({count} people) |" for name, count in people.items())
    print(f"| camera | what is done to it |{head}\n|---|---|{'---|' * len(people)}")
    for (camera, change), cells in found.items():
        print(f"| {camera} | {change} | {' | '.join(cells.get(name, '') for name in people)} |")


def shares_told(arrays: HeadsetArrays, typical: dict[str, np.ndarray]) -> dict[tuple[str, str], float]:
    """Share of a set's takes told, by camera and change; a camera and its mirror image count together."""
    told: dict[tuple[str, str], list[bool]] = {}
    for person in np.unique(arrays.person):
        rows = np.flatnonzero(arrays.person == person)
        taken = {name: np.asarray(arrays.pictures[name][rows]) for name in typical}
        for name in taken:
            partner = mirror_partner(name)
            pair = name if partner == name else " or ".join(sorted({name, partner}))
            changes = {what: turn(taken[name]) for what, turn in TURNS.items()}
            changes |= {
                "the other eye's" if other == partner else f"{other}'s": taken[other]
                for other in taken
                if other != name
            }
            for what, pictures in changes.items():
                lines = told_orientation(footage_of(taken | {name: pictures}), typical)
                said = any(line.startswith(f"{name}:") for line in lines)
                told.setdefault((pair, what), []).append(said)
    return {key: float(np.mean(values)) for key, values in told.items()}


def footage_of(pictures: dict[str, np.ndarray]) -> Footage:
    """Sound footage of these pictures."""
    count = len(next(iter(pictures.values())))
    return Footage(
        cameras=tuple(pictures),
        numbers=np.arange(count),
        pictures=pictures,
        faults={name: (None,) * count for name in pictures},
        time_s=None,
        source="",
        notes=(),
    )


if __name__ == "__main__":
    main()
