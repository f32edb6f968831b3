"""Writes samples as the Live Link Face app sends them to Unreal, version 6.

::

    u8 6 | i32 n, device in n bytes | i32 n, subject | i32 frame, f32 part, i32 rate, i32 1 | u8 61 | 61 x f32

All big-endian. The floats are Unreal's enumeration of ARKit's shapes, which is the order of `BLENDSHAPES`, and nine
angles; the app's recordings have jawRight and mouthRight before their left partners instead. A frame without a face
ends behind the rate.

References
----------
.. [1] JimWest, PyLiveLinkFace (github.com/JimWest/PyLiveLinkFace): the layout; ids of 36 characters alone.
.. [2] Epic Games, Unreal Engine, ``EARFaceBlendShape`` (ARTrackable.h): the order, JawLeft before JawRight.
.. [3] VRCFaceTracking/LiveLinkTrackingModule, ``ArKitPacketReader.cs``: takes datagrams of 312 bytes alone, which are
   those whose subject has six letters; eyes in radians, yaw to the right.
.. [4] Epic Games, "Recording Face Animation on iOS Device": port 11111.
"""

import hashlib
import math
import platform
import struct

import numpy as np

from facegen.formats.live_link import TIMECODE_RATE
from regress.runtime.sample import Sample
from regress.runtime.writers.live_link import app_angles
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target
from track.sinks.udp import UdpSink

PORT = 11111

ANGLES = {"radians": 1.0, "half-turns": 1 / np.pi}
"""Factors on the nine angles. The app's recordings have radians: an eye's yaw is .60 where lookOut is 1 (4,030 frames).
Epic's own source for ARKit divides degrees by 180 instead; which of them Unreal's receiver expects was not tried."""

SUBJECT = "Webcam"
"""Six letters, so that VRCFaceTracking takes it."""

_VERSION = 6


class LiveLink:
    """A format of samples: one datagram each.

    Parameters
    ----------
    subject
        What Unreal lists.
    angles
        Key of `ANGLES`.
    """

    def __init__(self, subject: str = SUBJECT, angles: str = "radians") -> None:
        device = hashlib.sha256(f"{platform.node()} {subject}".encode()).hexdigest()
        # as a UUID is written: receivers take ids of 36 characters alone
        device = "-".join([device[:8], device[8:12], device[12:16], device[16:20], device[20:32]])
        self._names = struct.pack("!B", _VERSION) + _text(device) + _text(subject)
        self._factor = ANGLES[angles]
        self._frames = 0

    def __call__(self, sample: Sample) -> list[bytes]:
        """The sample's datagram."""
        self._frames += 1
        known = sample.time_s is not None and math.isfinite(sample.time_s)
        part, frame = math.modf(max(sample.time_s, 0.0) * TIMECODE_RATE) if known else (0.0, self._frames)
        header = self._names + struct.pack("!ifii", int(frame) % 2**31, part, TIMECODE_RATE, 1)
        if not has_face(sample):
            return [header]
        angles = app_angles(1, _row(sample.head), _row(sample.gaze))[0] * self._factor
        values = np.concatenate([sample.weights, angles])
        return [header + struct.pack(f"!B{len(values)}f", len(values), *values.tolist())]


def _row(values: np.ndarray | None) -> np.ndarray | None:
    return None if values is None else values[None]


def _text(text: str) -> bytes:
    encoded = text.encode()
    return struct.pack("!i", len(encoded)) + encoded


def open_sink(target: Target, tell: Tell) -> Sink:
    """Live Link Face on its way to Unreal."""
    subject = target.options.get("subject", SUBJECT)
    if len(subject.encode()) != len(SUBJECT):
        tell(
            f"{target.title}: subject {subject!r} has not six bytes, and VRCFaceTracking takes no other; Unreal does"
        )
    return UdpSink(target, LiveLink(**target.options), tell)
