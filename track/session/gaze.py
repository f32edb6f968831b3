"""Gaze from the irises and the head that the detector gives, without fitting a head of our own."""

from dataclasses import replace

import numpy as np

from regress.runtime.heads.eyes import MEAN_EYES, gaze_angles, own_eyes
from regress.runtime.heads.fit import FACING, HeadPoses
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage
from track.detectors.head import typical_camera
from track.profile.neutral import NeutralFace


class IrisGaze(Stage):
    """Gives samples with irises and a head their gaze.

    Parameters
    ----------
    neutral
        Of the person, looking into the camera; the eyes of the mean person without.
    """

    def __init__(self, neutral: NeutralFace | None = None) -> None:
        self._eyes = MEAN_EYES
        if neutral is None or neutral.picture is None:
            return
        points, irises, heads = (neutral.frames(name) for name in ("points", "irises", "heads"))
        if irises is not None and heads is not None:
            poses = poses_of(heads)
            camera = typical_camera(*neutral.picture)
            # as `track.session.faces` asks for; a screen is below, and who looks at it holds the head down
            self._eyes = own_eyes(points, irises, poses, camera, into_camera=True)

    def use_straight_ahead(self, gaze: np.ndarray) -> None:
        """Take what eyes read (4,) where they look straight ahead: those that close go there."""
        self._eyes = replace(self._eyes, ahead=gaze.reshape(2, 2))

    def step(self, sample: Sample) -> Sample:
        """The sample with gaze (4,); NaN where irises or head are not known, and as it was where there are none."""
        if sample.irises is None or sample.head is None or not sample.pictures:
            return sample
        if not (np.isfinite(sample.head).all() and np.isfinite(sample.points).all()):
            return replace(sample, gaze=np.full(4, np.nan))
        height, width = next(iter(sample.pictures.values())).shape[:2]
        found = gaze_angles(
            sample.points[None],
            sample.irises[None],
            poses_of(sample.head[None]),
            typical_camera(width, height),
            self._eyes,
        )
        return replace(sample, gaze=found.reshape(4))


def poses_of(heads: np.ndarray) -> HeadPoses:
    """Poses of heads (n, 6) as samples have them: the inverse of `regress.runtime.stages.head.angles_of`."""
    sine, cosine = np.sin(heads[:, 3:]), np.cos(heads[:, 3:])
    yaw, pitch, roll = np.zeros((3, len(heads), 3, 3))
    for turn, (first, second), column, sign in (
        (yaw, (0, 2), 0, 1),
        (pitch, (1, 2), 1, 1),
        (roll, (0, 1), 2, 1),
    ):
        fixed = 3 - first - second
        turn[:, fixed, fixed] = 1.0
        turn[:, first, first] = turn[:, second, second] = cosine[:, column]
        turn[:, first, second], turn[:, second, first] = sign * sine[:, column], -sign * sine[:, column]
    return HeadPoses(
        rotation=FACING @ (yaw @ pitch @ roll),
        translation=heads[:, :3],
        coefficients=np.zeros((len(heads), 0)),
    )
