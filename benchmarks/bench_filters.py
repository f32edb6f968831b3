"""Measures filters over weights, as live streams have them: what they take off, and by how much they come late.

    python benchmarks/bench_filters.py models/default --real RECORDINGS --json filters.json

Two takes of an iPhone's 52 weights (Live Link Face, 30 frames a second; smooth curves are laid through them for other
rates), played by people of the rig `ict`, projected to 68 points of 100 px between the outer eye corners at rest, and
disturbed: a detector's bias that stays, and jitter of every point and frame. Ten neutral frames are given. Each filter
of `regress predict --filter` sees the model's weights frame by frame, and so do two that are no better: a Kalman filter
with the test errors of the model's record as noise, and one of constant velocity.

By filter and rate: mean absolute error and median r (over shapes that move: standard deviation 0.05 or more);
stillness, the root mean square over shapes of the standard deviation on a still face; the height of blinks as a share
of the same model's without jitter; and the delay of steps of the input from 0 to 1 and to 0.2: waiting and lag
together.
"""

import argparse
import json
import platform
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

import numpy as np
from replay import MOVES_SD, NEUTRAL_FRAMES, SEED, TAKES, correlation
from scipy.interpolate import PchipInterpolator
from scipy.signal import find_peaks, peak_widths
from small_movements import OUTER_EYE_PX, project

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.formats import read_live_link
from facegen.rigs import Rig, load_rig
from regress import Model, load_model
from regress.learning.training.noise import displace, draw_bias
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILTERS
from regress.runtime.stages.kalman import NOISE_LEAST, SURPRISE, KalmanSmoothing
from regress.runtime.stages.output import filter_stage
from regress.runtime.stages.stage import Chain, DelayingStage, Stage
from regress.targets import OUTPUTS

RATES = (15, 24, 30, 60)
DENSE_RATE = 120
"""Of the curves that the frames of each rate are taken from: a multiple of all."""
SHAPES = [BLENDSHAPE_INDEX[name] for name in OUTPUTS]
STILL_FRAMES = 600
SETTLED = 60
"""Frames of a still face before its jitter counts."""
BLINK_S = 0.2
"""Peaks of eyeBlink that are narrower than this at half their height are blinks."""
BLINK_LEAST = 0.3
STEPS = (1.0, 0.2)


class ConstantVelocity(DelayingStage):
    """A Kalman filter of weights that keep their speed, without looking ahead; accelerated where they surprise."""

    def __init__(self, noise: np.ndarray, acceleration: float = 1.0) -> None:
        self._seen, self._acceleration = noise**2, acceleration
        self._time: float | None = None

    def feed(self, sample: Sample) -> list[Sample]:
        row = sample.weights
        if self._time is None:
            self._mean = np.stack([row, np.zeros_like(row)])
            self._spread = np.stack(
                [np.diag([seen, 1.0]) for seen in self._seen]
            )  # weights reach 1 in a second at most
        else:
            seconds = sample.time_s - self._time
            move = np.array([[1, seconds], [0, 1]])
            push = np.array([[seconds**3 / 3, seconds**2 / 2], [seconds**2 / 2, seconds]])
            mean = move @ self._mean
            spread = move @ self._spread @ move.T + self._acceleration * push
            surprise = row - mean[0]
            lacking = np.maximum((surprise / SURPRISE) ** 2 - spread[:, 0, 0] - self._seen, 0)
            spread = spread + (lacking / push[0, 0])[:, None, None] * push
            share = spread[:, :, 0] / (spread[:, 0, 0] + self._seen)[:, None]
            self._mean = mean + share.T * surprise
            self._spread = spread - share[:, :, None] * spread[:, None, 0, :]
        self._time = sample.time_s
        return [Sample(label=sample.label, time_s=sample.time_s, weights=self._mean[0])]


def filters(model: Model) -> dict[str, Callable[[], Stage]]:
    """What is measured, by name: new stages for each take."""
    made: dict[str, Callable[[], Stage]] = {"none": lambda: Chain([])}
    for name in FILTERS:
        made[name] = lambda name=name: filter_stage(name)
    if model.record is not None:
        noise = np.full(len(BLENDSHAPE_INDEX), NOISE_LEAST)
        for shape in OUTPUTS:
            noise[BLENDSHAPE_INDEX[shape]] = model.record.scores[shape]["calibrated"].mae
        made["Kalman, 33 ms ahead, noise of the record"] = lambda: KalmanSmoothing(1 / 30, noise=noise)
        made["Kalman of constant velocity, noise of the record"] = lambda: ConstantVelocity(noise)
    return made


def samples(weights: np.ndarray, rate: int) -> list[Sample]:
    """Frames of weights (n, 52)."""
    return [Sample(label=str(row), time_s=row / rate, weights=each) for row, each in enumerate(weights)]


def filtered(stage: Stage, weights: np.ndarray, rate: int) -> np.ndarray:
    """What leaves a stage (n, 52)."""
    return np.stack([sample.weights for sample in stage.run(samples(weights, rate))])


