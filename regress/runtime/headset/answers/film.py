"""The avatar beside the cameras' pictures, as a film."""

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import BinaryIO

import cv2
import numpy as np

from facegen.files import output_errors, whole_file
from facegen.formats.film import WRITTEN_FILMS, check_film_path, encode_film
from facegen.formats.ppm import read_ppm_stream
from regress.errors import InputError, OutputError
from regress.runtime.headset.recordings.footage import Footage

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
    with output_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    with whole_file(path) as part, tempfile.TemporaryDirectory() as folder:
        table = Path(folder, "weights.csv")
        table.write_text(weights_csv, encoding="utf-8")
        encode_film(part, _drawn(footage, table, rig=rig, fps=fps, height_px=height_px), fps=fps)


def check_film_name(path: Path) -> None:
    """Refuse a name whose ending is not one of those that can be written, or that is no text."""
    check_film_path(path)
    if path.suffix.lower() not in WRITTEN_FILMS:
        raise InputError(
            f"{path} is no name of a film that can be written; these end in {', '.join(WRITTEN_FILMS)}"
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


def _drawn(footage: Footage, table: Path, *, rig: str, fps: float, height_px: int) -> Iterator[np.ndarray]:
    """Pictures (h, w, 3) RGB of the film: the face comes from a program of its own, as pictures on a pipe.

    The packages meet in files and pipes, and the renderer belongs to facegen.
    """
    options = (
        "--weights",
        table,
        "--out",
        "-",
        "--rig",
        rig,
        "--fps",
        fps,
        "--size",
        height_px,
        "--no-landmarks",
    )
    command = [sys.executable, "-m", "facegen", "preview", *map(str, options)]
    with (
        tempfile.TemporaryFile() as talk,
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=talk) as facegen,
    ):
        try:
            rows = 0
            for rows, face in enumerate(read_ppm_stream(facegen.stdout), start=1):
                yield _beside(footage, rows - 1, face)
        finally:
            facegen.stdout.close()
            code = facegen.wait()
        if code:
            raise InputError(f"facegen preview cannot draw the face: {_last_line(talk)}")
        if rows != len(footage.numbers):
            raise OutputError(f"facegen preview drew {rows} frames; {len(footage.numbers)} are needed")


def _beside(footage: Footage, row: int, face: np.ndarray) -> np.ndarray:
    """One picture of the film: the cameras' pictures at the left, the face with the frame's number at the right."""
    face = face.copy()
    cv2.putText(
        face,
        str(footage.numbers[row]),
        (8, face.shape[0] - 10),
        cv2.FONT_HERSHEY_SIMPLEX,
        0.5,
        (90,) * 3,
        1,
        cv2.LINE_AA,
    )
    return np.hstack([tiles(footage, row, face.shape[0]), face])


def _last_line(talk: BinaryIO) -> str:
    talk.seek(0)
    return (talk.read().decode(errors="replace").strip() or "no reason given").splitlines()[-1]
