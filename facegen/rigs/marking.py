"""Finds parts of a head on its mesh: the red of the lips, the brows, lid margins, and what moves with the lids."""

from itertools import pairwise

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from facegen.conventions import BLENDSHAPE_INDEX, LANDMARK_GROUPS, Part

LID_REACH = 2.2
"""Lid vertices lie within this many eye radii of the eyeball's centre."""
BROW_HALF_WIDTH_M = 3.5e-3


def face_sides(faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Sides (s, 2) of quads and of triangles padded with -1, and the face (s,) each belongs to."""
    following = np.roll(faces, -1, axis=1)
    triangle = faces[:, 3] < 0
    following[triangle, 2] = faces[triangle, 0]
    real = faces >= 0
    return np.stack([faces[real], following[real]], axis=-1), np.nonzero(real)[0]


def shortest_path(faces: np.ndarray, vertices: np.ndarray, through: list[int]) -> list[int]:
    """Vertices along the shortest way over the sides of faces (f, 4) from the first of ``through`` to the last.

    Raises
    ------
    ValueError
        Two successive vertices lie on pieces of the mesh that do not hang together.
    """
    sides = np.unique(np.sort(face_sides(faces)[0], axis=1), axis=0)
    length = np.linalg.norm(vertices[sides[:, 0]] - vertices[sides[:, 1]], axis=1)
    graph = sparse.csr_matrix((length, sides.T), (len(vertices), len(vertices)))
    _, before = csgraph.dijkstra(graph, directed=False, indices=through[:-1], return_predecessors=True)
    path = [int(through[0])]
    for start, goal, came_from in zip(through, through[1:], before, strict=False):
        piece = []
        while goal != start:
            if goal < 0:
                raise ValueError(f"no way along the mesh leads from vertex {start} to the next")
            piece.append(int(goal))
            goal = came_from[goal]
        path += piece[::-1]
    return path


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
    unique, index = np.unique(sides, axis=0, return_inverse=True)
    ring = landmarks[list(LANDMARK_GROUPS["outer_lip"])]
    path = shortest_path(faces[outer], vertices, [*ring, ring[0]])
    border = {tuple(sorted(side)) for side in pairwise(path)}
    open_side = np.array([tuple(side) not in border for side in unique.tolist()])
    order = np.argsort(index.ravel(), kind="stable")
    same = (index.ravel()[order][1:] == index.ravel()[order][:-1]) & open_side[index.ravel()[order][1:]]
    pairs = np.stack([owner[order][:-1][same], owner[order][1:][same]])
    linked = sparse.csr_matrix((np.ones(pairs.shape[1]), pairs), (len(faces), len(faces)))
    _, label = csgraph.connected_components(linked, directed=False)
    # 60 and 64 are corners, which touch the cheek too
    inner = landmarks[list(LANDMARK_GROUPS["inner_lip"])[1:4]]
    return outer & np.isin(label, label[outer & np.isin(faces, inner).any(axis=1)])


def lid_neighbourhood(
    vertices: np.ndarray,
    expression: np.ndarray,
    eye_center: np.ndarray,
    eye_radius: np.ndarray,
    *,
    margins: np.ndarray | None = None,
) -> np.ndarray:
    """(2, M) vertices near each eye that some eye blendshape of its side moves, padded with -1.

    Those of ``margins`` (2, m) are among them in any case: a head may lack shapes.
    """
    neighbourhoods = []
    for index, (side, centre, radius) in enumerate(
        zip(("Left", "Right"), eye_center, eye_radius, strict=True)
    ):
        shapes = [i for name, i in BLENDSHAPE_INDEX.items() if name.startswith("eye") and name.endswith(side)]
        moves = np.linalg.norm(expression[shapes], axis=-1).max(axis=0) > 1e-6
        near = np.linalg.norm(vertices - centre, axis=-1) < LID_REACH * radius
        chosen = moves & near
        if margins is not None:
            chosen[margins[index]] = True
        neighbourhoods.append(np.flatnonzero(chosen))
    padded = np.full((2, max(map(len, neighbourhoods))), -1)
    for row, indices in zip(padded, neighbourhoods, strict=True):
        row[: len(indices)] = indices
    return padded


def paint_brows(part: np.ndarray, vertices: np.ndarray, faces: np.ndarray, landmarks: np.ndarray) -> None:
    """Mark the skin within `BROW_HALF_WIDTH_M` of the lines through the brow landmarks (68,), in place."""
    corner = np.where(faces >= 0, faces, faces[:, :1])
    middle = vertices[corner].mean(axis=1)
    for group in ("right_brow", "left_brow"):
        line = vertices[landmarks[list(LANDMARK_GROUPS[group])]]
        for a, b in pairwise(line):
            along = np.clip((middle - a) @ (b - a) / ((b - a) @ (b - a)), 0.0, 1.0)
            distance = np.linalg.norm(middle - a - along[:, None] * (b - a), axis=1)
            part[(distance < BROW_HALF_WIDTH_M) & (part == Part.SKIN)] = Part.BROWS
