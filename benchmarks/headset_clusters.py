"""The second paper's figure 4 on exact weights: what a network a camera can gain over one of all, without pictures.

    python benchmarks/headset_clusters.py TRAINING_ARRAYS TEST_ARRAYS

Faces of unseen people are replaced by the nearest of K cluster centres of each camera's part, or of 3 K centres of the
whole face, over three seeds; once with all training frames, once with those alone in which one region moves. Prints
Markdown; the results stand in docs/headset-network-figures.md.
"""

import argparse
from pathlib import Path

import numpy as np
from headset_networks import print_table, spread

from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.clusters import cluster_error_mm

CLUSTERS = (25, 100, 400)
SEEDS = range(3)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("training", type=Path)
    parser.add_argument("test", type=Path)
    arguments = parser.parse_args()
    training, test = read_arrays(arguments.training), read_arrays(arguments.test)
    cameras = len(training.cameras)
    rows = [
        row for withhold in ("none", "regions") for row in cluster_rows(training, test, withhold=withhold)
    ]
    head = [
        "training frames",
        "rows",
        "K",
        f"modular, {cameras} x K",
        f"holistic, {cameras} K",
        "difference %",
    ]
    print_table("Clusters of exact weights (the paper's figure 4), geometry error in mm", head, rows)


def cluster_rows(training: HeadsetArrays, test: HeadsetArrays, *, withhold: str) -> list[list[object]]:
    """A row of the table for each K that leaves two faces or more a centre."""
    cameras = tuple(camera.name for camera in training.cameras)
    kept = training.kept_rows("train", withhold=withhold)
    known = training.weights[kept[~training.neutral[kept]]]  # neutral faces are all the same
    unseen = test.weights[(test.split == "test") & ~test.neutral]
    rows = []
    for count in CLUSTERS:
        whole = len(cameras) * count
        if 2 * whole > len(known):
            continue
        modular, holistic = (
            [cluster_error_mm(training.face, known, unseen, seed=seed, **of) for seed in SEEDS]
            for of in ({"clusters": count, "cameras": cameras}, {"clusters": whole})
        )
        less = 100 * (np.mean(modular) / np.mean(holistic) - 1)
        what = "all" if withhold == "none" else "one region"
        rows.append([what, len(known), count, spread(modular), spread(holistic), f"{less:+.1f}"])
    return rows


if __name__ == "__main__":
    main()
