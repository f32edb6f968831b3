"""Sends datagrams and waits for nobody: a receiver that is away, slow or gone costs nothing."""

import socket
from dataclasses import replace

import numpy as np

from regress.runtime.sample import Sample
from track.errors import InputError
from track.sinks.sink import Datagrams, Sink, Tell, has_face
from track.sinks.targets import Target

_PARTINGS = 2
"""How often the last datagrams are sent: no others come behind them, should one get lost."""


class UdpSink(Sink):
    """A wire format on its way to one receiver.

    Parameters
    ----------
    target
        With host and port.
    datagrams
        The format.
    tell
        Takes the one sentence about a network that takes nothing.

    Raises
    ------
    InputError
        Where the host is not known.
    """

    def __init__(self, target: Target, datagrams: Datagrams, tell: Tell) -> None:
        self.title = target.title
        self._datagrams, self._tell, self._told = datagrams, tell, False
        family, self._address = resolved(target)
        self._socket = socket.socket(family, socket.SOCK_DGRAM)
        self._socket.setblocking(False)
        self._shown: Sample | None = None

    def send(self, sample: Sample) -> None:
        """Send a sample's datagrams; what the system does not take at once is lost."""
        if has_face(sample):
            self._shown = sample
        self._put(self._datagrams(sample))

    def close(self) -> None:
        """Leave a face at rest that nobody tracks, and let the socket go: avatars keep what they were told last."""
        if self._shown is not None:
            for sample in _parting(self._shown):
                self._put(self._datagrams(sample) * _PARTINGS)
        self._socket.close()

    def _put(self, datagrams: list[bytes]) -> None:
        for datagram in datagrams:
            try:
                self._socket.sendto(datagram, self._address)
            except (BlockingIOError, ConnectionError):
                continue  # its buffer is full, or nobody listens there and the other machine said so
            except OSError as error:
                if not self._told:
                    self._told = True
                    self._tell(
                        f"{self.title}: nothing can be sent ({error.strerror}); going on, and trying again"
                    )


def _parting(last: Sample) -> tuple[Sample, Sample]:
    """A face at rest where the last one was, and then none."""
    head = None if last.head is None else np.concatenate([last.head[:3], np.zeros(3)])
    rest = replace(last, weights=np.zeros_like(last.weights), gaze=np.zeros(4), head=head)
    return rest, replace(rest, weights=None, gaze=None, head=None)


def resolved(target: Target) -> tuple[socket.AddressFamily, tuple]:
    """Family and address of a target's receiver, asked for once.

    Raises
    ------
    InputError
        Where nobody knows the host.
    """
    try:
        found = socket.getaddrinfo(target.host, target.port, type=socket.SOCK_DGRAM)
    except (socket.gaierror, UnicodeError) as error:
        raise InputError(f"--to {target.name}: host {target.host!r} is not known ({error})") from error
    # some systems name ::1 first for localhost, where receivers that listen by IPv4 alone hear nothing
    best = min(found, key=lambda each: each[0] != socket.AF_INET)
    return best[0], best[4]


def is_of_this_machine(target: Target) -> bool:
    """Whether a target's address is this machine's, be it the loopback's or not: nobody listens at those of others."""
    family, (host, _, *rest) = resolved(target)
    with socket.socket(family, socket.SOCK_DGRAM) as trial:
        try:
            trial.bind((host, 0, *rest))
        except OSError:
            return False
    return True
