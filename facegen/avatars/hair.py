"""Simple hair: shells over the skull, combed from the crown to the hairline, with gaps between strands."""

from dataclasses import dataclass

import cv2
import numpy as np
from scipy import ndimage

from facegen.avatars.pictures import png
from facegen.avatars.surface import Material, Surface, vertex_normals
from facegen.raster import nearest_triangles

SKULL_M = np.array([0.0, 0.018, -0.085])
"""Middle of the skull in the head frame, for adults: directions of the hair start here."""
CROWN = np.array([0.0, np.cos(np.radians(35.0)), -np.sin(np.radians(35.0))])
"""Where hair begins to part, seen from the skull's middle."""
AROUND, ALONG = 44, 11
LAYERS = 4
WIDE_PX, BAND_PX = 512, 128


@dataclass(frozen=True, kw_only=True)
class HairStyle:
    """A haircut.

    Attributes
    ----------
    line_deg
        (azimuth, elevation) pairs of the hairline from the front (0) over the ears (90) to the nape (180).
    top_m, side_m, nape_m, edge_m
        How thick the hair lies there, and at the front of the hairline.
    ragged
        Share of its length by which strands end before the others.
    fall_m
        How far hair beside and behind the face hangs below the ears.
    sweep_rad
        How far strands of the front bend to the subject's left.
    bun_m
        Radius of a bun behind the crown; 0 for none.
    cloth
        Colour (sRGB, 0 to 1) of a cap in place of hair.
    """

    line_deg: tuple[tuple[float, float], ...]
    top_m: float
    side_m: float
    nape_m: float
    edge_m: float
    ragged: float = 0.09
    fall_m: float = 0.0
    sweep_rad: float = 0.5
    bun_m: float = 0.0
    cloth: tuple[float, float, float] | None = None


SHORT_LINE = (
    *((0.0, 30.0), (20.0, 31.5), (38.0, 34.5), (52.0, 31.0), (63.0, 22.0), (73.0, 7.0), (79.0, -5.0)),
    *((87.0, -5.0), (92.0, 6.0), (102.0, 4.0), (112.0, -8.0), (121.0, -22.0), (135.0, -33.0), (180.0, -41.0)),
)
LONG_LINE = (
    *((0.0, 35.0), (20.0, 34.0), (34.0, 29.0), (46.0, 19.0), (56.0, 9.0), (66.0, 3.0), (76.0, 0.0)),
    *((90.0, 0.0), (180.0, 0.0)),
)
CAP_LINE = (
    *((0.0, 27.0), (25.0, 27.0), (45.0, 25.0), (62.0, 18.0), (78.0, 8.0), (90.0, 7.0), (104.0, 4.0)),
    *((118.0, -14.0), (140.0, -27.0), (180.0, -32.0)),
)
STYLES: dict[str, HairStyle] = {
    "short": HairStyle(line_deg=SHORT_LINE, top_m=19e-3, side_m=7e-3, nape_m=5e-3, edge_m=3e-3),
    "cropped": HairStyle(
        line_deg=SHORT_LINE, top_m=5e-3, side_m=2.5e-3, nape_m=2e-3, edge_m=2e-3, ragged=0.05
    ),
    "long": HairStyle(
        line_deg=LONG_LINE,
        top_m=16e-3,
        side_m=19e-3,
        nape_m=15e-3,
        edge_m=6e-3,
        ragged=0.06,
        fall_m=0.15,
        sweep_rad=0.2,
    ),
    "bob": HairStyle(
        line_deg=LONG_LINE,
        top_m=17e-3,
        side_m=20e-3,
        nape_m=15e-3,
        edge_m=7e-3,
        ragged=0.04,
        fall_m=0.08,
        sweep_rad=0.3,
    ),
    "bun": HairStyle(
        line_deg=SHORT_LINE, top_m=9e-3, side_m=6e-3, nape_m=6e-3, edge_m=4e-3, ragged=0.03, bun_m=30e-3
    ),
    "cap": HairStyle(
        line_deg=CAP_LINE,
        top_m=17e-3,
        side_m=7e-3,
        nape_m=8e-3,
        edge_m=3e-3,
        ragged=0.0,
        cloth=(0.2, 0.46, 0.5),
    ),
}
"""Haircuts by name; a cap is one, for operating rooms."""


