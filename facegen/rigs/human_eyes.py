"""Gives a rig eyes of human size: balls that fill the lids of every identity, in place of those its source draws.

Sources draw large balls (MakeHuman 16.6 mm, ICT-FaceKit 15, people 12 [1]_), before which a pupil moves up to 1.4
times too far a degree. The lids stay where they are, and the landmarks on them. The ball comes forward until it
touches the margins before the iris, and its pupil to where people's is between them.

References
----------
.. [1] I. Bekerman et al., "Variations in eyeball diameters of the healthy adults", J. Ophthalmology 2014, 503645:
   24.2 mm across, 23.7 mm high, with a standard deviation of about 0.8 mm between people, hardly any between sexes.
"""

from dataclasses import replace

import numpy as np

from facegen.rigs.eyes import lid_support_radius
from facegen.rigs.rig import Rig

EYE_RADIUS_M, EYE_RADIUS_SD_M = 12.0e-3, 0.4e-3
CLEARANCE_M = 0.2e-3
"""Mean distance of the margins from an eye that looks ahead, before the skin is pushed off it where it is nearer than
`facegen.rigs.lid_closing.THICKNESS_M` allows."""
BEFORE_IRIS_M = 6.0e-3
"""Margins so far beside the pupil's middle decide how far forward the eye comes."""
PUPIL_SHARE = 0.42
"""Of the opening's height lies above the middle of the pupil: upper lids cover the iris, lower ones touch its edge."""
_STEPS, _PROBE = 12, 1.5


def with_human_eyes(rig: Rig) -> Rig:
    """The rig with eyeballs of human size in its lids; their sizes and places are linear in identity.

    A person's radius follows the size of the source's eyes, scaled to `EYE_RADIUS_SD_M`.
    """
    size = rig.eye_radius_identity.mean(axis=1)
    spread = np.linalg.norm(size)
    size = EYE_RADIUS_SD_M * size / spread if spread > 0.0 else np.zeros(rig.components)
    probes = _PROBE * np.concatenate([np.zeros((1, rig.components)), *np.stack([np.eye(rig.components)] * 2)])
    probes[1 + rig.components :] *= -1.0
    center = np.stack(
        [_centers(rig, side, probes, EYE_RADIUS_M + probes @ size) for side in range(2)], axis=1
    )
    plus, minus = center[1 : 1 + rig.components], center[1 + rig.components :]
    return replace(
        rig,
        eye_center=center[0],
        eye_center_identity=(plus - minus) / (2.0 * _PROBE),
        eye_radius=np.full(2, EYE_RADIUS_M),
        eye_radius_identity=np.stack([size, size], axis=1),
    )


def _centers(rig: Rig, side: int, identity: np.ndarray, radius: np.ndarray) -> np.ndarray:
    """Centres (n, 3) of one side's eyes of the given radii (n,) in the lids of the identities (n, K)."""
    center = rig.eye_center[side] + identity @ rig.eye_center_identity[:, side]
    upper, lower = (
        rig.vertices[ring] + np.tensordot(identity, rig.identity[:, ring], 1)
        for ring in (rig.upper_lid[side], rig.lower_lid[side])
    )
    top, bottom = _height_at(upper, center[:, 0]), _height_at(lower, center[:, 0])
    center[:, 1] = top - PUPIL_SHARE * (top - bottom)
    margins = np.concatenate([upper[:, 1:-1], lower[:, 1:-1]], axis=1)
    beside_m = np.abs(margins[..., 0] - center[:, None, 0])
    # of coarse lids on wide eyes none may lie before the iris: then the nearest decide
    near = beside_m < np.maximum(BEFORE_IRIS_M, 1.01 * beside_m.min(axis=1, keepdims=True))
    for _ in range(_STEPS):
        away = margins - center[:, None]
        length = np.linalg.norm(away, axis=-1)
        support = lid_support_radius(away / length[..., None], radius[:, None], np.array([0.0, 0.0, 1.0]))
        clearance = ((length - support) * near).sum(axis=1) / near.sum(axis=1)
        center[:, 2] += clearance - CLEARANCE_M
    return center


def _height_at(margin: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Height (n,) of margins (n, m, 3) over x (n,)."""
    outwards = np.sign(x)
    return np.array(
        [
            np.interp(sign * at, np.maximum.accumulate(sign * line[:, 0]), line[:, 1])
            for sign, at, line in zip(outwards, x, margin, strict=True)
        ]
    )
