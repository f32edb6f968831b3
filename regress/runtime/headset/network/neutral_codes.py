"""Encodes neutral pictures once, not again with every frame: a third of a network's time is theirs."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from regress.errors import ModelError
from regress.runtime.headset.network.model import CameraInput
from regress.runtime.onnx_cut import cut
from regress.runtime.onnx_session import open_session, session_errors

if TYPE_CHECKING:
    from regress.runtime.onnx_session import Session

PICTURES, NEUTRAL = "pictures_", "neutral_"
"""Before a camera's name: inputs of a headset network's graph."""

_PROBED = 2
"""Random frames of which both ways have to say the same."""

_NEAR = 1e-4
"""Difference, as a share of the largest number, that is let through: as much as an export may differ."""


class NeutralCodes:
    """What a graph's early half makes of neutral pictures, kept as long as they are the same.

    Parameters
    ----------
    half
        Takes all inputs of the whole graph.
    values
        What it gives: one row a frame, or as many a frame as cameras share an encoder, each camera's together.
    cameras
        The model's.
    others
        Further inputs.
    """

    def __init__(
        self,
        half: "Session",
        values: Sequence[str],
        cameras: Sequence[CameraInput],
        others: Mapping[str, np.ndarray],
    ) -> None:
        self._half, self._values, self._cameras, self._others = half, list(values), cameras, dict(others)
        self._taken = {value.name for value in half.get_inputs()}
        self._blank = {one.name: np.zeros((1, one.height, one.width), np.uint8) for one in cameras}
        self._last: tuple[dict[str, np.ndarray], list[np.ndarray]] | None = None
        self._nothing = [np.zeros_like(code) for code in self._encode(self._blank)]

    def with_others(self, others: Mapping[str, np.ndarray]) -> "NeutralCodes":
        """The same, with other further inputs."""
        return NeutralCodes(self._half, self._values, self._cameras, others)

    def of(self, neutral: Mapping[str, np.ndarray] | None, rows: int) -> dict[str, np.ndarray]:
        """Inputs of the late half for so many frames.

        Parameters
        ----------
        neutral : mapping of (rows, h, w) uint8, or None
            By camera; one that is left out is black. None gives zeros, of which nothing comes in an uncalibrated frame.
        rows
            Number of frames.
        """
        if neutral is None:
            codes = self._nothing
        elif rows == 1 or all(picture.strides[0] == 0 for picture in neutral.values()):
            codes = self._kept({**self._blank, **{name: picture[:1] for name, picture in neutral.items()}})
        else:
            blank = {name: np.broadcast_to(one, (rows, *one.shape[1:])) for name, one in self._blank.items()}
            return dict(zip(self._values, self._encode({**blank, **neutral}), strict=True))
        return dict(zip(self._values, (np.repeat(code, rows, axis=0) for code in codes), strict=True))

    def _kept(self, pictures: dict[str, np.ndarray]) -> list[np.ndarray]:
        last = self._last  # once: another thread may bring another person's
        if last is None or any(not np.array_equal(one, last[0][name]) for name, one in pictures.items()):
            copies = {name: one.copy() for name, one in pictures.items()}
            self._last = last = copies, self._encode(copies)
        return last[1]

    def _encode(self, pictures: Mapping[str, np.ndarray]) -> list[np.ndarray]:
        rows = len(next(iter(pictures.values())))
        feed = {
            "present": np.ones((rows, len(self._cameras)), np.float32),
            "calibrated": np.ones(rows, np.float32),
        }
        for kind in (PICTURES, NEUTRAL):
            feed |= {kind + name: np.ascontiguousarray(one) for name, one in pictures.items()}
        feed = {name: value for name, value in (feed | self._others).items() if name in self._taken}
        return self._half.run(self._values, feed)


def cut_network(
    content: bytes, whole: "Session", cameras: Sequence[CameraInput]
) -> "tuple[Session, NeutralCodes] | None":
    """The late half of a network, and the codes that it takes; None where halves do not say what the whole says.

    Parameters
    ----------
    content
        Bytes of network.onnx.
    whole
        A session of it.
    cameras
        The model's.
    """
    halves = cut(content, lambda name: name.startswith(NEUTRAL), lambda name: name.startswith(PICTURES))
    if halves is None:
        return None
    try:
        with session_errors("a half of network.onnx cannot be run"):
            late = open_session(halves.late)
            codes = NeutralCodes(open_session(halves.early), halves.values, cameras, {})
            return (late, codes) if _alike(whole, late, codes, cameras) else None
    except ModelError:  # the whole may run, and says why where it does not
        return None


def _alike(
    whole: "Session",
    late: "Session",
    codes: NeutralCodes,
    cameras: Sequence[CameraInput],
) -> bool:
    """Whether halves say what the whole says: of random frames, the last of them uncalibrated."""
    random = np.random.default_rng(0)

    def probe(kind: str, rows: int) -> dict[str, np.ndarray]:
        return {
            kind + one.name: random.integers(0, 256, (rows, one.height, one.width), np.uint8)
            for one in cameras
        }

    feed = probe(PICTURES, _PROBED) | {
        "present": np.ones((_PROBED, len(cameras)), np.float32),
        "calibrated": (np.arange(_PROBED) < _PROBED - 1).astype(np.float32),
    }
    neutral = {name: np.repeat(picture, _PROBED, axis=0) for name, picture in probe(NEUTRAL, 1).items()}
    same = {name.removeprefix(NEUTRAL): np.broadcast_to(one[:1], one.shape) for name, one in neutral.items()}
    expected = whole.run(None, feed | neutral)
    given = late.run(None, feed | codes.of(same, _PROBED))
    return all(
        one.shape == other.shape
        and np.abs(one - other).max(initial=0) <= _NEAR * max(1, np.abs(other).max(initial=0))
        for one, other in zip(given, expected, strict=True)
    )
