"""A block of samples: every draw of 1,000 consecutive samples, gathered."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import BLOCK
from facegen.randomness import stream
from facegen.rigs import Rig, eye_centers
from facegen.sampling.cameras import camera_from_head, draw_head_rotation, draw_keypoint_camera
from facegen.sampling.expression import COMPONENT_NAMES, draw_faces
from facegen.sampling.gaze import axes_from_weights
from facegen.sampling.people import people_of, split_of
from facegen.sampling.plan import Plan, block_places
from facegen.spec import draw

FIT_AXES = 6
"""Degrees of freedom of a headset on a head: translation x, y, z and rotation about x, y, z."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Samples:
    """What was drawn for n samples; the rows of all arrays belong together.

    Attributes
    ----------
    sample, person, session, clip, frame
        (n,) int64, see `facegen.sampling.plan.Places`.
    time_s
        (n,) seconds from the start of the clip.
    neutral
        (n,) bool.
    split
        (n,) int8, index into `facegen.conventions.SPLITS`.
    female, age_years, ancestry
        (n,), (n,), (n, 3): see `facegen.sampling.people.People`.
    identity
        (n, K) coefficients.
    weights
        (n, 52) blendshape weights.
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    component
        (n,) int8, index into `facegen.sampling.COMPONENT_NAMES`: what made the expression.
    camera_from_head
        (n, 4, 4) of the keypoint camera.
    intrinsics
        (n, 4): fx, fy, cx, cy of the keypoint camera, pixels.
    detector_noise
        (n, 68, 2) noise of the detected landmarks, as a share of the face's width.
    pupil_radius_m
        (n, 2) radii of the pupils.
    donning, slip
        (n, 6) standard normal draws of how the headset sits, a session's and a frame's (`FIT_AXES`).
    """

    sample: np.ndarray
    person: np.ndarray
    session: np.ndarray
    clip: np.ndarray
    frame: np.ndarray
    time_s: np.ndarray
    neutral: np.ndarray
    split: np.ndarray
    female: np.ndarray
    age_years: np.ndarray
    ancestry: np.ndarray
    identity: np.ndarray
    weights: np.ndarray
    gaze: np.ndarray
    component: np.ndarray
    camera_from_head: np.ndarray
    intrinsics: np.ndarray
    detector_noise: np.ndarray
    pupil_radius_m: np.ndarray
    donning: np.ndarray
    slip: np.ndarray

    def rows(self, index: slice | np.ndarray) -> "Samples":
        """Some of the samples."""
        return Samples(**{field.name: getattr(self, field.name)[index] for field in fields(self)})


def _by_session(seed: int, component: str, session: np.ndarray, width: int) -> np.ndarray:
    blocks = np.unique(session // BLOCK)
    drawn = np.concatenate([stream(seed, component, int(b)).standard_normal((BLOCK, width)) for b in blocks])
    return drawn[np.searchsorted(blocks, session // BLOCK) * BLOCK + session % BLOCK]


def draw_samples(plan: Plan, rig: Rig, block: int) -> Samples:
    """All draws of a block of 1,000 samples; rows past the dataset's end are there, and to be cut by the caller."""
    spec, places = plan.spec, block_places(plan, block)
    people = people_of(spec, rig, places.person)

    def rng(component: str) -> np.random.Generator:
        return stream(spec.seed, component, block)

    if plan.recording is None:
        faces = draw_faces(spec, rng, eye_centers(rig, people.identity))
        weights, gaze, component = faces.weights, faces.gaze, faces.component
        weights[places.neutral] = 0.0
        gaze[places.neutral] = (0.0, 0.0, 1.0)
        component[places.neutral] = COMPONENT_NAMES.index("neutral")
    else:
        weights = plan.recording[places.frame % plan.frames]
        gaze = axes_from_weights(weights)
        component = np.full(BLOCK, COMPONENT_NAMES.index("recording"), np.int8)
    intrinsics, position = draw_keypoint_camera(spec, rng("camera"), BLOCK)
    rotation = draw_head_rotation(spec, rng("head"), BLOCK)
    pupil = draw(spec.eyes.pupil_radius_mm, rng("pupil"), BLOCK) * 1e-3
    return Samples(
        sample=places.sample,
        person=places.person,
        session=places.session,
        clip=places.clip,
        frame=places.frame,
        time_s=places.time_s,
        neutral=places.neutral,
        split=split_of(spec, places.person),
        female=people.female,
        age_years=people.age_years,
        ancestry=people.ancestry,
        identity=people.identity,
        weights=weights,
        gaze=gaze,
        component=component,
        camera_from_head=camera_from_head(rotation, position),
        intrinsics=intrinsics,
        detector_noise=rng("detector").standard_normal((BLOCK, 68, 2)) * spec.landmarks.noise_face_widths,
        pupil_radius_m=np.repeat(pupil[:, None], 2, axis=1),
        donning=_by_session(spec.seed, "donning", places.session, FIT_AXES),
        slip=rng("slip").standard_normal((BLOCK, FIT_AXES)),
    )
