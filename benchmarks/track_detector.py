"""Compares our weights with MediaPipe's own on films of faces, and takes the time of each step up to the weights.

    python benchmarks/track_detector.py FILM ... [--model MODEL] [--json FILE]
    python benchmarks/track_detector.py docs/samples/acting-avatar.webm --truth docs/samples/acting-avatar.csv

MediaPipe's blendshapes are no truth, only another opinion from the same pictures. A film's neutral face is that of its
five calmest frames by MediaPipe, which stand for a neutral face that a person gives. r is Pearson's, over a film's
frames after a mean of three, of the shapes that move (standard deviation of MediaPipe's weight above .04).
Gaze is from the irises, as eyeLook weights.

With --truth both are held against what the face in the film really does: 52 weights and the angles of eyes and head in
each picture. The sample's face is our avatar, of whose relatives the networks have learned: it favours them. Shapes
take turns in it and rest most of the time, so that always answering zero errs by little; it stands beside both, and so
do errors of the frames in which a shape is at work.
"""

import argparse
import json
import platform
import sys
import time
from collections import defaultdict
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress import load_model
from regress.runtime.heads.eyes import gaze_angles, own_eyes
from regress.runtime.heads.fit import HeadPoses
from regress.runtime.model import Model
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS, look_weights
from track.detectors import MediapipeDetector
from track.detectors.head import rotation_of, typical_camera
from track.sources import Pace, open_source

MOVES = 0.04
"""Standard deviation of MediaPipe's weight from which a shape counts in a film."""

ACTIVE = 0.1
"""True weight above which a shape is at work."""

CALM = 5
"""Frames of the neutral face."""

MEAN_OF = 3
"""Frames that both are averaged over."""

WARMING = 10
"""Frames that are not timed."""


class Stopwatch:
    """CPU time of named steps, in milliseconds a frame; all threads of the process count."""

    def __init__(self) -> None:
        self.taken_ms: dict[str, list[float]] = defaultdict(list)

    def time(self, step: str, call: Callable, *arguments: object) -> object:
        """What ``call`` gives."""
        since_s = time.process_time()
        result = call(*arguments)
        self.taken_ms[step].append(1000 * (time.process_time() - since_s))
        return result


class Watched:
    """What was found in a film: samples with a face, MediaPipe's weights (n, 52), and the picture's size."""

    def __init__(self, film: Path, file: Path | None, stopwatch: Stopwatch) -> None:
        source, detector = open_source(str(film), Pace(fast=True)), MediapipeDetector(file, blendshapes=True)
        self.samples: list[Sample] = []
        weights, self.frames = [], 0
        try:
            while (picture := stopwatch.time("decode", source.read)) is not None:
                self.frames += 1
                self.size = picture.pixels.shape[1::-1]
                sample = Sample(time_s=picture.time_s, pictures={"camera": picture.pixels})
                sample = stopwatch.time("detector: MediaPipe, 68 points, head", detector.step, sample)
                if detector.own_weights is not None:
                    self.samples.append(sample)
                    weights.append([detector.own_weights.get(name, 0.0) for name in BLENDSHAPES])
        finally:
            source.close()
            detector.close()
        self.theirs = np.array(weights).reshape(-1, len(BLENDSHAPES))

    @property
    def points(self) -> np.ndarray:
        """(n, 68, 2)."""
        return np.array([sample.points for sample in self.samples])

    @property
    def calm(self) -> np.ndarray:
        """Rows of the calmest frames by MediaPipe, blinks and looks aside included."""
        return np.argsort(self.theirs.sum(axis=1))[:CALM]

    def gaze_weights(self, calm: np.ndarray) -> np.ndarray:
        """The eight eyeLook weights (n, 8) from the irises, with the eyes of the calm frames, by their rows."""
        camera = typical_camera(*self.size)
        heads = np.array([sample.head for sample in self.samples])
        poses = HeadPoses(
            rotation=np.array([rotation_of(head) for head in heads]),
            translation=heads[:, :3],
            coefficients=np.zeros((len(heads), 0)),
        )
        irises = np.array([sample.irises for sample in self.samples])
        eyes = own_eyes(self.points[calm], irises[calm], poses.take(calm), camera)
        gazes = gaze_angles(self.points, irises, poses, camera, eyes).reshape(-1, 4)
        return np.array([look_weights(gaze) for gaze in gazes])


def smooth(weights: np.ndarray) -> np.ndarray:
    """A mean of three frames (n - 2, k) of weights (n, k)."""
    return np.mean([weights[start : len(weights) - MEAN_OF + 1 + start] for start in range(MEAN_OF)], axis=0)


