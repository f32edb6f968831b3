"""Draws rigs with numbered landmarks, for a person to judge where the points lie; hidden ones are white."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES, Part
from facegen.geometry import rotation_from_angles
from facegen.geometry.grids import halves, ring_quads
from facegen.preview.person import Person, brow_cover, draw_person
from facegen.raster import Nearest, faces_of_triangles, nearest_along_z, triangles_of
from facegen.rigs.evaluation import EvaluatedFaces, evaluate
from facegen.rigs.eyes import IRIS_RADIUS_M, lid_support_radius
from facegen.rigs.rig import Rig

VIEWS_DEG = {"front": 0.0, "three-quarter": 35.0, "side": 75.0}
COLOURS = {
    Part.SKIN: (0.80, 0.68, 0.62),
    Part.LIPS: (0.76, 0.45, 0.45),
    Part.BROWS: (0.62, 0.50, 0.44),
    Part.SCLERA: (0.95, 0.95, 0.95),
    Part.IRIS: (0.35, 0.45, 0.55),
    Part.TEETH: (0.95, 0.93, 0.85),
    Part.TONGUE: (0.70, 0.35, 0.35),
    Part.MOUTH_CAVITY: (0.40, 0.15, 0.15),
    Part.EYE_CAVITY: (0.55, 0.30, 0.30),
    Part.HEADSET: (0.36, 0.38, 0.44),
}
SHEET_M = (-0.125, 0.142, 0.125, -0.138)
"""Window of `draw_portraits` about the middle of the head: the whole head, and room for a title above it."""
HEAD_MIDDLE_M = 0.075
"""How far behind the eyes the middle of a head lies."""
SHEET_PX = 500
"""Width of a picture of `draw_portraits`, in which numbers of the lips find room."""
BROW_COVER = 0.4
"""Share of a triangle that a brow covers, from which it counts as brow."""
HIDDEN_M = 4e-3
"""A landmark this far behind what is drawn is hidden; jaw points on the silhouette lie a little behind it."""


def eyeball_mesh(
    center: np.ndarray, radius: float, axis: np.ndarray, *, rings: int = 40, segments: int = 64
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and part per triangle of the front of an eye's outer surface, cornea included."""
    axis = axis / np.linalg.norm(axis)
    right = np.cross((0.0, 1.0, 0.0), axis)
    right /= np.linalg.norm(right)
    up = np.cross(axis, right)
    polar = np.linspace(0.0, 0.6 * np.pi, rings + 1)
    around = np.linspace(0.0, 2.0 * np.pi, segments, endpoint=False)
    p, a = (grid.ravel()[..., None] for grid in np.meshgrid(polar, around, indexing="ij"))
    direction = np.cos(p) * axis + np.sin(p) * (np.cos(a) * right + np.sin(a) * up)
    vertices = center + lid_support_radius(direction, radius, axis)[:, None] * direction
    triangles = halves(ring_quads(rings + 1, segments))
    iris = np.sin(np.repeat(polar[1:], segments)) * radius < IRIS_RADIUS_M
    part = np.where(np.concatenate([iris, iris]), Part.IRIS, Part.SCLERA)
    return vertices, triangles, part


