"""The avatar beside the cameras' pictures, as a film."""

import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from facegen.formats.film import encode_film
from regress.errors import InputError, OutputError
from regress.runtime.headset.footage import Footage
from regress.runtime.headset.recordings import FILMS

WRITTEN = tuple(suffix for suffix in FILMS if suffix != ".webm")
"""Endings of films that can be written: WebM holds no MPEG-4."""

_GREY = 40
"""Of what surrounds the pictures, and of a camera that has none."""


def write_film(
    path: Path, footage: Footage, weights_csv: str, *, rig: str, fps: float, height_px: int = 480
) -> None:
    """Write a film of the cameras' pictures with the face that ``facegen preview --weights`` draws beside them.

    Parameters
    ----------
    path
        Has passed ``check_film_name``.
    weights_csv
        Text of a CSV of the 52 weights, a row for each frame of the footage.
    rig
        Name of a built rig, or a rig's file.
    fps, height_px
        Of the film; the height is even.

    Raises
    ------
    InputError
        Where facegen cannot draw the face.
    OutputError
        Where the film cannot be written.
    """
    part = path.with_name(f".{path.stem}.{os.getpid()}{path.suffix}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory() as folder:
            table, face = Path(folder, "weights.csv"), Path(folder, "face.mp4")
            table.write_text(weights_csv, encoding="utf-8")
            _draw_face(table, face, rig=rig, fps=fps, height_px=height_px)
            encode_film(part, _tiled(footage, face, height_px), fps=fps)
        part.replace(path)
    except OSError as error:
        raise OutputError(f"the film cannot be written to {path}: {error.strerror or error}") from error
    finally:
        part.unlink(missing_ok=True)


def check_film_name(path: Path) -> None:
    """Refuse a name whose ending is not one of ``WRITTEN``."""
    if path.suffix.lower() not in WRITTEN:
        raise InputError(
            f"{path} is no name of a film that can be written; these end in {', '.join(WRITTEN)}"
        )


def tiles(footage: Footage, row: int, height_px: int) -> np.ndarray:
    """The cameras' pictures of a frame, named, in two columns, the subject's left at the right: (h, w, 3) uint8."""
    # pictures of a face show its right side at the left
    order = sorted(footage.cameras, key=lambda name: ("right" not in name, "left" not in name))
    rows = -(-len(order) // 2)
    side = height_px // rows // 2 * 2
    canvas = np.full((height_px, 2 * side if len(order) > 1 else side, 3), _GREY, dtype=np.uint8)
    for place, name in enumerate(order):
        alone = place == len(order) - 1 and place % 2 == 0 and len(order) > 1
        top, left = place // 2 * side, side // 2 if alone else place % 2 * side
        fault = footage.faults[name][row]
        if fault is None:
            picture = footage.pictures[name][row]
            scale = side / max(picture.shape)
            size = round(picture.shape[1] * scale), round(picture.shape[0] * scale)
            scaled = cv2.resize(picture, size, interpolation=cv2.INTER_CUBIC)
            canvas[top : top + size[1], left : left + size[0]] = scaled[..., None]
        said = name if fault is None else f"{name}: {fault.name.lower()}"
        cv2.putText(
            canvas, said, (left + 6, top + 18), cv2.FONT_HERSHEY_SIMPLEX, 0.45, (255,) * 3, 1, cv2.LINE_AA
        )
    return canvas


def _draw_face(table: Path, out: Path, *, rig: str, fps: float, height_px: int) -> None:
    # a program of its own: the packages meet in files, and its renderer belongs to facegen
    options = [
        "--weights",
        table,
        "--out",
        out,
        "--rig",
        rig,
        "--fps",
        fps,
        "--size",
        height_px,
        "--no-landmarks",
    ]
    command = [sys.executable, "-m", "facegen", "preview", *map(str, options)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode:
        said = (done.stderr.strip() or "no reason given").splitlines()[-1]
        raise InputError(f"facegen preview cannot draw the face: {said}")


def _tiled(footage: Footage, face: Path, height_px: int) -> Iterator[np.ndarray]:
    film = cv2.VideoCapture(str(face))
    try:
        for row in range(len(footage.numbers)):
            there, picture = film.read()
            if not there:
                raise OutputError(f"facegen preview drew {row} frames; {len(footage.numbers)} are needed")
            beside = tiles(footage, row, picture.shape[0])
            number = str(footage.numbers[row])
            place = (8, picture.shape[0] - 10)
            cv2.putText(picture, number, place, cv2.FONT_HERSHEY_SIMPLEX, 0.5, (90,) * 3, 1, cv2.LINE_AA)
            yield cv2.cvtColor(np.hstack([beside, picture]), cv2.COLOR_BGR2RGB)
    finally:
        film.release()
