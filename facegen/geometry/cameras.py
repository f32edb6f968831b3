"""Camera models: pinhole with Brown-Conrady distortion, and equidistant fisheye, as OpenCV defines them.

Pixels count from the centre of the top-left pixel. Camera frame: x right, y down, z forward.

A distortion's polynomial fits the rays that a lens lets through. Far beyond them it may turn back, and would put what
lies beside the camera into its picture: models end at their `turning_radius`.

References
----------
.. [1] OpenCV, "Camera calibration and 3D reconstruction" and "Fisheye camera model", version 4.11.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

DISTORTION_TERMS = {"pinhole": ("k1", "k2", "p1", "p2", "k3"), "fisheye": ("k1", "k2", "k3", "k4")}
"""Names of the distortion coefficients of each model, in OpenCV's order."""
_STEPS, _STILL = 200, 1e-14
"""Most steps of Newton's method, and the relative size of the last. Six do; next to the turning point each step halves
the error only, and from pixels in the millions each goes back by a seventh."""


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


def _radial_terms(camera: Camera) -> np.ndarray:
    """Coefficients of 1, r^2, r^4, ... by which a camera's distortion multiplies the radius r."""
    k = camera.coefficients
    return np.array([1.0, k[0], k[1], k[4]]) if camera.model == "pinhole" else np.array([1.0, *k])


