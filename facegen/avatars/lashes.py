"""Lashes: the rig's strips, which every movement of the lids carries, with hairs painted on them."""

import cv2
import numpy as np

from facegen.avatars.pictures import png
from facegen.avatars.shapes import FaceShapes
from facegen.avatars.surface import Material, Surface, vertex_normals
from facegen.geometry.grids import grid_quads, halves
from facegen.rigs.lash_strips import lash_strips
from facegen.scene.lashes import BARE

WIDE_PX, HIGH_PX = 512, 64
HAIRS = {"upper": 95, "lower": 60}


def lash_surfaces(shapes: FaceShapes, *, picture: np.ndarray) -> list[Surface]:
    """The upper and lower lashes of both eyes as one surface; none where the rig has no strips.

    ``picture`` is from `draw_lashes`.
    """
    strips = lash_strips(shapes.rig)
    if not strips:
        return []
    numbers, uv, triangles, start = [], [], [], 0
    for strip in strips:
        # every second row and column are the rig's own, the others come of its subdivision
        grid = strip.grid[::2, ::4] if strip.grid.shape[0] > 12 else strip.grid
        along, out = np.meshgrid(*(np.linspace(0.0, 1.0, size) for size in grid.shape), indexing="ij")
        # the picture's upper half is for upper lashes; roots at its lower border
        half = 0.0 if strip.lid == "upper" else 0.5
        uv.append(np.stack([along, half + 0.5 * (1.0 - out)], axis=-1).reshape(-1, 2))
        triangles.append(start + halves(grid_quads(*grid.shape)))
        numbers.append(grid.ravel())
        start += grid.size
    used, faces = np.concatenate(numbers), np.concatenate(triangles)
    positions = shapes.neutral[used]
    return [
        Surface(
            mesh="Head",
            material=Material(
                name="lashes", roughness=0.7, picture=png(picture), alpha="BLEND", both_sides=True
            ),
            positions=positions,
            normals=vertex_normals(positions, faces),
            triangles=faces,
            uv=np.concatenate(uv),
            moved=shapes.moved[:, used],
            turned=np.zeros((len(shapes.moved), len(used), 3)),
            bones=("Head",),
            shares=np.ones((len(used), 1)),
        )
    ]


def draw_lashes(rng: np.random.Generator) -> np.ndarray:
    """Picture (2 * `HIGH_PX`, `WIDE_PX`, 4) uint8: upper lashes above lower ones, inner corner at the left."""
    halves = []
    for lid, most in (("upper", 0.92), ("lower", 0.62)):
        cover = np.zeros((HIGH_PX, WIDE_PX), np.float32)
        place = BARE + (0.97 - BARE) * np.sort(rng.random(HAIRS[lid]))
        for root in place:
            longest = most * np.sin(np.pi * np.clip(0.10 + 0.85 * root, 0.0, 0.95)) ** 0.6
            reach = longest * rng.uniform(0.6, 1.0)
            t = np.linspace(0.0, 1.0, 12)
            lean = 0.035 * (root - 0.35) + rng.normal(0.0, 0.006)
            x = (root + lean * t**1.5) * (WIDE_PX - 1)
            y = (1.0 - reach * t) * (HIGH_PX - 1)
            width = 2.6 if lid == "upper" else 1.6
            for step in range(len(t) - 1):
                hair = np.zeros_like(cover)
                ends = [(round(8 * x[k]), round(8 * y[k])) for k in (step, step + 1)]
                strength = float(np.clip(width * (1.0 - t[step]) ** 0.8, 0.25, 1.0))
                size = 2 if width * (1.0 - t[step]) > 1.6 else 1
                cv2.line(hair, *ends, strength, size, cv2.LINE_AA, 3)
                np.maximum(cover, hair, out=cover)
        # roots run together into a line
        rows = np.arange(HIGH_PX)[:, None]
        root_line = np.clip((rows - (HIGH_PX - 5)) / 4.0, 0.0, 0.8 if lid == "upper" else 0.25)
        ends = np.clip((np.arange(WIDE_PX) / WIDE_PX - 0.5 * BARE) / (0.5 * BARE), 0.0, 1.0)
        halves.append(np.maximum(cover, root_line * ends))
    cover = np.concatenate(halves)
    picture = np.empty((*cover.shape, 4), np.uint8)
    picture[..., :3] = (22, 15, 12)
    picture[..., 3] = np.rint(255.0 * np.clip(cover, 0.0, 1.0))
    return picture
