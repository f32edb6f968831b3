"""The tongue: a soft body along a curve from the throat to its tip, resting in the lower arch or put out over the lip."""

import numpy as np
from scipy.interpolate import PchipInterpolator

ALONG, AROUND = 40, 32
REST = np.array(
    [[-28.0, -56.0], [-9.0, -50.0], [-1.0, -39.0], [0.0, -28.0], [-2.0, -17.0], [-4.0, -9.5], [-5.0, -5.0]]
)
"""Middle line at rest, height over and distance before the lower incisors' edges, millimetres; it begins in the throat
and ends behind the incisors."""
HALF_WIDTH = np.array([16.0, 18.0, 18.5, 18.0, 15.5, 12.0, 8.5])
HALF_HEIGHT = np.array([10.0, 10.5, 10.0, 8.5, 6.0, 4.2, 3.0])
"""Of the body at those places."""
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
    rest = size * REST
    put_out = rest.copy()
    put_out[2:3] += size * np.array([1.0, 3.0])
    put_out[-4:] = path_mm
    # it rises over the teeth before it comes forward
    lift, forth = (_smooth(np.clip(out / share, 0.0, 1.0)) for share in (0.45, 1.0))
    line = np.stack([rest[:, 0] + lift * (put_out - rest)[:, 0], rest[:, 1] + forth * (put_out - rest)[:, 1]], axis=-1)
    knots = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
    # nearer together at the tip
    at = knots[-1] * (1.0 - (1.0 - np.linspace(0.0, 1.0, ALONG)) ** 1.5)
    middle = _softened(PchipInterpolator(knots, line)(at))
    broad = np.array([1.0, 1.0, 0.95, 0.85, 0.92, 1.12, 1.3])
    flat = np.minimum(HALF_HEIGHT, max(0.42 * room_mm / size, 2.2))
    half_width = size * width * PchipInterpolator(knots, HALF_WIDTH * (1.0 + forth * (broad - 1.0)))(at)
    half_height = size * PchipInterpolator(knots, HALF_HEIGHT + lift * (flat - HALF_HEIGHT))(at)
    left = np.clip((knots[-1] - at) / (size * ROUND_MM), 0.0, 1.0)
    tip = np.sqrt(np.clip(1.0 - (1.0 - left) ** 2, 0.0, 1.0))
    half_width, half_height = half_width * tip, half_height * (0.25 + 0.75 * tip) * np.sqrt(tip)
    tangent = np.gradient(middle, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    normal = np.stack([tangent[:, 1], -tangent[:, 0]], axis=-1)  # (height, distance): up where it runs forward
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
    i, j = np.meshgrid(np.arange(ALONG - 2), np.arange(AROUND), indexing="ij")
    k = (j + 1) % AROUND
    quads = np.stack([i * AROUND + j, i * AROUND + k, (i + 1) * AROUND + k, (i + 1) * AROUND + j], axis=-1)
    last, j = (ALONG - 2) * AROUND, np.arange(AROUND)
    fan = np.stack([last + j, last + (j + 1) % AROUND, np.full(AROUND, len(vertices) - 1), np.full(AROUND, -1)], axis=-1)
    return 1e-3 * vertices, np.concatenate([quads.reshape(-1, 4), fan]).astype(np.int32)


def _smooth(x: float) -> float:
    return x * x * (3.0 - 2.0 * x)


def _softened(line: np.ndarray) -> np.ndarray:
    """A line (n, 2) with its bends rounded; its ends stay."""
    for _ in range(12):
        line = np.concatenate([line[:1], 0.25 * line[:-2] + 0.5 * line[1:-1] + 0.25 * line[2:], line[-1:]])
    return line
