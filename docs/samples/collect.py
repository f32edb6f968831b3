"""Gather the samples of ``make samples``: ``python docs/samples/collect.py TAKE.csv DATASET``.

The take is the CSV of ``facegen pack --format openface``, the dataset the one of docs/samples/headset.toml. Beside them
stand the answers of the ready-made models, to hold an installation against: every
tenth row of the landmarks' and every row of the pictures'.
"""

import shutil
import sys
from pathlib import Path

from regress.cli import app
from regress.runtime.ready_made import HEADSET, ready_made_models

FOLDER = Path(__file__).parent
CAMERAS = ("left_eye", "right_eye", "mouth")
EVERY = 10


def predict(*words: str) -> None:
    """Run ``regress`` with these words."""
    app(list(words), standalone_mode=False)


def landmarks(take: Path) -> None:
    """The talking face and every tenth row of its weights."""
    shutil.copyfile(take, FOLDER / "talking-face.csv")
    weights = FOLDER / "talking-face.weights.csv"
    predict("predict", str(FOLDER / "talking-face.csv"), "--neutral", "1-30", "--out", str(weights))
    header, *rows = weights.read_text().splitlines(keepends=True)
    weights.write_text("".join([header, *rows[::EVERY]]))


def pictures(dataset: Path) -> None:
    """The cameras' pictures, numbered from 0, and their weights where there is a model of this headset."""
    samples = sorted((dataset / "renders").glob("*/*/sample.json"))
    for camera in CAMERAS:
        shutil.rmtree(FOLDER / "headset" / camera, ignore_errors=True)
        (FOLDER / "headset" / camera).mkdir(parents=True)
        for number, sample in enumerate(samples):
            shutil.copyfile(
                sample.parent / f"{camera}.png", FOLDER / "headset" / camera / f"{number:03d}.png"
            )
    if HEADSET not in ready_made_models():
        print(f"no ready-made model {HEADSET}: headset.weights.csv is left out", file=sys.stderr)
        return
    paths = [word for camera in CAMERAS for word in ("--camera", f"{camera}={FOLDER / 'headset' / camera}")]
    predict("headset", "predict", *paths, "--neutral", "0", "--out", str(FOLDER / "headset.weights.csv"))


if __name__ == "__main__":
    landmarks(Path(sys.argv[1]))
    pictures(Path(sys.argv[2]))
