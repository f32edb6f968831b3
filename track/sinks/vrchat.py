"""Writes samples as VRChat takes them by OSC: an avatar's face-tracking parameters, and its eyes.

Avatars choose which parameters they have and how: as floats, or as bits of a number (``JawOpen1``, ``JawOpen2``,
``JawOpen4``, and ``JawXNegative``) to save their budget. VRChat drops what an avatar has not, and nobody asks it here
which it has: VRCFaceTracking does, and takes our Live Link or iFacialMocap (docs/track-sinks.md).

References
----------
.. [1] docs.vrchat.com/docs/osc-avatar-parameters and osc-eye-tracking: port 9000; degrees, positive downwards and to
   the right; after ten seconds without eyes VRChat moves them itself.
.. [2] benaclejames/VRCFaceTracking, VRCFaceTracking.Core/Params: names, sums, ``BinaryBaseParameter``; its
   documentation: a gaze of 1 is 45 degrees.
"""

import re
import time
from collections.abc import Callable, Iterator
from importlib import resources

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from track.sinks.axes import HeadPose, head_pose, unity_position
from track.sinks.osc import bundles, message
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target
from track.sinks.udp import UdpSink

PORT = 9000
FULL_GAZE_RAD = np.pi / 4
FULL_TURN_RAD, FULL_WAY_M = np.pi / 2, 0.5
"""What 1 is of a head's turn and of its way from where it was first (VRCFaceTracking, ``UnifiedData.cs``)."""
_PARAMETERS = "/avatar/parameters/"

FLAGS = ("EyeTrackingActive", "ExpressionTrackingActive", "LipTrackingActive")

PUPIL_ENDS = (0.2, 0.65)
"""Pupil over iris, of an adult's pupil of 2.3 and of 7.6 mm."""

_CENTIMETRES = 1.17
"""Of an iris, nearly the same in all people (F. Rüfer et al., Cornea 24(3), 2005). VRCFaceTracking sends a pupil's
millimetres times 0.1 (``UnifiedExpressionsParameters.cs``)."""

_ALL_AFTER_S = 1.0
"""After which everything is sent again, changed or not: datagrams are lost, and avatars are changed."""

_COMBINED = resources.files("track.sinks") / "vrchat_parameters.toml"


