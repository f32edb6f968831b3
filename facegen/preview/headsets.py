"""Draws a headset round the mean head: cameras, LEDs, occluders, and what each camera sees."""

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from facegen.geometry import apply_transform, project, rotation_from_angles, unproject
from facegen.headsets import Headset
from facegen.preview.lettering import write_labels
from facegen.preview.portraits import shade
from facegen.preview.wearer import EDGE, Wearer, put_on, seen_landmarks
from facegen.raster import nearest_along_z, nearest_triangles
from facegen.rigs import Rig
from facegen.scene import View
from facegen.scene.assembly import headset_lamps
from facegen.sensor.lens import transmission

SIDES_DEG = {"from the front": (0.0, 0.0), "from the left": (75.0, 0.0), "from below": (0.0, -55.0)}
"""Yaw and pitch of the viewer."""
WINDOW_M = (-0.12, 0.085, 0.13, -0.165)
"""Left, top, right and bottom of the pictures of the head, in the head turned towards the viewer."""
STEP_M = 0.6e-3
CORNER_M = 0.022
"""How far along the rays of its picture's corners a camera is drawn."""
VIEW_PX = 320
WIDTH_IN, TITLE_IN, GAP_IN = 10.2, 0.22, 0.1
"""Of the figure, of the line above each picture, and between two pictures."""
_COLORS = ("#0050ff", "#e07000", "#009050", "#c000a0", "#806000", "#00a0b0", "#d02020", "#5050a0", "#60a000")


