"""A face's 52 shapes as straight ways, which is what morph targets are: the rig evaluated at weight 1, one by one."""

from dataclasses import dataclass

import numpy as np

from facegen.avatars.eyeballs import clearance
from facegen.avatars.surface import vertex_normals
from facegen.conventions import BLENDSHAPES, Part
from facegen.raster import triangles_of
from facegen.rigs import Rig, evaluate
from facegen.sampling.gaze import axes_from_weights

CLEAR_M = 0.12e-3
"""Lids keep this from the drawn eye at every weight."""
WAY = (0.1, 0.2, 0.3, 0.35, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)
"""Weights at which that is looked after."""
CLOSING = ("eyeBlink", "eyeSquint", "eyeLookDown")
SKIN = (Part.SKIN, Part.LIPS, Part.BROWS, Part.MOUTH_CAVITY, Part.EYE_CAVITY)
"""Parts that are one surface."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FaceShapes:
    """One head's neutral and its shapes, V vertices of the rig.

    Attributes
    ----------
    rig
        Whose mean is this head.
    neutral
        (V, 3) with lids on the eyes.
    moved
        (52, V, 3) by weight 1.
    normals, turned
        (V, 3) and (52, V, 3) of the skin and what lines it; 0 elsewhere.
    faces, part, uv
        The coarse faces (F, 4), padded with -1, their parts (F,) and corners (F, 4, 2): those that the rig was
        subdivided from, whose vertices come first, or all.
    """

    rig: Rig
    neutral: np.ndarray
    moved: np.ndarray
    normals: np.ndarray
    turned: np.ndarray
    faces: np.ndarray
    part: np.ndarray

    def landmarks(self) -> np.ndarray:
        """(68, 3) of the neutral."""
        rig = self.rig
        return np.einsum("ln,lnc->lc", rig.landmark_weights, self.neutral[rig.landmark_vertices])


def face_shapes(rig: Rig) -> FaceShapes:
    """The shapes of a rig's mean face."""
    weights = np.concatenate([np.zeros((1, len(BLENDSHAPES))), np.eye(len(BLENDSHAPES))])
    axes = axes_from_weights(weights)
    faces = evaluate(rig, np.zeros((len(weights), rig.components)), weights, axes)
    neutral, moved = faces.vertices[0], faces.vertices[1:] - faces.vertices[0]
    for index, name in enumerate(BLENDSHAPES):
        if name.startswith(CLOSING):
            _lift_lids_off_eyeball(
                rig, neutral, moved[index], eye=int(name.endswith("Right")), looks=axes[1 + index]
            )
    triangles = triangles_of(rig.faces[np.isin(rig.part, SKIN)])
    normals = vertex_normals(neutral, triangles)
    turned = np.stack([vertex_normals(neutral + one, triangles) for one in moved]) - normals
    coarse, part = coarse_faces(rig)
    return FaceShapes(
        rig=rig, neutral=neutral, moved=moved, normals=normals, turned=turned, faces=coarse, part=part
    )


def coarse_faces(rig: Rig) -> tuple[np.ndarray, np.ndarray]:
    """Faces (F, 4) that the rig's were subdivided from and their parts (F,); the rig's own where it was not."""
    if len(rig.faces) % 4 == 0:
        quads = rig.faces.reshape(-1, 4, 4)[:, :, 0]
        known = {tuple(face) for face in np.sort(quads, axis=1).tolist()}
        if all(tuple(face) in known for face in np.sort(rig.cage_faces, axis=1).tolist()):
            return quads, rig.part[::4]
    return rig.faces, rig.part


def _lift_lids_off_eyeball(
    rig: Rig, neutral: np.ndarray, moved: np.ndarray, *, eye: int, looks: np.ndarray
) -> None:
    """Lift the skin of one eye's lids off the drawn eye on their whole way, in place.

    What is added grows with the weight as the shape does, so it is the most that any weight asks for.
    """
    lid = rig.lid_vertices[eye]
    skin = rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS, Part.LIPS, Part.LASHES))]
    lid = np.intersect1d(lid[lid >= 0], skin)
    centre, radius = rig.eye_center[eye], float(rig.eye_radius[eye])
    rest = np.linalg.norm(neutral[lid] - centre, axis=1)
    outwards = neutral[lid] + moved[lid] - centre
    outwards /= np.linalg.norm(outwards, axis=1, keepdims=True)
    # folds behind the margin lie in the eye as they are: what comes out of it is meant
    visible = clearance(neutral[lid], centre, radius, np.array([0.0, 0.0, 1.0])) > 0.0
    lift = np.zeros(len(lid))
    for weight in WAY:
        axis = np.array([0.0, 0.0, 1.0]) + weight * (looks[eye] - [0.0, 0.0, 1.0])
        at = neutral[lid] + weight * moved[lid] + weight * lift[:, None] * outwards
        lacks = CLEAR_M - clearance(at, centre, radius, axis / np.linalg.norm(axis))
        lift = np.maximum(lift, lift + lacks / weight)
    moved[lid] += (np.where(visible, lift, 0.0) * (rest < 1.6 * radius))[:, None] * outwards
