"""Writes samples as the iFacialMocap app sends them, and answers who greets it.

::

    trackingStatus-1|jawOpen-12|...|=head#rx,ry,rz,px,py,pz|rightEye#rx,ry,rz|leftEye#rx,ry,rz|

Weights are whole numbers from 0 to 100. Angles are degrees in ARKit's frame, which is glTF's: x to the subject's left,
y up, z out of the face; places are metres from the camera. Version 2 has ``&`` for ``-`` between a name and its number.
A receiver may ask for one of them by a greeting to our port 49983; the answer goes to its own port 49983, wherever the
greeting came from. A lost face has ``trackingStatus-0`` and the numbers of the last one: who does not read the status,
as VMagicMirror, sees it by datagrams that are equal to the last byte.

No phone was at hand: signs are read in programs of others, and in packets that they caught [3]_ [4]_ [5]_.

References
---------
.. [1] www.ifacialmocap.com/for-developer: greeting, ports, grammar.
.. [2] VRCFaceTracking/VRC_iFacialMocap: takes what comes without a greeting; exchanges left and right of the weights,
   but takes angles of head and eyes as they are, y positive to the right: it shows the app's person as a mirror does
   (``sides=mirrored`` undoes that). It skips what stands first (``Split('|')[1..^1]``), which is the status in the
   app's packets [5]_, and reads ``browInnerUp_L`` and ``browInnerUp_R``.
.. [3] emoto-yasushi/NVIDIA_ARSDK_iFacialMocap, ``ExpressionApp.cpp``, by the app's author: an eye's +x is LookDown, its
   +y LookOutLeft and LookInRight; with names exchanged, a place's +x is the picture's left.
.. [4] Menithal/UnityIFM, ``IFMPacket.cs``: y and z of all angles change their sign on the way to Unity.
.. [5] prodzpod/SnekStudio-iFacialMocap, ``iFacialMocap.gd``: a packet with eyeLookIn_R 54, eyeLookOut_L 44, y of the
   eyes +19 and +16, and of the head -7: eyes that stay on something while the head turns away from it. Packets that
   others caught begin with ``trackingStatus-1|`` and end with ``hapihapi-0|``.
"""

import numpy as np

from facegen.conventions import BLENDSHAPES, MIRRORED_BLENDSHAPES
from regress.runtime.sample import Sample
from track.sinks.axes import head_pose, unity_euler_deg
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target
from track.sinks.udp import UdpSink, is_of_this_machine, resolved

PORT = 49983
GREETING = b"iFacialMocap_sahuasouryya9218sauhuiayeta91555dy3719"
SIDES = ("own", "mirrored")
_VERSION_2 = b"sendDataVersion=v2"
_GREETINGS_A_FRAME = 8
"""Read before each frame: a flood of them must not hold a frame up."""

_STATUS = "trackingStatus"
"""Stands before the weights: 1 where a face is seen."""

_BROW = "browInnerUp"
"""Sent for each side as well, by names that ARKit does not have."""

_TURNS = {"own": np.array([1, -1, -1]), "mirrored": np.array([1, 1, 1])}
"""On Unity's angles. Unity's frame mirrors x of ARKit's, so that a mirrored person's angles there are Unity's."""

_PLACES = {"own": np.array([1, 1, 1]), "mirrored": np.array([-1, 1, 1])}
"""On places in glTF's frame."""

_WHOLE = ("jawLeft", "jawRight", "mouthLeft", "mouthRight")


def app_name(shape: str) -> str:
    """How the app spells an ARKit name: ``eyeBlink_L``; jaw and mouth moved sideways keep theirs."""
    for side in ("Left", "Right"):
        if shape.endswith(side) and shape not in _WHOLE:
            return f"{shape.removesuffix(side)}_{side[0]}"
    return shape


