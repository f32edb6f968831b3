"""Holds what a previewed person wears on the rig: colours of the skin's vertices, hair, eyes; and draws them all."""

from dataclasses import dataclass
from functools import lru_cache

import cv2
import numpy as np

from facegen.avatars.complexion import draw_skin_spots, skin_tones
from facegen.avatars.hair import draw_hair_surfaces
from facegen.avatars.haircuts import STYLES, HairStyle
from facegen.avatars.strands import LAYERS
from facegen.avatars.surface import vertex_normals
from facegen.conventions import LANDMARK_GROUPS, Part
from facegen.preview.looks import Look
from facegen.raster import nearest_along_z, triangles_of
from facegen.raster.z_buffer import barycentric
from facegen.rigs import Rig
from facegen.rigs.eyes import IRIS_RADIUS_M

OUTSIDE = (Part.SKIN, Part.LIPS, Part.BROWS)
INSIDE = {
    Part.TEETH: (0.90, 0.88, 0.82),
    Part.TONGUE: (0.70, 0.38, 0.38),
    Part.MOUTH_CAVITY: (0.36, 0.14, 0.14),
    Part.EYE_CAVITY: (0.55, 0.30, 0.30),
}
PUPIL_M, WHITE = 2.0e-3, (0.91, 0.885, 0.865)
DRAWN_LAYERS = LAYERS - 1
"""The outermost has so few strands that they look like noise in a small picture."""
PAPER = (0.925, 0.93, 0.935)
"""Colour behind the head."""
_LAMPS = ((np.array([-0.42, 0.50, 0.76]), 0.60), (np.array([0.72, 0.12, 0.68]), 0.24))
_HALF = np.array([-0.23, 0.27, 0.935])
"""Between the first lamp and the viewer: where a gloss is seen."""
_BALD = HairStyle(line_deg=((0.0, 89.0), (180.0, 89.0)), top_m=0.0, side_m=0.0, nape_m=0.0, edge_m=0.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Hair:
    """Shells over the skull, in the head frame: one (T, 3) of triangles a layer, inner ones first."""

    positions: np.ndarray
    normals: np.ndarray
    uv: np.ndarray
    shade: np.ndarray
    layers: tuple[np.ndarray, ...]
    strands: np.ndarray
    colour: np.ndarray


@dataclass(frozen=True, kw_only=True, eq=False)
class Person:
    """A rig's head with colours.

    Attributes
    ----------
    skin
        (V, 3) sRGB of the rig's vertices.
    iris
        (3,) sRGB.
    hair
        None where there is none.
    """

    skin: np.ndarray
    iris: np.ndarray
    hair: Hair | None


@lru_cache(maxsize=64)
def _cached_skin(rig: Rig, look: Look) -> np.ndarray:
    style = STYLES.get(look.hair, _BALD)
    spots = draw_skin_spots(np.random.Generator(np.random.PCG64([look.seed, 0])))
    lips = np.zeros(len(rig.vertices))
    of_lips = rig.faces[rig.part == Part.LIPS]
    lips[of_lips[of_lips >= 0]] = 1.0
    colour = skin_tones(
        rig.vertices,
        lips,
        np.ones(len(lips)),
        look.colours,
        style,
        rig=rig,
        neutral=rig.vertices,
        spots=spots,
    )
    hair = np.array(look.colours.hair)
    cover = 0.92 * brow_cover(rig)[:, None]
    colour = colour * (1.0 - cover) + cover * (0.75 * hair + 0.25 * colour)
    for part, inner in INSIDE.items():
        faces = rig.faces[rig.part == part]
        colour[np.setdiff1d(faces[faces >= 0], rig.faces[np.isin(rig.part, OUTSIDE)])] = inner
    return np.clip(colour, 0.0, 1.0)


@lru_cache(maxsize=4)
def brow_cover(rig: Rig) -> np.ndarray:
    """Share (V,) of the skin that brows cover: along their landmarks, thick at the nose, thin outwards."""
    marks = np.einsum("ln,lnc->lc", rig.landmark_weights, rig.vertices[rig.landmark_vertices])
    cover = np.zeros(len(rig.vertices))
    for group, inner in (("left_brow", 0), ("right_brow", -1)):
        line = marks[list(LANDMARK_GROUPS[group])]
        line = line if inner == 0 else line[::-1]
        t = np.linspace(0.0, 1.0, 60)
        dense = np.stack([np.interp(t, np.linspace(0, 1, len(line)), line[:, k]) for k in range(3)], axis=-1)
        far = np.linalg.norm(rig.vertices[:, None] - dense, axis=-1) / (4.3e-3 - 2.0e-3 * t)
        cover = np.maximum(cover, np.exp(-(far.min(axis=1) ** 2)))
    return cover


def dressed_person(rig: Rig, identity: np.ndarray, look: Look) -> Person:
    """A person of identity coefficients (K,) with a look."""
    neutral = rig.vertices + np.tensordot(identity, rig.identity, 1)
    hair = None
    if look.hair in STYLES:
        hair = _hair(rig, neutral, look)
    return Person(skin=_cached_skin(rig, look), iris=np.array(look.colours.iris), hair=hair)


def _hair(rig: Rig, neutral: np.ndarray, look: Look) -> Hair:
    outer = triangles_of(rig.faces[np.isin(rig.part, OUTSIDE)])
    rng = np.random.Generator(np.random.PCG64([look.seed, 5]))
    (surface,) = draw_hair_surfaces(neutral, outer, STYLES[look.hair], colour=look.colours.hair, rng=rng)
    uv = surface.uv
    band = np.floor(uv[surface.triangles, 1].mean(axis=1) * LAYERS).astype(int)
    strands = cv2.imdecode(np.frombuffer(surface.material.picture, np.uint8), cv2.IMREAD_UNCHANGED)
    return Hair(
        positions=surface.positions,
        normals=surface.normals,
        uv=uv,
        shade=surface.colours[:, 0],
        layers=tuple(surface.triangles[band == layer] for layer in range(DRAWN_LAYERS)),
        strands=strands[..., [2, 1, 0, 3]] / 255.0,
        colour=np.array(look.colours.hair),
    )


def draw_person(
    person: Person,
    head: tuple[np.ndarray, np.ndarray, np.ndarray],
    eyes: np.ndarray,
    *,
    turn: np.ndarray,
    corner_m: tuple[float, float],
    step_m: float,
    shape: tuple[int, int],
) -> tuple[np.ndarray, np.ndarray]:
    """Picture (h, w, 3) in [0, 1] of a person for a distant viewer, and depth (h, w) of the face: hair hides nothing.

    Parameters
    ----------
    person
        Colours and hair.
    head
        Vertices (V', 3) of the face and behind them the eyeballs, triangles, and the part of each, head frame.
    eyes
        (V' - V,) angle of each of the eyeballs' vertices from its eye's axis, as its sine's length in metres.
    turn
        (3, 3) head frame to the viewer's, by ``vertices @ turn``.
    corner_m, step_m, shape
        Left and top of the picture, a pixel's size, and height and width in pixels.
    """
    vertices, triangles, part = head
    colours = np.concatenate([person.skin, _eye_colours(person.iris, eyes)])
    normals = vertex_normals(vertices, triangles) @ turn
    vertices = vertices @ turn
    origin = np.array(corner_m)
    near = nearest_along_z(vertices, triangles, origin=origin, step=step_m, shape=shape)
    picture = np.tile(np.array(PAPER), (*shape, 1))
    row, column = np.nonzero(near.triangle >= 0)
    number = near.triangle[row, column]
    share = _shares(vertices, triangles[number], row, column, origin, step_m)
    normal = _unit(np.einsum("nk,nkc->nc", share, normals[triangles[number]]))
    colour = np.einsum("nk,nkc->nc", share, colours[triangles[number]])
    wet = np.isin(part[number], (Part.IRIS, Part.SCLERA))
    gloss = np.clip(normal @ _HALF, 0.0, 1.0)
    light = _light(normal)[:, None]
    picture[row, column] = colour * light + np.where(wet, 0.75 * gloss**250, 0.07 * gloss**22)[:, None]
    if person.hair is not None:
        _draw_hair(person.hair, picture, near.value, turn=turn, origin=origin, step_m=step_m)
    return np.clip(picture, 0.0, 1.0), near.value


def _draw_hair(
    hair: Hair, picture: np.ndarray, depth: np.ndarray, *, turn: np.ndarray, origin: np.ndarray, step_m: float
) -> None:
    """Draw layers from the inside out over a picture, in place, where they lie before its depth (h, w)."""
    depth = depth.copy()
    vertices, normals = hair.positions @ turn, hair.normals @ turn
    high, wide = hair.strands.shape[:2]
    for triangles in hair.layers:
        if not len(triangles):
            continue
        near = nearest_along_z(vertices, triangles, origin=origin, step=step_m, shape=depth.shape)
        row, column = np.nonzero((near.triangle >= 0) & (near.value > depth))
        used = triangles[near.triangle[row, column]]
        share = _shares(vertices, used, row, column, origin, step_m)
        u, v = np.einsum("nk,nkc->nc", share, hair.uv[used]).T
        strand = hair.strands[
            np.clip((v * high).astype(int), 0, high - 1), np.clip((u * wide).astype(int), 0, wide - 1)
        ]
        there = strand[:, 3] > 0.5
        row, column, share, used, strand = (x[there] for x in (row, column, share, used, strand))
        normal = _unit(np.einsum("nk,nkc->nc", share, normals[used]))
        normal *= np.sign(normal[:, 2:] + 1e-9)
        light = _light(normal) * np.einsum("nk,nk->n", share, hair.shade[used]) * strand[:, 0]
        gloss = 0.10 * np.clip(normal @ _HALF, 0.0, 1.0) ** 12 * strand[:, 0] ** 2
        picture[row, column] = 1.15 * light[:, None] * hair.colour + gloss[:, None]
        depth[row, column] = near.value[row, column]


def _eye_colours(iris: np.ndarray, away_m: np.ndarray) -> np.ndarray:
    """sRGB (n, 3) of an eyeball at distances (n,) from its axis: pupil, iris with a dark rim, white."""
    ring = np.clip((away_m - 0.8 * IRIS_RADIUS_M) / (0.25 * IRIS_RADIUS_M), 0.0, 1.0)
    colour = np.where((away_m < 1.02 * IRIS_RADIUS_M)[:, None], iris * (1.25 - 0.8 * ring)[:, None], WHITE)
    return np.where((away_m < PUPIL_M)[:, None], 0.03, colour)


def _light(normal: np.ndarray) -> np.ndarray:
    light = np.full(len(normal), 0.26)
    for direction, strength in _LAMPS:
        light += strength * np.clip((normal @ direction + 0.18) / 1.18, 0.0, 1.0)
    return light


def _shares(
    vertices: np.ndarray,
    corners: np.ndarray,
    row: np.ndarray,
    column: np.ndarray,
    origin: np.ndarray,
    step_m: float,
) -> np.ndarray:
    flat = (vertices[:, :2] - origin) * [1.0, -1.0] / step_m
    return barycentric(np.stack([column, row], axis=-1).astype(float), flat[corners])


def _unit(vectors: np.ndarray) -> np.ndarray:
    return vectors / np.maximum(np.linalg.norm(vectors, axis=1, keepdims=True), 1e-12)
