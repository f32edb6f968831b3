"""Times every sink of `track`: processor milliseconds a frame, of a face of which everything moves.

    python benchmarks/bench_sinks.py

Last run (2026-11-29, one of two shared cores of an Intel Xeon, Python 3.11.7, NumPy 1.26.4), ms a frame:

    vmc           0.179   and 0 ms at the end
    livelink      0.029   and 0 ms at the end
    ifacialmocap  0.045   and 0 ms at the end
    vrchat        0.353   and 1 ms at the end
    csv           0.056   and 1 ms at the end
    livelink-csv  0.091   and 1 ms at the end
    gltf          0.005   and 186 ms at the end
    vrma          0.005   and 54 ms at the end

VMC and VRChat send 73 and 155 messages; all sinks together take a thirtieth of a camera's frame.
"""

import tempfile
import time
from pathlib import Path

import numpy as np

from regress.runtime.sample import Sample
from track.sinks.targets import SINKS, open_sink, parse_target

FRAMES, ROUNDS = 300, 5


def samples(round_: int) -> list[Sample]:
    """Faces in which every number changes from frame to frame."""
    rng = np.random.default_rng(round_)
    return [
        Sample(
            time_s=(round_ * FRAMES + number) / 30,
            weights=rng.uniform(size=52),
            gaze=rng.uniform(-0.4, 0.4, size=4),
            head=np.concatenate([[0.1, -0.05, 0.6], rng.uniform(-0.6, 0.6, size=3)]),
        )
        for number in range(FRAMES)
    ]


def main() -> None:
    """Print the least of some rounds for each sink; a room needs a server and is left out."""
    rounds = [samples(number) for number in range(ROUNDS)]
    with tempfile.TemporaryDirectory() as folder:
        for name in SINKS:
            if name == "room":
                continue
            place = "" if SINKS[name].port is not None else f":{Path(folder, name)}"
            sink = open_sink(parse_target(name + place), print)
            taken = []
            for frames in rounds:
                start = time.process_time()
                for frame in frames:
                    sink.send(frame)
                taken.append((time.process_time() - start) / FRAMES * 1e3)
            start = time.process_time()
            sink.close()
            print(f"{name:13} {min(taken):.3f}   and {(time.process_time() - start) * 1e3:.0f} ms at the end")


if __name__ == "__main__":
    main()
