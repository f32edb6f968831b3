"""Labels that every sample has, rendered or not: 68 landmarks before the keypoint camera."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import FACE_WIDTH_LANDMARKS, Visibility
from facegen.geometry import apply_transform
from facegen.labels.contour import JAW, label_contour
from facegen.raster import hidden_by_own
from facegen.rigs import EvaluatedFaces, Rig, evaluate, occluder
from facegen.sampling import Samples
from facegen.spec import Spec

KEYPOINT_TOLERANCE_M = 2e-3
"""A face must be this much nearer to hide a landmark. The cage cuts up to 1 mm off the smooth surface between its
vertices (measured on the default rig), and lips and lids that touch lie within another millimetre."""

AT_ONCE = 100
"""Faces evaluated and labelled together: 10 MB of vertices (default rig) stay near the processor. 1,000 took a third
longer and ten times the memory; it is one chunk of `facegen.rigs.evaluate`."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Keypoints:
    """Landmarks of n samples.

    Attributes
    ----------
    points_3d
        (n, 68, 3) head frame, metres.
    points_2d
        (n, 68, 2) exact pixels in the keypoint camera.
    detected_2d
        (n, 68, 2) the same with the spec's detector noise.
    visibility
        (n, 68) uint8, `facegen.conventions.Visibility`.
    face_width
        (n,) pixels between the landmarks at both ends of the jaw.
    contour_3d, contour_2d
        (n, 17, 3) and (n, 17, 2) the sliding contour of the jaw (`facegen.labels.contour`), as ``points_3d`` and
        ``points_2d``; (n, 0, ...) where the spec does not ask for it.
    """

    points_3d: np.ndarray
    points_2d: np.ndarray
    detected_2d: np.ndarray
    visibility: np.ndarray
    face_width: np.ndarray
    contour_3d: np.ndarray
    contour_2d: np.ndarray


def project_pinhole(points_camera: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:
    """Pixels (n, p, 2) of points (n, p, 3) in the frames of n pinholes with (n, 4) fx, fy, cx, cy."""
    focal, center = intrinsics[:, None, :2], intrinsics[:, None, 2:]
    return points_camera[..., :2] / points_camera[..., 2:] * focal + center


def label_keypoints(spec: Spec, rig: Rig, samples: Samples, faces: EvaluatedFaces | None = None) -> Keypoints:
    """Keypoint labels of samples; each row follows from its own sample alone.

    ``faces`` are the samples' faces where they have been evaluated already; their cage is enough.
    """
    if faces is None:
        starts = range(0, max(len(samples.sample), 1), AT_ONCE)
        parts = [_label_some(spec, rig, samples.rows(slice(start, start + AT_ONCE))) for start in starts]
        return Keypoints(
            **{f.name: np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(Keypoints)}
        )
    in_camera = apply_transform(samples.camera_from_head, faces.landmarks)
    points_2d = project_pinhole(in_camera, samples.intrinsics)
    first, last = FACE_WIDTH_LANDMARKS
    face_width = np.linalg.norm(points_2d[:, first] - points_2d[:, last], axis=-1)
    hiding, mesh = occluder(rig), faces.vertices
    if mesh.shape[1] > len(hiding.vertices):
        mesh = mesh[:, hiding.vertices]
    covered = hidden_by_own(
        in_camera,
        mesh,
        samples.camera_from_head,
        hiding.faces,
        tolerance_m=KEYPOINT_TOLERANCE_M,
    )
    visibility = np.where(covered, Visibility.HIDDEN, Visibility.VISIBLE)
    size = np.array([spec.camera.width_px, spec.camera.height_px])
    contour = np.empty((len(points_2d), 0, 3))
    if spec.landmarks.sliding_contour:
        jaw = faces.landmarks[:, JAW], covered[:, JAW]
        contour = label_contour(rig, mesh, samples.camera_from_head, *jaw, tolerance_m=KEYPOINT_TOLERANCE_M)
    inside = ((points_2d >= -0.5) & (points_2d < size - 0.5)).all(axis=-1) & (in_camera[..., 2] > 0)
    return Keypoints(
        points_3d=faces.landmarks,
        points_2d=points_2d,
        detected_2d=points_2d + samples.detector_noise * face_width[:, None, None],
        visibility=np.where(inside, visibility, Visibility.OUTSIDE).astype(np.uint8),
        face_width=face_width,
        contour_3d=contour,
        contour_2d=project_pinhole(apply_transform(samples.camera_from_head, contour), samples.intrinsics),
    )


def _label_some(spec: Spec, rig: Rig, samples: Samples) -> Keypoints:
    faces = evaluate(rig, samples.identity, samples.weights, samples.gaze, cage_only=True)
    return label_keypoints(spec, rig, samples, faces)