class IFacialMocap:
    """A format of samples: one datagram each.

    Parameters
    ----------
    version
        1 or 2; a greeting changes it.
    sides
        Of `SIDES`: whether the person is sent, or its picture in a mirror: left is right then in names, turns and
        places. ``leftEye`` stays the person's own, as VRCFaceTracking's module has it.
    """

    def __init__(self, version: int = 1, sides: str = "own") -> None:
        self._separator = "&" if version == 2 else "-"
        names = tuple(map(app_name, BLENDSHAPES))
        self._names = names if sides == "own" else tuple(names[other] for other in MIRRORED_BLENDSHAPES)
        self._turns, self._places = _TURNS[sides], _PLACES[sides]
        self._last = ""

    def greeted(self, datagram: bytes) -> bool:
        """Take a greeting, and with it the version that is asked for; whether it is one."""
        if not datagram.startswith(GREETING):
            return False
        self._separator = "&" if _VERSION_2 in datagram else "-"
        return True

    def __call__(self, sample: Sample) -> list[bytes]:
        """The sample's datagram; the last face again where it is lost."""
        seen = has_face(sample)
        if seen:
            self._last = self._text(sample)
        if not self._last:
            return []
        return [f"{_STATUS}{self._separator}{int(seen)}|{self._last}".encode("ascii")]

    def _text(self, sample: Sample) -> str:
        """All of it but the status."""
        percent = np.clip(np.rint(sample.weights * 100), 0, 100).astype(int).tolist()
        named = list(zip(self._names, percent, strict=True))
        named += [(f"{_BROW}_{side}", percent[BLENDSHAPES.index(_BROW)]) for side in "LR"]
        weights = (f"{name}{self._separator}{value}|" for name, value in named)
        head, gaze = head_pose(sample.head), sample.gaze
        where = np.zeros(6)
        if head is not None:
            turn = unity_euler_deg(head.angles_rad) * self._turns
            where = np.concatenate([turn, head.position * self._places])
        eyes = np.zeros((2, 3)) if gaze is None or np.isnan(gaze).any() else gaze.reshape(2, 2) @ np.eye(2, 3)
        left, right = (unity_euler_deg(eye) * self._turns for eye in eyes)
        return "".join(weights) + f"=head#{_list(where)}|rightEye#{_list(right)}|leftEye#{_list(left)}|"


def _list(numbers: np.ndarray) -> str:
    return ",".join(f"{number + 0.0:.4f}" for number in numbers.tolist())


class GreetedSink(UdpSink):
    """iFacialMocap on its way to a receiver that may greet.

    Parameters
    ----------
    target, tell
        As of every sink.
    version, sides
        Of `IFacialMocap`.
    listen
        Where greetings arrive; None for nowhere.
    """

    def __init__(
        self,
        target: Target,
        tell: Tell,
        *,
        version: str = "1",
        sides: str = "own",
        listen: tuple[str, int] | None = None,
    ) -> None:
        self._format = IFacialMocap(version=int(version), sides=sides)
        super().__init__(target, self._format, tell)
        if listen is not None:
            try:
                self._socket.bind(listen)
            except OSError as error:
                tell(
                    f"{self.title}: port {listen[1]} is taken ({error.strerror}); going on without greetings"
                )

    def send(self, sample: Sample) -> None:
        """Read the greetings that came from the receiver itself, and send."""
        for _ in range(_GREETINGS_A_FRAME):
            try:
                datagram, sender = self._socket.recvfrom(len(GREETING) + 64)
            except OSError:  # none is there, it is too long, or the other machine says that nobody listens
                break
            if sender[0] == self._address[0]:
                self._format.greeted(datagram)
        super().send(sample)


def open_sink(target: Target, tell: Tell) -> Sink:
    """iFacialMocap on its way to a receiver.

    One on this machine has the port of greetings for itself, and takes what comes without any.
    """
    if is_of_this_machine(target):
        return GreetedSink(target, tell, **target.options)
    everywhere = "::" if ":" in resolved(target)[1][0] else "0.0.0.0"
    return GreetedSink(target, tell, **target.options, listen=(everywhere, PORT))