def drawn_mesh(
    rig: Rig, faces: EvaluatedFaces, index: int, gaze: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and part per triangle of evaluated face ``index`` with its eyeballs."""
    shown = rig.part != Part.LASHES  # without a texture they would be a solid strip before the eye
    triangles, source = triangles_of(rig.faces[shown]), faces_of_triangles(rig.faces[shown])
    part = rig.part[shown][source]
    if not (part == Part.BROWS).any():  # a rig whose source marks none
        brow = brow_cover(rig)[triangles].mean(axis=1) > BROW_COVER
        part = np.where(brow & (part == Part.SKIN), Part.BROWS, part)
    vertices, all_triangles, parts = [faces.vertices[index]], [triangles], [part]
    for eye in range(2):
        v, t, p = eyeball_mesh(faces.eye_center[index, eye], faces.eye_radius[index, eye], gaze[eye])
        all_triangles.append(t + sum(map(len, vertices)))
        vertices.append(v)
        parts.append(p)
    return np.concatenate(vertices), np.concatenate(all_triangles), np.concatenate(parts)


def shade(
    vertices: np.ndarray,
    triangles: np.ndarray,
    part: np.ndarray,
    depth: Nearest,
    *,
    viewer: np.ndarray | None = None,
) -> np.ndarray:
    """Picture (h, w, 3) in [0, 1] of a z-buffer, lit from the camera's upper left.

    Triangles that show their back to a ``viewer`` (3,) near by are lit as their fronts: between lid and eyeball the
    lid's inside is seen, as specks that would be nearly black.
    """
    corner = vertices[triangles]
    flat = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal = np.zeros_like(vertices)
    for k in range(3):
        np.add.at(normal, triangles[:, k], flat)
    smooth = normal[triangles].sum(axis=1)
    smooth /= np.maximum(np.linalg.norm(smooth, axis=1, keepdims=True), 1e-12)
    if viewer is not None:
        smooth *= np.where(((viewer - corner[:, 0]) * flat).sum(axis=1) < 0.0, -1.0, 1.0)[:, None]
    light = np.array([-0.35, 0.45, 0.82])
    lit = np.round(24.0 * (0.25 + 0.75 * np.maximum(smooth @ light, 0.0))) / 24.0  # few tones: small files
    palette = np.ones((max(Part) + 1, 3))
    for name, colour in COLOURS.items():
        palette[name] = colour
    colour = palette[part] * lit[:, None]
    return np.where(depth.triangle[..., None] >= 0, colour[depth.triangle], 1.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Portrait:
    """``picture`` (h, w, 3) in [0, 1]; ``landmarks`` (68, 2) in pixels; ``seen`` (68,) if not hidden."""

    picture: np.ndarray
    landmarks: np.ndarray
    seen: np.ndarray


def portrait(
    rig: Rig,
    faces: EvaluatedFaces,
    index: int,
    gaze: np.ndarray,
    *,
    yaw_deg: float = 0.0,
    pitch_deg: float = 0.0,
    rotation: np.ndarray | None = None,
    window_m: tuple[float, float, float, float] = (-0.100, 0.085, 0.100, -0.125),
    step_m: float = 0.5e-3,
    person: Person | None = None,
) -> Portrait:
    """Draw one evaluated face (with all its vertices) for a distant viewer.

    Parameters
    ----------
    gaze
        (2, 3) optical axes of this face.
    yaw_deg, pitch_deg
        Where the viewer stands: towards the subject's left, and above.
    rotation
        (3, 3) of the head in its own frame, seen from the front; instead of the two angles.
    window_m
        Left, top, right and bottom of the picture, in the head turned towards the viewer.
    step_m
        Size of a pixel.
    person
        Colours and hair; without, parts have the plain colours of figures.
    """
    turn = rotation_from_angles(np.radians(yaw_deg), np.radians(pitch_deg), 0.0)
    if rotation is not None:
        turn = rotation.T
    vertices, triangles, part = drawn_mesh(rig, faces, index, gaze)
    left, top, right, bottom = window_m
    shape = (round((top - bottom) / step_m), round((right - left) / step_m))
    if person is None:
        vertices = vertices @ turn
        near = nearest_along_z(vertices, triangles, origin=np.array([left, top]), step=step_m, shape=shape)
        picture, depth = shade(vertices, triangles, part, near), near.value
    else:
        picture, depth = draw_person(
            person,
            (vertices, triangles, part),
            _off_axis_m(vertices[len(rig.vertices) :], faces.eye_center[index], gaze),
            turn=turn,
            corner_m=(left, top),
            step_m=step_m,
            shape=shape,
        )
    points = faces.landmarks[index] @ turn
    pixels = np.stack([(points[:, 0] - left) / step_m, (top - points[:, 1]) / step_m], axis=-1)
    column, row = np.clip(np.round(pixels).astype(int), 0, np.array(shape[::-1]) - 1).T
    seen = points[:, 2] > depth[row, column] - HIDDEN_M
    return Portrait(picture=picture, landmarks=pixels, seen=seen)


def _off_axis_m(vertices: np.ndarray, centers: np.ndarray, gaze: np.ndarray) -> np.ndarray:
    """Distance of both eyeballs' vertices (n, 3), one after the other, from their eyes' axes."""
    halves = vertices.reshape(2, -1, 3) - centers[:, None]
    along = np.einsum("enc,ec->en", halves, gaze)
    away = np.linalg.norm(halves - along[..., None] * gaze[:, None], axis=-1)
    return np.where(along > 0.0, away, 1.0).ravel()


def draw_portraits(rig: Rig, out: Path, *, people: int = 3) -> None:
    """Write a PNG of the mean person and others from the front, three quarters and the side.

    A rig without identities has one person.

    Raises
    ------
    InputError
        ``out`` is a folder.
    OutputError
        The file cannot be written.
    """
    # heavy, and only this function needs them
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    from facegen.files import whole_file
    from facegen.preview.lettering import write_labels

    people = people if rig.components else 1
    rng = np.random.Generator(np.random.PCG64(7))
    identity = np.clip(rng.standard_normal((people, rig.components)), -2.0, 2.0)
    identity[0] = 0.0
    gaze = np.tile((0.0, 0.0, 1.0), (people, 2, 1))
    faces = evaluate(rig, identity, np.zeros((people, len(BLENDSHAPES))), gaze)
    left, top, right, bottom = SHEET_M
    step_m = (right - left) / SHEET_PX
    height_px = round((top - bottom) / step_m)
    # pixels match the file's
    figure = Figure(figsize=(SHEET_PX * len(VIEWS_DEG) / 100, height_px * people / 100), dpi=100)
    canvas = FigureCanvasAgg(figure)
    for person in range(people):
        for column, (view, yaw) in enumerate(VIEWS_DEG.items()):
            axes = figure.add_axes((column / 3, 1 - (person + 1) / people, 1 / 3, 1 / people))
            aside_m = HEAD_MIDDLE_M * np.sin(np.radians(yaw))  # where the turned head has its middle
            window_m = (left + aside_m, top, right + aside_m, bottom)
            drawn = portrait(rig, faces, person, gaze[person], yaw_deg=yaw, window_m=window_m, step_m=step_m)
            axes.imshow(drawn.picture, interpolation="nearest")
            axes.plot(*drawn.landmarks[drawn.seen].T, ".", color="#0040ff", markersize=3)
            axes.plot(*drawn.landmarks[~drawn.seen].T, ".", color="#ffffff", markersize=2)
            axes.set_axis_off()
            seen = np.flatnonzero(drawn.seen)
            colors = ["#a00000"] * len(seen)
            write_labels(
                *(canvas, axes, drawn.landmarks[seen], [str(number) for number in seen], colors),
                fontsize=6,
                keep_off=drawn.landmarks[~drawn.seen],
            )
            if person == 0:
                axes.set_title(view, y=0.965, fontsize=10)
    with whole_file(out) as part:
        canvas.print_png(str(part), metadata={"Software": None}, pil_kwargs={"optimize": True})
