"""Runs the trained graph in onnxruntime on one core."""

import copy
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from facegen.conventions import CAMERA_TERMS
from facegen.documents import read_bytes
from regress.errors import InputError, ModelError
from regress.runtime.headset.network.estimates import (
    CAMERA_INPUT,
    GRAPH_OUTPUTS,
    TERMS_TOLD,
    Estimates,
    points_output,
)
from regress.runtime.headset.network.folder import MOST_GRAPH_BYTES
from regress.runtime.headset.network.graph_interface import GraphInterface
from regress.runtime.headset.network.model import CameraInput
from regress.runtime.headset.network.neutral_codes import NEUTRAL, PICTURES, NeutralCodes, cut_network
from regress.runtime.onnx_file import graph_fault
from regress.runtime.onnx_session import open_session, session_errors

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
    points
        By camera what it traces, where the model says so; without, any number of points.

    Raises
    ------
    ModelError
        Where the graph is not run (`graph_fault`), onnxruntime cannot read it, or its inputs and outputs are not those
        of the cameras.

    Attributes
    ----------
    listens
        Whether it can be told where its cameras are.
    """

    def __init__(
        self,
        source: str | os.PathLike[str] | bytes,
        cameras: tuple[CameraInput, ...],
        points: Mapping[str, Sequence[str]] | None = None,
    ) -> None:
        data = source if isinstance(source, bytes) else read_bytes(Path(source), most_bytes=MOST_GRAPH_BYTES)
        fault = graph_fault(data)
        if fault is not None:
            raise ModelError(f"network.onnx {fault}")
        with session_errors("network.onnx is not a graph that onnxruntime reads"):
            self._session = open_session(data)
        self._cameras = cameras
        self._interface = GraphInterface(cameras, points or {})
        inputs, outputs = self._session.get_inputs(), self._session.get_outputs()
        defaults = self._session.get_overridable_initializers()
        try:
            self._interface.check(inputs, defaults, outputs)
        # onnxruntime reads any bytes, and decodes them as they are asked for
        except UnicodeDecodeError as error:
            raise ModelError("network.onnx has a name that is no UTF-8 text") from error
        self._outputs = {value.name for value in outputs}
        self.listens = CAMERA_INPUT in {value.name for value in defaults}
        self._told: dict[str, np.ndarray] = {}
        self._codes: NeutralCodes | None = None
        halves = cut_network(data, self._session, cameras)
        if halves is not None:
            self._session, self._codes = halves

    @property
    def outputs(self) -> frozenset[str]:
        """Names of all that it answers with."""
        return frozenset(self._outputs)

    @property
    def told_table(self) -> np.ndarray | None:
        """(cameras, 15) float32 that it is told of cameras; None where it is told nothing."""
        return self._told.get(CAMERA_INPUT)

    def told(self, terms: Mapping[str, np.ndarray]) -> "HeadsetGraph":
        """The same graph, told of cameras: ``CAMERA_TERMS`` (14,) by name; of those left out it knows nothing.

        Raises
        ------
        InputError
            Where the graph does not listen.
        """
        if not self.listens:
            raise InputError(
                "the model was trained for one headset and is not told where cameras are; leave that out, or take a "
                "model of drawn headsets, as headset-any"
            )
        table = np.zeros((len(self._cameras), TERMS_TOLD), np.float32)
        for row, camera in zip(table, self._cameras, strict=True):
            if camera.name in terms:
                row[:-1], row[-1] = np.asarray(terms[camera.name], np.float32).reshape(len(CAMERA_TERMS)), 1.0
        other = copy.copy(self)
        other._told = {CAMERA_INPUT: table}
        if self._codes is not None:
            other._codes = self._codes.with_others(other._told)
        return other

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

    def see(
        self,
        pictures: dict[str, np.ndarray],
        *,
        neutral: dict[str, np.ndarray] | None = None,
        present: np.ndarray | None = None,
        calibrated: np.ndarray | None = None,
    ) -> tuple[Estimates, dict[str, np.ndarray]]:
        """What `run` and `trace` say, for the time of one."""
        names = [name for name in GRAPH_OUTPUTS if name in self._outputs]
        cameras = [name for name in pictures if points_output(name) in self._outputs]
        wanted = [*names, *map(points_output, cameras)]
        arrays = self._run(wanted, pictures, neutral, present, calibrated)
        count = len(names)
        estimates = Estimates(**dict(zip(names, arrays[:count], strict=True)))
        return estimates, dict(zip(cameras, arrays[count:], strict=True))

    def read(
        self,
        values: Sequence[str],
        pictures: dict[str, np.ndarray],
        *,
        neutral: dict[str, np.ndarray] | None = None,
    ) -> tuple[Estimates, list[np.ndarray]]:
        """What `run` says, and other outputs of a graph that has more than model.json tells."""
        names = [name for name in GRAPH_OUTPUTS if name in self._outputs]
        arrays = self._run([*names, *values], pictures, neutral, None, None)
        return Estimates(**dict(zip(names, arrays[: len(names)], strict=True))), arrays[len(names) :]

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
        needed = zip(cameras, (seen * with_neutral[:, None]).any(axis=0), strict=True)
        lost = [name for name, is_needed in needed if is_needed and name not in neutral]
        if lost:
            raise InputError(
                f"no neutral pictures are given of {', '.join(lost)}; a calibrated frame needs them of every camera "
                f"that is present"
            )
        blocks = []
        for start in range(0, max(rows, 1), _BLOCK_ROWS):
            block = slice(start, start + _BLOCK_ROWS)
            count = len(with_neutral[block])
            compared = None if neutral is None else {name: one[block] for name, one in neutral.items()}
            feed = {"present": seen[block], "calibrated": with_neutral[block], **self._told}
            feed |= self._whole(PICTURES, {name: one[block] for name, one in pictures.items()}, count)
            with session_errors("network.onnx cannot be run"):
                if self._codes is None:
                    feed |= self._whole(NEUTRAL, compared or {}, count)
                else:
                    feed |= self._codes.of(compared, count)
                blocks.append(self._session.run(names, feed))
            self._interface.check_answers(dict(zip(names, blocks[-1], strict=True)), rows=count)
        return blocks[0] if len(blocks) == 1 else [np.concatenate(one) for one in zip(*blocks, strict=True)]

    def _whole(self, kind: str, pictures: Mapping[str, np.ndarray], count: int) -> dict[str, np.ndarray]:
        """Inputs of all cameras; black pictures (count, h, w) of those that are left out."""
        return {
            kind + one.name: np.ascontiguousarray(pictures[one.name])
            if one.name in pictures
            else np.zeros((count, one.height, one.width), np.uint8)
            for one in self._cameras
        }
