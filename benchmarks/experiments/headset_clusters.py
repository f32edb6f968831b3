"""Repeats the second paper's figure 4 on exact weights: the gain of one network per camera over one for all.

    python -m benchmarks.experiments.headset_clusters TRAINING_ARRAYS TEST_ARRAYS

Faces of unseen people are replaced by the nearest of K cluster centres of each camera's part, or of 3 K centres of the
whole face, over three seeds; once with all training frames, once with those alone in which one region moves. Prints
Markdown; the results stand in docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np
from sklearn.cluster import KMeans

from benchmarks.headset_networks import print_table, spread
from facegen.conventions import BLENDSHAPES
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.geometry import FaceGeometry
from regress.runtime.headset.network.parts import part_of

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


def cluster_error_mm(
    face: FaceGeometry,
    weights: np.ndarray,
    unseen: np.ndarray,
    *,
    clusters: int,
    cameras: tuple[str, ...] = (),
    seed: int = 0,
) -> float:
    """Mean geometry error of unseen faces that are replaced by the nearest cluster centre.

    With cameras, each camera's part has its own clusters and takes its own nearest centre (modular); without, the
    face is one (holistic). A fair comparison gives the face as many centres as all parts have together.

    Parameters
    ----------
    weights, unseen : (n, 52), (m, 52) float
        Faces whose clusters are found, and faces that are replaced.
    clusters
        Centres of each part, or of the face.
    cameras
        Names; a shape that several see belongs to the first.
    """
    parts = _partition(cameras)
    # in these coordinates distances are root mean square displacements of the face's vertices
    values, vectors = np.linalg.eigh(face.gram_mm2())
    root = vectors * np.sqrt(np.clip(values, 0, None))
    replaced = np.zeros_like(np.asarray(unseen, np.float64))
    for part in parts:
        known, wanted = (np.asarray(faces, np.float64)[:, part] for faces in (weights, unseen))
        found = KMeans(min(clusters, len(known)), n_init=1, random_state=seed).fit(known @ root[part])
        labels = found.labels_
        centres = np.stack([known[labels == label].mean(axis=0) for label in range(found.n_clusters)])
        replaced[:, part] = centres[found.predict(wanted @ root[part])]
    return float(face.error_mm(replaced, unseen).mean())


def _partition(cameras: tuple[str, ...]) -> list[list[int]]:
    left = list(range(len(BLENDSHAPES)))
    parts = []
    for camera in cameras:
        seen = set(part_of(camera))
        parts.append([column for column in left if BLENDSHAPES[column] in seen])
        left = [column for column in left if BLENDSHAPES[column] not in seen]
    return [part for part in (*parts, left) if part]


if __name__ == "__main__":
    main()
