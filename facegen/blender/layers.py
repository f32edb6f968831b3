"""Turns the passes that Cycles renders into layers: the camera's frame, metres, and no digits without meaning."""

from functools import lru_cache

import numpy as np

from facegen.conventions import Part
from facegen.geometry import Camera, pixel_rays
from facegen.scene.scene import Glimpse, Layers, View

NOTHING_M = 1e9
"""Cycles writes 1e10 where a ray meets nothing."""
HALF_MAX = float(np.finfo(np.float16).max)
DEPTH_STEP_M, UV_STEP = 2.0**-20, 2.0**-16
"""A micrometre, and a 32nd of a pixel of a 2,048 texture: digits below mean nothing and do not compress."""


def layers_of_passes(view: View, beauty: dict[str, np.ndarray], truth: dict[str, np.ndarray]) -> Layers:
    """Layers of a view, in the camera's frame and in metres.

    Parameters
    ----------
    view
        What was rendered.
    beauty
        Passes of the render with light, float32 (h, w, channels) by name.
    truth
        Passes of the render with the label material, one sample a pixel.
    """
    ray_length = truth["Depth"][..., 0]
    nothing = ray_length > NOTHING_M
    # custom cameras measure along the ray; labels want the distance along the camera's axis
    depth = np.where(nothing, np.inf, ray_length * _ray_z(view.camera))
    normal = np.where(nothing[..., None], 0.0, truth["Normal"] @ view.camera_from_head[:3, :3].T)
    label = truth["Combined"]
    part = np.rint(label[..., 0]).astype(np.uint8)
    return Layers(
        radiance=radiance_of_passes(beauty),
        depth=_rounded(depth, DEPTH_STEP_M),
        normal=normal.astype(np.float16).astype(np.float32),
        part=part,
        uv=np.where(part[..., None] == Part.BACKGROUND, 0.0, _rounded(label[..., 1:3], UV_STEP)),
    )


def radiance_of_passes(passes: dict[str, np.ndarray]) -> np.ndarray:
    """Radiance (h, w) float32, W sr-1 m-2, rounded to the half floats that files hold."""
    return np.clip(passes["Combined"][..., 0], 0.0, HALF_MAX).astype(np.float16).astype(np.float32)


def glimpse_of_passes(passes: dict[str, np.ndarray]) -> Glimpse:
    """Radiance and the denoiser's guides, the normals in the camera's frame."""
    return Glimpse(
        radiance=radiance_of_passes(passes),
        normal=passes["Denoising Normal"] * np.float32([1, -1, 1]),
        albedo=passes["Denoising Albedo"][..., 0],
    )


def _rounded(values: np.ndarray, step: float) -> np.ndarray:
    return (np.rint(values / step) * step).astype(np.float32)


@lru_cache(maxsize=32)
def _ray_z(camera: Camera) -> np.ndarray:
    return pixel_rays(camera)[..., 2]
