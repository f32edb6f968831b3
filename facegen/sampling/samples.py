"""Draws blocks of 1,000 consecutive samples: everything that is drawn of them, gathered."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import BLOCK
from facegen.randomness import stream
from facegen.rigs import Rig
from facegen.sampling.blocks import blocks_of
from facegen.sampling.cameras import camera_from_head
from facegen.sampling.detector import draw_detector_noise
from facegen.sampling.frames import FIT_AXES, draw_clip_frames, draw_played_frames, draw_single_frames
from facegen.sampling.people import people_of, split_of
from facegen.sampling.plan import Plan, block_positions


@dataclass(frozen=True, kw_only=True, eq=False)
class Samples:
    """What was drawn for n samples; the rows of all arrays belong together.

    Attributes
    ----------
    sample, person, session, clip, frame
        (n,) int64, see `facegen.sampling.plan.Positions`.
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
        (n, 52) blendshape weights; those of shapes that the rig lacks are 0 (`facegen.rigs.Rig.unseen`).
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    component
        (n,) int8, index into `facegen.sampling.frames.COMPONENT_NAMES`: what made the expression.
    camera_from_head
        (n, 4, 4) of the keypoint camera.
    intrinsics
        (n, 4): fx, fy, cx, cy of the keypoint camera, pixels.
    detector_noise
        (n, 68, 2) noise of the detected landmarks, as a share of the face's width; NaN where no face is found.
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
    blocks, row = blocks_of(session)
    return np.concatenate([stream(seed, component, b).standard_normal((BLOCK, width)) for b in blocks])[row]


def draw_samples(plan: Plan, rig: Rig, block: int) -> Samples:
    """All draws of a block of 1,000 samples; rows past the dataset's end are there, and to be cut by the caller."""
    spec, positions = plan.spec, block_positions(plan, block)
    people = people_of(spec, rig, positions.person)
    if plan.script is not None:
        frames = draw_clip_frames(plan, rig, positions, people.identity)
    elif plan.recording is not None:
        frames = draw_played_frames(plan, block, positions)
    else:
        frames = draw_single_frames(plan, rig, block, positions, people.identity)
    frames.weights[:, rig.unseen] = 0.0  # behind the draws, so that all others stay what they are
    noise = draw_detector_noise(
        spec.landmarks, spec.seed, block, person=positions.person, rotation=frames.rotation
    )
    noise[frames.dropped] = np.nan
    return Samples(
        **vars(positions),
        **vars(people),
        split=split_of(spec, positions.session if spec.split == "session" else positions.person),
        weights=frames.weights,
        gaze=frames.gaze,
        component=frames.component,
        camera_from_head=camera_from_head(frames.rotation, frames.position_m),
        intrinsics=frames.intrinsics,
        detector_noise=noise,
        pupil_radius_m=np.repeat(frames.pupil_radius_m[:, None], 2, axis=1),
        donning=_by_session(spec.seed, "donning", positions.session, FIT_AXES),
        slip=frames.slip,
    )
