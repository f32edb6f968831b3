"""The tongue: a soft body from the throat to its tip, resting in the lower arch or put out over the lip."""

import numpy as np
import scipy

from facegen.geometry.grids import facing_back, ring_quads

ALONG, AROUND = 40, 32
REST = np.array(
    [[-28.0, -56.0], [-10.0, -50.0], [-3.0, -39.0], [-2.5, -28.0], [-4.0, -17.0], [-5.5, -9.5], [-6.0, -5.0]]
)
"""Middle line at rest, height over and distance before the lower incisors' edges, millimetres; it begins in the throat
and ends behind the incisors."""
HALF_WIDTH = np.array([16.0, 18.0, 18.5, 18.0, 15.5, 12.0, 8.5])
HALF_HEIGHT = np.array([9.0, 9.0, 8.5, 7.5, 5.6, 4.2, 3.0])
"""Of the body at those places."""
BROAD = np.array([1.0, 1.0, 0.95, 0.85, 0.92, 1.12, 1.3])
"""Factors on the width of a tongue that is put out."""
RISEN = 0.4
"""At this share of its way out the tip lies on the teeth."""
ROUND_MM = 8.0
"""The tip is rounded off within this length."""


def tongue_surface(
    *,
    size: float,
    width: float,
    out: float,
    path_mm: np.ndarray,
    room_mm: float,
) -> tuple[np.ndarray, np.ndarray]:
    """The tongue in a frame with its origin at the lower incisors' edges: x left, y up, z forward.

    Parameters
    ----------
    size, width
        Factors on everything and on the width.
    out
        0 at rest to 1 put out.
    path_mm
        (4, 2) heights and distances that the middle line's last four points have when the tongue is out.
    room_mm
        Height between upper and lower teeth that the tongue has when it is put out.

    Returns
    -------
    vertices : numpy.ndarray
        (V, 3) metres.
    faces : numpy.ndarray
        (F, 4) int32, outsides out; triangles padded with -1.
    """
    # it rises over the teeth before it comes forward, along the way that it lies on in the end
    lift, reach = _smooth(min(out / RISEN, 1.0)), max(out - RISEN, 0.0) / (1.0 - RISEN)
    share = 1.0 - (1.0 - np.linspace(0.0, 1.0, ALONG)) ** 1.5  # nearer together at the tip
    rest = _dense(size * REST, 1.0, share)
    way = size * REST + np.array([0.0, 2.0]) * size
    way[-4:] = path_mm
    to_teeth, whole = (np.linalg.norm(np.diff(way[:end], axis=0), axis=1).sum() for end in (4, len(way)))
    put_out = _dense(way, (to_teeth + reach * (whole - to_teeth)) / whole, share)
    middle = _softened(rest + lift * (put_out - rest))
    at = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(middle, axis=0), axis=1))])
    stations = np.linspace(0.0, 1.0, len(REST))
    flat = np.minimum(HALF_HEIGHT, max(0.42 * room_mm / size, 2.2))
    broad = HALF_WIDTH * (1.0 + lift * reach * (BROAD - 1.0))
    half_width = size * width * scipy.interpolate.pchip_interpolate(stations, broad, share)
    high = HALF_HEIGHT + lift * (flat - HALF_HEIGHT)
    half_height = size * scipy.interpolate.pchip_interpolate(stations, high, share)
    left = np.clip((at[-1] - at) / (size * ROUND_MM), 0.0, 1.0)
    tip = np.sqrt(np.clip(1.0 - (1.0 - left) ** 2, 0.0, 1.0))
    half_width, half_height = half_width * tip, half_height * (0.25 + 0.75 * tip) * np.sqrt(tip)
    tangent = np.gradient(middle, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    # (height, distance): up where it runs forward
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)
    turn = np.arange(AROUND) * (2.0 * np.pi / AROUND)
    x = np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** 0.85
    y = np.sign(np.sin(turn)) * np.abs(np.sin(turn)) ** 0.9
    # a furrow along the middle of the back
    furrow = np.where(y > 0.0, -0.16 * np.exp(-((x / 0.16) ** 2)), 0.0)
    rise = half_height[:-1, None] * (y + furrow)
    sides = half_width[:-1, None] * x
    rings = np.stack(
        [sides, middle[:-1, :1] + rise * normal[:-1, :1], middle[:-1, 1:] + rise * normal[:-1, 1:]], axis=-1
    )
    vertices = np.concatenate([rings.reshape(-1, 3), [[0.0, *middle[-1]]]])
    quads = facing_back(ring_quads(ALONG - 1, AROUND))
    last, j = (ALONG - 2) * AROUND, np.arange(AROUND)
    fan = np.stack(
        [last + j, last + (j + 1) % AROUND, np.full(AROUND, len(vertices) - 1), np.full(AROUND, -1)], axis=-1
    )
    return 1e-3 * vertices, np.concatenate([quads, fan]).astype(np.int32)


def _dense(line: np.ndarray, until: float, share: np.ndarray) -> np.ndarray:
    """Points (n, 2) of the smooth line through ``line`` (k, 2), at shares (n,) of its first ``until`` (a share too)."""
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    return scipy.interpolate.pchip_interpolate(knots, line, until * knots[-1] * share)


def _smooth(x: float) -> float:
    return x * x * (3.0 - 2.0 * x)


def _softened(line: np.ndarray) -> np.ndarray:
    """A line (n, 2) with its bends rounded; its ends stay."""
    for _ in range(12):
        line = np.concatenate([line[:1], 0.25 * line[:-2] + 0.5 * line[1:-1] + 0.25 * line[2:], line[-1:]])
    return line
