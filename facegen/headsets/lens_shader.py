"""Repeats the iterations of the renderer's lens shader (``facegen/blender/lens.osl``) in NumPy.

They have a fixed number of steps and do not converge for every distortion that labels can follow.
"""

import numpy as np

from facegen.geometry import Camera
from facegen.geometry.cameras import DISTORTION_TERMS

_NEWTON_STEPS, _FIXED_POINT_STEPS = 20, 40


def rendered_rays(camera: Camera, pixels: np.ndarray) -> np.ndarray:
    """Rays (..., 3) in the camera frame that the renderer sends through pixels (..., 2)."""
    a = (pixels[..., 0] - camera.cx) / camera.fx
    b = (pixels[..., 1] - camera.cy) / camera.fy
    terms = dict(zip(DISTORTION_TERMS[camera.model], camera.distortion, strict=False))
    k1, k2, k3, k4, p1, p2 = (terms.get(name, 0.0) for name in ("k1", "k2", "k3", "k4", "p1", "p2"))
    if camera.model == "fisheye":
        distorted = np.hypot(a, b)
        theta = distorted
        for _ in range(_NEWTON_STEPS):
            t2 = theta * theta
            value = theta * (1 + t2 * (k1 + t2 * (k2 + t2 * (k3 + t2 * k4)))) - distorted
            theta = theta - value / (1 + t2 * (3 * k1 + t2 * (5 * k2 + t2 * (7 * k3 + t2 * 9 * k4))))
        scale = np.divide(np.sin(theta), distorted, where=distorted > 0, out=np.ones_like(distorted))
        return np.stack([a * scale, b * scale, np.cos(theta)], axis=-1)
    x, y = a, b
    for _ in range(_FIXED_POINT_STEPS):
        r2 = x * x + y * y
        radial = 1 + r2 * (k1 + r2 * (k2 + r2 * k3))
        x, y = (
            (a - 2 * p1 * x * y - p2 * (r2 + 2 * x * x)) / radial,
            (b - p1 * (r2 + 2 * y * y) - 2 * p2 * x * y) / radial,
        )
    return np.stack([x, y, np.ones_like(x)], axis=-1)
