"""Compares datasets with other heads and winks, and recipes of other noise and size: one line a trial, as Markdown.

    python benchmarks/experiments/bench_sweep.py WORK [--faces 6000] [--only "NAME;NAME"] [--real RECORDINGS]

Datasets are `datasets/default.toml` with other heads or winks; `facegen generate` makes the missing ones in WORK. All
trials are judged on one of them, "heads 6/6, 5 %", on its test people: exact points, beside a neutral frame that has as
much noise as the face. Columns: mean R2 of the visible shapes frontal, and what is lost of it within 20 degrees
(probes.poses); what is said of the shut and of the open eye in a wink, and of both where both are shut
(probes.winks); mean R2 over all shapes at five levels of noise, with how many lie more than 0.01 below ridge
regression on the same rows; with --real, the error on recorded expressions of another rig at 0.5 px
(benchmarks/real_recordings.py) and r of mouthClose there. docs/measurements/landmark-networks.md has a run's table.
"""

import argparse
import os
import re
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")  # the fit has threads of its own

import numpy as np

sys.path.insert(
    0, str(Path(__file__).parents[1])
)  # the modules beside it find each other by their names alone

from replay import mean_mae, play, replay

from facegen.rigs import load_rig
from regress.learning.probes.faces import ProbeFaces, read_faces
from regress.learning.probes.methods import networks_of, ridges_of
from regress.learning.probes.observability import NOISE_PERCENT, observability
from regress.learning.probes.poses import pose_errors
from regress.learning.probes.winks import winks
from regress.learning.training import RECIPES, Recipe, read_dataset, train
from regress.learning.training.noise import DetectorNoise
from regress.runtime.model import Model
from regress.targets import OUTPUTS, VISIBLE_SHAPES

SPEC = Path(__file__).parents[2] / "datasets" / "default.toml"
PEOPLE_FACES = 10
"""Faces of each person in that spec."""
TAKE_NOISE_PX = 0.5
VISIBLE = [OUTPUTS.index(shape) for shape in VISIBLE_SHAPES]
DEFAULT = RECIPES["default"]


@dataclass(frozen=True, kw_only=True)
class Data:
    """Standard deviations of yaw and pitch, and the share of one-sided faces."""

    yaw_deg: int = 12
    pitch_deg: int = 10
    one_sided: float = 0.15

    @property
    def name(self) -> str:
        return f"heads {self.yaw_deg}/{self.pitch_deg}, {100 * self.one_sided:g} %"

    def spec(self, people: int) -> str:
        """The default dataset's spec with these values, and no pictures."""
        text = SPEC.read_text(encoding="utf-8")
        most = {axis: max(20, round(2.5 * sd)) for axis, sd in self._heads().items()}
        for pattern, value in (
            (r"(?m)^people = .*$", f"people = {people}"),
            (
                r"(?m)^yaw_deg = .*$",
                f"yaw_deg = {{ normal = [0, {self.yaw_deg}], within = [-{most['yaw']}, {most['yaw']}] }}",
            ),
            (
                r"(?m)^pitch_deg = .*$",
                f"pitch_deg = {{ normal = [0, {self.pitch_deg}], within = [-{most['pitch']}, {most['pitch']}] }}",
            ),
            (r"(?m)^one_sided = .*$", f"one_sided = {self.one_sided:g}"),
            (r"(?s)\[render\].*", ""),
        ):
            text, count = re.subn(pattern, value, text)
            if count != 1:
                sys.exit(
                    f"{SPEC}: {pattern} matches {count} times, and once is needed; change bench_sweep.py"
                )
        return text

    def _heads(self) -> dict[str, int]:
        return {"yaw": self.yaw_deg, "pitch": self.pitch_deg}


def _noisy(**values: float) -> Recipe:
    def changed(noise: DetectorNoise) -> DetectorNoise:
        return replace(noise, **values)

    return replace(DEFAULT, noise=changed(DEFAULT.noise), calibrated_noise=changed(DEFAULT.calibrated_noise))


