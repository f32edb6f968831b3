"""Paints the skin's picture: tones of the face's regions, lips, lids, hair roots and the shadows of folds."""

from dataclasses import dataclass
from itertools import pairwise

import cv2
import numpy as np
from scipy import ndimage

from facegen.avatars.haircuts import STYLES, HairStyle, in_hair
from facegen.avatars.pictures import Waves, draw_waves, noise
from facegen.avatars.shapes import FaceShapes
from facegen.avatars.skin import OUTSIDE, chart
from facegen.conventions import (
    CHIN,
    LANDMARK_GROUPS,
    LEFT_MOUTH_CORNER,
    LEFT_NOSE_WING,
    LOWER_LIP_BOTTOM,
    LOWER_LIP_SEAM,
    NOSE_BASE,
    NOSE_TIP,
    RIGHT_MOUTH_CORNER,
    RIGHT_NOSE_WING,
    UPPER_LIP_SEAM,
    Part,
)
from facegen.raster import nearest_triangles, triangles_of
from facegen.raster.z_buffer import barycentric
from facegen.rigs import Rig

PICTURE_PX = 1024
SHADOW_VIEWS = 48
SHADOW_PX = 320


@dataclass(frozen=True, kw_only=True)
class Complexion:
    """A person's colours, sRGB from 0 to 1, and how much of what shows."""

    skin: tuple[float, float, float] = (0.86, 0.67, 0.57)
    lips: tuple[float, float, float] = (0.72, 0.42, 0.39)
    hair: tuple[float, float, float] = (0.38, 0.26, 0.17)
    iris: tuple[float, float, float] = (0.33, 0.42, 0.45)
    flush: float = 1.0
    beard: float = 0.0


@dataclass(frozen=True, kw_only=True, eq=False)
class SkinSpots:
    """What differs from place to place on one person's skin, as waves of `facegen.avatars.pictures.noise`."""

    speckle: Waves
    wide: Waves
    middling: Waves
    pores: Waves
    lip_lines: Waves
    hairline: Waves


def draw_skin_spots(rng: np.random.Generator) -> SkinSpots:
    """Draw a person's spots."""
    speckle, wide, middling = (draw_waves(rng) for _ in range(3))
    pores, lip_lines = (draw_waves(rng, 28) for _ in range(2))
    return SkinSpots(
        speckle=speckle,
        wide=wide,
        middling=middling,
        pores=pores,
        lip_lines=lip_lines,
        hairline=draw_waves(rng),
    )


def paint_skin(
    shapes: FaceShapes,
    look: Complexion,
    style: HairStyle,
    *,
    spots: SkinSpots,
    size: int = PICTURE_PX,
) -> np.ndarray:
    """Picture (size, size, 3) uint8 sRGB of the head's skin on `facegen.avatars.skin.chart`."""
    rig = shapes.rig
    faces = rig.faces[np.isin(rig.part, OUTSIDE)]
    parts = rig.part[np.isin(rig.part, OUTSIDE)]
    triangles = triangles_of(faces)
    of_lips = np.concatenate([parts == Part.LIPS, (parts == Part.LIPS)[faces[:, 3] >= 0]])
    place = chart(shapes.neutral) * size - 0.5
    across = np.ptp(place[triangles], axis=1).max(axis=1)
    away = np.linalg.norm(shapes.neutral - [0.0, -0.02, -0.065], axis=1)
    drawn = nearest_triangles(place, away, triangles[across < size / 3], shape=(size, size))
    row, column = np.nonzero(drawn.triangle >= 0)
    number = np.flatnonzero(across < size / 3)[drawn.triangle[row, column]]
    corner = triangles[number]
    share = barycentric(np.stack([column, row], axis=-1).astype(float), place[corner])
    point = np.einsum("nk,nkc->nc", share, shapes.neutral[corner])
    shadow = _shadows(shapes.neutral, triangles, shapes.normals)
    light = np.einsum("nk,nk->n", share, shadow[corner])
    lips = _blurred(of_lips[number], row, column, size)
    colour = skin_tones(point, lips, light, look, style, rig=rig, neutral=shapes.neutral, spots=spots)
    picture = np.zeros((size, size, 3))
    picture[row, column] = colour
    nearest = ndimage.distance_transform_edt(drawn.triangle < 0, return_distances=False, return_indices=True)
    return np.rint(255.0 * np.clip(picture[tuple(nearest)], 0.0, 1.0)).astype(np.uint8)


def _blurred(inside: np.ndarray, row: np.ndarray, column: np.ndarray, size: int) -> np.ndarray:
    mask = np.zeros((size, size), np.float32)
    mask[row, column] = inside
    return cv2.GaussianBlur(mask, (0, 0), size / 1024 * 2.2)[row, column]


