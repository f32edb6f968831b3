"""Labels where eyeballs and pupils lie in a headset's views, and where the eyes look."""

from dataclasses import dataclass
from typing import Any, ClassVar, Self

import numpy as np

from facegen.conventions import SIDES
from facegen.geometry import apply_transform, project
from facegen.labels.view_label import LabelKey
from facegen.rigs import Rig
from facegen.sessions import SampleScene


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewEyes:
    """Both eyes in a view, the subject's left first.

    Attributes
    ----------
    eye_center_2d, pupil_center_2d
        (2, 2) pixels of eyeball and pupil centres; the pupil's without refraction.
    pupil_center_camera
        (2, 3) centres of the pupils, camera frame, metres.
    gaze_camera
        (2, 3) unit optical axes in the camera frame.
    """

    eye_center_2d: np.ndarray
    pupil_center_2d: np.ndarray
    pupil_center_camera: np.ndarray
    gaze_camera: np.ndarray

    KEYS: ClassVar = (
        LabelKey(name="eye_center_2d", meaning="by side", unit="px"),
        LabelKey(name="pupil_center_2d", meaning="by side, without refraction", unit="px"),
        LabelKey(name="pupil_center_camera", meaning="by side", unit="m, camera"),
        LabelKey(name="gaze_camera", meaning="by side: the optical axis", unit="camera"),
    )

    @classmethod
    def of_sample(cls, _rig: Rig, sample: SampleScene) -> dict[str, Self]:
        """Label every view of a sample."""
        centers = np.stack([eye.center for eye in sample.eyes])
        pupils = np.stack([eye.center + eye.iris_plane_offset * eye.axis for eye in sample.eyes])
        axes = np.stack([eye.axis for eye in sample.eyes])
        labels = {}
        for view in sample.scene.views:
            pupils_camera = apply_transform(view.camera_from_head, pupils)
            labels[view.name] = cls(
                eye_center_2d=project(view.camera, apply_transform(view.camera_from_head, centers)),
                pupil_center_2d=project(view.camera, pupils_camera),
                pupil_center_camera=pupils_camera,
                gaze_camera=axes @ view.camera_from_head[:3, :3].T,
            )
        return labels

    def record(self) -> dict[str, Any]:
        """Values of `KEYS`."""
        return {key.name: dict(zip(SIDES, getattr(self, key.name), strict=True)) for key in self.KEYS}
