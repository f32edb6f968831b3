"""Where the head is and where it looks, from landmarks and irises as the detector gave them; and its smoothing."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from regress.errors import InputError
from regress.runtime.heads.camera import CameraSettings, FaceCamera
from regress.runtime.heads.eyes import MEAN_EYES, gaze_angles, own_eyes
from regress.runtime.heads.fit import FACING, fit_poses, own_shape
from regress.runtime.heads.shape import load_head_shape
from regress.runtime.sample import Sample
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.smoothing import OneEuroFilter
from regress.runtime.stages.stage import BatchStage, Stage

_AT_ONCE = 64
"""Faces of a batch: each takes 50 kB on the way, which a core's memory should hold."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadSettings:
    """What a person says of the camera and of the own face.

    Parameters
    ----------
    camera
        All unknown by default.
    neutral : (m, 68, 2) float64, optional
        Neutral frames by the same camera and detector.
    neutral_irises : (m, 2, 2) float64, optional
        Of the same frames, looking straight ahead; the subject's left eye first.
    into_camera
        Whether they look into the camera instead, wherever the head turns.
    wanted
        Whether samples keep their heads; a gaze needs them in any case.
    """

    camera: CameraSettings = field(default_factory=CameraSettings)
    neutral: np.ndarray | None = None
    neutral_irises: np.ndarray | None = None
    into_camera: bool = False
    wanted: bool = True


class HeadPose(BatchStage):
    """Finds the pose of each frame's head, and the gaze where the irises are seen.

    What is not known of the camera is taken from the take's first whole face, so a stage serves one take. Its first
    frame says whether frames have irises: in later ones without them they are not seen.
    """

    def __init__(self, settings: HeadSettings) -> None:
        self._settings = settings
        self._camera: FaceCamera | None = None
        self._has_irises: bool | None = None
        self._shape, self._eyes = load_head_shape(), MEAN_EYES
        if settings.neutral is not None:
            whole = np.isfinite(settings.neutral).all(axis=(1, 2))
            if not whole.any():
                raise InputError(
                    "no face of the neutral frames is whole; choose frames in which all points are seen"
                )
            faces = settings.neutral[whole]
            camera = settings.camera.camera(faces[0], self._shape)
            self._shape = own_shape(faces, camera, self._shape)
            if settings.neutral_irises is not None:
                poses = fit_poses(faces, camera, self._shape)
                irises = settings.neutral_irises[whole]
                self._eyes = own_eyes(faces, irises, poses, camera, into_camera=settings.into_camera)

    def use_straight_ahead(self, gaze: np.ndarray) -> None:
        """Take what eyes read (4,) where they look straight ahead: those that close go there."""
        self._eyes = replace(self._eyes, ahead=gaze.reshape(2, 2))

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with head (6,), and gaze (4,) where irises are given; NaN where a point is missing.

        Raises
        ------
        InputError
            Where a frame has irises and the first one had none: filters and tables want a gaze in all or in none.
        """
        if self._has_irises is None:
            self._has_irises = samples[0].irises is not None
        late = None if self._has_irises else next((each for each in samples if each.irises is not None), None)
        if late is not None:
            raise InputError(
                f"frame {late.label} has irises and the take's first frame has none; give NaN where they are not seen"
            )
        if not self._settings.wanted and not self._has_irises:
            return list(samples)
        heads, gazes = np.full((len(samples), 6), np.nan), np.full((len(samples), 4), np.nan)
        irises = np.array(
            [np.full((2, 2), np.nan) if each.irises is None else each.irises for each in samples]
        )
        faces = np.stack([sample.points for sample in samples])
        whole = np.flatnonzero(np.isfinite(faces).all(axis=(1, 2)))
        if len(whole) and self._camera is None:
            self._camera = self._settings.camera.camera(faces[whole[0]], load_head_shape())
        for start in range(0, len(whole), _AT_ONCE):
            rows = whole[start : start + _AT_ONCE]
            poses = fit_poses(faces[rows], self._camera, self._shape)
            heads[rows] = np.concatenate([poses.translation, angles_of(poses.rotation)], axis=1)
            gazes[rows] = gaze_angles(faces[rows], irises[rows], poses, self._camera, self._eyes).reshape(
                -1, 4
            )
        return [
            replace(
                sample,
                head=head if self._settings.wanted else sample.head,
                gaze=gaze if self._has_irises else sample.gaze,
            )
            for sample, head, gaze in zip(samples, heads, gazes, strict=True)
        ]


class HeadSmoothing(Stage):
    """One-Euro over position and angles of heads, by the frames' times.

    Parameters
    ----------
    settings
        Of the filter; a radian or a metre counts as a weight of 1.
    """

    def __init__(self, settings: OneEuro) -> None:
        self._filter = OneEuroFilter(settings, np.full(6, settings.cutoff_hz))
        self._angles = np.zeros(3)

    def step(self, sample: Sample) -> Sample:
        """The sample with its head smoothed; one without a head or a time as it is."""
        if sample.head is None or sample.time_s is None or np.isnan(sample.head).any():
            return sample
        head = sample.head.copy()
        head[3:] -= _whole_turns(head[3:] - self._angles)  # half a turn to either side is one and the same
        head = self._filter.step(sample.time_s, head).copy()
        self._angles = head[3:].copy()
        head[3:] -= _whole_turns(head[3:])
        return replace(sample, head=head)


def _whole_turns(angles: np.ndarray) -> np.ndarray:
    """Radians of the whole turns that angles are nearest to."""
    return 2 * np.pi * np.round(angles / (2 * np.pi))


def angles_of(camera_from_head: np.ndarray) -> np.ndarray:
    """Yaw to the subject's left, pitch upwards, roll towards the left shoulder (n, 3), of rotations (n, 3, 3).

    A head that looks into the camera has none of them: ``FACING @ Ry(yaw) Rx(-pitch) Rz(-roll)``.
    """
    turn = FACING @ camera_from_head
    yaw = np.arctan2(turn[:, 0, 2], turn[:, 2, 2])
    pitch = np.arcsin(np.clip(turn[:, 1, 2], -1, 1))
    return np.stack([yaw, pitch, np.arctan2(-turn[:, 1, 0], turn[:, 1, 1])], axis=1)