def skin_tones(
    point: np.ndarray,
    lips: np.ndarray,
    light: np.ndarray,
    look: Complexion,
    style: HairStyle,
    *,
    rig: Rig,
    neutral: np.ndarray,
    spots: SkinSpots,
) -> np.ndarray:
    """Colours (n, 3), sRGB about 0 to 1, of places on a head's skin.

    Parameters
    ----------
    point
        (n, 3) places, metres in the head frame.
    lips, light
        (n,) share of the lips' red there, and of the sky's light that comes there.
    look, style
        Whose skin, and the hair that it bears.
    rig, neutral
        The rig, and the head's vertices (V, 3).
    spots
        From `draw_skin_spots`.
    """
    marks = np.einsum("ln,lnc->lc", rig.landmark_weights, neutral[rig.landmark_vertices])
    skin = np.array(look.skin)

    def near(middle: np.ndarray, reach_m: float, flat: tuple[float, float, float] = (1, 1, 1)) -> np.ndarray:
        return np.exp(-0.5 * (((point - middle) * flat / reach_m) ** 2).sum(axis=1))

    eyes = {"left": marks[LANDMARK_GROUPS["left_eye"]], "right": marks[LANDMARK_GROUPS["right_eye"]]}
    red, yellow, cool = (np.zeros(len(point)) for _ in range(3))
    for eye, corner, wing in (
        (eyes["left"], LEFT_MOUTH_CORNER, LEFT_NOSE_WING),
        (eyes["right"], RIGHT_MOUTH_CORNER, RIGHT_NOSE_WING),
    ):
        middle = eye.mean(axis=0)
        cheek = (
            0.42 * marks[corner] + 0.58 * middle + (marks[corner] - marks[LOWER_LIP_BOTTOM]) * [0.35, 0, 0]
        )
        red += 0.75 * near(cheek, 15e-3, (1.0, 1.15, 0.6))
        red += 0.35 * near(marks[wing], 7e-3)
        red += 0.28 * near(middle + np.array([0, 8e-3, 0]), 11e-3, (0.8, 1.4, 0.7))
        cool += 0.45 * near(middle - [0, 15e-3, 0], 8e-3, (0.6, 1.2, 0.6))
    red += 0.6 * near(marks[NOSE_TIP], 9e-3) + 0.2 * near(marks[CHIN] + [0, 8e-3, 0], 12e-3)
    red += (
        0.9
        * np.clip((np.abs(point[:, 0]) - 0.066) / 0.012, 0, 1)
        * np.clip((-0.055 - point[:, 2]) / 0.02, 0, 1)
        * (np.abs(point[:, 1] + 0.02) < 0.05)
    )
    yellow += 0.5 * near(np.array([0.0, 0.065, 0.0]), 32e-3, (0.7, 1.0, 0.6))
    speckle = noise(point, 3.5e-3, spots.speckle)
    mottle = (
        0.5 * noise(point, 24e-3, spots.wide) + 0.35 * noise(point, 9e-3, spots.middling) + 0.25 * speckle
    )
    pores = noise(point, 1.6e-3, spots.pores)
    red = look.flush * (red + 0.10 * mottle)
    colour = skin * (1.0 + 0.016 * mottle + 0.012 * pores)[:, None]
    depth = float(skin.mean())  # dark skins flush less
    colour += depth * (
        red[:, None] * [0.015, -0.075, -0.07]
        + yellow[:, None] * [0.0, 0.0, -0.03]
        + cool[:, None] * [-0.045, -0.05, -0.02]
    )
    if look.beard > 0.0:
        colour *= 1.0 - look.beard * _beard(point, marks, pores)[:, None] * [0.20, 0.17, 0.12]
    lines = noise(point * [1.0, 0.12, 0.3], 1.5e-3, spots.lip_lines)
    colour = _paint_lips(colour, point, lips, marks, look, lines)
    rim = _lid_line(point, rig, neutral)
    colour *= 1.0 - rim[:, None] * [0.55, 0.62, 0.62]
    # folds: light that comes back from skin is red
    colour *= 1.0 - (1.0 - light[:, None]) * [0.42, 0.55, 0.58]
    # a cap hides cropped hair, of which its sides show some
    inside = in_hair(STYLES["short"] if style.cloth else style, point) + 0.02 * noise(
        point, 5e-3, spots.hairline
    )
    scalp = np.clip(inside / np.radians(8.0) + 0.3, 0.0, 1.0)
    # ears and what lies beside the face at their height have no roots
    scalp *= 1.0 - np.clip((np.abs(point[:, 0]) - 0.078) / 0.004, 0, 1) * (point[:, 1] < 0.045)
    roots = (scalp * scalp * (3.0 - 2.0 * scalp))[:, None] * 0.86
    return colour * (1.0 - roots) + roots * np.array(look.hair) * 0.8


