"""Eyeballs of an avatar: one glossy ball each, with iris, pupil and veins painted on it.

Lids of an avatar go straight from open to shut, as morph targets do, and would cut through a ball of true size half
way: the ball is drawn a little smaller and its cornea flatter, and `clearance` says what the lids keep from it.
"""

import cv2
import numpy as np

from facegen.avatars.pictures import jpeg
from facegen.avatars.surface import Material, Surface, vertex_normals
from facegen.geometry.grids import halves, ring_quads
from facegen.rigs import Rig
from facegen.rigs.eyes import IRIS_RADIUS_M

SMALLER_M = 0.35e-3
"""Than the rig's ball: as much as lids keep from it, so that they clear it on their straight way."""
BULGE_M = 0.5e-3
"""Of the cornea over the ball; a true one's 1.6 mm would come through half-shut lids."""
SEGMENTS = 32
RINGS_RAD = np.radians([0, 5, 10, 15, 19, 22, 26, 33, 44, 58, 75, 95])
"""Angles from the axis of the ball's rings; behind the last nobody looks."""
PICTURE_PX = 512
EDGE_RAD = np.radians(75.0)
"""Angle from the axis at the picture's border; beyond it the border's colour goes on."""


def drawn_radius(angle: np.ndarray, radius: float) -> np.ndarray:
    """Distance of the drawn eye's surface from its centre, at angles (...) from its axis, metres."""
    limbus = np.arcsin(IRIS_RADIUS_M / radius)
    rise = np.clip(1.0 - (angle / (1.1 * limbus)) ** 2, 0.0, 1.0)
    return radius - SMALLER_M + BULGE_M * rise**1.5


def clearance(points: np.ndarray, centre: np.ndarray, radius: float, axis: np.ndarray) -> np.ndarray:
    """Distance of points (..., 3) from the drawn eye's surface along rays from its centre, negative inside, metres."""
    away = points - centre
    length = np.linalg.norm(away, axis=-1)
    angle = np.arccos(np.clip((away @ axis) / length, -1.0, 1.0))
    return length - drawn_radius(angle, radius)


def eyeballs(rig: Rig, *, picture: np.ndarray) -> list[Surface]:
    """Both eyes, subject's left first; each hangs on its bone and looks along +z.

    ``picture`` is from `draw_eye`.
    """
    material = Material(name="eyes", roughness=0.12, picture=jpeg(picture))
    surfaces = []
    for side, bone in enumerate(("LeftEye", "RightEye")):
        positions, triangles = _ball(float(rig.eye_radius[side]))
        angle = np.arctan2(np.hypot(positions[:, 0], positions[:, 1]), positions[:, 2])
        turn = np.arctan2(positions[:, 1], positions[:, 0])
        reach = 0.5 * np.minimum(angle / EDGE_RAD, 1.0)
        surfaces.append(
            Surface(
                mesh="Eyes",
                material=material,
                positions=positions + rig.eye_center[side],
                normals=vertex_normals(positions, triangles),
                triangles=triangles,
                uv=np.stack([0.5 + reach * np.cos(turn), 0.5 - reach * np.sin(turn)], axis=-1),
                bones=(bone,),
            )
        )
    return surfaces


def _ball(radius: float) -> tuple[np.ndarray, np.ndarray]:
    rings = RINGS_RAD[1:]
    turn = np.arange(SEGMENTS) * (2.0 * np.pi / SEGMENTS)
    far = drawn_radius(rings, radius)[:, None]
    ring = np.stack(
        [
            far * np.sin(rings)[:, None] * np.cos(turn),
            far * np.sin(rings)[:, None] * np.sin(turn),
            np.broadcast_to(far * np.cos(rings)[:, None], (len(rings), SEGMENTS)),
        ],
        axis=-1,
    )
    positions = np.concatenate([[[0.0, 0.0, drawn_radius(np.zeros(1), radius)[0]]], ring.reshape(-1, 3)])
    j = np.arange(SEGMENTS)
    k = (j + 1) % SEGMENTS
    fan = np.stack([np.zeros(SEGMENTS, int), 1 + j, 1 + k], axis=-1)
    return positions, np.concatenate([fan, 1 + halves(ring_quads(len(rings), SEGMENTS))])


