"""Draws clips from beginning to end, all of their frames."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLINK_INDICES
from facegen.expression.acted import together
from facegen.expression.couplings import (
    CLOSE_BEYOND_JAW,
    close_lips,
    fade,
    follow_gaze,
    restrain,
)
from facegen.geometry import direction_from_angles
from facegen.randomness import stream
from facegen.sampling.detector import RUN, draw_dropped
from facegen.sampling.faces import LIDS_FOLLOW_DOWN, LIDS_FOLLOW_UP, draw_resting
from facegen.sampling.gaze import axes_from_target, weights_from_axes
from facegen.sampling.motion.blinks import draw_blinks, lid_closure
from facegen.sampling.motion.continuity import ease
from facegen.sampling.motion.envelopes import draw_edges, wander
from facegen.sampling.motion.glances import gaze_course
from facegen.sampling.motion.kinds import CLIP_KINDS, ClipKind
from facegen.sampling.motion.performances import Direction
from facegen.sampling.motion.script import Script
from facegen.sampling.motion.speech import SYLLABLES_PER_S
from facegen.spec import Spec, draw

SLIP_AXES = 6
"""Degrees of freedom of a headset on a head (see `facegen.sampling.frames.FIT_AXES`)."""
BLINKERS = 0.25
"""Log standard deviation of people's blink rates."""
HEAD_PASSAGE_S = 0.8
"""Longest turn of the head from one pose to the next."""
DRIFT_GAP_S, DRIFT_PASSAGE_S = (1.0, 2.5), 1.5
"""How often and how slowly resting activity, sway, slip and pupils change."""
SWAY_SD_M = 0.005
"""Sitting people sway by millimetres."""
HIPPUS = 0.03
"""Standard deviation of the pupils' radius over time as a share of it (hippus, about 2 to 5 %; Stark et al. 1958)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Take:
    """n frames of one or more clips; the rows of all arrays belong together.

    Attributes
    ----------
    weights
        (n, 52) blendshape weights in [0, 1], held to the couplings.
    gaze
        (n, 2, 3) unit optical axes in the head frame, subject's left eye first.
    head_deg
        (n, 3) yaw, pitch and roll of the head.
    sway_m
        (n, 3) of the head from where it is in its session, camera frame.
    pupil
        (n,) factor on the pupils' radius.
    slip
        (n, 6) how far the headset has slipped, standard deviations.
    dropped
        (n,) bool: frames in which a detector finds no face.
    """

    weights: np.ndarray
    gaze: np.ndarray
    head_deg: np.ndarray
    sway_m: np.ndarray
    pupil: np.ndarray
    slip: np.ndarray
    dropped: np.ndarray


def draw_takes(spec: Spec, script: Script, clips: np.ndarray, eye_center: np.ndarray) -> Take:
    """Takes of clips (k,), one after the other; ``eye_center`` (k, 2, 3) as in `draw_take`."""
    takes = [
        draw_take(spec, script, int(clip), center) for clip, center in zip(clips, eye_center, strict=True)
    ]
    return Take(**{f.name: np.concatenate([getattr(take, f.name) for take in takes]) for f in fields(Take)})


def draw_take(spec: Spec, script: Script, clip: int, eye_center: np.ndarray) -> Take:
    """One clip.

    Parameters
    ----------
    spec, script
        What is recorded.
    clip
        Number of the clip in the dataset: everything follows from it, however many clips are drawn before.
    eye_center
        (2, 3) centres of this person's eyeballs, head frame, metres, subject's left eye first.
    """
    session, place = divmod(clip, len(script.kind))
    kind = list(CLIP_KINDS.values())[script.kind[place]]
    time_s = np.arange(script.frames[place]) / spec.sequence.fps
    direction, blinks_per_min = _draw_habits(
        spec, kind, session // spec.sequence.sessions, int(script.index[place])
    )

    def rng(component: str) -> np.random.Generator:
        return stream(spec.seed, f"clip {component}", clip)

    head_deg = _draw_head(spec, kind, session, rng("head"), time_s)
    drift = rng("drift")
    edges = draw_edges(drift, time_s[-1], DRIFT_GAP_S)
    loose = np.clip(drift.standard_normal((len(edges) + 1, 3 + 1 + SLIP_AXES)), -3, 3)
    course = wander(time_s, edges, loose, DRIFT_PASSAGE_S)
    if kind.neutral:
        weights = np.zeros((len(time_s), len(BLENDSHAPE_INDEX)))
        gaze = np.tile([0.0, 0.0, 1.0], (len(time_s), 2, 1))
    else:
        gaze = _draw_gaze(spec, kind, direction, rng("gaze"), time_s, head_deg, eye_center)
        weights = kind.draw[direction.index % len(kind.draw)](rng("expression"), time_s, direction)
        weights = _draw_living(spec, rng("rest"), time_s, weights, gaze)
        closure = lid_closure(draw_blinks(rng("blinks"), time_s[-1], rate_per_min=blinks_per_min), time_s)
        weights[:, BLINK_INDICES] = together(weights[:, BLINK_INDICES], closure[:, None])
        weights = restrain(ease(weights))
    return Take(
        weights=weights,
        gaze=gaze,
        head_deg=head_deg,
        sway_m=SWAY_SD_M * course[:, :3],
        pupil=1.0 + HIPPUS * course[:, 3],
        slip=course[:, 4:],
        dropped=draw_dropped(rng("dropped"), len(time_s), share=spec.landmarks.dropped, run=RUN),
    )


def _draw_habits(spec: Spec, kind: ClipKind, person: int, index: int) -> tuple[Direction, float]:
    """How a person speaks, and blinks in clips of a kind (blinks a minute)."""
    rng = stream(spec.seed, "habits", person)
    low, high = SYLLABLES_PER_S
    direction = Direction(
        index=index,
        correlation=spec.expression.left_right_correlation,
        syllables_per_s=low + (high - low) * rng.random(),
    )
    return direction, kind.blinks_per_min * float(np.exp(BLINKERS * np.clip(rng.standard_normal(), -2, 2)))


def _draw_head(
    spec: Spec, kind: ClipKind, session: int, rng: np.random.Generator, time_s: np.ndarray
) -> np.ndarray:
    """Yaw, pitch and roll (n, 3) in degrees, around the session's own pose and never beyond the spec's bounds."""
    ranges = (spec.head.yaw_deg, spec.head.pitch_deg, spec.head.roll_deg)
    at_session = stream(spec.seed, "session head", session)
    home = np.concatenate([draw(d, at_session, 1) for d in ranges])
    edges = draw_edges(rng, time_s[-1], kind.head_gap_s)
    keys = np.stack([draw(d, rng, len(edges) + 1) for d in ranges], axis=-1)
    return wander(time_s, edges, home + kind.head_share * (keys - home), HEAD_PASSAGE_S)


def _draw_gaze(
    spec: Spec,
    kind: ClipKind,
    direction: Direction,
    rng: np.random.Generator,
    time_s: np.ndarray,
    head_deg: np.ndarray,
    eye_center: np.ndarray,
) -> np.ndarray:
    """Unit optical axes (n, 2, 3): eyes that keep to what they look at while the head turns."""
    fixations = kind.look[direction.index % len(kind.look)](rng, spec.gaze, float(time_s[-1]))
    yaw, pitch, distance = gaze_course(fixations, time_s)
    yaw, pitch = (
        np.clip(angle - (head_deg[:, axis] - head_deg[0, axis]), bounds.low, bounds.high)
        for axis, (angle, bounds) in enumerate(
            zip((yaw, pitch), (spec.gaze.yaw_deg, spec.gaze.pitch_deg), strict=True)
        )
    )
    target = distance[:, None] * direction_from_angles(np.radians(yaw), np.radians(pitch))
    return axes_from_target(target, np.broadcast_to(eye_center, (len(time_s), 2, 3)))


def _draw_living(
    spec: Spec, rng: np.random.Generator, time_s: np.ndarray, weights: np.ndarray, gaze: np.ndarray
) -> np.ndarray:
    """Weights (n, 52) with resting activity, faded antagonists, closed lips, and lids that follow the gaze.

    What `facegen.sampling.faces.draw_faces` does for single living faces; its draws hold for the whole clip.
    """
    edges = draw_edges(rng, time_s[-1], DRIFT_GAP_S)
    resting = draw_resting(spec.expression, rng, len(edges) + 1)
    weights = fade(together(weights, wander(time_s, edges, resting, DRIFT_PASSAGE_S)))
    beyond, down, up = rng.random(3)
    close_lips(weights, beyond=np.full(len(weights), CLOSE_BEYOND_JAW * beyond**4))
    for column, value in weights_from_axes(gaze).items():
        weights[:, column] = value
    follow_gaze(weights, down=LIDS_FOLLOW_DOWN * down, up=LIDS_FOLLOW_UP * up)
    return weights