def _paint_lips(
    colour: np.ndarray,
    point: np.ndarray,
    lips: np.ndarray,
    marks: np.ndarray,
    look: Complexion,
    lines: np.ndarray,
) -> np.ndarray:
    seam = 0.5 * (marks[UPPER_LIP_SEAM, 1] + marks[LOWER_LIP_SEAM, 1])
    upper = np.clip((point[:, 1] - seam) / 2e-3 + 0.5, 0.0, 1.0)
    red = np.array(look.lips) * (1.03 - 0.09 * upper + 0.05 * lines)[:, None]
    share = np.clip(1.25 * lips - 0.1, 0.0, 1.0)[:, None] * 0.88
    return colour * (1.0 - share) + red * share


def _beard(point: np.ndarray, marks: np.ndarray, pores: np.ndarray) -> np.ndarray:
    """Share (n,) of shaved beard: below the nose, on chin and jaw, with stubble."""
    below = np.clip((marks[NOSE_BASE, 1] - 2e-3 - point[:, 1]) / 10e-3, 0, 1)
    cheek = np.interp(
        np.abs(point[:, 0]),
        [0.02, 0.045, 0.07],
        [marks[NOSE_BASE, 1], marks[RIGHT_MOUTH_CORNER, 1] + 4e-3, -0.03],
    )
    inside = np.clip((cheek - point[:, 1]) / 9e-3, 0, 1) * np.clip((point[:, 1] + 0.135) / 0.02, 0, 1)
    return below * inside * np.clip((point[:, 2] + 0.09) / 0.03, 0, 1) * (0.8 + 0.35 * pores)


def _lid_line(point: np.ndarray, rig: Rig, neutral: np.ndarray) -> np.ndarray:
    """Share (n,) of the dark line that roots of lashes draw along the lids, stronger on the upper ones."""
    line = np.zeros(len(point))
    for eye in range(2):
        near = np.linalg.norm(point - rig.eye_center[eye], axis=1) < 0.032
        for margin, strength, reach in (
            (rig.upper_lid[eye], 0.85, 0.8e-3),
            (rig.lower_lid[eye], 0.35, 0.6e-3),
        ):
            path = neutral[margin]
            dense = np.concatenate([a + (b - a) * np.linspace(0, 1, 8)[:, None] for a, b in pairwise(path)])
            along = np.linspace(0.0, 1.0, len(dense))
            gap = np.linalg.norm(point[near][:, None] - dense, axis=-1)
            first = gap.argmin(axis=1)
            fade = np.clip((along[first] - 0.08) / 0.1, 0.0, 1.0)
            there = strength * fade * np.exp(-0.5 * (gap[np.arange(len(first)), first] / reach) ** 2)
            line[near] = np.maximum(line[near], there)
    return line


def _shadows(vertices: np.ndarray, triangles: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Share (V,) of an even sky that vertices see: drawn from many sides, what is nearest is lit."""
    index = np.arange(SHADOW_VIEWS) + 0.5
    height = 1.0 - 2.0 * index / SHADOW_VIEWS
    turn = np.pi * (1.0 + 5.0**0.5) * index
    flat = np.sqrt(1.0 - height**2)
    views = np.stack([flat * np.cos(turn), height, flat * np.sin(turn)], axis=-1)
    seen, all_of = np.zeros(len(vertices)), np.zeros(len(vertices))
    for view in views:
        side = np.cross(view, [0.0, 1.0, 0.0] if abs(view[1]) < 0.9 else [1.0, 0.0, 0.0])
        side /= np.linalg.norm(side)
        local = vertices @ np.stack([side, np.cross(view, side), view], axis=-1)
        low, span = local[:, :2].min(axis=0), np.ptp(local[:, :2], axis=0).max()
        pixels = (local[:, :2] - low) / span * (SHADOW_PX - 1)
        depth = nearest_triangles(pixels, local[:, 2], triangles, shape=(SHADOW_PX, SHADOW_PX)).value
        depth = ndimage.minimum_filter(depth, 3)
        at = np.rint(pixels).astype(int)
        lit = local[:, 2] > depth[at[:, 1], at[:, 0]] - 1.2e-3
        weight = np.clip(normals @ view, 0.0, None)
        seen += weight * lit
        all_of += weight
    return seen / np.maximum(all_of, 1e-9)
