"""Writes one face in every wire format, with what each part of it means: the tables of docs/track-sinks.md."""

import struct
from collections.abc import Iterator

import numpy as np
from pythonosc.osc_packet import OscPacket

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import Sample
from track.sinks.axes import head_pose
from track.sinks.ifacialmocap import IFacialMocap
from track.sinks.live_link import LiveLink
from track.sinks.room_state import TRACKED, face_state
from track.sinks.vmc import Vmc
from track.sinks.vrchat import VrChat

ACTED = {"jawOpen": 0.5, "mouthSmileLeft": 0.25, "eyeBlinkRight": 1.0}

Part = tuple[str, str]
"""Bytes in hexadecimal, or text, and what they mean."""


def face() -> Sample:
    """A face 0.6 m before the camera, turned by 30 degrees to its left, that looks a little left and up."""
    weights = np.zeros(52)
    for name, weight in ACTED.items():
        weights[BLENDSHAPE_INDEX[name]] = weight
    return Sample(
        time_s=1.5,
        weights=weights,
        gaze=np.array([0.1, 0.05, 0.1, 0.05]),
        head=np.array([0.1, -0.05, 0.6, np.pi / 6, 0.0, 0.0]),
    )


def live_link() -> list[Part]:
    """The datagram in pieces; the device's name is of zeros, as each machine has its own."""
    (datagram,) = LiveLink()(face())
    datagram = datagram[:5] + b"00000000-0000-0000-0000-000000000000" + datagram[41:]
    floats = [datagram[place : place + 4] for place in range(68, 312, 4)]
    parts = [
        (datagram[:1], "version 6"),
        (datagram[1:5], "36 letters follow, i32"),
        (datagram[5:41], "the device, in the form of a UUID"),
        (datagram[41:45], "6 letters follow"),
        (datagram[45:51], "the subject, `Webcam`"),
        (datagram[51:55], "frame 90: 1.5 s at 60 a second"),
        (datagram[55:59], "part of a frame, f32"),
        (datagram[59:67], "60 frames in 1 second"),
        (datagram[67:68], "61 numbers follow"),
        *_weights(floats[:52], "f32"),
        *[
            (number, f"{bone}: {angle} {value}")
            for number, (bone, angle, value) in zip(
                floats[52:],
                [
                    ("head", "yaw", "30° in radians, to its left is positive"),
                    ("head", "pitch", "0, upwards is positive"),
                    ("head", "roll", "0, to its right shoulder is positive"),
                    ("left eye", "yaw", "-0.1, to the right is positive"),
                    ("left eye", "pitch", "-0.05, downwards is positive"),
                    ("left eye", "roll", "0"),
                    ("right eye", "yaw", "-0.1"),
                    ("right eye", "pitch", "-0.05"),
                    ("right eye", "roll", "0"),
                ],
                strict=True,
            )
        ],
    ]
    assert b"".join(part for part, _ in parts) == datagram
    return [(_hexadecimal(part), meaning) for part, meaning in _together(parts)]


def room() -> list[Part]:
    """The state in pieces."""
    sample = face()
    state = face_state(
        flags=TRACKED,
        sequence=7,
        time_ms=1500,
        weights=sample.weights,
        rotation=head_pose(sample.head).rotation,
        gaze=sample.gaze,
    )
    parts = [
        (state[:1], "version 1"),
        (state[1:2], "flags: a camera sees this face"),
        (state[2:4], "the seventh message"),
        (state[4:8], "1,500 ms"),
        *_weights([state[place : place + 1] for place in range(8, 60)], "of 255"),
        (state[60:66], "head: where it rests, mm"),
        (state[66:74], "head: x, y, z, w of the turn by 30° about y, of 32,767"),
        (state[74:78], "gaze: yaw and pitch of the left eye, then of the right, half degrees"),
        (state[78:85], "body, heading, gesture: the page's"),
    ]
    assert b"".join(part for part, _ in parts) == state
    return [(_hexadecimal(part), meaning) for part, meaning in _together(parts)]


def ifacialmocap() -> list[Part]:
    """The text in pieces."""
    text = IFacialMocap()(face())[0].decode()
    weights, bones = text.split("=")
    meanings = {
        "trackingStatus": "a face is seen",
        "jawOpen": "half open",
        "mouthSmile_L": "the person's left",
        "eyeBlink_R": "shut",
    }
    parts = [(f"{part}|", meanings.get(part.split("-")[0], "0")) for part in weights.split("|")[:-1]]
    head, right, left = (f"{part}|" for part in bones.split("|")[:-1])
    parts += [
        (f"={head}", "degrees about x, y, z: to its left is positive about y; then metres, x to its left"),
        (right, "degrees: up is negative about x, left positive about y"),
        (left, "as the right eye"),
    ]
    assert "".join(part for part, _ in parts) == text
    return [(f"`{_short(part)}`".replace("|", "\\|"), meaning) for part, meaning in _together(parts)]


