"""The second paper's figure 4 on exact weights: what parts gain where training never saw a combination."""

import numpy as np
from sklearn.cluster import KMeans

from facegen.conventions import BLENDSHAPES
from regress.learning.headset.geometry import FaceGeometry
from regress.runtime.headset.parts import part_of


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
