"""A rig: a head that is linear in identity and expression, with landmarks, eyes and lids marked on it."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES, EYE_LOOK_INDICES


@dataclass(frozen=True, kw_only=True, eq=False)
class Rig:
    """Everything about a head that does not depend on the sample; float64 in memory, float32 on disk.

    All positions are in the head frame, in metres: origin midway between the eyeballs that the source
    draws in the mean head, x to the subject's left, y up, z out of the face. ``V`` vertices, ``F`` faces, ``K``
    identity components, ``T`` traits.

    Attributes
    ----------
    name
        Name under which the rig was built.
    vertices
        (V, 3) mean adult neutral. The first ``cage_vertices`` of them belong to the coarse cage.
    faces
        (F, 4) int32 vertex indices, counter-clockwise seen from outside; triangles are padded with -1.
    cage_faces
        (C, 4) int32, a coarse mesh over the cage's vertices that stands for the visible head in occlusion
        tests of keypoints; equal to a subset of ``faces`` where a rig was not subdivided.
    cage_vertices
        Number of vertices of the cage; landmarks, lid rings and cage faces use only these.
    uv
        (F, 4, 2) texture coordinates of each face's corners, in [0, 1].
    part
        (F,) uint8, `facegen.conventions.Part` of each face.
    identity
        (K, V, 3) displacements, scaled so that coefficients are about N(0, 1) over the rig's population.
    identity_from_traits
        (K, T) mean coefficients as a linear function of traits; (K, 0) where the rig knows no traits.
    identity_residual
        (K, K) lower triangular factor of the coefficients' covariance given the traits: a person is
        ``identity_from_traits @ traits + identity_residual @ N(0, 1)``.
    traits
        (T,) names of the traits, in order: ``"one"`` (the constant 1), ``"female"`` (0 or 1), ``"age"`` (0 at
        25, 1 at 90 years), ``"african"``, ``"asian"`` (shares of ancestry; the rest is caucasian).
    expression
        (52, V, 3) displacements of the ARKit blendshapes in `facegen.conventions.BLENDSHAPES` order, weight
        1.
    landmark_vertices, landmark_weights
        (68, n) indices and weights: a landmark is the weighted sum of its vertices.
    eye_center, eye_center_identity
        (2, 3) and (K, 2, 3): the eyes' centres of rotation, subject's left first, linear in identity.
    eye_radius, eye_radius_identity
        (2,) and (K, 2): radii of the eyeballs in metres.
    upper_lid, lower_lid
        (2, U) and (2, L) vertex indices along the lid margins, subject's left eye first, each from the inner
        to the outer canthus, both canthi included; the shorter of a pair repeats its last vertex.
    lid_vertices
        (2, M) indices of the skin and lash vertices that follow a closing lid, those of the margins among them, padded
        with -1.
    licence, source, version
        Where the shapes come from and under which terms pictures of them may be used.
    missing
        Blendshapes that the source does not have; their displacements are zero. Datasets leave the weights of those
        that nothing shows (`unseen`) at zero.
    sha256
        Of the file the rig was read from; empty for a rig that was not saved yet.
    """

    name: str
    vertices: np.ndarray
    faces: np.ndarray
    cage_faces: np.ndarray
    cage_vertices: int
    uv: np.ndarray
    part: np.ndarray
    identity: np.ndarray
    identity_from_traits: np.ndarray
    identity_residual: np.ndarray
    traits: tuple[str, ...]
    expression: np.ndarray
    landmark_vertices: np.ndarray
    landmark_weights: np.ndarray
    eye_center: np.ndarray
    eye_center_identity: np.ndarray
    eye_radius: np.ndarray
    eye_radius_identity: np.ndarray
    upper_lid: np.ndarray
    lower_lid: np.ndarray
    lid_vertices: np.ndarray
    licence: str
    source: str
    version: str
    missing: tuple[str, ...] = ()
    sha256: str = ""

    @property
    def components(self) -> int:
        """Number K of identity components."""
        return len(self.identity)

    @property
    def unseen(self) -> list[int]:
        """Indices of missing blendshapes that nothing shows: eyeballs turn by eyeLook, where no lid follows too."""
        return [i for i, name in enumerate(BLENDSHAPES) if name in self.missing and i not in EYE_LOOK_INDICES]
