"""Labels the 68 landmarks of every sample, rendered or not, before its keypoint camera."""

from dataclasses import dataclass, fields

import numpy as np

from facegen.conventions import FACE_WIDTH_LANDMARKS, Visibility
from facegen.geometry import apply_transform, project_pinhole
from facegen.labels.contour import SLIDING_CONTOUR
from facegen.labels.keypoint_label import KEYPOINT_TOLERANCE_M, FacesInView, KeypointColumn, KeypointLabel
from facegen.raster import hidden_by_own
from facegen.rigs import EvaluatedFaces, Rig, evaluate, occluder
from facegen.sampling import Samples
from facegen.spec import Spec

KEYPOINT_LABELS: tuple[KeypointLabel, ...] = (SLIDING_CONTOUR,)
"""Labels that a spec can ask for beside the landmarks; shards, ``sample.json``, packs, checks and docs/labels.md follow
from this list."""

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
    image_size
        (n, 2) width and height of the keypoint camera, pixels.
    further
        (n, ...) columns by name of those of `KEYPOINT_LABELS` that the spec asks for.
    """

    points_3d: np.ndarray
    points_2d: np.ndarray
    detected_2d: np.ndarray
    visibility: np.ndarray
    face_width: np.ndarray
    image_size: np.ndarray
    further: dict[str, np.ndarray]

    @property
    def columns(self) -> dict[str, np.ndarray]:
        """All arrays by name, the further ones too."""
        own = {field.name: getattr(self, field.name) for field in fields(self) if field.name != "further"}
        return own | self.further


def further_columns(spec: Spec) -> tuple[KeypointColumn, ...]:
    """Columns of those of `KEYPOINT_LABELS` that a spec asks for."""
    return tuple(column for label in KEYPOINT_LABELS if label.asked_for(spec) for column in label.columns)


def label_keypoints(spec: Spec, rig: Rig, samples: Samples, faces: EvaluatedFaces | None = None) -> Keypoints:
    """Keypoint labels of samples; each row follows from its own sample alone.

    ``faces`` are the samples' faces where they have been evaluated already; their cage is enough.
    """
    if faces is None:
        starts = range(0, max(len(samples.sample), 1), AT_ONCE)
        parts = [_label_some(spec, rig, samples.rows(slice(start, start + AT_ONCE))) for start in starts]
        return _joined(parts)
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
    inside = ((points_2d >= -0.5) & (points_2d < size - 0.5)).all(axis=-1) & (in_camera[..., 2] > 0)
    view = FacesInView(rig=rig, samples=samples, faces=faces, cage=mesh, points_2d=points_2d, hidden=covered)
    further = {}
    for label in KEYPOINT_LABELS:
        if label.asked_for(spec):
            further |= label.make(view)
    return Keypoints(
        points_3d=faces.landmarks,
        points_2d=points_2d,
        detected_2d=points_2d + samples.detector_noise * face_width[:, None, None],
        visibility=np.where(inside, visibility, Visibility.OUTSIDE).astype(np.uint8),
        face_width=face_width,
        image_size=np.broadcast_to(size, (len(points_2d), 2)),
        further=further,
    )


def _label_some(spec: Spec, rig: Rig, samples: Samples) -> Keypoints:
    faces = evaluate(rig, samples.identity, samples.weights, samples.gaze, cage_only=True)
    return label_keypoints(spec, rig, samples, faces)


def _joined(parts: list[Keypoints]) -> Keypoints:
    joined = {name: np.concatenate([part.columns[name] for part in parts]) for name in parts[0].columns}
    further = {name: joined.pop(name) for name in parts[0].further}
    return Keypoints(**joined, further=further)