def hairline(style: HairStyle, azimuth: np.ndarray) -> np.ndarray:
    """Elevation (...) of the hairline at azimuths (...), both seen from the skull's middle, radians."""
    where, height = np.radians(np.array(style.line_deg)).T
    return np.interp(np.abs(azimuth), where, height)


def in_hair(style: HairStyle, points: np.ndarray) -> np.ndarray:
    """How far points (n, 3) of the skin lie above the hairline, radians; negative below it."""
    away = points - SKULL_M
    azimuth = np.arctan2(away[:, 0], away[:, 2])
    return np.arctan2(away[:, 1], np.hypot(away[:, 0], away[:, 2])) - hairline(style, azimuth)


def hair_surfaces(
    vertices: np.ndarray,
    triangles: np.ndarray,
    style: HairStyle,
    *,
    colour: tuple[float, float, float],
    rng: np.random.Generator,
) -> list[Surface]:
    """Hair over the skin ``vertices`` (V, 3) with ``triangles`` (T, 3); ``colour`` is sRGB, 0 to 1."""
    skull = _skull(vertices, triangles)
    turn = np.linspace(-np.pi, np.pi, AROUND + 1)
    clumps = _clumps(rng)
    pieces = []
    for layer in range(1 if style.cloth else LAYERS):
        height = (layer + 1.0) / LAYERS
        past = 1.04 + 0.03 * layer
        v = np.linspace(0.0, past, ALONG)
        # strands bend to one side on their way
        bent = turn + style.sweep_rad * np.cos(turn / 2.0) ** 2 * v[:, None] ** 2
        end = _direction(bent, hairline(style, (bent + np.pi) % (2.0 * np.pi) - np.pi))
        direction = _between(CROWN, end, v)
        radius = _at(skull, direction)
        thick = _thickness(style, direction, v)
        lift = 1.5e-3 + thick * (0.35 + 0.65 * height) * (1.0 + 0.35 * clumps)
        lift *= np.clip((1.08 + 0.02 * layer - v) / 0.2, 0.12, 1.0)[:, None] ** 0.5
        points = SKULL_M + direction * (radius + lift)[..., None]
        if style.fall_m:
            points = _hanging(points, turn, style.fall_m * (1.0 + 0.05 * layer))
        pieces.append(_shell(points, np.linspace(0.0, 1.0, len(points)), layer))
    positions = np.concatenate([piece[0] for piece in pieces])
    shade = np.concatenate([piece[2] for piece in pieces])
    start, faces = 0, []
    for piece in pieces:
        faces.append(piece[3] + start)
        start += len(piece[0])
    kept = np.concatenate(faces)
    uv = np.concatenate([piece[1] for piece in pieces])
    if style.bun_m:
        place = SKULL_M + _between(CROWN, np.array([[0.0, -0.2, -0.98]]), np.array([0.25]))[0, 0] * (
            float(_at(skull, CROWN[None])[0]) + 0.4 * style.bun_m
        )
        ball = _ball(place, style.bun_m)
        positions, shade = np.concatenate([positions, ball[0]]), np.append(shade, np.full(len(ball[0]), 0.9))
        kept, uv = np.concatenate([kept, ball[2] + start]), np.concatenate([uv, ball[1]])
    linear = np.array(style.cloth or colour) ** 2.2
    if style.cloth:
        shade = np.ones(len(positions))
    colours = np.ones((len(positions), 4))
    colours[:, :3] = shade[:, None]
    material = Material(
        name="cap" if style.cloth else "hair",
        colour=(*(float(x) for x in linear), 1.0),
        roughness=0.85 if style.cloth else 0.62,
        picture=b"" if style.cloth else png(_strands(style, rng)),
        alpha="OPAQUE" if style.cloth else "MASK",
        both_sides=True,
    )
    return [
        Surface(
            mesh="Hair",
            material=material,
            positions=positions,
            normals=_seamless(positions, kept),
            triangles=kept,
            uv=None if style.cloth else uv,
            colours=colours,
        )
    ]