def project_pinhole(points_camera: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:
    """Pixels (n, p, 2) of points (n, p, 3) in the frames of n pinholes with (n, 4) fx, fy, cx, cy."""
    focal, center = intrinsics[:, None, :2], intrinsics[:, None, 2:]
    return points_camera[..., :2] / points_camera[..., 2:] * focal + center


@lru_cache(maxsize=256)
def turning_radius(camera: Camera) -> float:
    """Where a camera's distortion turns back: what lies further from the axis has no pixel.

    Without tangential terms it is the least positive root of the slope of the distorted radius. With them it is where
    the distortion's Jacobian, which is symmetric, may cease to be positive definite: its eigenvalues along and across
    the radius r differ from those without by at most 6 r |(p1, p2)|. Within, the distortion is the gradient of a
    strictly convex function, so no two rays share a pixel.

    Returns
    -------
    float
        Tangent of the angle from the axis (pinhole), +inf where nothing turns; the angle in radians, at most pi
        (fisheye).
    """
    across = _radial_terms(camera)
    along = across * np.arange(1, 2 * len(across), 2)
    tangential = 6.0 * np.hypot(*camera.coefficients[2:4]) if camera.model == "pinhole" else 0.0
    least = np.inf if camera.model == "pinhole" else np.pi
    for terms in (along, across):
        powers = np.zeros(2 * len(terms) - 1)
        powers[::2], powers[1] = terms, -tangential
        roots = np.roots(powers[::-1])
        # a double root comes with an imaginary part of the square root of rounding
        turns = roots.real[(np.abs(roots.imag) < 1e-7 * np.abs(roots)) & (roots.real > 0.0)]
        least = min([least, *turns])
    return float(least)


def project(camera: Camera, points_camera: np.ndarray) -> np.ndarray:
    """Pixels (..., 2) of points (..., 3) in the camera frame, metres.

    NaN where a camera cannot see: beyond its `turning_radius`, at z <= 0 of a pinhole, straight behind a fisheye.
    """
    points_camera = np.asarray(points_camera, np.float64)
    # as in `rotations`, gaps would change the last bit
    x, y, z = np.ascontiguousarray(np.moveaxis(points_camera, -1, 0))
    if camera.model == "pinhole":
        with np.errstate(divide="ignore", invalid="ignore"):
            in_front = z > 0
            a, b = np.where(in_front, x / z, np.nan), np.where(in_front, y / z, np.nan)
            seen = np.hypot(a, b) < turning_radius(camera)
        a, b = _distort_pinhole(a, b, camera.coefficients)
    else:
        radius = np.hypot(x, y)
        theta = np.arctan2(radius, z)
        seen = (theta < turning_radius(camera)) & ((radius > 0) | (z > 0))
        # sin(theta)/theta tends to 1 on the axis, where radius/z is 0/0
        scale = np.divide(
            _fisheye_angle(theta, camera.coefficients), radius, where=radius > 0, out=np.zeros_like(radius)
        )
        a, b = x * scale, y * scale
    pixels = np.stack([camera.fx * a + camera.cx, camera.fy * b + camera.cy], axis=-1)
    return np.where(seen[..., None], pixels, np.nan)


def unproject(camera: Camera, pixels: np.ndarray) -> np.ndarray:
    """Unit rays (..., 3) in the camera frame through pixels (..., 2); the inverse of `project`.

    NaN where no ray goes, because the distortion turns back before.
    """
    pixels = np.asarray(pixels, np.float64)
    a = (pixels[..., 0] - camera.cx) / camera.fx
    b = (pixels[..., 1] - camera.cy) / camera.fy
    distorted = np.hypot(a, b)
    radius = _undistorted_radius(camera, distorted)
    if camera.model == "fisheye":
        scale = np.divide(np.sin(radius), distorted, where=distorted > 0, out=np.ones_like(distorted))
        rays = np.stack([a * scale, b * scale, np.cos(radius)], axis=-1)
    else:
        scale = np.divide(radius, distorted, where=distorted > 0, out=np.ones_like(distorted))
        x, y = _undistorted_pinhole(camera, a, b, start=(a * scale, b * scale))
        rays = np.stack([x, y, np.ones_like(x)], axis=-1)
        rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    back = np.isclose(project(camera, rays), pixels, rtol=1e-9, atol=1e-6).all(axis=-1)
    return np.where(back[..., None], rays, np.nan)


def _undistorted_radius(camera: Camera, distorted: np.ndarray) -> np.ndarray:
    """Radii that the radial terms alone take to these; Newton's method, kept within the turning point."""
    terms, high = _radial_terms(camera), turning_radius(camera)
    if not terms[1:].any():
        return distorted
    low, high = np.zeros_like(distorted), np.full_like(distorted, high)
    radius = np.minimum(distorted, high)
    for _ in range(_STEPS):
        square = radius * radius
        ratio, slope = np.zeros_like(square), np.zeros_like(square)
        for power in range(len(terms) - 1, -1, -1):
            ratio = terms[power] + square * ratio
            slope = (2 * power + 1) * terms[power] + square * slope
        excess = radius * ratio - distorted
        low, high = np.where(excess < 0.0, radius, low), np.where(excess > 0.0, radius, high)
        with np.errstate(divide="ignore", invalid="ignore"):
            step = radius - excess / slope
        within = (step >= low) & (step <= high)
        # steps from one end of the bracket to the other and back would never end
        within &= ~(np.abs(step - radius) > 0.5 * (high - low))
        # without a turning point nothing bounds the first steps
        before, radius = (
            radius,
            np.where(within, step, np.where(np.isinf(high), 2.0 * radius, 0.5 * (low + high))),
        )
        if (np.abs(radius - before) <= _STILL * radius).all():
            break
    return radius


def _undistorted_pinhole(
    camera: Camera, a: np.ndarray, b: np.ndarray, *, start: tuple[np.ndarray, np.ndarray]
) -> tuple[np.ndarray, np.ndarray]:
    """Points of the plane z = 1 that all terms take to (a, b); Newton's method in the plane."""
    k1, k2, p1, p2, k3 = camera.coefficients
    x, y = start
    if not (p1 or p2):
        return x, y
    end = turning_radius(camera)
    for _ in range(_STEPS):
        found_a, found_b = _distort_pinhole(x, y, camera.coefficients)
        r2 = x * x + y * y
        radial = 1.0 + r2 * (k1 + r2 * (k2 + r2 * k3))
        growth = 2.0 * (k1 + r2 * (2.0 * k2 + r2 * 3.0 * k3))
        xx = radial + growth * x * x + 2.0 * p1 * y + 6.0 * p2 * x
        yy = radial + growth * y * y + 6.0 * p1 * y + 2.0 * p2 * x
        xy = growth * x * y + 2.0 * (p1 * x + p2 * y)
        off_a, off_b = found_a - a, found_b - b
        with np.errstate(divide="ignore", invalid="ignore"):
            determinant = xx * yy - xy * xy
            dx = (yy * off_a - xy * off_b) / determinant
            dy = (xx * off_b - xy * off_a) / determinant
        x, y = x - dx, y - dy
        beyond = np.minimum(end / np.maximum(np.hypot(x, y), 1e-300), 1.0)
        x, y = x * beyond, y * beyond
        if (np.hypot(dx, dy) <= _STILL * np.hypot(x, y)).all():
            break
    return x, y


def pixel_rays(camera: Camera) -> np.ndarray:
    """Unit rays (height, width, 3) through the centres of all pixels."""
    v, u = np.mgrid[0 : camera.height, 0 : camera.width]
    return unproject(camera, np.stack([u, v], axis=-1))