def draw_eye(
    iris: tuple[float, float, float], radius: float, rng: np.random.Generator, size: int = PICTURE_PX
) -> np.ndarray:
    """Picture (size, size, 3) uint8 sRGB of the eye's front, as far as `EDGE_RAD` from the axis.

    ``iris`` is its colour (sRGB, 0 to 1), ``radius`` the ball's in metres.
    """
    middle = (size - 1) / 2.0
    y, x = np.mgrid[:size, :size]
    x, y = (x - middle) / middle, (middle - y) / middle
    away, turn = np.hypot(x, y) * EDGE_RAD, np.arctan2(y, x)
    limbus = np.arcsin(IRIS_RADIUS_M / radius)
    place = away / limbus  # 1 at the border of the iris
    white = np.array([0.93, 0.90, 0.875]) - 0.10 * np.clip((place - 1.3) / 2.2, 0.0, 1.0)[..., None] * (
        [0.4, 1.0, 1.0]
    )
    white = white - _draw_veins(size, rng)[..., None] * np.clip((place - 1.35) / 1.5, 0.0, 1.0)[..., None] * (
        [0.10, 0.42, 0.42]
    )
    colour = _draw_iris(np.array(iris), place, turn, rng)
    pupil = 0.34
    colour = colour * _step(place, pupil, 0.05)[..., None] + 0.012 * (
        1.0 - _step(place, pupil, 0.05)[..., None]
    )
    ring = 0.5 * np.exp(-(((place - 1.0) / 0.11) ** 2))
    share = _step(place, 1.0, 0.09)[..., None]
    picture = (colour * (1.0 - share) + white * share) * (1.0 - ring[..., None] * [0.85, 0.8, 0.75])
    # the upper lid and its lashes keep light off; the iris catches it again below
    shade = 1.0 - 0.16 * np.clip(y / 0.45, 0.0, 1.0) ** 1.2
    return np.rint(255.0 * np.clip(picture * shade[..., None], 0.0, 1.0)).astype(np.uint8)


def _draw_iris(
    colour: np.ndarray, place: np.ndarray, turn: np.ndarray, rng: np.random.Generator
) -> np.ndarray:
    """Fibres that run outwards from the pupil, a lighter ring round it, light gathered below."""
    fibres = np.zeros_like(place)
    for waves, strength in ((9, 0.3), (23, 0.35), (47, 0.35), (83, 0.3)):
        phase, sway = rng.uniform(0.0, 2.0 * np.pi, 2)
        fibres += strength * np.sin(
            waves * turn + phase + 1.6 * np.sin(5.0 * place + sway) + 0.7 * np.sin(3 * turn + sway)
        )
    around = np.exp(-(((place - 0.47) / 0.12) ** 2))
    light = 1.0 + 0.20 * fibres * np.clip((place - 0.3) / 0.2, 0.0, 1.0)
    light += 0.45 * around - 0.35 * np.clip(place - 0.7, 0.0, None)
    light += 0.30 * np.clip(-np.sin(turn), 0.0, 1.0) * np.clip(place, 0.0, 1.0)
    warm = around[..., None] * np.array([0.12, 0.06, -0.03])
    return np.clip(colour * light[..., None] + warm, 0.0, 1.0)


def _draw_veins(size: int, rng: np.random.Generator) -> np.ndarray:
    """Fine lines (size, size), 0 to 1, that wander from the border inwards."""
    picture = np.zeros((size, size), np.float32)
    for _ in range(46):
        at = rng.uniform(0.0, 2.0 * np.pi)
        # fewer above and below, where lids cover them
        at = np.arctan2(0.55 * np.sin(at), np.cos(at))
        heading, points, place = at + np.pi, [], 1.02 * np.array([np.cos(at), np.sin(at)])
        for _ in range(int(rng.integers(10, 34))):
            heading += rng.normal(0.0, 0.32) + 0.12 * np.sin(at + np.pi - heading)
            place = place + 0.018 * np.array([np.cos(heading), np.sin(heading)])
            points.append((size - 1) / 2.0 * (1.0 + place * [1.0, -1.0]))
        line = np.rint(8.0 * np.array(points)).astype(np.int32)
        cv2.polylines(
            picture, [line], False, float(rng.uniform(0.25, 0.75)), 1, lineType=cv2.LINE_AA, shift=3
        )
    return cv2.GaussianBlur(picture, (0, 0), 0.9)


def _step(value: np.ndarray, edge: float, width: float) -> np.ndarray:
    share = np.clip((value - edge) / width + 0.5, 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)
