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

from collections.abc import Iterator
from importlib import resources

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from track.sinks.osc import bundles, message
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target
from track.sinks.udp import UdpSink

PORT = 9000
FULL_GAZE_RAD = np.pi / 4
_PARAMETERS = "/avatar/parameters/"

PUPIL_ENDS = (0.2, 0.65)
"""Pupil over iris, of an adult's pupil of 2.3 and of 7.6 mm."""

_ALL_AFTER = 30
"""Samples after which everything is sent again, changed or not: datagrams are lost, and avatars are changed."""

_COMBINED = resources.files("track.sinks") / "vrchat_parameters.toml"


class VrChat:
    """A format of samples: bundles with the parameters that changed, and the eyes.

    Parameters
    ----------
    prefix
        What stands before a parameter's name; many avatars have ``FT/v2``.
    bits
        Of each parameter; 0 sends floats.
    """

    def __init__(self, prefix: str = "v2", bits: int = 0) -> None:
        # people paste whole addresses, and some avatars have no prefix
        prefix = prefix.strip("/").removeprefix(_PARAMETERS.strip("/")).strip("/")
        self._address, self._bits = f"{_PARAMETERS}{prefix}/" if prefix else _PARAMETERS, bits
        targets = [read_retargeting("unified_expressions"), read_retargeting(str(_COMBINED))]
        driven = [target.factors.any(axis=0) for target in targets]
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
        self._until_all = 0

    def __call__(self, sample: Sample) -> list[bytes]:
        """Bundles of one sample; without a face they say so, and nothing moves."""
        if self._until_all == 0:
            self._sent.clear()
            self._until_all = _ALL_AFTER
        self._until_all -= 1
        return list(bundles(self._messages(sample)))

    def _messages(self, sample: Sample) -> Iterator[bytes]:
        seen = has_face(sample)
        for name in ("EyeTrackingActive", "ExpressionTrackingActive", "LipTrackingActive"):
            if self._changed(name, seen):
                yield message(_PARAMETERS + name, seen)
        if not seen:
            return
        shapes = np.clip(sample.weights @ self._factors, self._low, self._high)
        for name, value in zip(self._names, shapes.tolist(), strict=True):
            yield from self._parameter(name, value)
        closed = np.clip(sample.weights[_BLINKS], 0, 1)
        wide = np.clip(sample.weights[_WIDES], 0, 1)
        for side, shut, open_wide in zip(("Left", "Right"), closed.tolist(), wide.tolist(), strict=True):
            yield from self._parameter(f"EyeOpen{side}", 1 - shut)
            yield from self._parameter(f"EyeLid{side}", 0.75 * (1 - shut) + 0.25 * open_wide)
        yield message("/tracking/eye/EyesClosedAmount", float(closed.mean()))
        if sample.eyes is not None:
            yield from self._pupils(sample.eyes.pupil)
        if sample.gaze is None or np.isnan(sample.gaze).any():
            return
        # right and up are positive in parameters, right and down in VRChat's own eyes
        across, up = np.clip(sample.gaze.reshape(2, 2).T * [[-1], [1]] / FULL_GAZE_RAD, -1, 1)
        for side, x, y in zip(("Left", "Right", ""), [*across, across.mean()], [*up, up.mean()], strict=True):
            yield from self._parameter(f"Eye{side}X", float(x))
            yield from self._parameter(f"Eye{side}Y", float(y))
        degrees = -np.degrees(sample.gaze[[1, 0, 3, 2]])
        yield message("/tracking/eye/LeftRightPitchYaw", *degrees.tolist())

    def _pupils(self, shares: np.ndarray) -> Iterator[bytes]:
        """Pupils' diameters as shares of the widest, and how far they are dilated between their ends."""
        narrow, wide = PUPIL_ENDS
        dilated = np.clip((shares - narrow) / (wide - narrow), 0, 1)
        for side, share in zip(("Left", "Right"), shares.tolist(), strict=True):
            if np.isfinite(share):
                yield from self._parameter(f"PupilDiameter{side}", round(min(share / wide, 1.0), 2))
        if np.isfinite(dilated).any():
            # hundredths: a parameter that trembles would be sent in every frame
            yield from self._parameter("PupilDilation", round(float(np.nanmean(dilated)), 2))

    def _parameter(self, name: str, value: float) -> Iterator[bytes]:
        """A parameter's messages, where it is not what was sent last."""
        if self._bits == 0:
            if self._changed(name, value):
                yield message(self._address + name, value)
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


_BLINKS, _WIDES = (
    [BLENDSHAPE_INDEX[f"{shape}{side}"] for side in ("Left", "Right")] for shape in ("eyeBlink", "eyeWide")
)


def open_sink(target: Target, tell: Tell) -> Sink:
    """VRChat's parameters on their way."""
    bits = int(target.options.get("bits", "0"))
    return UdpSink(target, VrChat(prefix=target.options.get("prefix", "v2"), bits=bits), tell)
