"""Writes the frames of a performance as a film, an animated picture or a strip for a page."""

import itertools
import math
from collections.abc import Iterable, Sequence
from pathlib import Path

import matplotlib.style
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from facegen.conventions import BLENDSHAPES
from facegen.errors import InputError
from facegen.formats.film import encode_film
from facegen.preview.performance import Performance, face_window, pictures

FILM_SUFFIXES, ANIMATION_SUFFIXES = (".webm", ".mp4"), (".gif", ".webp")
"""Films are written by OpenCV, animated pictures by Pillow (which holds all frames in memory)."""
GIF_SHORTEST_S = 0.02
"""Of a frame; frames of quicker films are left out of a GIF."""
CURVES = 8
"""Weights that a strip draws: those that move most."""


def write_film(path: Path, frames: Iterable[np.ndarray], *, fps: float) -> None:
    """Write RGB pictures (h, w, 3) uint8 as the file's suffix says.

    Raises
    ------
    InputError
        If the suffix is none of `FILM_SUFFIXES` and `ANIMATION_SUFFIXES`.
    OSError
        If OpenCV cannot write the film.
    """
    suffix = path.suffix.lower()
    if suffix in ANIMATION_SUFFIXES:
        # a GIF counts hundredths of a second, and programs that play it take the shortest ones for ten times as long
        every = 1 if suffix == ".webp" else max(1, math.ceil(fps * GIF_SHORTEST_S - 1e-6))
        images = [Image.fromarray(frame) for frame in itertools.islice(frames, 0, None, every)]
        fps /= every
        options = {"lossless": False, "quality": 80} if suffix == ".webp" else {"optimize": True}
        unit_ms = 1 if suffix == ".webp" else 10
        ends = np.round(np.arange(len(images) + 1) * 1000 / fps / unit_ms).astype(int) * unit_ms
        lasting = np.diff(ends).tolist()
        images[0].save(path, save_all=True, append_images=images[1:], duration=lasting, loop=0, **options)
        return
    if suffix not in FILM_SUFFIXES:
        raise InputError(f"{path}: films end in {', '.join((*FILM_SUFFIXES, *ANIMATION_SUFFIXES))}")
    encode_film(path, frames, fps=fps)


def clip_strip(
    performance: Performance, *, count: int = 8, height_px: int = 320, landmarks: bool = True
) -> Figure:
    """Faces at ``count`` times over the whole of a performance, above the curves of the weights that move most."""
    chosen = np.unique(np.linspace(0, len(performance.time_s) - 1, count).round().astype(int))
    with matplotlib.style.context({"font.size": 8, "axes.spines.top": False, "axes.spines.right": False}):
        figure = Figure(figsize=(1.5 * len(chosen), 4.6), dpi=120)
        FigureCanvasAgg(figure)
        faces = figure.add_gridspec(1, len(chosen), left=0.01, right=0.99, top=0.91, bottom=0.53, wspace=0.02)
        curves = figure.add_gridspec(1, 1, left=0.05, right=0.85, top=0.51, bottom=0.1)
        shown = performance.rows(chosen)
        window_m = face_window(shown)
        drawn = pictures(shown, height_px=height_px, landmarks=landmarks, window_m=window_m)
        for column, (row, picture) in enumerate(zip(chosen, drawn, strict=True)):
            axes = figure.add_subplot(faces[0, column])
            axes.imshow(picture, interpolation="lanczos")
            axes.set_title(f"{performance.time_s[row]:.2f} s", pad=2)
            axes.set_axis_off()
        axes = figure.add_subplot(curves[0, 0])
        _draw_curves(axes, performance, chosen)
        figure.suptitle(performance.title, x=0.01, y=0.99, ha="left", fontsize=9)
    return figure


def _draw_curves(axes: object, performance: Performance, chosen: Sequence[int]) -> None:
    spread = performance.weights.std(axis=0)
    largest = [index for index in np.argsort(-spread, kind="stable")[:CURVES] if spread[index] > 0]
    for index in largest:
        axes.plot(performance.time_s, performance.weights[:, index], linewidth=1.2, label=BLENDSHAPES[index])
    for row in chosen:
        axes.axvline(performance.time_s[row], color="#bbbbbb", linewidth=0.6, zorder=0)
    axes.set_ylim(-0.02, 1.02)
    axes.set_xlim(performance.time_s[0], performance.time_s[-1] + 1e-6)
    axes.set_xlabel("seconds")
    axes.set_ylabel("weight")
    if largest:
        axes.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), frameon=False)
