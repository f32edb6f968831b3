"""Measures a meeting of two people, each with a film before the camera and speech in the microphone, by the real page.

    make room-face
    python benchmarks/room_meeting.py --film ada.mp4 ben.mp4 --seconds 30

Each person is a headless Chromium of its own on this machine, which draws nothing. Its camera plays the first minute of
a film, again and again; its microphone repeats a burst like a voice, and silence. Both press "This is my neutral face"
as soon as their faces are found. Then each page keeps what it says and what comes from the other, for so many seconds.
At the end each one stands two metres to the left of the other, and then to the right.
Without films our avatar acts before both cameras (docs/samples). Needs Chromium, and what `make room-face` makes.
Last result: see docs/measurements/room.md, with machine, versions and date.
"""

import argparse
import asyncio
import os
import statistics
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.room.filmed import BURST_S, MOVED, NAMES, Direction, meet  # noqa: E402

SAMPLE = ROOT / "docs/samples/acting-avatar.webm"
SHOWN_SHAPES = 12
"""Shapes that are printed, of those that moved."""


def halves(values: list[float]) -> str:
    """Half of all values and 95 % of them are at most so large."""
    if not values:
        return "-"
    return f"{statistics.median(values):.0f}, {sorted(values)[int(0.95 * len(values))]:.0f}"


ROWS: tuple[tuple[str, Callable[[Direction], str]], ...] = (
    ("a face was found in pictures looked at",
     lambda d: f"{d.faces} of {d.pictures} ({d.faces / max(1, d.pictures):.1%})"),
    ("such pictures a second", lambda d: f"{d.pictures / d.seconds:.1f}"),
    ("ms from a picture to its weights, half and 95 %", lambda d: halves(d.detect_ms)),
    ("states said, of the camera's face", lambda d: f"{d.sent}, {d.tracked / d.sent:.1%}"),
    ("states that came over", lambda d: f"{d.arrived} of {d.sent}"),
    ("ms until they came, half and 95 %", lambda d: halves(d.later_ms)),
    ("weights that came less those said, mean and most",
     lambda d: f"{d.differences.mean():.4f}, {d.differences.max():.4f}"),
    (f"shapes that moved by {MOVED} or more, said and on the avatar there",
     lambda d: f"{len(d.moved())}, {sum(d.spans_shown.get(name, 0) >= MOVED for name in d.moved())}"),
    ("energy at the ear of the speaker's side over the other: left, right",
     lambda d: f"{d.ears['left']:.1f}, {d.ears['right']:.1f}"),
    ("ms until the speaking sign is on, half and 95 %", lambda d: f"{halves(d.on_ms)} ({len(d.on_ms)} of {d.begins})"),
    ("ms until it is off, half and 95 %", lambda d: f"{halves(d.off_ms)} ({len(d.off_ms)} of {d.ends})"),
)  # fmt: skip


def report(directions: tuple[Direction, Direction]) -> str:
    """Both tables."""
    ada, ben = NAMES
    lines = [f"| | {ada}, at {ben}'s page | {ben}, at {ada}'s page |", "|---|---|---|"]
    lines += [f"| {name} | {' | '.join(map(tell, directions))} |" for name, tell in ROWS]
    lines += ["", "| moved most | shape | said | came | on the avatar |", "|---|---|---|---|---|"]
    for name, one in zip(NAMES, directions, strict=True):
        for shape in one.moved()[:SHOWN_SHAPES]:
            shown = one.spans_shown.get(shape)
            lines.append(
                f"| {name} | {shape} | {one.spans_sent[shape]:.2f} | {one.spans_arrived[shape]:.2f} | "
                f"{'-' if shown is None else f'{shown:.2f}'} |"
            )
    return "\n".join(lines)


def main() -> None:
    """Hold the meeting, and print its tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument(
        "--film", nargs=2, type=Path, default=(SAMPLE, SAMPLE), metavar=NAMES, help="what each camera plays"
    )
    parser.add_argument("--seconds", type=float, default=30.0, help="that are watched, 30 by default")
    options = parser.parse_args()
    if options.seconds < 3 * BURST_S:
        parser.error(f"--seconds: three bursts take {3 * BURST_S:.0f} seconds")
    if absent := [str(film) for film in options.film if not film.is_file()]:
        parser.error(f"--film: {', '.join(absent)} is not there")
    if not (ROOT / "room/server/static/face/face.js").exists():
        parser.error("pages see no face before `make room-face` was run")
    with tempfile.TemporaryDirectory() as folder:
        print(report(asyncio.run(meet(tuple(options.film), seconds=options.seconds, folder=Path(folder)))))
    print(f"\nload {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores")


if __name__ == "__main__":
    main()