def osc(datagrams: list[bytes], meanings: dict[str, str]) -> list[Part]:
    """Messages of bundles: those whose meaning is told, and how many others there are between them."""
    parts: list[Part] = []
    others = 0
    for datagram in datagrams:
        for timed in OscPacket(datagram).messages:
            name = " ".join([timed.message.address, *(p for p in timed.message.params if isinstance(p, str))])
            if name not in meanings:
                others += 1
                continue
            if others:
                parts.append((f"… {others} more", ""))
            others = 0
            values = [_shown(value) for value in timed.message.params if not isinstance(value, str)]
            parts.append((f"`{' '.join([name, *values])}`", meanings[name]))
    return [*parts, *([(f"… {others} more", "")] if others else [])]


VMC = {
    "/VMC/Ext/OK": "loaded, calibrated, in normal mode, tracking; i",
    "/VMC/Ext/T": "seconds, f",
    "/VMC/Ext/Root/Pos root": "the avatar stays where it is",
    "/VMC/Ext/Bone/Pos Neck": "place on a grown person; a third of the turn, x, y, z, w in Unity's frame",
    "/VMC/Ext/Bone/Pos Head": "the rest of the turn",
    "/VMC/Ext/Bone/Pos LeftEye": "the left is at -x there",
    "/VMC/Ext/Bone/Pos RightEye": "",
    "/VMC/Ext/Blend/Val EyeBlinkRight": "Perfect Sync, shut",
    "/VMC/Ext/Blend/Val JawOpen": "Perfect Sync, half open",
    "/VMC/Ext/Blend/Val MouthSmileLeft": "Perfect Sync, the person's left",
    "/VMC/Ext/Blend/Val A": "VRM 0",
    "/VMC/Ext/Blend/Val Blink_R": "VRM 0",
    "/VMC/Ext/Blend/Apply": "the last message",
}

VRCHAT = {
    "/avatar/parameters/EyeTrackingActive": "T or F, as the face is seen or lost",
    "/avatar/parameters/v2/EyeClosedRight": "Unified Expressions, f",
    "/avatar/parameters/v2/JawOpen": "",
    "/avatar/parameters/v2/MouthCornerPullLeft": "",
    "/avatar/parameters/v2/SmileFrownLeft": "combined: from -1 to 1",
    "/avatar/parameters/v2/EyeLidLeft": "0.75 is open, 1 is wide",
    "/avatar/parameters/v2/EyeLidRight": "shut",
    "/avatar/parameters/v2/Head/Yaw": "to the right is positive, 90° is 1",
    "/avatar/parameters/v2/Head/PosX": "from where it was first, 0.5 m is 1",
    "/tracking/eye/EyesClosedAmount": "both eyes",
    "/avatar/parameters/v2/EyeLeftX": "to the right is positive, 45° is 1",
    "/avatar/parameters/v2/EyeLeftY": "up is positive",
    "/tracking/eye/LeftRightPitchYaw": "degrees; down and right are positive",
}


def tables() -> str:
    """All tables, as they stand in the page."""
    written = {
        "VMC": osc(Vmc()(face()), VMC),
        "Live Link Face": live_link(),
        "iFacialMocap": ifacialmocap(),
        "VRChat": osc(VrChat()(face()), VRCHAT),
        "A room": room(),
    }
    lines = []
    for name, parts in written.items():
        lines += [f"**{name}**", "", "| sent | means |", "|---|---|"]
        lines += [f"| {part} | {meaning} |" for part, meaning in parts]
        lines.append("")
    return "\n".join(lines)


def _weights(numbers: list[bytes], kind: str) -> Iterator[tuple[bytes, str]]:
    for index, number in enumerate(numbers):
        name = next((name for name in ACTED if BLENDSHAPE_INDEX[name] == index), None)
        yield number, "weights, 0" if name is None else f"{name} {ACTED[name]:g}, {kind}"


def _together(parts: list[tuple]) -> list[tuple]:
    """Neighbours of one meaning in one piece."""
    joined: list[tuple] = []
    for part, meaning in parts:
        if joined and joined[-1][1] == meaning and meaning in ("weights, 0", "0"):
            joined[-1] = (joined[-1][0] + part, meaning)
        else:
            joined.append((part, meaning))
    return joined


def _hexadecimal(part: bytes) -> str:
    if len(part) > 7 and not any(part):
        return f"`00` × {len(part)}"
    if part.isascii() and part.decode().isprintable() and len(part) > 4:
        return f'`"{part.decode()}"`'
    return f"`{part.hex()}`"


def _short(text: str) -> str:
    words = text.split("|")[:-1]
    return text if len(words) < 4 else f"{words[0]}|…|{words[-1]}|"


def _shown(value: object) -> str:
    if isinstance(value, bool):
        return "T" if value else "F"
    if isinstance(value, int):
        return str(value)
    return f"{struct.unpack('f', struct.pack('f', value))[0] + 0.0:.5g}"


if __name__ == "__main__":
    print(tables())
