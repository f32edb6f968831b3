"""Brows: a patch of skin lifted a hair's breadth, with the hairs painted on it, so that the face's shapes carry it."""

import cv2
import numpy as np

from facegen.avatars.pictures import png
from facegen.avatars.shapes import FaceShapes
from facegen.avatars.surface import Material, Surface
from facegen.conventions import LANDMARK_GROUPS, Part
from facegen.raster import triangles_of
from facegen.scene.brows import COMBING_RAD, COURSE, HALF_WIDTH_M, LEAN_RAD, LENGTH_M

LIFT_M = 0.35e-3
"""Over the skin: no flicker between the two at ten metres in a 24-bit depth buffer."""
MARGIN_M = 9e-3
WIDE_PX, HIGH_PX = 512, 128
HAIRS = 480


def draw_brow_surfaces(
    shapes: FaceShapes, *, colour: tuple[float, float, float], rng: np.random.Generator
) -> list[Surface]:
    """Both brows as one surface; ``colour`` is sRGB, 0 to 1."""
    landmarks = shapes.landmarks()
    left = landmarks[list(LANDMARK_GROUPS["left_brow"])]
    right = landmarks[list(LANDMARK_GROUPS["right_brow"])][::-1]
    low = np.minimum(left[:, :2], right[:, :2] * [-1, 1]).min(axis=0) - [MARGIN_M, 1.15 * MARGIN_M]
    high = np.maximum(left[:, :2], right[:, :2] * [-1, 1]).max(axis=0) + MARGIN_M
    triangles = triangles_of(shapes.faces[np.isin(shapes.part, (Part.SKIN, Part.BROWS))])
    corners = shapes.neutral[triangles]
    middle = corners.mean(axis=1)
    inside = ((np.abs(middle[:, 0]) > low[0]) & (np.abs(middle[:, 0]) < high[0])) & (
        (middle[:, 1] > low[1]) & (middle[:, 1] < high[1]) & (middle[:, 2] > -0.03)
    )
    # lids fold back under the brow: only what looks ahead
    inside &= (shapes.normals[triangles, 2] > 0.25).all(axis=1)
    kept = triangles[inside]
    used, numbers = np.unique(kept, return_inverse=True)
    at_rest = shapes.neutral[used]
    place = (np.stack([np.abs(at_rest[:, 0]), at_rest[:, 1]], axis=-1) - low) / (high - low)
    picture = _draw_brow(left, low, high, colour, rng)
    return [
        Surface(
            mesh="Head",
            material=Material(name="brows", roughness=0.75, picture=png(picture), alpha="BLEND"),
            positions=at_rest + LIFT_M * shapes.normals[used],
            normals=shapes.normals[used],
            triangles=numbers.reshape(-1, 3),
            uv=np.stack([place[:, 0], 1.0 - place[:, 1]], axis=-1),
            moved=shapes.moved[:, used] + LIFT_M * shapes.turned[:, used],
            turned=shapes.turned[:, used],
            bones=("Head",),
            shares=np.ones((len(used), 1)),
        )
    ]


def _draw_brow(
    line: np.ndarray,
    low: np.ndarray,
    high: np.ndarray,
    colour: tuple[float, float, float],
    rng: np.random.Generator,
) -> np.ndarray:
    """Picture (`HIGH_PX`, `WIDE_PX`, 4) uint8 of the left brow, whose landmarks are ``line`` (5, 3)."""
    scale = np.array([WIDE_PX - 1, HIGH_PX - 1]) / (high - low)
    cover = np.zeros((HIGH_PX, WIDE_PX), np.float32)
    for _ in range(HAIRS):
        course = rng.uniform(0.0, 0.93)
        across = float(np.clip(rng.normal(0.0, 0.5), -1.0, 1.0))
        root = np.array([np.interp(course, COURSE, line[:, axis]) for axis in range(2)])
        root[0] += rng.normal(0.0, 1.3e-3) * (1.0 - course)
        root[1] += 0.85 * across * np.interp(course, COURSE, HALF_WIDTH_M)
        lean = np.interp(course, COURSE, LEAN_RAD) - across * COMBING_RAD + rng.normal(0.0, 0.14)
        length = 0.85 * np.interp(course, COURSE, LENGTH_M) * rng.uniform(0.6, 1.1)
        t = np.linspace(0.0, 1.0, 8)
        heading = lean - 0.35 * t
        step = np.stack([np.cos(heading), np.sin(heading)], axis=-1) * length / len(t)
        path = (root + np.cumsum(step, axis=0) - low) * scale
        path[:, 1] = HIGH_PX - 1 - path[:, 1]
        hair = np.zeros((HIGH_PX, WIDE_PX), np.float32)
        for k in range(len(t) - 1):
            ends = [tuple(np.rint(8 * path[at]).astype(int).tolist()) for at in (k, k + 1)]
            cv2.line(hair, *ends, float(0.75 * (1.0 - t[k]) ** 0.5 + 0.1), 1, cv2.LINE_AA, 3)
        cover = 1.0 - (1.0 - cover) * (1.0 - 0.8 * hair)
    # skin below is shaded by the hair over it
    cover = np.maximum(cover, 0.55 * cv2.GaussianBlur(cover, (0, 0), 3.0))
    picture = np.empty((HIGH_PX, WIDE_PX, 4), np.uint8)
    picture[..., :3] = np.rint(255.0 * np.array(colour))
    picture[..., 3] = np.rint(255.0 * np.clip(cover, 0.0, 0.97))
    return picture