def _shell(
    points: np.ndarray, v: np.ndarray, layer: int
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Positions, texture coordinates, brightness and triangles of a grid (rows, AROUND + 1, 3)."""
    rows, columns = points.shape[:2]
    # the picture has a band for each layer: the inner layer's has no gaps
    cell = layer / LAYERS
    u = np.linspace(0.0, 1.0, columns)
    # thrice around, forth and back, so that nothing jumps
    u = np.abs((3.0 * u + 0.37 * layer) % 2.0 - 1.0)
    uv = np.stack(
        [np.broadcast_to(u, (rows, columns)), np.broadcast_to(cell + v[:, None] / LAYERS, (rows, columns))],
        axis=-1,
    )
    shade = (0.62 + 0.38 * (layer + 1) / LAYERS) * (0.8 + 0.25 * np.clip(v, 0.0, 1.0))
    i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
    a = (i * columns + j).ravel()
    b, c, d = a + columns, a + columns + 1, a + 1
    faces = np.concatenate([np.stack([a, b, c], axis=-1), np.stack([a, c, d], axis=-1)])
    return points.reshape(-1, 3), uv.reshape(-1, 2), np.repeat(shade, columns), faces


def _hanging(points: np.ndarray, azimuth: np.ndarray, fall_m: float) -> np.ndarray:
    """A grid with rows more, which hang down beside and behind the face and end on one height."""
    share = np.clip((np.abs(np.degrees(azimuth)) - 50.0) / 22.0, 0.0, 1.0)
    share = share * share * (3.0 - 2.0 * share)
    last = points[-1]
    rows = []
    for step in np.linspace(0.0, 1.0, 7)[1:]:
        row = last.copy()
        row[:, 1] -= share * fall_m * step
        # in towards the neck at the back, forward over the shoulders at the sides
        row[:, 2] += share * step * 0.012 * np.cos(azimuth) * -1.0 * fall_m / 0.1
        row[:, 0] *= 1.0 - 0.10 * share * step**2
        rows.append(row)
    return np.concatenate([points, np.stack(rows)])


def _ball(place: np.ndarray, radius: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Positions, texture coordinates in the inner band, and triangles of a bun."""
    up, around = np.meshgrid(
        np.linspace(-np.pi / 2, np.pi / 2, 9), np.linspace(-np.pi, np.pi, 17), indexing="ij"
    )
    points = place + radius * _direction(around, up) * [1.0, 0.85, 0.95]
    uv = np.stack([np.abs(around / np.pi), 0.02 + 0.18 * (up / np.pi + 0.5)], axis=-1)
    i, j = np.meshgrid(np.arange(8), np.arange(16), indexing="ij")
    a = (i * 17 + j).ravel()
    faces = np.concatenate([np.stack([a, a + 1, a + 18], axis=-1), np.stack([a, a + 18, a + 17], axis=-1)])
    return points.reshape(-1, 3), uv.reshape(-1, 2), faces


def _seamless(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Normals that are equal where vertices lie on one place, as they do along a shell's seam."""
    _, number = np.unique(np.round(positions, 7), axis=0, return_inverse=True)
    number = number.ravel()
    merged = np.zeros((number.max() + 1, 3))
    merged[number] = positions
    return vertex_normals(merged, number[triangles])[number]


def _direction(azimuth: np.ndarray, elevation: np.ndarray) -> np.ndarray:
    flat = np.cos(elevation)
    return np.stack([np.sin(azimuth) * flat, np.sin(elevation), np.cos(azimuth) * flat], axis=-1)


def _between(start: np.ndarray, end: np.ndarray, share: np.ndarray) -> np.ndarray:
    """Unit directions (k, n, 3) at shares (k,) of the arcs from ``start`` (3,) to ``end`` (1 or k, n, 3)."""
    angle = np.arccos(np.clip(end @ start, -1.0, 1.0))
    sine = np.sin(angle)
    share = share[:, None]
    first, second = np.sin((1.0 - share) * angle) / sine, np.sin(share * angle) / sine
    return first[..., None] * start + second[..., None] * end


def _thickness(style: HairStyle, direction: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Metres (k, n): thick on top, thin above the ears and in the nape."""
    up = np.clip(direction[..., 1], 0.0, 1.0) ** 0.8
    front = np.clip(direction[..., 2], 0.0, 1.0)
    low = style.side_m + (style.nape_m - style.side_m) * np.clip(-direction[..., 2], 0.0, 1.0)
    thick = low + (style.top_m - low) * up
    near_edge = np.clip((v - 0.72) / 0.28, 0.0, 1.0)[:, None] ** 1.5
    return thick + near_edge * front * (style.edge_m - thick)


def _clumps(rng: np.random.Generator) -> np.ndarray:
    """Unevenness (ALONG, AROUND + 1), about -1 to 1: locks that run along the hair."""
    field = np.zeros((ALONG, AROUND))
    for size, strength in ((1.2, 0.5), (3.0, 0.8), (7.0, 0.6)):
        one = ndimage.gaussian_filter(
            rng.standard_normal((ALONG, AROUND)), (5.0, size), mode=("nearest", "wrap")
        )
        field += strength * one / one.std()
    field *= np.clip(np.arange(ALONG) / 6.0, 0.0, 1.0)[:, None]  # none where all strands meet
    return np.concatenate([field, field[:, :1]], axis=1) / 1.5


def _strands(style: HairStyle, rng: np.random.Generator) -> np.ndarray:
    """Picture (`WIDE_PX`, `WIDE_PX`, 4): one band a layer, strands running down, with gaps in the outer ones.

    Rows of a band are equal but for the strands' ends, which makes a small PNG.
    """
    rows = BAND_PX
    place = np.arange(rows)[:, None] / rows
    bands = []
    for layer in range(LAYERS):
        fine = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 0.8, mode="reflect")
        broad = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 6.0, mode="reflect")
        light = 0.72 + 0.16 * fine / fine.std() * 0.8 + 0.07 * broad / broad.std()
        density = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 1.1, mode="reflect")
        order = density.argsort().argsort() / WIDE_PX  # 0 to 1, evenly
        length = ndimage.gaussian_filter1d(rng.standard_normal(WIDE_PX), 1.3, mode="reflect")
        length = 1.0 - style.ragged * (0.3 + 0.7 * layer / (LAYERS - 1)) * np.abs(length / length.std())
        length = np.minimum(length, 0.985)
        gaps = 0.0 if layer == 0 else 0.22 + 0.5 * layer / LAYERS * (0.4 + 0.6 * place)
        cover = (order >= gaps) & (place < length) & (place > 0.04 * layer)
        band = np.empty((rows, WIDE_PX, 4), np.uint8)
        band[..., :3] = np.rint(255.0 * np.clip(light, 0.25, 1.0))[None, :, None]
        band[..., 3] = 255 * cover
        bands.append(band)
    return np.concatenate(bands)


def _skull(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Distance (181, 361) of the head's innermost skin from `SKULL_M` by elevation and azimuth, degree by degree.

    The innermost, because ears stand off the skull; smoothed, because their folds remain.
    """
    away = vertices - SKULL_M
    distance = np.linalg.norm(away, axis=1)
    azimuth = np.degrees(np.arctan2(away[:, 0], away[:, 2]))
    elevation = np.degrees(np.arcsin(away[:, 1] / distance))
    corners = azimuth[triangles]
    whole = np.ptp(corners, axis=1) < 120.0
    rounds = []
    for shift in (-360.0, 0.0, 360.0):
        # those across the back are drawn at either border
        unrolled = np.where(~whole[:, None] & (corners < 0.0), corners + 360.0, corners) + shift
        places = np.stack([unrolled + 180.0, elevation[triangles] + 90.0], axis=-1).reshape(-1, 2)
        drawn = nearest_triangles(
            places,
            -distance[triangles].reshape(-1),
            np.arange(triangles.size).reshape(-1, 3),
            shape=(181, 361),
        )
        rounds.append(drawn.value)
    value = -np.max(rounds, axis=0)
    empty = ~np.isfinite(value)
    nearest = ndimage.distance_transform_edt(empty, return_distances=False, return_indices=True)
    value = value[tuple(nearest)]
    value = ndimage.median_filter(value, 9, mode="nearest")
    return cv2.GaussianBlur(np.pad(value, ((0, 0), (30, 30)), mode="wrap"), (0, 0), 4.0)[:, 30:-30]


def _at(skull: np.ndarray, direction: np.ndarray) -> np.ndarray:
    azimuth = np.degrees(np.arctan2(direction[..., 0], direction[..., 2])) + 180.0
    elevation = np.degrees(np.arcsin(np.clip(direction[..., 1], -1.0, 1.0))) + 90.0
    return ndimage.map_coordinates(skull, [elevation, azimuth], order=1, mode="nearest")
