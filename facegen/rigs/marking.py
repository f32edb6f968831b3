"""Finds parts of a head on its mesh: the red of the lips, and what moves with the lids."""

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from facegen.conventions import BLENDSHAPE_INDEX, LANDMARK_GROUPS

LID_REACH = 2.2
"""Lid vertices lie within this many eye radii of the eyeball's centre."""


def face_sides(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sides (s, 2) of quads and of triangles padded with -1, and the face (s,) each belongs to."""
    following = np.roll(faces, -1, axis=1)
    triangle = faces[:, 3] < 0
    following[triangle, 2] = faces[triangle, 0]
    real = faces >= 0
    return np.stack([faces[real], following[real]], axis=-1), np.nonzero(real)[0]


def lip_faces(
    faces: np.ndarray, outer: np.ndarray, vertices: np.ndarray, landmarks: np.ndarray
) -> np.ndarray:
    """Which faces (f,) are the red of the lips.

    It is the outer skin that is reached from the inner lip's landmarks without crossing the border, the
    shortest path along the mesh through the outer lip's landmarks.

    Parameters
    ----------
    faces
        (f, 4) quads, triangles padded with -1.
    outer
        (f,) whether a face belongs to the outer skin.
    vertices
        (v, 3) positions.
    landmarks
        (68,) the vertex of each landmark.
    """
    sides, owner = face_sides(faces)
    sides, owner = np.sort(sides[outer[owner]], axis=1), owner[outer[owner]]
    length = np.linalg.norm(vertices[sides[:, 0]] - vertices[sides[:, 1]], axis=1)
    unique, first, index = np.unique(sides, axis=0, return_index=True, return_inverse=True)
    graph = sparse.csr_matrix((length[first], unique.T), (len(vertices), len(vertices)))
    ring = landmarks[list(LANDMARK_GROUPS["outer_lip"])]
    _, before = csgraph.dijkstra(graph, directed=False, indices=ring, return_predecessors=True)
    border = set()
    for start, goal in enumerate(np.roll(ring, -1)):
        while goal != ring[start]:
            border.add(tuple(sorted((int(goal), int(before[start, goal])))))
            goal = before[start, goal]
    open_side = np.array([tuple(side) not in border for side in unique.tolist()])
    order = np.argsort(index.ravel(), kind="stable")
    same = (index.ravel()[order][1:] == index.ravel()[order][:-1]) & open_side[index.ravel()[order][1:]]
    pairs = np.stack([owner[order][:-1][same], owner[order][1:][same]])
    linked = sparse.csr_matrix((np.ones(pairs.shape[1]), pairs), (len(faces), len(faces)))
    _, label = csgraph.connected_components(linked, directed=False)
    inner = landmarks[
        list(LANDMARK_GROUPS["inner_lip"])[1:4]
    ]  # 60 and 64 are corners, which touch the cheek too
    return outer & np.isin(label, label[outer & np.isin(faces, inner).any(axis=1)])


def lid_neighbourhood(
    vertices: np.ndarray, expression: np.ndarray, eye_center: np.ndarray, eye_radius: np.ndarray
) -> np.ndarray:
    """(2, M) vertices near each eye that some eye blendshape of its side moves, padded with -1."""
    found = []
    for side, centre, radius in zip(("Left", "Right"), eye_center, eye_radius, strict=True):
        shapes = [i for name, i in BLENDSHAPE_INDEX.items() if name.startswith("eye") and name.endswith(side)]
        moves = np.linalg.norm(expression[shapes], axis=-1).max(axis=0) > 1e-6
        near = np.linalg.norm(vertices - centre, axis=-1) < LID_REACH * radius
        found.append(np.flatnonzero(moves & near))
    padded = np.full((2, max(map(len, found))), -1)
    for row, indices in zip(padded, found, strict=True):
        row[: len(indices)] = indices
    return padded
