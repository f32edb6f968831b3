"""Measures what a person's own blinks gain, on blinks that an iPhone recorded.

    python benchmarks/own_blinks.py --real RECORDINGS

First the takes' eyeBlinkLeft itself, read by a network that sees a share of it, with noise of `NOISE` a frame: each of
`STARTS` begins the take anew, and blinks count from the one behind the eighth. Then the whole way of landmarks: people
of two rigs play the takes at 30 frames a second, 1 px of noise with a detector's bias at 100 px between the outer eye
corners, and landmarks-default reads them with and without a neutral face. Prints Markdown, which stands in
docs/measurements/real-recordings.md.
"""

import argparse
from pathlib import Path

import numpy as np
from replay import SEED, TAKES, play

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLINK_INDICES
from facegen.formats import read_live_link
from facegen.rigs import load_rig
from regress import load_model
from regress.runtime.ready_made import model_folder
from regress.runtime.sample import Sample
from regress.runtime.stages.own_blinks import FEWEST, SIDE_S, BlinkWatch, OwnBlinks

FPS = 30
STEPS = {"range of motion": 2, "speech": 1}
"""Rows of a take for one of 30 a second: the first was recorded at 60."""
SHARES = (0.3, 0.4, 0.5, 0.7, 0.85, 1.0)
NOISE = 0.02
"""Standard deviation of a frame."""
STARTS = range(0, 40, 4)
"""Seconds."""
RIGS = ("ict", "anny")


def blinks_of(readings: np.ndarray) -> np.ndarray:
    """Rows at which an eye's readings (n,) end a blink's rise: its peaks."""
    watch, found, seen = BlinkWatch(), [], []
    for row, reading in enumerate(readings):
        seen.append((row, reading))
        if watch.step(row / FPS, float(reading)):
            peak = watch.peaks[-1]
            found.append(max(near for near, value in seen[-round(2 * SIDE_S * FPS) :] if value == peak))
    return np.array(found, dtype=int)


def answered(read: np.ndarray) -> np.ndarray:
    """Blinks (n, 2) as they leave the stage, of readings (n, 2) as they come."""
    stage, answers = OwnBlinks(), []
    for row, blinks in enumerate(read):
        weights = np.zeros(len(BLENDSHAPES))
        weights[BLINK_INDICES] = blinks
        answers.append(stage.step(Sample(time_s=row / FPS, weights=weights)).weights[BLINK_INDICES])
    return np.array(answers)


def errors(true: np.ndarray, read: np.ndarray, later: slice) -> tuple[float, float, float]:
    """At the true blinks' peaks: mean absolute error, and its mean with a sign; over all frames the absolute one."""
    peaks = blinks_of(true)
    peaks = peaks[peaks >= later.start]
    apart = read[peaks] - true[peaks]
    return float(np.abs(apart).mean()), float(apart.mean()), float(np.abs(read - true)[later].mean())


def told(found: list[tuple[float, float, float]]) -> str:
    """Means of `errors` as a cell."""
    peak, sign, all_frames = np.mean(found, axis=0)
    return f"{peak:.3f} ({sign:+.3f}), {all_frames:.3f}"


def curves(real: Path) -> None:
    """Takes read in part."""
    print(
        "| take | share that is read | as read: at blinks (with sign), all frames | stretched |\n|---|---|---|---|"
    )
    for take, path in TAKES.items():
        whole = read_live_link(real / path).weights[:: STEPS[take], BLENDSHAPE_INDEX["eyeBlinkLeft"]]
        for share in SHARES:
            noise = NOISE * np.random.default_rng(SEED).standard_normal(len(whole))
            plain, own = [], []
            for start in STARTS:
                true = whole[start * FPS :]
                read = np.clip(share * true + noise[start * FPS :], 0, 1)
                seen = blinks_of(read)
                begin = seen[FEWEST - 1] + round(SIDE_S * FPS) + 1 if len(seen) >= FEWEST else len(true)
                if not (blinks_of(true) >= begin).any():
                    continue
                later = slice(begin, None)
                plain.append(errors(true, read, later))
                own.append(errors(true, answered(np.stack([read, read], axis=1))[:, 0], later))
            cells = (told(plain), told(own)) if plain else ("too few blinks are seen",) * 2
            print(f"| {take} | {share:g} | {cells[0]} | {cells[1]} |")


def landmarks(real: Path, people: int) -> None:
    """The whole way, from points."""
    model = load_model(model_folder("landmarks-default"))
    print(
        "\n| played by | take | neutral face | as read: at blinks (with sign), all frames | stretched |\n"
        "|---|---|---|---|---|"
    )
    for name in RIGS:
        takes = {step: play(real, load_rig(name), people, step) for step in set(STEPS.values())}
        for number, take in enumerate(TAKES):
            played = takes[STEPS[take]][number]
            true = played.weights[:, BLINK_INDICES[0]]
            for known in (False, True):
                plain, own = [], []
                for neutral, frames in played.seen(1.0, biased=True):
                    used = model.calibrate(neutral) if known else model
                    read = used.predict(frames)[:, BLINK_INDICES]
                    later = slice(0, None)
                    plain.append(errors(true, read[:, 0], later))
                    own.append(errors(true, answered(read)[:, 0], later))
                print(
                    f"| {name} | {take} | {'yes' if known else 'no'} | {told(plain)} | {told(own)} |",
                    flush=True,
                )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--real", required=True, type=Path, help="folder with livelink/")
    parser.add_argument("--people", type=int, default=4, help="of each rig, who play the takes")
    arguments = parser.parse_args()
    curves(arguments.real)
    landmarks(arguments.real, arguments.people)


if __name__ == "__main__":
    main()
