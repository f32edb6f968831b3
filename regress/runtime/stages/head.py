"""Where the head is and how it is turned, from the landmarks as the detector gave them; and its smoothing."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from regress.runtime.heads.camera import CameraSettings, FaceCamera
from regress.runtime.heads.fit import FACING, fit_poses, own_shape
from regress.runtime.heads.shape import HeadShape, load_head_shape
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
    """

    camera: CameraSettings = field(default_factory=CameraSettings)
    neutral: np.ndarray | None = None


class HeadPose(BatchStage):
    """Finds the pose of each frame's head.

    What is not known of the camera is taken from the take's first whole face, so a stage serves one take.
    """

    def __init__(self, settings: HeadSettings) -> None:
        self._settings = settings
        self._camera: FaceCamera | None = None
        self._shape = load_head_shape()
        if settings.neutral is not None:
            whole = settings.neutral[np.isfinite(settings.neutral).all(axis=(1, 2))]
            camera = settings.camera.camera(whole[0], self._shape)
            self._shape = own_shape(whole, camera, self._shape)

    def batch(self, samples: Sequence[Sample]) -> list[Sample]:
        """Samples with head (6,); NaN where a point is missing."""
        heads = np.full((len(samples), 6), np.nan)
        faces = np.stack([sample.points for sample in samples])
        whole = np.flatnonzero(np.isfinite(faces).all(axis=(1, 2)))
        if len(whole) and self._camera is None:
            self._camera = self._settings.camera.camera(faces[whole[0]], load_head_shape())
        for start in range(0, len(whole), _AT_ONCE):
            rows = whole[start : start + _AT_ONCE]
            heads[rows] = head_of(faces[rows], self._camera, self._shape)
        return [replace(sample, head=head) for sample, head in zip(samples, heads, strict=True)]


class HeadSmoothing(Stage):
    """One-Euro over position and angles of heads, by the frames' times.

    Parameters
    ----------
    settings
        Of the filter; a radian or a metre counts as a weight of 1.
    """

    def __init__(self, settings: OneEuro) -> None:
        self._filter = OneEuroFilter(settings, np.full(6, settings.cutoff_hz))

    def step(self, sample: Sample) -> Sample:
        """The sample with its head smoothed; one without a head or a time as it is."""
        if sample.head is None or sample.time_s is None or np.isnan(sample.head).any():
            return sample
        return replace(sample, head=self._filter.step(sample.time_s, sample.head))


def head_of(faces: np.ndarray, camera: FaceCamera, shape: HeadShape) -> np.ndarray:
    """Position in the camera frame (m), then yaw, pitch and roll (rad), of faces (n, 68, 2); (n, 6) float64."""
    poses = fit_poses(faces, camera, shape)
    return np.concatenate([poses.translation, angles_of(poses.rotation)], axis=1)


def angles_of(camera_from_head: np.ndarray) -> np.ndarray:
    """Yaw to the subject's left, pitch upwards, roll towards the left shoulder (n, 3), of rotations (n, 3, 3).

    A head that looks into the camera has none of them: ``FACING @ Ry(yaw) Rx(-pitch) Rz(-roll)``.
    """
    turn = FACING @ camera_from_head
    yaw = np.arctan2(turn[:, 0, 2], turn[:, 2, 2])
    pitch = np.arcsin(np.clip(turn[:, 1, 2], -1, 1))
    return np.stack([yaw, pitch, np.arctan2(-turn[:, 1, 0], turn[:, 1, 1])], axis=1)
