"""Rigid motions, camera models and small solids: pure functions on arrays, float64."""

from facegen.geometry.camera_terms import camera_terms
from facegen.geometry.cameras import Camera, pixel_rays, project, project_pinhole, turning_radius, unproject
from facegen.geometry.ellipses import Ellipse, fit_ellipse
from facegen.geometry.mirrors import Reflection, fresnel, reflect_in_sphere, reflect_in_thread
from facegen.geometry.refraction import refract_through_sphere
from facegen.geometry.rotations import (
    angles_from_direction,
    angles_from_rotation,
    apply_transform,
    direction_from_angles,
    invert_transform,
    look_at,
    rotation_from_angles,
    transform,
)

__all__ = [
    "Camera",
    "Ellipse",
    "Reflection",
    "angles_from_direction",
    "angles_from_rotation",
    "apply_transform",
    "camera_terms",
    "direction_from_angles",
    "fit_ellipse",
    "fresnel",
    "invert_transform",
    "look_at",
    "pixel_rays",
    "project",
    "project_pinhole",
    "reflect_in_sphere",
    "reflect_in_thread",
    "refract_through_sphere",
    "rotation_from_angles",
    "transform",
    "turning_radius",
    "unproject",
]
