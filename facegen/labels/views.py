"""Labels of one rendered view: what the headset's camera sees of landmarks and eyes."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import Part, Visibility
from facegen.geometry import apply_transform, project, unproject
from facegen.labels.eye_outlines import EyeOutlines
from facegen.labels.glints import Glints
from facegen.raster import hidden, nearest_depth, triangles_of
from facegen.rigs.eyes import EyeGeometry
from facegen.scene import Mesh, View

VIEW_TOLERANCE_M = 5e-4
"""A face of the rendered mesh must be this much nearer to hide a landmark (floats, and lips that touch)."""
RESOLVED_M = 9e-4
"""A landmark is visible only where the picture can show it: one of the 3x3 pixels around it must see the surface at the
landmark's depth. Skin seen at grazing angles runs several millimetres per pixel. `validate` allows 1 mm."""

TRANSPARENT = (Part.CORNEA, Part.LENS, Part.LASHES, Part.HAIR)
"""Parts that hide no landmark behind them: cornea and lenses are clear, lashes and hair are strands."""


@dataclass(frozen=True, kw_only=True, eq=False)
class ViewLabels:
    """Labels of a view. Pixels as in `facegen.conventions`, points in the camera frame, metres.

    Attributes
    ----------
    points_2d, points_camera, visibility
        (68, 2) pixels (NaN behind the camera), (68, 3), and (68,) `facegen.conventions.Visibility`.
    eye_center_2d, pupil_center_2d
        (2, 2) pixels of eyeball and pupil centres, subject's left first; the pupil's without refraction.
    pupil_center_camera
        (2, 3) centres of the pupils.
    gaze_camera
        (2, 3) unit optical axes in the camera frame.
    eyes
        Outlines of the subject's left and right eye.
    glints
        Mirror images of the LEDs.
    """

    points_2d: np.ndarray
    points_camera: np.ndarray
    visibility: np.ndarray
    eye_center_2d: np.ndarray
    pupil_center_2d: np.ndarray
    pupil_center_camera: np.ndarray
    gaze_camera: np.ndarray
    eyes: tuple[EyeOutlines, EyeOutlines]
    glints: Glints


def occluders(
    meshes: tuple[Mesh, ...], *, transparent: tuple[Part, ...] = TRANSPARENT
) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (V, 3) and triangles (T, 3) of everything opaque in a scene, as one mesh in the head frame."""
    vertices, triangles, start = [], [], 0
    for mesh in meshes:
        opaque = ~np.isin(mesh.part, transparent)
        vertices.append(mesh.vertices)
        triangles.append(triangles_of(mesh.faces[opaque]) + start)
        start += len(mesh.vertices)
    return np.concatenate(vertices), np.concatenate(triangles)


def label_view(
    view: View,
    landmarks: np.ndarray,
    eyes: tuple[EyeGeometry, EyeGeometry],
    occluder: tuple[np.ndarray, np.ndarray],
    glints: Glints,
    outlines: tuple[EyeOutlines, EyeOutlines],
) -> ViewLabels:
    """Labels of one view.

    Parameters
    ----------
    view
        Camera and ``camera_from_head``.
    landmarks
        (68, 3) head frame, metres.
    eyes
        The subject's left and right eye.
    occluder
        What `occluders` gives for the scene.
    glints
        The view's, from `facegen.labels.glints.label_glints`.
    outlines
        Both eyes', from `facegen.labels.eye_outlines.outline_eye`.
    """
    in_camera = apply_transform(view.camera_from_head, landmarks)
    points_2d = project(view.camera, in_camera)
    vertices, triangles = occluder
    vertices = apply_transform(view.camera_from_head, vertices)
    inside = view.camera.contains(points_2d) & (in_camera[:, 2] > 0)
    seen = ~hidden(in_camera, vertices, triangles, tolerance_m=VIEW_TOLERANCE_M)
    seen[inside] &= _resolved(view, points_2d[inside], in_camera[inside, 2], vertices, triangles)
    visibility = np.where(inside, np.where(seen, Visibility.VISIBLE, Visibility.HIDDEN), Visibility.OUTSIDE)
    centers = apply_transform(view.camera_from_head, np.stack([eye.center for eye in eyes]))
    pupils = apply_transform(
        view.camera_from_head, np.stack([eye.center + eye.iris_plane_offset * eye.axis for eye in eyes])
    )
    return ViewLabels(
        points_2d=points_2d,
        points_camera=in_camera,
        visibility=visibility.astype(np.uint8),
        eye_center_2d=project(view.camera, centers),
        pupil_center_2d=project(view.camera, pupils),
        pupil_center_camera=pupils,
        gaze_camera=np.stack([eye.axis for eye in eyes]) @ view.camera_from_head[:3, :3].T,
        eyes=outlines,
        glints=glints,
    )


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