def correlations(ours: np.ndarray, theirs: np.ndarray, columns: list[int]) -> dict[str, float]:
    """r by shape, of those columns of weights (n, 52) that move; 0 where ours stands still."""
    found = {}
    for column in columns:
        one, other = smooth(ours)[:, column], smooth(theirs)[:, column]
        if other.std() > MOVES:
            found[BLENDSHAPES[column]] = float(np.corrcoef(one, other)[0, 1]) if one.std() > 1e-9 else 0.0
    return found


def compare(watched: Watched, model: Model, stopwatch: Stopwatch) -> dict[str, dict[str, float]]:
    """r by shape, of the networks without and with a neutral face, and of gaze."""
    points, others = watched.points, [column for column in range(len(BLENDSHAPES)) if column not in LOOKS]
    calibrated = model.calibrate(points[watched.calm])
    ours = np.array([stopwatch.time("networks", calibrated.predict, face[None])[0] for face in points])
    looks = np.zeros_like(ours)
    looks[:, LOOKS] = watched.gaze_weights(watched.calm)
    return {
        "no neutral": correlations(model.predict(points), watched.theirs, others),
        "calm neutral": correlations(ours, watched.theirs, others),
        "gaze from irises": correlations(looks, watched.theirs, LOOKS),
        "gaze from lids": correlations(ours, watched.theirs, LOOKS),
    }


def tell(films: dict[str, dict], stopwatch: Stopwatch) -> None:
    """Print the tables, in Markdown."""
    print("\n| film | frames | with a face | shapes | no neutral | calm neutral | gaze: irises | lids |")
    print("|---|---|---|---|---|---|---|---|")
    everything = {way: [] for way in ("no neutral", "calm neutral", "gaze from irises", "gaze from lids")}
    for name, film in films.items():
        for way, found in film["r"].items():
            everything[way] += found.values()
        cells = [_median(film["r"][way].values()) for way in everything]
        shapes = len(film["r"]["calm neutral"])
        print(f"| {name} | {film['frames']} | {film['faces']} | {shapes} | " + " | ".join(cells) + " |")
    print("| median over all | | | | " + " | ".join(_median(found) for found in everything.values()) + " |")
    print("\n| shape | films in which it moves | median r | lowest |\n|---|---|---|---|")
    by_shape = defaultdict(list)
    for film in films.values():
        for name, r in (film["r"]["calm neutral"] | film["r"]["gaze from irises"]).items():
            by_shape[name].append(r)
    for name, found in sorted(by_shape.items(), key=lambda item: -float(np.median(item[1]))):
        print(f"| {name} | {len(found)} | {np.median(found):.2f} | {min(found):.2f} |")
    still = [name for name in BLENDSHAPES if name not in by_shape]
    print(f"\nThese move in no film, by MediaPipe: {', '.join(still) or 'none'}.")
    tell_times(stopwatch)


def tell_times(stopwatch: Stopwatch) -> None:
    """Print what each step takes, in Markdown."""
    print("\n| step | CPU ms a frame, median | p95 |\n|---|---|---|")
    for step, taken_ms in stopwatch.taken_ms.items():
        taken_ms = taken_ms[WARMING:] or taken_ms
        print(f"| {step} | {np.median(taken_ms):.2f} | {np.percentile(taken_ms, 95):.2f} |")


@dataclass(frozen=True, kw_only=True)
class Agreement:
    """How two opinions agree with what one shape truly does: ours, then MediaPipe's.

    Attributes
    ----------
    r
        Of both.
    mae, active
        Mean absolute errors of both, and of always answering zero: of all frames, and of those in which the true weight
        is above `ACTIVE` (NaN where it never is).
    """

    r: tuple[float, float]
    mae: tuple[float, float, float]
    active: tuple[float, float, float]


def agreement(ours: np.ndarray, theirs: np.ndarray, true: np.ndarray) -> Agreement:
    """Of one shape's weights (n,)."""
    errors = np.abs(np.stack([ours, theirs, np.zeros_like(true)]) - true)
    works = true > ACTIVE
    active = errors[:, works].mean(axis=1) if works.any() else np.full(3, np.nan)
    return Agreement(
        r=(_r(ours, true), _r(theirs, true)),
        mae=tuple(errors.mean(axis=1).tolist()),
        active=tuple(active.tolist()),
    )