LESS_NOISE = {"clean": 0.5, "unbiased": 0.2, "jitter": 0.0005, "jitter_most": 0.02}
JUDGE = Data(yaw_deg=6, pitch_deg=6, one_sided=0.05)
TRIALS: dict[str, tuple[Data, Recipe]] = {
    "heads 6/6, 5 % one-sided, less noise": (JUDGE, _noisy(**LESS_NOISE)),
    "heads 6/6, 15 %, less noise": (replace(JUDGE, one_sided=0.15), _noisy(**LESS_NOISE)),
    "heads 12/10, 15 %, less noise": (Data(), _noisy(**LESS_NOISE)),
    "the same, turn left as it is": (Data(), replace(_noisy(**LESS_NOISE), undo_turn=False)),
    "default": (Data(), DEFAULT),
    "default, 40 hidden units": (Data(), replace(DEFAULT, hidden=40)),
    "default, jitter to 5 %": (Data(), _noisy(jitter_most=0.05)),
    "default, half of the faces with jitter": (Data(), _noisy(clean=0.2, unbiased=0.5)),
    "default, jitter from 0.5 to 4 %": (Data(), _noisy(jitter=0.005, jitter_most=0.04)),
}


def made(work: Path, data: Data, people: int) -> Path:
    """Folder of a dataset, made where it is missing."""
    folder = work / f"{data.yaw_deg}-{data.pitch_deg}-{round(100 * data.one_sided)}-{people}"
    if not (folder / "dataset.json").exists():
        work.mkdir(parents=True, exist_ok=True)
        spec = folder.with_suffix(".toml")
        spec.write_text(data.spec(people), encoding="utf-8")
        command = [sys.executable, "-m", "facegen", "generate", str(spec), "--out", str(folder)]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder


def judged(model: Model, dataset_folder: Path, faces: ProbeFaces, neutral: ProbeFaces) -> list[str]:
    """Cells of one trial: what its networks beside a neutral frame do."""
    networks = [method for method in networks_of(model) if method.calibrated]
    floors = [
        method
        for method in ridges_of(model, read_dataset(dataset_folder))
        if method.calibrated and method.name == "ridge, same rows"
    ]
    (turned,) = pose_errors(networks, faces, neutral)
    wink = winks(networks[0], faces, neutral)
    found, floor = (each.r2 for each in observability((*networks, *floors), faces, neutral))
    return [
        f"{np.nanmean(turned.frontal_r2[VISIBLE]):.3f}",
        f"{np.nanmean(turned.loss[VISIBLE]):.3f}",
        f"{wink.shut:.2f}, {wink.leak:.2f}, {wink.both:.2f}",
        *(
            f"{np.nanmean(row):.3f}, {np.sum(row < least - 0.01)}"
            for row, least in zip(found, floor, strict=True)
        ),
    ]


def replayed(model: Model, real: Path) -> list[str]:
    """Cells of the recorded expressions: error of either take, and r of mouthClose in the range of motion."""
    played = play(real, load_rig("ict"), people=4, step=4)
    judged = replay(model, {}, played, noises=(TAKE_NOISE_PX,), biased=(False,))
    rows = {row["take"]: row["model"] for row in judged}
    errors = " ".join(f"{mean_mae(row):.3f}" for row in rows.values())
    return [errors, f"{rows['range of motion']['mouthClose']['r']:.2f}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("work", type=Path, help="folder of the datasets")
    parser.add_argument("--faces", type=int, default=6000, help="of each dataset, all splits together")
    parser.add_argument("--only", default=";".join(TRIALS), help="trials, joined by semicolons")
    parser.add_argument("--real", type=Path, help="folder of the recordings; needs the rig ict")
    parser.add_argument("--seed", type=int, default=0)
    arguments = parser.parse_args()
    people = arguments.faces // PEOPLE_FACES
    faces, neutral = read_faces(made(arguments.work, JUDGE, people)).beside_neutral("test")
    head = ["trained on", "CPU s", "frontal R²", "loss within ±20°", "wink: shut, open, both"]
    head += [f"{percent:g} %" for percent in NOISE_PERCENT]
    if arguments.real:
        head += ["takes", "mouthClose"]
    print("| " + " | ".join(head) + " |\n|" + "---|" * len(head), flush=True)
    for name in filter(None, map(str.strip, arguments.only.split(";"))):
        data, recipe = TRIALS[name]
        folder = made(arguments.work, data, people)
        began = time.process_time()
        model = train(read_dataset(folder), recipe, seed=arguments.seed)
        cells = [name, f"{time.process_time() - began:.0f}", *judged(model, folder, faces, neutral)]
        if arguments.real:
            cells += replayed(model, arguments.real)
        print("| " + " | ".join(cells) + " |", flush=True)


if __name__ == "__main__":
    main()
