"""Simple hair: shells over the skull, combed from the crown to the hairline, with gaps between strands."""

import numpy as np
from scipy import ndimage

from facegen.avatars.haircuts import HairStyle, hairline
from facegen.avatars.pictures import png
from facegen.avatars.skull import SKULL_M, between, direction_of, distance_at, skull_distance
from facegen.avatars.strands import LAYERS, draw_strands
from facegen.avatars.surface import Material, Surface, vertex_normals
from facegen.geometry.grids import facing_back, grid_quads, halves

CROWN = np.array([0.0, np.cos(np.radians(35.0)), -np.sin(np.radians(35.0))])
"""Where hair begins to part, seen from the skull's middle."""
AROUND, ALONG = 44, 11


def draw_hair_surfaces(
    vertices: np.ndarray,
    triangles: np.ndarray,
    style: HairStyle,
    *,
    colour: tuple[float, float, float],
    rng: np.random.Generator,
) -> list[Surface]:
    """Hair over the skin ``vertices`` (V, 3) with ``triangles`` (T, 3); ``colour`` is sRGB, 0 to 1."""
    skull = skull_distance(vertices, triangles)
    turn = np.linspace(-np.pi, np.pi, AROUND + 1)
    clumps = _draw_clumps(rng)
    pieces = []
    for layer in range(1 if style.cloth else LAYERS):
        height = (layer + 1.0) / LAYERS
        past = 1.04 + 0.03 * layer
        v = np.linspace(0.0, past, ALONG)
        # strands bend to one side on their way
        bent = turn + style.sweep_rad * np.cos(turn / 2.0) ** 2 * v[:, None] ** 2
        end = direction_of(bent, hairline(style, (bent + np.pi) % (2.0 * np.pi) - np.pi))
        direction = between(CROWN, end, v)
        radius = distance_at(skull, direction)
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
        place = SKULL_M + between(CROWN, np.array([[0.0, -0.2, -0.98]]), np.array([0.25]))[0, 0] * (
            float(distance_at(skull, CROWN[None])[0]) + 0.4 * style.bun_m
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
        picture=b"" if style.cloth else png(draw_strands(style, rng)),
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
    faces = halves(grid_quads(rows, columns))
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
    points = place + radius * direction_of(around, up) * [1.0, 0.85, 0.95]
    uv = np.stack([np.abs(around / np.pi), 0.02 + 0.18 * (up / np.pi + 0.5)], axis=-1)
    faces = halves(facing_back(grid_quads(*up.shape)))
    return points.reshape(-1, 3), uv.reshape(-1, 2), faces


def _seamless(positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Normals that are equal where vertices lie on one place, as they do along a shell's seam."""
    _, number = np.unique(np.round(positions, 7), axis=0, return_inverse=True)
    number = number.ravel()
    merged = np.zeros((number.max() + 1, 3))
    merged[number] = positions
    return vertex_normals(merged, number[triangles])[number]


def _thickness(style: HairStyle, direction: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Metres (k, n): thick on top, thin above the ears and in the nape."""
    up = np.clip(direction[..., 1], 0.0, 1.0) ** 0.8
    front = np.clip(direction[..., 2], 0.0, 1.0)
    low = style.side_m + (style.nape_m - style.side_m) * np.clip(-direction[..., 2], 0.0, 1.0)
    thick = low + (style.top_m - low) * up
    near_edge = np.clip((v - 0.72) / 0.28, 0.0, 1.0)[:, None] ** 1.5
    return thick + near_edge * front * (style.edge_m - thick)


def _draw_clumps(rng: np.random.Generator) -> np.ndarray:
    """Unevenness (ALONG, AROUND + 1), about -1 to 1: locks that run along the hair."""
    field = np.zeros((ALONG, AROUND))
    for size, strength in ((1.2, 0.5), (3.0, 0.8), (7.0, 0.6)):
        one = ndimage.gaussian_filter(
            rng.standard_normal((ALONG, AROUND)), (5.0, size), mode=("nearest", "wrap")
        )
        field += strength * one / one.std()
    field *= np.clip(np.arange(ALONG) / 6.0, 0.0, 1.0)[:, None]  # none where all strands meet
    return np.concatenate([field, field[:, :1]], axis=1) / 1.5