def beside_truth(watched: Watched, model: Model, truth: dict[str, np.ndarray]) -> dict[str, Agreement]:
    """By shape that moves."""
    if len(watched.samples) != len(truth["frame"]):
        sys.exit(f"a face is seen in {len(watched.samples)} frames, and the truth has {len(truth['frame'])}")
    true = np.array([truth[name] for name in BLENDSHAPES]).T
    rest = np.flatnonzero(true.sum(axis=1) == 0)[WARMING:]
    ours = model.calibrate(watched.points[rest]).predict(watched.points)
    ours[:, LOOKS] = watched.gaze_weights(rest)
    return {
        BLENDSHAPES[column]: agreement(ours[:, column], watched.theirs[:, column], true[:, column])
        for column in np.flatnonzero(true.std(axis=0) > MOVES)
    }


def read_truth(path: Path) -> dict[str, np.ndarray]:
    """What a face does in a film, by column: 52 weights, and degrees under the names of ``docs/samples/acting.py``."""
    table = np.genfromtxt(path, delimiter=",", names=True)
    return {name: table[name] for name in table.dtype.names}


def tell_truth(watched: Watched, model: Model, truth: dict[str, np.ndarray]) -> None:
    """Print how both opinions agree with what is true, in Markdown.

    Parameters
    ----------
    truth
        As :func:`read_truth` gives it.
    """
    print("\n".join(truth_table(beside_truth(watched, model, truth))))
    heads = np.degrees([sample.head[3:] for sample in watched.samples])
    print("\n| head | r | degrees for each true one | off at rest, degrees |\n|---|---|---|---|")
    for angle, found in zip(("yaw", "pitch", "roll"), heads.T, strict=True):
        slope, offset = np.polyfit(truth[f"head_{angle}_deg"], found, 1)
        print(f"| {angle} | {_r(found, truth[f'head_{angle}_deg']):.3f} | {slope:.2f} | {offset:.1f} |")


def truth_table(beside: dict[str, Agreement]) -> Iterable[str]:
    """Lines of Markdown: each shape, then means and medians over shapes."""
    yield f"\n| shape | r: ours, MediaPipe | MAE: ours, MediaPipe, zero | where the true weight is above {ACTIVE:g} |"
    yield "|---|---|---|---|"
    for name, one in beside.items():
        yield _truth_row(name, [*one.r, *one.mae, *one.active])
    figures = [[*one.r, *one.mae, *one.active] for one in beside.values()]
    for what, over in (("mean", np.nanmean), ("median", np.nanmedian)):
        yield _truth_row(f"{what} of {len(figures)}", over(figures, axis=0))


def _truth_row(what: str, figures: Iterable[float]) -> str:
    r_ours, r_theirs, *errors = figures
    mae, active = (" / ".join(f"{one:.3f}" for one in three) for three in (errors[:3], errors[3:]))
    return f"| {what} | {r_ours:.2f} / {r_theirs:.2f} | {mae} | {active} |"


def _r(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.corrcoef(one, other)[0, 1]) if one.std() > 1e-9 else 0.0


def _median(found: object) -> str:
    values = list(found)
    return f"{np.median(values):.2f}" if values else "-"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("films", type=Path, nargs="+", help="each of one face that acts, from a calm face")
    parser.add_argument(
        "--model", default="landmarks-default", help="of landmarks: a folder, or a ready-made one"
    )
    parser.add_argument("--detector-file", type=Path, help="MediaPipe's model file")
    parser.add_argument(
        "--truth", type=Path, help="of the one film: what its face does, as docs/samples has it"
    )
    parser.add_argument("--json", type=Path, help="write all figures here")
    arguments = parser.parse_args()
    model, stopwatch, films = load_model(arguments.model), Stopwatch(), {}
    for path in arguments.films:
        watched = Watched(path, arguments.detector_file, stopwatch)
        if len(watched.samples) < CALM + MEAN_OF:
            print(
                f"{path.name}: a face in {len(watched.samples)} of {watched.frames} frames, which is too few"
            )
            continue
        r = compare(watched, model, stopwatch)
        films[path.name] = {"frames": watched.frames, "faces": len(watched.samples), "r": r}
    print(
        f"# {platform.machine()}, Python {platform.python_version()}, MediaPipe {version('mediapipe')}; model "
        f"{arguments.model} ({model.recipe})"
    )
    if arguments.truth:
        tell_truth(watched, model, read_truth(arguments.truth))
        tell_times(stopwatch)
    else:
        tell(films, stopwatch)
    if arguments.json:
        arguments.json.write_text(json.dumps(films, indent=1))


if __name__ == "__main__":
    main()
