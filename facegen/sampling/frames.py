"""Draws what differs from frame to frame, for each kind of dataset: faces, gaze, pose, camera, pupils, slip."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLOCK
from facegen.expression import COMPONENTS, UNMIXED
from facegen.geometry import rotation_from_angles
from facegen.randomness import stream
from facegen.rigs import Rig, eye_centers
from facegen.sampling.cameras import draw_head_rotation, draw_keypoint_camera
from facegen.sampling.detector import RUN, draw_dropped
from facegen.sampling.faces import draw_faces
from facegen.sampling.gaze import AHEAD, axes_from_weights
from facegen.sampling.motion import CLIP_KINDS, draw_takes
from facegen.sampling.plan import Plan, Positions
from facegen.spec import Spec, draw

COMPONENT_NAMES: tuple[str, ...] = (
    *UNMIXED,
    *COMPONENTS,
    *(name for name, kind in CLIP_KINDS.items() if not kind.neutral),
)
"""What ``component`` labels count: neutral faces, frames of a recording, the mixture of stills, kinds of clips."""

FIT_AXES = 6
"""Degrees of freedom of a headset on a head: translation x, y, z and yaw, pitch, roll."""


@dataclass(frozen=True, kw_only=True, eq=False)
class DrawnFrames:
    """n frames; the rows of all arrays belong together.

    Attributes
    ----------
    weights
        (n, 52) blendshape weights.
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    component
        (n,) int8, index into `COMPONENT_NAMES`.
    rotation
        (n, 3, 3) of the head in its own frame.
    position_m
        (n, 3) of the head frame's origin in the camera frame.
    intrinsics
        (n, 4): fx, fy, cx, cy of the keypoint camera, pixels.
    pupil_radius_m
        (n,) radius of both pupils.
    slip
        (n, 6) standard normal draws of how the headset has slipped (`FIT_AXES`).
    dropped
        (n,) bool: a detector finds no face.
    """

    weights: np.ndarray
    gaze: np.ndarray
    component: np.ndarray
    rotation: np.ndarray
    position_m: np.ndarray
    intrinsics: np.ndarray
    pupil_radius_m: np.ndarray
    slip: np.ndarray
    dropped: np.ndarray


def draw_single_frames(
    plan: Plan, rig: Rig, block: int, positions: Positions, identity: np.ndarray
) -> DrawnFrames:
    """Frames of a block that are drawn each by itself."""
    spec = plan.spec

    def rng(component: str) -> np.random.Generator:
        return stream(spec.seed, component, block)

    faces = draw_faces(spec, rng, eye_centers(rig, identity))
    weights, gaze, component = faces.weights, faces.gaze, faces.component
    weights[positions.neutral] = 0.0
    gaze[positions.neutral] = AHEAD
    component[positions.neutral] = COMPONENT_NAMES.index("neutral")
    intrinsics, position = draw_keypoint_camera(spec, rng("camera"), BLOCK)
    return DrawnFrames(
        weights=weights,
        gaze=gaze,
        component=component,
        rotation=draw_head_rotation(spec, rng("head"), BLOCK),
        position_m=position,
        intrinsics=intrinsics,
        pupil_radius_m=draw(spec.eyes.pupil_radius_mm, rng("pupil"), BLOCK) * 1e-3,
        slip=rng("slip").standard_normal((BLOCK, FIT_AXES)),
        dropped=rng("detector dropped").random(BLOCK) < spec.landmarks.dropped,  # no frame follows another
    )


def draw_played_frames(plan: Plan, block: int, positions: Positions) -> DrawnFrames:
    """Frames of a block that play a recording; its weights apart, all is drawn once for each person's clip."""
    spec = plan.spec
    people, of_person = np.unique(positions.person, return_inverse=True)

    def of_each(component: str, draw_one: Callable[[np.random.Generator], np.ndarray]) -> np.ndarray:
        drawn = [draw_one(stream(spec.seed, f"played {component}", int(person))) for person in people]
        return np.concatenate(drawn)[of_person]

    camera = of_each("camera", lambda rng: np.concatenate(draw_keypoint_camera(spec, rng, 1), axis=1))
    weights = plan.recording[positions.frame]
    dropped = stream(spec.seed, "detector dropped", block)
    return DrawnFrames(
        weights=weights,
        gaze=axes_from_weights(weights),
        component=np.full(BLOCK, COMPONENT_NAMES.index("recording"), np.int8),
        rotation=of_each("head", lambda rng: draw_head_rotation(spec, rng, 1)),
        position_m=camera[:, 4:],
        intrinsics=camera[:, :4],
        pupil_radius_m=of_each("pupil", lambda rng: draw(spec.eyes.pupil_radius_mm, rng, 1)) * 1e-3,
        slip=of_each("slip", lambda rng: rng.standard_normal((1, FIT_AXES))),
        dropped=draw_dropped(dropped, BLOCK, share=spec.landmarks.dropped, run=RUN),
    )


def draw_clip_frames(plan: Plan, rig: Rig, positions: Positions, identity: np.ndarray) -> DrawnFrames:
    """Frames of a block cut from the clips that it touches; each clip is drawn whole, by its own number."""
    spec, script = plan.spec, plan.script
    clips, first_row, of_clip = np.unique(positions.clip, return_index=True, return_inverse=True)
    take = draw_takes(spec, script, clips, eye_centers(rig, identity[first_row]))
    frames = script.frames[clips % len(script.kind)]
    row = (np.cumsum(frames) - frames)[of_clip] + positions.frame
    sessions, of_session = np.unique(positions.session, return_inverse=True)
    drawn = [draw_keypoint_camera(spec, stream(spec.seed, "session camera", int(s)), 1) for s in sessions]
    intrinsics, position = (np.concatenate(parts)[of_session] for parts in zip(*drawn, strict=True))
    radius_m = np.array([_draw_pupil_radius_m(spec, int(s)) for s in sessions])[of_session]
    kinds = np.array([COMPONENT_NAMES.index(name) for name in CLIP_KINDS], np.int8)
    return DrawnFrames(
        weights=take.weights[row],
        gaze=take.gaze[row],
        component=kinds[script.kind[positions.clip % len(script.kind)]],
        rotation=rotation_from_angles(*np.radians(take.head_deg[row]).T),
        position_m=position + take.sway_m[row],
        intrinsics=intrinsics,
        pupil_radius_m=radius_m * take.pupil[row],
        slip=take.slip[row],
        dropped=take.dropped[row],
    )


def _draw_pupil_radius_m(spec: Spec, session: int) -> float:
    """Radius of a person's pupils in the room of a session: the darkest room, with the largest pupils, comes first."""
    person, within = divmod(session, spec.sequence.sessions)
    rooms = draw(spec.eyes.pupil_radius_mm, stream(spec.seed, "pupil rooms", person), spec.sequence.rooms)
    return float(np.sort(rooms)[::-1][within % spec.sequence.rooms]) * 1e-3
