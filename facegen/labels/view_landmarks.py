"""Labels the 68 landmarks in a headset's views: where they lie, and which of them a picture shows."""

from dataclasses import dataclass
from typing import ClassVar, Self

import numpy as np

from facegen.conventions import Visibility
from facegen.geometry import apply_transform, project, unproject
from facegen.headsets import HeadsetCamera
from facegen.labels.occluders import occluders
from facegen.labels.view_label import LabelKey, ParquetColumn
from facegen.raster import hidden, nearest_depth
from facegen.rigs import Rig
from facegen.scene import View
from facegen.sessions import SampleScene

VIEW_TOLERANCE_M = 5e-4
"""A face of the rendered mesh must be this much nearer to hide a landmark (floats, and lips that touch)."""
RESOLVED_M = 9e-4
"""A landmark is visible only where the picture can show it: one of the 3x3 pixels around it must see the surface at the
landmark's depth. Skin seen at grazing angles runs several millimetres per pixel. `validate` allows 1 mm."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewLandmarks:
    """Landmarks of a view.

    Attributes
    ----------
    points_2d
        (68, 2) pixels, NaN behind the camera.
    points_camera
        (68, 3) camera frame, metres.
    visibility
        (68,) uint8, `facegen.conventions.Visibility`.
    """

    points_2d: np.ndarray
    points_camera: np.ndarray
    visibility: np.ndarray

    KEYS: ClassVar = (
        LabelKey(
            name="points_2d",
            meaning="landmarks",
            unit="px",
            parquet=ParquetColumn(
                description="landmarks in the picture of camera {view}; NaN behind it",
                kind="float32",
                width=136,
                shape="68 2",
            ),
        ),
        LabelKey(name="points_camera", meaning="landmarks", unit="m, camera"),
        LabelKey(
            name="visibility",
            meaning="of the landmarks: 0 outside the picture, 1 hidden, 2 visible",
            parquet=ParquetColumn(
                description="0 outside the picture, 1 hidden, 2 visible", kind="uint8", width=68
            ),
        ),
    )

    @classmethod
    def of_sample(cls, _rig: Rig, sample: SampleScene) -> dict[str, Self]:
        """Label every view of a sample."""
        occluder, unit = occluders(sample.scene.meshes), sample.session.unit
        return {
            view.name: label_landmarks(view, sample.face.landmarks[0], occluder, unit.camera(view.name))
            for view in sample.scene.views
        }

    def record(self) -> dict[str, np.ndarray]:
        """Values of `KEYS`."""
        return {key.name: getattr(self, key.name) for key in self.KEYS}


def label_landmarks(
    view: View,
    landmarks: np.ndarray,
    occluder: tuple[np.ndarray, np.ndarray],
    camera: HeadsetCamera,
) -> ViewLandmarks:
    """Label the landmarks of one view.

    Parameters
    ----------
    view
        Camera and ``camera_from_head``.
    landmarks
        (68, 3) head frame, metres.
    occluder
        What `facegen.labels.occluders.occluders` gives for the scene.
    camera
        The headset's, whose lens may have a rim: what it covers is hidden.
    """
    in_camera = apply_transform(view.camera_from_head, landmarks)
    points_2d = project(view.camera, in_camera)
    vertices, triangles = occluder
    vertices = apply_transform(view.camera_from_head, vertices)
    inside = view.camera.contains(points_2d) & (in_camera[:, 2] > 0)
    seen = ~hidden(in_camera, vertices, triangles, tolerance_m=VIEW_TOLERANCE_M)
    seen[inside] &= _resolved(view, points_2d[inside], in_camera[inside, 2], vertices, triangles)
    with np.errstate(invalid="ignore"):  # NaN: behind the camera
        seen &= ~(camera.inside_aperture_px(points_2d) < 0)
    visibility = np.where(inside, np.where(seen, Visibility.VISIBLE, Visibility.HIDDEN), Visibility.OUTSIDE)
    return ViewLandmarks(points_2d=points_2d, points_camera=in_camera, visibility=visibility.astype(np.uint8))


def _resolved(
    view: View, pixels: np.ndarray, depth_m: np.ndarray, vertices_camera: np.ndarray, triangles: np.ndarray
) -> np.ndarray:
    """Whether one of the 3x3 pixels around each point (n, 2) sees a surface at the point's depth (n,)."""
    steps = np.stack(np.meshgrid((-1, 0, 1), (-1, 0, 1)), axis=-1).reshape(-1, 2)
    around = np.round(pixels)[:, None] + steps
    rays = unproject(view.camera, around)
    depth = nearest_depth(rays.reshape(-1, 3), vertices_camera, triangles).reshape(len(pixels), -1)
    near = np.abs(depth - depth_m[:, None]) <= RESOLVED_M
    return (near & view.camera.contains(around)).any(axis=1)
