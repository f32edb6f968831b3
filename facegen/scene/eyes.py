"""Meshes of an eye: sclera, iris, pupil and cornea as surfaces of revolution about the optical axis."""

import numpy as np

from facegen.conventions import Part
from facegen.geometry.grids import ring_quads
from facegen.rigs.eyes import EyeGeometry
from facegen.scene.scene import Mesh

SEGMENTS = 96
"""Around the axis; a chord of the 5.9 mm limbus then lies 3 micrometres inside the circle."""
IRIS_MARGIN_M = 1.1e-3
"""The iris goes this far beyond the limbus circle, inside the ball: refraction then shows no gap."""
PUPIL_DEPTH_M = 0.3e-3
"""The dark disc lies this far behind the iris, and is as wide: from the side rays go up to 1 mm aside on their way."""


def _revolve(profile: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Vertices and quads of a profile (k, 2) of (radius, height) turned about z; falling heights face out."""
    rows = len(profile)
    angle = np.linspace(0.0, 2.0 * np.pi, SEGMENTS, endpoint=False)
    circle = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    flat = profile[:, None, :1] * circle
    vertices = np.concatenate([flat, np.broadcast_to(profile[:, None, 1:], (rows, SEGMENTS, 1))], axis=-1)
    return vertices.reshape(-1, 3), ring_quads(rows, SEGMENTS).astype(np.int32)


def _polar_uv(radius: np.ndarray) -> np.ndarray:
    """Texture coordinates (F, 4, 2) of a revolved profile: u once around, v as given for each row (k,)."""
    rows = len(radius)
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(SEGMENTS), indexing="ij")
    u = np.stack([j, j, j + 1, j + 1], axis=-1) / SEGMENTS
    v = np.stack([radius[i], radius[i + 1], radius[i + 1], radius[i]], axis=-1)
    return np.stack([u, v], axis=-1).reshape(-1, 4, 2)


def _sphere_profile(radius: float, offset: float, start: float, stop: float, rows: int) -> np.ndarray:
    angle = np.linspace(start, stop, rows)
    return np.stack([radius * np.sin(angle), offset + radius * np.cos(angle)], axis=-1)


def head_from_eye(eye: EyeGeometry) -> np.ndarray:
    """Pose (4, 4) of the eye's own frame: origin at its centre, z along the optical axis, y upwards."""
    sideways = np.cross((0.0, 1.0, 0.0), eye.axis)
    sideways /= np.linalg.norm(sideways)
    pose = np.eye(4)
    pose[:3, :3] = np.stack([sideways, np.cross(eye.axis, sideways), eye.axis], axis=-1)
    pose[:3, 3] = eye.center
    return pose


def eye_meshes(eye: EyeGeometry, side: str) -> tuple[Mesh, ...]:
    """Sclera, iris, pupil and cornea of one eye, in the head frame.

    The iris is a flat ring in the plane that labels use, its hole the physical pupil. Its texture coordinates
    are the angle about the axis (u, 0 to 1) and the place between pupil (v = 0) and limbus circle (v = 1,
    beyond it more); the sclera's v is 1 at the limbus and 0 at the back pole, and the cornea's are 0.

    Parameters
    ----------
    eye
        The eye's shape and direction.
    side
        ``"left"`` or ``"right"``; starts the meshes' names.
    """
    apex_angle = np.arcsin(eye.limbus_radius / eye.cornea_radius)
    cornea = _sphere_profile(eye.cornea_radius, eye.cornea_center_offset, 0.0, apex_angle, 24)
    limbus_angle = np.arcsin(eye.limbus_radius / eye.radius)
    sclera = _sphere_profile(eye.radius, eye.sclera_center_offset, limbus_angle, np.pi, 64)
    iris_radius = np.linspace(eye.pupil_radius, eye.limbus_radius + IRIS_MARGIN_M, 24)
    iris = np.stack([iris_radius, np.full_like(iris_radius, eye.iris_plane_offset)], axis=-1)
    depth = eye.iris_plane_offset - PUPIL_DEPTH_M
    pupil = np.array([[0.0, depth], [iris_radius[-1], depth]])
    pose = head_from_eye(eye)

    def mesh(name: str, profile: np.ndarray, part: Part, v: np.ndarray) -> Mesh:
        vertices, faces = _revolve(profile)
        return Mesh(
            name=f"{side}_{name}",
            vertices=vertices @ pose[:3, :3].T + pose[:3, 3],
            faces=faces,
            part=np.full(len(faces), part, np.uint8),
            materials=(name,),
            face_material=np.zeros(len(faces), np.int32),
            uv=_polar_uv(v),
        )

    return (
        mesh("sclera", sclera, Part.SCLERA, np.linspace(1.0, 0.0, len(sclera))),
        mesh(
            "iris",
            iris,
            Part.IRIS,
            (iris_radius - eye.pupil_radius) / (eye.limbus_radius - eye.pupil_radius),
        ),
        mesh("pupil", pupil, Part.PUPIL, np.zeros(len(pupil))),
        mesh("cornea", cornea, Part.CORNEA, np.zeros(len(cornea))),
    )
