"""Draws what `regress headset check` found: frames as they come with traced points, and as the network sees them."""

from collections.abc import Mapping

import cv2
import numpy as np

from regress.runtime.headset.fitness.camera_fitness import CameraFitness
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.placing.levels import levels_in

_ACROSS, _SIDE, _GAP, _LINE = 6, 192, 4, 20
_INK, _PAPER, _ALARM = (235, 235, 235), (38, 34, 30), (90, 150, 255)
_LIDS, _IRIS, _PUPIL, _VIEW = (60, 220, 255), (255, 190, 60), (80, 80, 255), (120, 230, 120)
_LETTERS = 108
"""Of a line of text in this width."""


def fitness_sheet(
    predictor: HeadsetPredictor, footage: Mapping[str, np.ndarray], judged: list[CameraFitness]
) -> bytes:
    """A PNG in colour with a block for each camera.

    Each has six frames, evenly chosen, as they were recorded, with the view's frame and what the network traces in it;
    below them the same as the network sees them, and at the end the mean picture of its training. Networks of drawn
    headsets have no such picture.
    """
    blocks = [_block(predictor, footage[one.camera], one) for one in judged]
    width = max(block.shape[1] for block in blocks)
    drawn = np.vstack([_wide(block, width) for block in blocks])
    return cv2.imencode(".png", drawn)[1].tobytes()


def _block(predictor: HeadsetPredictor, pictures: np.ndarray, one: CameraFitness) -> np.ndarray:
    width, height = predictor.sizes[one.camera]
    chosen = pictures[np.linspace(0, len(pictures) - 1, _ACROSS).round().astype(int)]
    views = np.stack([one.placement.view(picture, width=width, height=height) for picture in chosen])
    levelled = levels_in([views], predictor.model.looks[one.camera]).apply(views)
    traced = predictor.graph.trace({one.camera: levelled}).get(one.camera)
    names = predictor.model.points.get(one.camera, ())
    above, below = [], []
    for number, picture in enumerate(chosen):
        matrix = one.placement.picture_from_view((picture.shape[1], picture.shape[0]), (width, height))
        frame = np.array(
            [[-0.5, -0.5], [width - 0.5, -0.5], [width - 0.5, height - 0.5], [-0.5, height - 0.5]]
        )
        cell = _cell(picture)
        _line(cell, picture, frame @ matrix[:, :2].T + matrix[:, 2], _VIEW, closed=True)
        seen = _cell(levelled[number])
        if traced is not None:
            _points(cell, picture, traced[number] @ matrix[:, :2].T + matrix[:, 2], names)
            _points(seen, levelled[number], traced[number], names)
        above.append(cell)
        below.append(seen)
    typical = predictor.typical.get(one.camera)
    caption = "above: as recorded, the view in green; below: as the network sees them"
    if typical is not None:
        below.append(_cell(typical))
        above.append(np.full_like(below[-1], _PAPER))
        caption += ", and its training's mean picture"
    rows = [_row(above), _row(below)]
    sentences = [finding.sentence for finding in one.findings] or [f"{one.camera}: its frames fit"]
    lines = [(caption, _INK)]
    for sentence in sentences:
        colour = _ALARM if one.findings else _VIEW
        lines += [(text, colour) for text in _broken(sentence)]
    wide = max(row.shape[1] for row in rows)
    return np.vstack([*(_wide(row, wide) for row in rows), _text(lines, wide)])


def _cell(picture: np.ndarray) -> np.ndarray:
    """The picture in colour, as large as a cell is high."""
    scale = _SIDE / picture.shape[0]
    large = cv2.resize(picture, None, fx=scale, fy=scale, interpolation=cv2.INTER_CUBIC)
    return cv2.cvtColor(large, cv2.COLOR_GRAY2BGR)


def _points(cell: np.ndarray, picture: np.ndarray, points: np.ndarray, names: tuple[str, ...]) -> None:
    for part, colour, closed in (
        ("_upper_lid_", _LIDS, False),
        ("_lower_lid_", _LIDS, False),
        ("_iris_", _IRIS, True),
    ):
        columns = [column for column, name in enumerate(names) if part in name]
        if columns:
            _line(cell, picture, points[columns], colour, closed=closed)
    for column, name in enumerate(names):
        if "_pupil" in name or not ("_lid_" in name or "_iris_" in name):
            at = _at(points[column], picture)
            cv2.circle(
                cell, tuple(at.tolist()), 32, _PUPIL if "_pupil" in name else _LIDS, -1, cv2.LINE_AA, 4
            )


def _line(
    cell: np.ndarray, picture: np.ndarray, points: np.ndarray, colour: tuple[int, ...], *, closed: bool
) -> None:
    cv2.polylines(cell, [_at(points, picture)[:, None]], closed, colour, 1, cv2.LINE_AA, 4)


def _at(points: np.ndarray, picture: np.ndarray) -> np.ndarray:
    """Sixteenths of a cell's pixels; points far outside stay within what OpenCV draws."""
    scale = _SIDE / picture.shape[0]
    return np.rint(16 * np.clip(scale * (points + 0.5) - 0.5, -2000, 4000)).astype(np.int32)


def _row(cells: list[np.ndarray]) -> np.ndarray:
    framed = [cv2.copyMakeBorder(cell, 0, _GAP, 0, _GAP, cv2.BORDER_CONSTANT, value=_PAPER) for cell in cells]
    return np.hstack(framed)


def _wide(block: np.ndarray, width: int) -> np.ndarray:
    return cv2.copyMakeBorder(block, 0, 0, 0, width - block.shape[1], cv2.BORDER_CONSTANT, value=_PAPER)


def _broken(sentence: str) -> list[str]:
    lines = [""]
    for word in sentence.replace("°", " degrees").split():
        if len(lines[-1]) + len(word) > _LETTERS:
            lines.append("  ")
        lines[-1] = f"{lines[-1]}{' ' if lines[-1].strip() else ''}{word}"
    return lines


def _text(lines: list[tuple[str, tuple[int, ...]]], width: int) -> np.ndarray:
    paper = np.full((_LINE * len(lines) + 12, width, 3), _PAPER, np.uint8)
    for number, (line, colour) in enumerate(lines):
        at = (8, 16 + _LINE * number)
        cv2.putText(paper, line, at, cv2.FONT_HERSHEY_SIMPLEX, 0.5, colour, 1, cv2.LINE_AA)
    return paper
