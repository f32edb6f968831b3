"""Writes samples as the Virtual Motion Capture protocol: OSC with VRM's expressions and Unity's bones.

References
----------
.. [1] protocol.vmc.info/english and marionette-spec: messages; port 39539 takes what drives an avatar, 39540 what
   assists a program that does; a sender must offer VRM 0's names, and may offer VRM 1's.
.. [2] hinzka, "52 blendshapes for VRoid face" (Perfect Sync): ARKit's names with a capital, as clips of an avatar.
"""

from collections.abc import Iterator

import numpy as np

from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from track.sinks.axes import NO_TURN, eye_turns, head_pose, share_of, unity_position, unity_quaternion
from track.sinks.osc import bundles, message, number_message
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target
from track.sinks.udp import UdpSink

PORT = 39539

SETS = {
    "both": ("perfect_sync", "vrm0"),
    "perfect-sync": ("perfect_sync",),
    "vrm0": ("vrm0",),
    "vrm1": ("vrm1",),
}
"""Names of expressions by what a person asks for: an avatar that has Perfect Sync and VRM's moves twice by both."""

EMOTIONS = ("joy", "angry", "sorrow", "fun", "happy", "sad", "relaxed", "surprised")
"""Whole faces of an avatar, not parts of one: VRoid's shut the eyes, and a smile would do so beside its own shape. They
stay with the buttons of the receiver."""

OF_THE_NECK = 1 / 3
"""Of a head's turn: a head that turns on a neck at rest looks like an owl's."""

REST = {
    "Neck": np.array([0.0, 0.1, -0.02]),
    "Head": np.array([0.0, 0.09, 0.01]),
    "LeftEye": np.array([0.032, 0.07, 0.07]),
    "RightEye": np.array([-0.032, 0.07, 0.07]),
}
"""Where the bones are in those above them, on a grown person, in glTF's frame and metres: receivers that take positions
would draw bones together at 0."""


class Vmc:
    """A format of samples: bundles with expressions, head and eyes.

    Parameters
    ----------
    names
        Key of `SETS`.
    emotions
        ``on`` sends those of `EMOTIONS` that the names have.
    neck
        ``on`` turns the neck by its share, and the head by the rest; ``off`` turns the head alone.
    """

    def __init__(self, names: str = "both", emotions: str = "off", neck: str = "on") -> None:
        self._neck = OF_THE_NECK if neck == "on" else 0.0
        self._retargets = []
        for target_name in SETS[names]:
            target = read_retargeting(target_name)
            sent = {
                i: name for i, name in enumerate(target.names) if emotions == "on" or name not in EMOTIONS
            }
            values = [
                number_message("/VMC/Ext/Blend/Val", _spelled(name, target_name)) for name in sent.values()
            ]
            self._retargets.append((target, list(sent), values))

    def __call__(self, sample: Sample) -> list[bytes]:
        """Bundles of one sample; the last message applies the expressions. Without a face they say only so."""
        return list(bundles(self._messages(sample)))

    def _messages(self, sample: Sample) -> Iterator[bytes]:
        seen = has_face(sample)
        # loaded, calibrated, in normal mode, and whether tracking works (2.7); who knows 2.0 reads the first alone
        yield message("/VMC/Ext/OK", 1, 3, 0, int(seen))
        yield message("/VMC/Ext/T", float(np.nan_to_num(sample.time_s or 0.0)))
        if not seen:
            return
        yield _bone("/VMC/Ext/Root/Pos", "root", np.zeros(3), NO_TURN)
        head = head_pose(sample.head)
        if head is not None:
            if self._neck:
                turn = share_of(head.rotation, self._neck)
                yield _bone("/VMC/Ext/Bone/Pos", "Neck", REST["Neck"], turn)
            turn = share_of(head.rotation, 1 - self._neck)
            yield _bone("/VMC/Ext/Bone/Pos", "Head", REST["Head"], turn)
        eyes = eye_turns(sample.gaze)
        if eyes is not None:
            for name, turn in zip(("LeftEye", "RightEye"), eyes, strict=True):
                yield _bone("/VMC/Ext/Bone/Pos", name, REST[name], turn)
        for target, sent, values in self._retargets:
            weights = target.apply(sample.weights[None])[0, sent].tolist()
            yield from (value(weight) for value, weight in zip(values, weights, strict=True))
        yield message("/VMC/Ext/Blend/Apply")


def _bone(address: str, name: str, position: np.ndarray, rotation: np.ndarray) -> bytes:
    return message(address, name, *unity_position(position).tolist(), *unity_quaternion(rotation).tolist())


def _spelled(name: str, target: str) -> str:
    """A preset of VRM 0 as UniVRM's enumeration has it, which is what receivers compare with; others as they are."""
    if target != "vrm0":
        return name
    return f"Look{name[4:].title()}" if name.startswith("look") else name.title()


def open_sink(target: Target, tell: Tell) -> Sink:
    """VMC on its way to a receiver."""
    return UdpSink(target, Vmc(**target.options), tell)
