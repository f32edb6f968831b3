"""Runs the trained graph in onnxruntime on one core."""

import os
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from regress.errors import InputError, ModelError
from regress.runtime.headset.estimates import GRAPH_OUTPUTS, Estimates, points_output
from regress.runtime.headset.model import CameraInput
from regress.runtime.onnx_session import open_session

_BLOCK_ROWS = 64
"""Frames run at a time: more need more memory and are no faster."""


class HeadsetGraph:
    """A session of onnxruntime on a graph whose inputs and outputs ``HeadsetModel`` describes.

    Parameters
    ----------
    source
        Path of network.onnx, or its bytes.
    cameras
        The model's cameras, in its order.

    Raises
    ------
    ModelError
        Where onnxruntime cannot read the graph, or it lacks an input of a camera.
    """

    def __init__(self, source: str | os.PathLike[str] | bytes, cameras: tuple[CameraInput, ...]) -> None:
        data = source if isinstance(source, bytes) else Path(source).read_bytes()
        try:
            self._session = open_session(data)
        except Exception as error:  # onnxruntime's own classes share no public base
            raise ModelError(f"network.onnx is not a graph that onnxruntime reads: {error}") from error
        self._cameras = cameras
        inputs = {value.name for value in self._session.get_inputs()}
        self._outputs = {value.name for value in self._session.get_outputs()}
        lost = {f"{kind}_{camera.name}" for camera in cameras for kind in ("pictures", "neutral")} - inputs
        if lost:
            raise ModelError(f"network.onnx has no input {', '.join(sorted(lost))}; model.json names them")

    def run(
        self,
        pictures: dict[str, np.ndarray],
        *,
        neutral: dict[str, np.ndarray] | None = None,
        present: np.ndarray | None = None,
        calibrated: np.ndarray | None = None,
    ) -> Estimates:
        """Estimates of n frames.

        Parameters
        ----------
        pictures : dict of (n, height, width) uint8
            By camera; one that is left out counts as not present.
        neutral : dict of (n, height, width) uint8 or None
            Neutral pictures for each frame; None means uncalibrated.
        present : (n, cameras) float or None
            0 where a camera is not to be listened to.
        calibrated : (n,) float or None
            1 where the neutral pictures count; all, where they are given.

        Raises
        ------
        InputError
            Where pictures are of a camera that the model does not have, or a camera that is present in a calibrated
            frame has no neutral pictures.
        """
        names = [name for name in GRAPH_OUTPUTS if name in self._outputs]
        arrays = self._run(names, pictures, neutral, present, calibrated)
        return Estimates(**dict(zip(names, arrays, strict=True)))

    def trace(self, pictures: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Pixels (n, P, 2) float32 of the points that each of these cameras traces; see ``HeadsetModel.points``.

        Cameras that trace none are left out, and so are all of older models.
        """
        cameras = [name for name in pictures if points_output(name) in self._outputs]
        points = self._run([points_output(name) for name in cameras], pictures, None, None, None)
        return dict(zip(cameras, points, strict=True))

    def _run(
        self,
        names: Sequence[str],
        pictures: dict[str, np.ndarray],
        neutral: dict[str, np.ndarray] | None,
        present: np.ndarray | None,
        calibrated: np.ndarray | None,
    ) -> list[np.ndarray]:
        if not names:
            return []
        cameras = [camera.name for camera in self._cameras]
        unknown = [name for name in (*pictures, *(neutral or {})) if name not in cameras]
        if unknown:
            raise InputError(
                f"pictures are given of {', '.join(dict.fromkeys(unknown))}; the model has {', '.join(cameras)}"
            )
        rows = len(next(iter(pictures.values())))
        seen = np.tile(np.array([name in pictures for name in cameras], np.float32), (rows, 1))
        if present is not None:
            seen *= np.asarray(present, np.float32)
        with_neutral = np.full(rows, float(neutral is not None), np.float32)
        if calibrated is not None:
            with_neutral *= np.asarray(calibrated, np.float32)
        compared = zip(cameras, (seen * with_neutral[:, None]).any(axis=0), strict=True)
        lost = [name for name, needed in compared if needed and name not in neutral]
        if lost:
            raise InputError(
                f"no neutral pictures are given of {', '.join(lost)}; a calibrated frame needs them of every camera "
                f"that is present"
            )
        blocks = []
        for start in range(0, max(rows, 1), _BLOCK_ROWS):
            block = slice(start, start + _BLOCK_ROWS)
            feed = {"present": seen[block], "calibrated": with_neutral[block]}
            for camera in self._cameras:
                blank = np.zeros((len(with_neutral[block]), camera.height, camera.width), np.uint8)
                feed[f"pictures_{camera.name}"] = _rows(pictures, camera.name, block, blank)
                feed[f"neutral_{camera.name}"] = _rows(neutral or {}, camera.name, block, blank)
            blocks.append(self._session.run(names, feed))
        return [np.concatenate(arrays) for arrays in zip(*blocks, strict=True)]


def _rows(arrays: dict[str, np.ndarray], name: str, block: slice, blank: np.ndarray) -> np.ndarray:
    return np.ascontiguousarray(arrays[name][block]) if name in arrays else blank
