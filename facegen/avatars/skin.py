"""The skin of an avatar's head: its surface, the chart that a picture is laid on it by, and its bones' shares."""

import numpy as np

from facegen.avatars.shapes import FaceShapes
from facegen.avatars.surface import Material, Surface
from facegen.conventions import Part
from facegen.raster import triangles_of

OUTSIDE = (Part.SKIN, Part.LIPS, Part.BROWS)
CHART_CENTRE_M = np.array([0.0, -0.02, -0.065])
"""Inside the skull: the chart goes by directions from here."""
CHART_TILT_RAD = np.radians(35.0)
"""The chart's middle lies this far below straight ahead, so that what is opposite, its rim, lies under the hair."""
CHART_FALL = 0.8
"""How much denser the chart is before the face than behind it."""
NECK_S = (-0.155, -0.085)
"""Heights between which the neck's skin goes over to the head, metres."""
CHEST_S = (-0.175, -0.12)
"""Heights between which the chest's skin goes over to the neck: shoulders that turned with it would pierce a shirt."""


def chart(points: np.ndarray) -> np.ndarray:
    """Places (..., 2) in the picture, 0 to 1 and downwards, of points (..., 3) of the head frame."""
    cosine, sine = np.cos(CHART_TILT_RAD), np.sin(CHART_TILT_RAD)
    away = (points - CHART_CENTRE_M) @ np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    angle = np.arctan2(np.hypot(away[..., 0], away[..., 1]), away[..., 2])
    turn = np.arctan2(away[..., 1], away[..., 0])
    reach = 0.495 * np.tanh(CHART_FALL * angle) / np.tanh(CHART_FALL * np.pi)
    return np.stack([0.5 + reach * np.cos(turn), 0.5 - reach * np.sin(turn)], axis=-1)


def head_share(points: np.ndarray) -> np.ndarray:
    """Share (...) that the head has in carrying points (..., 3) of the head frame; neck and chest have the rest."""
    return _above(points, NECK_S)


def chest_share(points: np.ndarray) -> np.ndarray:
    """Share (...) that the chest has in carrying points (..., 3) of the head frame."""
    return (1.0 - _above(points, CHEST_S)) * (1.0 - head_share(points))


def _above(points: np.ndarray, heights_m: tuple[float, float]) -> np.ndarray:
    # the border rises towards the front, along jaw and nape
    height = points[..., 1] + 0.35 * (points[..., 2] + 0.07)
    share = np.clip((height - heights_m[0]) / (heights_m[1] - heights_m[0]), 0.0, 1.0)
    return share * share * (3.0 - 2.0 * share)


def part_of_face(
    shapes: FaceShapes, parts: tuple[Part, ...], *, mesh: str, material: Material
) -> tuple[Surface, np.ndarray]:
    """The coarse faces of some of the head's parts as a surface, and its vertices' numbers (V,) in the rig."""
    triangles = triangles_of(shapes.faces[np.isin(shapes.part, parts)])
    used, numbers = np.unique(triangles, return_inverse=True)
    positions = shapes.neutral[used]
    head = head_share(positions)
    surface = Surface(
        mesh=mesh,
        material=material,
        positions=positions,
        normals=shapes.normals[used],
        triangles=numbers.reshape(-1, 3),
        moved=shapes.moved[:, used],
        turned=shapes.turned[:, used],
        bones=("Head", "Neck"),
        shares=np.stack([head, 1.0 - head], axis=-1),
    )
    return surface, used
