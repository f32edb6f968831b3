"""Reduces a rig to the mesh that hides keypoints: its cage, eyes closed, and the rendered surface along the jaw."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from facegen.rigs.rig import Rig

RINGS = 2
"""Rings of cage faces about each landmark of the jaw that are replaced. The cage cuts up to 1 mm off the smooth
surface, and rays to landmarks that turn away graze it. 0, 1, 2 or 3 rings let 97.5, 99.5, 99.7 or 99.75 % of a thousand
faces' flags equal those of the whole mesh (default rig), with 0, 276, 595 or 973 vertices beyond the cage's 3,411.
"""


@dataclass(frozen=True, kw_only=True, eq=False)
class FaceOccluder:
    """``faces`` (C, 4) int32, padded with -1, over the rig's vertices at ``vertices`` (m,), the cage's first."""

    vertices: np.ndarray
    faces: np.ndarray


@lru_cache(maxsize=8)
def occluder(rig: Rig) -> FaceOccluder:
    """The mesh that stands for the head in occlusion tests of keypoints; the closed cage where nothing is subdivided.

    Where fine and coarse faces meet, their edges part by as much as the cage cuts off: rays that slip through there
    are among the flags that differ.
    """
    fine = _fine_faces(rig)
    near = rig.landmark_vertices[list(LANDMARK_GROUPS["jaw"])].ravel()
    for _ in range(RINGS):
        about = np.isin(rig.cage_faces, near).any(axis=1)
        near = np.setdiff1d(rig.cage_faces[about], [-1])
    still = ~np.isin(rig.faces[fine], rig.lid_vertices[rig.lid_vertices >= 0]).any(axis=(1, 2))
    replaced = about & (fine[:, 0] >= 0) & still  # lids move the cage's vertices alone
    faces = [rig.cage_faces[~replaced], rig.faces[fine[replaced]].reshape(-1, 4), _eye_fans(rig)]
    faces = np.concatenate(faces)
    cage = np.arange(rig.cage_vertices)
    vertices = np.concatenate([cage, np.setdiff1d(faces, [*cage, -1])])
    row = np.full(len(rig.vertices) + 1, -1, np.int32)  # the last entry serves the padding
    row[vertices] = np.arange(len(vertices))
    return FaceOccluder(vertices=vertices, faces=row[faces])


@lru_cache(maxsize=8)
def closed_cage(rig: Rig) -> np.ndarray:
    """The cage's faces (c, 4), padded with -1, and what closes its eyes."""
    return np.concatenate([rig.cage_faces, _eye_fans(rig)])


def _eye_fans(rig: Rig) -> np.ndarray:
    """Triangles (f, 4) from the outer canthi to the lids' margins: the cage has neither eyeballs nor cavities.

    Without them, far landmarks are seen through the eyes of turned heads. All touch the outer canthus, so that none
    stands before it.
    """
    margins = (*rig.upper_lid, *rig.lower_lid)
    fans = [
        np.stack(np.broadcast_arrays(margin[-1], margin[:-1], margin[1:], -1), axis=1) for margin in margins
    ]
    return np.concatenate(fans).astype(np.int32)


def _fine_faces(rig: Rig) -> np.ndarray:
    """Indices (C, 4) of the faces that subdivision made of each face of the cage (C, 4); -1 where it made none.

    `facegen.rigs.subdivision.catmull_clark` makes four faces in a row of each, each from one of its corners to a
    common new vertex in its middle.
    """
    corners = rig.faces[: len(rig.faces) // 4 * 4].reshape(-1, 4, 4)
    middle = corners[:, :, 2]
    quads = np.flatnonzero((middle == middle[:, :1]).all(axis=1) & (middle[:, 0] >= rig.cage_vertices))
    place = {tuple(quad): 4 * int(number) for number, quad in zip(quads, corners[quads, :, 0], strict=True)}
    first = np.array([place.get(tuple(face), -1) for face in rig.cage_faces])
    return np.where(first[:, None] >= 0, first[:, None] + np.arange(4), -1)