def seen(
    model: Model, rig: Rig, real: Path, people: int, noise_px: float
) -> dict[str, dict[str, np.ndarray]]:
    """By take, at `DENSE_RATE`: true weights, and those of the model with and without jitter, and still."""
    rng = np.random.default_rng(SEED)
    identities, biases = rng.standard_normal((people, rig.components)), draw_bias(rng, people)
    jitter = np.random.default_rng([SEED, round(10 * noise_px)])
    takes = {}
    for name, path in TAKES.items():
        take = read_live_link(real / path)
        course = PchipInterpolator(take.time_s, take.weights)
        true = np.clip(course(np.arange(0, take.time_s[-1], 1 / DENSE_RATE)), 0, 1)
        rest = np.zeros((NEUTRAL_FRAMES, true.shape[1]))
        found = {"noisy": [], "exact": [], "still": []}
        for identity, bias in zip(identities, biases, strict=True):
            points = project(rig, identity, np.concatenate([rest, true]))
            points = displace(points, np.broadcast_to(bias, points.shape))
            noisy = points + noise_px * jitter.standard_normal(points.shape)
            still = points[:1] + noise_px * jitter.standard_normal((STILL_FRAMES, *points.shape[1:]))
            of_person = model.calibrate(noisy[:NEUTRAL_FRAMES])
            found["noisy"].append(of_person.predict(noisy[NEUTRAL_FRAMES:]))
            found["exact"].append(of_person.predict(points[NEUTRAL_FRAMES:]))
            found["still"].append(of_person.predict(still))
        takes[name] = {"true": true, **{what: np.stack(rows) for what, rows in found.items()}}
    return takes


def blinks(true: np.ndarray, exact: np.ndarray, given: np.ndarray, rate: int) -> list[float]:
    """Heights of one lid's blinks as shares of those without jitter; each (n,)."""
    peaks, _ = find_peaks(true, prominence=0.4)
    widths = peak_widths(true, peaks, rel_height=0.5)[0] / rate
    shares = []
    for peak in peaks[widths < BLINK_S]:
        about = slice(max(peak - round(0.2 * rate), 0), peak + round(0.3 * rate))
        level = np.median(exact[about][:5])
        if exact[about].max() - level > BLINK_LEAST:
            shares.append((given[about].max() - level) / (exact[about].max() - level))
    return shares


def delay_ms(make: Callable[[], Stage], rate: int, height: float) -> float:
    """Milliseconds from half the height of a step in what comes to half its height in what leaves."""
    course = np.where(np.arange(4 * rate) < 2 * rate, 0.0, height)
    weights = np.repeat(course[:, None], len(BLENDSHAPE_INDEX), axis=1)
    stage, waits, last = make(), [], 0.0
    for sample in samples(weights, rate):
        waits += [sample.time_s - ready.time_s for ready in stage.feed(sample)]
    left = filtered(make(), weights, rate)[:, BLENDSHAPE_INDEX["jawOpen"]]
    last = _half(left, height) - _half(course, height)
    return float(1000 * (np.median(waits) + last / rate))


def _half(course: np.ndarray, height: float) -> float:
    """Frame, with a fraction, at which a rising course first has half a height."""
    after = int(np.argmax(course >= height / 2))
    return after - (course[after] - height / 2) / (course[after] - course[after - 1])


def measure(make: Callable[[], Stage], takes: dict[str, dict[str, np.ndarray]], rate: int) -> dict:
    """The figures of one filter at one rate."""
    every = DENSE_RATE // rate
    figures = {"blink": [], "still": []}
    for name, take in takes.items():
        true = take["true"][::every]
        moving = [column for column in SHAPES if true[:, column].std() >= MOVES_SD]
        given = np.stack([filtered(make(), weights[::every], rate) for weights in take["noisy"]])
        still = [filtered(make(), weights, rate)[SETTLED:].var(axis=0)[SHAPES] for weights in take["still"]]
        figures["still"].append(np.mean(still))
        r = [np.mean([correlation(each[:, column], true[:, column]) for each in given]) for column in moving]
        figures[name] = {
            "mae": float(np.abs(given - true)[..., moving].mean()),
            "r": float(np.median(r)),
        }
        for lid in (BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]):
            for exact, each in zip(take["exact"], given, strict=True):
                figures["blink"] += blinks(true[:, lid], exact[::every, lid], each[:, lid], rate)
    return {
        **{name: figures[name] for name in takes},
        "mae": float(np.mean([figures[name]["mae"] for name in takes])),
        "r": float(np.mean([figures[name]["r"] for name in takes])),
        "still": float(np.sqrt(np.mean(figures["still"]))),
        "blink": float(np.mean(figures["blink"])),
        "delay_ms": {f"{height:g}": delay_ms(make, rate, height) for height in STEPS},
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model", type=Path)
    parser.add_argument("--real", type=Path, required=True, help="folder with livelink/")
    parser.add_argument("--rig", default="ict", help="rig of those who play the takes")
    parser.add_argument("--people", type=int, default=3, help="who play the takes")
    parser.add_argument("--noise", type=float, default=1.0, help="jitter in px")
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    model = load_model(arguments.model)
    takes = seen(model, load_rig(arguments.rig), arguments.real, arguments.people, arguments.noise)
    print(
        f"# {platform.machine()}, Python {platform.python_version()}, NumPy {version('numpy')}; model "
        f"{arguments.model} ({model.recipe}), {arguments.people} people of {arguments.rig}, "
        f"{arguments.noise:g} px of {OUTER_EYE_PX:g}\n"
    )
    print("| filter | frames a second | delay of a step, of one of 0.2 | MAE | median r | still | blink |")
    print("|---|---|---|---|---|---|---|")
    figures = {}
    for name, make in filters(model).items():
        for rate in RATES:
            row = figures[f"{name}, {rate}"] = measure(make, takes, rate)
            whole, slight = (round(row["delay_ms"][f"{height:g}"]) for height in STEPS)
            print(
                f"| {name} | {rate} | {whole} ms, {slight} ms | {row['mae']:.4f} | {row['r']:.3f} | "
                f"{row['still']:.4f} | {row['blink']:.2f} |",
                flush=True,
            )
    if arguments.json:
        arguments.json.write_text(json.dumps(figures))


if __name__ == "__main__":
    main()
