"""Labels the jaw as pictures show it: points that slide from hidden landmarks to the outline of the cheek or chin.

A variant of landmark marching [1]_: each landmark of the jaw has a path over the skin towards the face's middle, and
where the face hides the landmark, the label is the first point of the path that can be seen.

References
----------
.. [1] X. Zhu, Z. Lei, J. Yan, D. Yi, S. Z. Li, "High-fidelity pose and expression normalization for face recognition
   in the wild", CVPR 2015, section 3.2.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from facegen.conventions import LANDMARK_GROUPS
from facegen.geometry import apply_transform, project_pinhole
from facegen.labels.keypoint_label import KEYPOINT_TOLERANCE_M, FacesInView, KeypointColumn, KeypointLabel
from facegen.raster import hidden_by_own, triangles_of
from facegen.rigs import Rig, closed_cage

JAW = list(LANDMARK_GROUPS["jaw"])
LOWER_LIP = 57
"""The landmark below the lower lip: paths from lower landmarks lead to its height."""
STEPS = 40
"""Points of a path: at most 3 mm apart, between which an outline of 60 mm radius turns by less than 0.1 mm."""
REACH_RAD = np.radians(75.0)
"""How far a path turns from the side of the head to its front; specs turn heads by 60 degrees at most."""

FORWARDS = np.array([0.0, 0.0, 1.0])


@dataclass(frozen=True, kw_only=True, eq=False)
class Paths:
    """One path from each landmark of the jaw; points are weighted sums of the cage's vertices.

    ``vertices`` and ``weights`` (17, `STEPS`, 3); the first point of a path is its landmark.
    """

    vertices: np.ndarray
    weights: np.ndarray


def label_contour(
    rig: Rig,
    vertices: np.ndarray,
    camera_from_head: np.ndarray,
    landmarks: np.ndarray,
    landmark_hidden: np.ndarray,
    *,
    tolerance_m: float,
) -> np.ndarray:
    """Points (n, 17, 3) of the sliding contour, head frame, metres.

    Parameters
    ----------
    rig
        The rig.
    vertices
        (n, m, 3) of the faces, the cage's first, head frame. The paths lie on the cage, and the cage hides them; the
        rendered mesh bulges by up to 1 mm over it, and its outline lies as much further out.
    camera_from_head
        (n, 4, 4).
    landmarks, landmark_hidden
        (n, 17, 3) of the jaw, head frame, and (n, 17) whether the face hides them; those that it does not stay.
    tolerance_m
        As for `facegen.raster.hidden`.
    """
    paths, cage = paths_of(rig), vertices[:, : rig.cage_vertices]
    points = np.einsum("psk,npskd->npsd", paths.weights, cage[:, paths.vertices])
    points[:, :, 0] = landmarks
    flat = apply_transform(camera_from_head, points.reshape(len(points), len(JAW) * STEPS, 3))
    hidden = hidden_by_own(flat, cage, camera_from_head, closed_cage(rig), tolerance_m=tolerance_m)
    hidden = hidden.reshape(points.shape[:3])
    hidden[:, :, 0] = landmark_hidden
    return slide(points, hidden)


def slide(points: np.ndarray, hidden: np.ndarray) -> np.ndarray:
    """First point (n, p, 3) of each path (n, p, s, 3) that is not ``hidden`` (n, p, s); its own first where all are."""
    first = np.argmin(hidden, axis=-1)
    return np.take_along_axis(points, first[..., None, None], axis=2)[:, :, 0]


@lru_cache(maxsize=8)
def paths_of(rig: Rig) -> Paths:
    """Paths over the cage of the rig's mean face; on other faces their points go with the skin.

    A landmark's path lies in a plane with the head's z axis, which is level where the landmark is higher than the lower
    lip, and leads to the middle of that lip otherwise. Rays from a point of the head's middle, straight inwards of the
    landmark, turn in this plane from the landmark to the front; a path ends where its ray meets no skin, at the eyes.
    """
    landmarks = (rig.landmark_weights[..., None] * rig.vertices[rig.landmark_vertices]).sum(axis=1)
    triangles = triangles_of(rig.cage_faces)
    width = rig.landmark_vertices.shape[1]
    corners = max(3, width)
    vertices, weights = np.zeros((len(JAW), STEPS, corners), np.int64), np.zeros((len(JAW), STEPS, corners))
    vertices[:, 0, :width], weights[:, 0, :width] = rig.landmark_vertices[JAW], rig.landmark_weights[JAW]
    for i in JAW:
        inside = np.array([0.0, max(landmarks[i, 1], landmarks[LOWER_LIP, 1]), landmarks[i, 2]])
        outwards = landmarks[i] - inside
        distance = np.linalg.norm(outwards)
        outwards /= distance
        turns = np.linspace(0.0, REACH_RAD, STEPS)[1:, None]
        rays = np.cos(turns) * outwards + np.sin(turns) * FORWARDS
        for step, hits in enumerate(_hits(rig.vertices[triangles] - inside, rays), start=1):
            if not len(hits.distance):
                vertices[i, step:], weights[i, step:] = vertices[i, step - 1], weights[i, step - 1]
                break
            near = np.argmin(np.abs(hits.distance - distance))  # the same sheet of skin as the point before
            distance = hits.distance[near]
            vertices[i, step, :3], weights[i, step, :3] = triangles[hits.triangle[near]], hits.share[near]
    return Paths(vertices=vertices, weights=weights)


class _Hits(NamedTuple):
    """What a ray meets: ``triangle`` (h,), weights ``share`` (h, 3) of its corners, ``distance`` (h,)."""

    triangle: np.ndarray
    share: np.ndarray
    distance: np.ndarray


def _hits(corners: np.ndarray, rays: np.ndarray) -> Iterator[_Hits]:
    """What each of the unit rays (r, 3) from the origin meets of triangles (T, 3, 3)."""
    a, b, c = np.moveaxis(corners, 1, 0)
    areas = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
    for ray in rays:
        volumes = areas @ ray
        total = volumes.sum(axis=1, keepdims=True)
        share = np.divide(volumes, total, out=np.full_like(volumes, -1.0), where=total != 0.0)
        met = np.flatnonzero((share > -1e-9).all(axis=1))  # a ray along an edge must not slip through
        distance = np.einsum("hk,hkd,d->h", share[met], corners[met], ray)
        ahead = distance > 0.0
        yield _Hits(triangle=met[ahead], share=share[met[ahead]], distance=distance[ahead])


def _make(view: FacesInView) -> dict[str, np.ndarray]:
    samples, jaw = view.samples, (view.faces.landmarks[:, JAW], view.hidden[:, JAW])
    points = label_contour(
        view.rig, view.cage, samples.camera_from_head, *jaw, tolerance_m=KEYPOINT_TOLERANCE_M
    )
    in_camera = apply_transform(samples.camera_from_head, points)
    return {"contour_2d": project_pinhole(in_camera, samples.intrinsics), "contour_3d": points}


_MEANING = "landmarks 0-16, slid to the face's outline where the face hides them"

SLIDING_CONTOUR = KeypointLabel(
    columns=(
        KeypointColumn(name="contour_2d", description=_MEANING, shape=(17, 2), unit="px"),
        KeypointColumn(
            name="contour_3d", description=f"{_MEANING}, in the head frame", shape=(17, 3), unit="m"
        ),
    ),
    asked_for=lambda spec: spec.landmarks.sliding_contour,
    make=_make,
)