class VrChat:
    """A format of samples: bundles with the parameters that changed, and the eyes.

    Parameters
    ----------
    prefix
        What stands before a parameter's name; many avatars have ``FT/v2``.
    bits
        Of each parameter, beside its float: avatars have some as bits and others as floats, and VRChat drops what it
        does not know. 0 sends floats alone.
    eyes
        Which are sent: ``parameters``, VRChat's own (``native``, and no parameter of eyes), or ``both``.
        VRCFaceTracking sends VRChat's own only to avatars without parameters of eyes; of a wink they shut both by half.
    clock
        Seconds.
    """

    def __init__(
        self,
        prefix: str = "v2",
        bits: int = 0,
        eyes: str = "both",
        *,
        clock: Callable[[], float] = time.perf_counter,
    ) -> None:
        # people paste whole addresses, and some avatars have no prefix
        prefix = prefix.strip("/").removeprefix(_PARAMETERS.strip("/")).strip("/")
        self._address, self._bits = f"{_PARAMETERS}{prefix}/" if prefix else _PARAMETERS, bits
        # VRCFaceTracking's flags have no version, but whatever stands before it: FT/EyeTrackingActive
        beside = re.fullmatch(r"(.+/)v\d+", prefix)
        self._flags = [
            f"{before}{name}" for before in ("", *(beside.groups() if beside else ())) for name in FLAGS
        ]
        targets = [read_retargeting("unified_expressions"), read_retargeting(str(_COMBINED))]
        self._parameters, self._native = eyes != "native", eyes != "parameters"
        driven = [
            target.factors.any(axis=0)
            & [self._parameters or not name.startswith("Eye") for name in target.names]
            for target in targets
        ]
        self._names = [
            name
            for target, some in zip(targets, driven, strict=True)
            for name, one in zip(target.names, some, strict=True)
            if one
        ]
        self._factors, self._low, self._high = (
            np.concatenate(
                [getattr(target, part)[..., some] for target, some in zip(targets, driven, strict=True)],
                axis=-1,
            )
            for part in ("factors", "low", "high")
        )
        self._sent: dict[str, float] = {}
        self._origin: np.ndarray | None = None
        self._clock, self._all_s = clock, -np.inf

    def __call__(self, sample: Sample) -> list[bytes]:
        """Bundles of one sample; without a face they say so, and nothing moves."""
        now_s = self._clock()
        if now_s - self._all_s >= _ALL_AFTER_S:
            self._sent.clear()
            self._all_s = now_s
        return list(bundles(self._messages(sample)))

    def _messages(self, sample: Sample) -> Iterator[bytes]:
        seen = has_face(sample)
        for name in self._flags:
            if self._changed(name, seen):
                yield message(_PARAMETERS + name, seen)
        if not seen:
            return
        shapes = np.clip(sample.weights @ self._factors, self._low, self._high)
        for name, value in zip(self._names, shapes.tolist(), strict=True):
            yield from self._parameter(name, value)
        closed, wide, squint, smile, frown, stretch = np.clip(sample.weights[_PAIRS], 0, 1)
        yield from self._sides("SmileSad", smile - np.maximum(frown, stretch), mean=True)
        yield from self._sides("MouthSad", np.maximum(frown, stretch))
        head = head_pose(sample.head)
        if head is not None:
            yield from self._head(head)
        gaze = None if sample.gaze is None or np.isnan(sample.gaze).any() else sample.gaze
        if self._parameters:
            yield from self._lids(closed, wide, squint)
            yield from () if gaze is None else self._looks(gaze)
        if self._native:
            yield message("/tracking/eye/EyesClosedAmount", float(closed.mean()))
            if gaze is not None:  # down and to the right are positive
                yield message("/tracking/eye/LeftRightPitchYaw", *(-np.degrees(gaze[[1, 0, 3, 2]])).tolist())
        if sample.eyes is not None:
            yield from self._pupils(sample.eyes.pupil)

    def _head(self, head: HeadPose) -> Iterator[bytes]:
        """Parameters of the head, in Unity's frame: to the right, down and tilted to the left are positive."""
        if self._origin is None:
            self._origin = head.position
        yaw, pitch, roll = head.angles_rad
        turns = np.array([-yaw, -pitch, roll]) / FULL_TURN_RAD
        way = unity_position(head.position - self._origin) / FULL_WAY_M
        names = ("Yaw", "Pitch", "Roll", "PosX", "PosY", "PosZ")
        for name, value in zip(names, np.clip([*turns, *way], -1, 1).tolist(), strict=True):
            yield from self._parameter(f"Head/{name}", value + 0.0)

    def _lids(self, closed: np.ndarray, wide: np.ndarray, squint: np.ndarray) -> Iterator[bytes]:
        yield from self._sides("EyeOpen", 1 - closed, mean=True)
        yield from self._sides("EyeClosed", closed, mean=True)
        yield from self._sides("EyeLid", 0.75 * (1 - closed) + 0.25 * wide, mean=True)
        for name, larger in (("EyeWide", wide), ("EyeSquint", squint), ("EyesSquint", squint)):
            yield from self._parameter(name, float(larger.max()))

    def _looks(self, gaze: np.ndarray) -> Iterator[bytes]:
        """Parameters of where eyes look: right and up are positive."""
        across, up = np.clip(gaze.reshape(2, 2).T * [[-1], [1]] / FULL_GAZE_RAD, -1, 1)
        for side, x, y in zip(("Left", "Right", ""), [*across, across.mean()], [*up, up.mean()], strict=True):
            yield from self._parameter(f"Eye{side}X", float(x))
            yield from self._parameter(f"Eye{side}Y", float(y))

    def _sides(self, name: str, pair: np.ndarray, *, mean: bool = False) -> Iterator[bytes]:
        """Parameters of both sides, and of their mean where VRCFaceTracking has one."""
        for side, value in zip(("Left", "Right"), pair.tolist(), strict=True):
            yield from self._parameter(f"{name}{side}", value)
        if mean:
            yield from self._parameter(name, float(pair.mean()))

    def _pupils(self, shares: np.ndarray) -> Iterator[bytes]:
        """Pupils' diameters in centimetres, and how far they are dilated between their ends."""
        narrow, wide = PUPIL_ENDS
        dilated = np.clip((shares - narrow) / (wide - narrow), 0, 1)
        diameters = np.clip(shares * _CENTIMETRES, 0, 1)
        for side, diameter in zip(("Left", "Right"), diameters.tolist(), strict=True):
            if np.isfinite(diameter):
                # hundredths: a parameter that trembles would be sent in every frame
                yield from self._parameter(f"PupilDiameter{side}", round(diameter, 2))
        if np.isfinite(dilated).any():
            yield from self._parameter("PupilDiameter", round(float(np.nanmean(diameters)), 2))
            yield from self._parameter("PupilDilation", round(float(np.nanmean(dilated)), 2))

    def _parameter(self, name: str, value: float) -> Iterator[bytes]:
        """A parameter's messages, where it is not what was sent last."""
        if self._changed(name, value):
            yield message(self._address + name, value)
        if self._bits == 0:
            return
        steps = min(int(abs(value) * 2**self._bits), 2**self._bits - 1)
        for bit in range(self._bits):
            on = bool(steps >> bit & 1)
            if self._changed(f"{name}{2**bit}", on):
                yield message(f"{self._address}{name}{2**bit}", on)
        if self._changed(f"{name}Negative", value < 0):
            yield message(f"{self._address}{name}Negative", value < 0)

    def _changed(self, name: str, value: float) -> bool:
        changed = self._sent.get(name) != value
        self._sent[name] = value
        return changed


_PAIRS = np.array(
    [
        [BLENDSHAPE_INDEX[f"{shape}{side}"] for side in ("Left", "Right")]
        for shape in ("eyeBlink", "eyeWide", "eyeSquint", "mouthSmile", "mouthFrown", "mouthStretch")
    ]
)
"""Of which parameters are made otherwise than by sums: lids, and the larger one of two."""


def open_sink(target: Target, tell: Tell) -> Sink:
    """VRChat's parameters on their way."""
    options = dict(target.options)
    return UdpSink(target, VrChat(bits=int(options.pop("bits", "0")), **options), tell)