def draw_headset(headset: Headset, rig: Rig) -> Figure:
    """Figure of a headset on the rig's mean head, without tolerances: from three sides, then camera by camera."""
    wearer = put_on(headset.scaled(VIEW_PX), rig)
    cameras = len(headset.cameras)
    columns = min(max(cameras, 2), 3)
    lines = -(-cameras // columns)
    side_in, view_in = WIDTH_IN / len(SIDES_DEG), WIDTH_IN / columns
    height_in = side_in + lines * view_in + (1 + lines) * TITLE_IN
    figure = Figure(figsize=(WIDTH_IN, height_in), dpi=100)
    canvas = FigureCanvasAgg(figure)

    def panel(number: float, wide_in: float, top_in: float) -> Axes:
        bottom_in = height_in - top_in - TITLE_IN - wide_in
        place = (number * wide_in + GAP_IN / 2, bottom_in + GAP_IN / 2, wide_in - GAP_IN, wide_in - GAP_IN)
        axes = figure.add_axes(np.array(place) / [WIDTH_IN, height_in, WIDTH_IN, height_in])
        axes.set_axis_off()
        return axes

    for number, (title, (yaw, pitch)) in enumerate(SIDES_DEG.items()):
        axes = panel(number, side_in, 0.0)
        _draw_side(canvas, axes, wearer, yaw, pitch)
        axes.set_title(title, fontsize=9)
    for number, (view, color) in enumerate(zip(wearer.views, _cycle(cameras), strict=True)):
        line, column = divmod(number, columns)
        # a line that is not full stands in the middle
        left = (columns - min(columns, cameras - line * columns)) / 2
        axes = panel(left + column, view_in, side_in + TITLE_IN + line * (view_in + TITLE_IN))
        _draw_view(canvas, axes, wearer, view)
        camera = headset.camera(view.name)
        seen = f"{seen_landmarks(wearer, view)[1].sum()} points"
        axes.set_title(
            f"{view.name}: {camera.model}, {camera.width}x{camera.height}, {seen}", fontsize=8, color=color
        )
    return figure


def _draw_side(canvas: FigureCanvasAgg, axes: Axes, wearer: Wearer, yaw: float, pitch: float) -> None:
    headset, fit = wearer.headset, wearer.head_from_headset
    turn = rotation_from_angles(np.radians(yaw), np.radians(pitch), 0.0)
    left, top, right, bottom = WINDOW_M
    shape = (round((top - bottom) / STEP_M), round((right - left) / STEP_M))
    pictures = []
    for vertices, triangles, part in (wearer.head, wearer.housed):
        turned = vertices @ turn
        depth = nearest_along_z(turned, triangles, origin=np.array([left, top]), step=STEP_M, shape=shape)
        pictures.append(shade(turned, triangles, part, depth))
    # the housing is half transparent: what it hides can be judged
    axes.imshow(0.5 * (pictures[0] + pictures[1]), extent=(left, right, bottom, top), interpolation="nearest")
    color_of = dict(zip(headset.camera_names, _cycle(len(headset.cameras)), strict=True))
    lamp_camera = {led.name: led.camera for led in headset.leds}
    drawn = []
    for lamp in headset_lamps(headset, fit):
        x, y, _ = lamp.position @ turn
        drawn.append(np.array([[x, y]]))
        axes.plot(x, y, "o", color="#ffd000", mec=color_of[lamp_camera[lamp.name]], ms=3.5, mew=0.8)
    pinholes = []
    for camera in headset.cameras:
        corners = [[-0.5, -0.5], [camera.width - 0.5, -0.5], [camera.width - 0.5, camera.height - 0.5]]
        corners.append([-0.5, camera.height - 0.5])
        rays = unproject(camera.camera, np.array(corners)) * CORNER_M
        corners_m = (
            apply_transform(fit @ camera.headset_from_camera, np.concatenate([np.zeros((1, 3)), rays])) @ turn
        )
        for k in range(4):
            line = corners_m[[0, 1 + k, 1 + (k + 1) % 4]]
            axes.plot(line[:, 0], line[:, 1], color=color_of[camera.name], lw=0.8)
            along = np.linspace(0, 1, 9)[:, None, None]
            drawn.append(((1 - along) * line[:-1, :2] + along * line[1:, :2]).reshape(-1, 2))
        pinholes.append(corners_m[0, :2])
    axes.set_xlim(left, right)
    axes.set_ylim(bottom, top)
    axes.set_axis_off()
    colors = [color_of[name] for name in headset.camera_names]
    write_labels(
        canvas,
        axes,
        np.array(pinholes),
        headset.camera_names,
        colors,
        fontsize=8,
        keep_off=np.concatenate(drawn),
    )


def _draw_view(canvas: FigureCanvasAgg, axes: Axes, wearer: Wearer, view: View) -> None:
    camera = wearer.headset.camera(view.name)
    vertices, triangles, part = wearer.housed
    vertices = apply_transform(view.camera_from_head, vertices)
    distance = np.linalg.norm(vertices, axis=-1)
    in_front = vertices[:, 2] > EDGE[camera.model] * distance
    pixels = np.where(in_front[:, None], project(camera.camera, vertices), np.nan)
    # over a fisheye's picture no measure of depth is exactly linear; triangles are small
    nearness = 1.0 / (distance if camera.model == "fisheye" else np.where(in_front, vertices[:, 2], np.inf))
    depth = nearest_triangles(pixels, nearness, triangles, shape=(camera.height, camera.width))
    picture = shade(vertices * (1.0, -1.0, -1.0), triangles, part, depth, viewer=np.zeros(3))
    axes.imshow(picture * transmission(camera)[..., None], interpolation="nearest")
    landmarks_px, seen = seen_landmarks(wearer, view)
    axes.plot(*landmarks_px[seen].T, ".", color="#0040ff", ms=3)
    axes.set_xlim(-0.5, camera.width - 0.5)
    axes.set_ylim(camera.height - 0.5, -0.5)
    numbers = [str(number) for number in np.flatnonzero(seen)]
    write_labels(canvas, axes, landmarks_px[seen], numbers, ["#a00000"] * len(numbers), fontsize=7)


def _cycle(count: int) -> list[str]:
    return [_COLORS[i % len(_COLORS)] for i in range(count)]
