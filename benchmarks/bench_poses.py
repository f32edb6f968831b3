"""Measures what a turned head costs each shape: frontal R2 less R2 within +-20 degrees of yaw and pitch, by model.

    python benchmarks/bench_poses.py DATASET MODEL [MODEL ...] [--json]

DATASET is what all MODELs were trained on. A thousand faces of people of the test split, exact points, are turned to a
grid of poses 10 degrees apart (probes.poses); with a neutral frame, that frame is frontal.
docs/measurements/landmark-networks.md has a run's table.
"""

import argparse
import json
from pathlib import Path

import numpy as np

from regress import load_model
from regress.learning.probes.faces import read_faces
from regress.learning.probes.methods import networks_of
from regress.learning.probes.poses import PoseErrors, pose_errors
from regress.targets import OUTPUTS, VISIBLE_SHAPES


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("models", type=Path, nargs="+")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    faces, neutral = read_faces(arguments.dataset).beside_neutral("test")
    found: dict[str, PoseErrors] = {}
    for folder in arguments.models:
        for errors in pose_errors(networks_of(load_model(folder)), faces, neutral):
            found[f"{folder.name}{' + neutral' if errors.calibrated else ''}"] = errors
    if arguments.json:
        rows = {
            name: {"frontal_r2": list(errors.frontal_r2), "loss": list(errors.loss)}
            for name, errors in found.items()
        }
        print(json.dumps({"shapes": OUTPUTS, **rows}))
        return
    print(f"{'frontal R2 / loss':<20}", *(f"{name:>22}" for name in found))
    for row, shape in enumerate(OUTPUTS):
        print(f"{shape:<20}", *(_cell(errors.frontal_r2[row], errors.loss[row]) for errors in found.values()))
    for over, shapes in (("visible shapes", VISIBLE_SHAPES), ("all shapes", OUTPUTS)):
        rows = [OUTPUTS.index(shape) for shape in shapes]
        print(
            f"{over:<20}",
            *(
                _cell(np.nanmean(errors.frontal_r2[rows]), np.nanmean(errors.loss[rows]))
                for errors in found.values()
            ),
        )
    first = next(iter(found.values()))
    for name, errors in list(found.items())[1:]:
        half = errors.loss < first.loss / 2
        print(f"{name}: loss below half of the first model's on {half.sum()} of {len(OUTPUTS)} shapes")


def _cell(frontal: float, loss: float) -> str:
    return f"{frontal:14.3f} {loss:7.3f}"


if __name__ == "__main__":
    main()
