"""Camera models: pinhole with Brown-Conrady distortion, and equidistant fisheye, as OpenCV defines them.

Pixels count from the centre of the top-left pixel. Camera frame: x right, y down, z forward.

References
----------
.. [1] OpenCV, "Camera calibration and 3D reconstruction" and "Fisheye camera model", version 4.11.
"""

from dataclasses import dataclass
from typing import Literal

import numpy as np

DISTORTION_TERMS = {"pinhole": ("k1", "k2", "p1", "p2", "k3"), "fisheye": ("k1", "k2", "k3", "k4")}
"""Names of the distortion coefficients of each model, in OpenCV's order."""


@dataclass(frozen=True, kw_only=True)
class Camera:
    """Intrinsics of one camera.

    Attributes
    ----------
    model
        ``"pinhole"`` (Brown-Conrady k1, k2, p1, p2, k3) or ``"fisheye"`` (equidistant, k1 to k4).
    width, height
        Size of the picture in pixels.
    fx, fy, cx, cy
        Focal lengths and principal point in pixels.
    distortion
        Coefficients in the order of `DISTORTION_TERMS`; empty means none.
    """

    model: Literal["pinhole", "fisheye"] = "pinhole"
    width: int
    height: int
    fx: float
    fy: float
    cx: float
    cy: float
    distortion: tuple[float, ...] = ()

    @property
    def coefficients(self) -> np.ndarray:
        """Distortion coefficients, zeros where none were given."""
        terms = np.zeros(len(DISTORTION_TERMS[self.model]))
        terms[: len(self.distortion)] = self.distortion
        return terms

    @property
    def matrix(self) -> np.ndarray:
        """The (3, 3) camera matrix K."""
        return np.array([[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]])

    def contains(self, pixels: np.ndarray) -> np.ndarray:
        """Whether points (..., 2) lie inside the picture, its outermost pixels included."""
        u, v = pixels[..., 0], pixels[..., 1]
        return (u >= -0.5) & (u < self.width - 0.5) & (v >= -0.5) & (v < self.height - 0.5)


def _distort_pinhole(x: np.ndarray, y: np.ndarray, terms: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    k1, k2, p1, p2, k3 = terms
    r2 = x * x + y * y
    radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
    return (
        x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x),
        y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y,
    )


def _fisheye_angle(theta: np.ndarray, terms: np.ndarray) -> np.ndarray:
    k1, k2, k3, k4 = terms
    t2 = theta * theta
    return theta * (1.0 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4))))


def project(camera: Camera, points_camera: np.ndarray) -> np.ndarray:
    """Pixels (..., 2) of points (..., 3) in the camera frame; NaN where a camera cannot see (pinhole: z <= 0)."""
    points_camera = np.asarray(points_camera, np.float64)
    x, y, z = np.moveaxis(points_camera, -1, 0)
    if camera.model == "pinhole":
        with np.errstate(divide="ignore", invalid="ignore"):
            in_front = z > 0
            a, b = np.where(in_front, x / z, np.nan), np.where(in_front, y / z, np.nan)
        a, b = _distort_pinhole(a, b, camera.coefficients)
    else:
        radius = np.hypot(x, y)
        theta = np.arctan2(radius, z)
        # sin(theta)/theta tends to 1 on the axis, where radius/z is 0/0
        scale = np.divide(
            _fisheye_angle(theta, camera.coefficients), radius, where=radius > 0, out=np.zeros_like(radius)
        )
        a, b = x * scale, y * scale
    return np.stack([camera.fx * a + camera.cx, camera.fy * b + camera.cy], axis=-1)


def unproject(camera: Camera, pixels: np.ndarray) -> np.ndarray:
    """Unit rays (..., 3) in the camera frame through pixels (..., 2); the inverse of `project`.

    Pinhole distortion is undone by fixed-point iteration, as OpenCV does, the fisheye's by Newton's method.
    """
    pixels = np.asarray(pixels, np.float64)
    a = (pixels[..., 0] - camera.cx) / camera.fx
    b = (pixels[..., 1] - camera.cy) / camera.fy
    terms = camera.coefficients
    if camera.model == "pinhole":
        k1, k2, p1, p2, k3 = terms
        x, y = a.copy(), b.copy()
        for _ in range(60 if np.any(terms) else 0):
            r2 = x * x + y * y
            radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
            x, y = (
                (a - 2.0 * p1 * x * y - p2 * (r2 + 2.0 * x * x)) / radial,
                (b - p1 * (r2 + 2.0 * y * y) - 2.0 * p2 * x * y) / radial,
            )
        rays = np.stack([x, y, np.ones_like(x)], axis=-1)
        return rays / np.linalg.norm(rays, axis=-1, keepdims=True)
    k1, k2, k3, k4 = terms
    distorted = np.hypot(a, b)
    theta = distorted.copy()
    for _ in range(30 if np.any(terms) else 0):
        t2 = theta * theta
        slope = 1.0 + t2 * (3.0 * k1 + t2 * (5.0 * k2 + t2 * (7.0 * k3 + t2 * 9.0 * k4)))
        theta = theta - (_fisheye_angle(theta, terms) - distorted) / slope
    scale = np.divide(np.sin(theta), distorted, where=distorted > 0, out=np.ones_like(distorted))
    return np.stack([a * scale, b * scale, np.cos(theta)], axis=-1)


def pixel_rays(camera: Camera) -> np.ndarray:
    """Unit rays (height, width, 3) through the centres of all pixels."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width]
    return unproject(camera, np.stack([u, v], axis=-1))
