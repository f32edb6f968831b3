"""Sends datagrams and waits for nobody: a receiver that is away, slow or gone costs nothing."""

import socket

from regress.runtime.sample import Sample
from track.errors import InputError
from track.sinks.sink import Datagrams, Sink, Tell
from track.sinks.targets import Target


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

    def send(self, sample: Sample) -> None:
        """Send a sample's datagrams; what the system does not take at once is lost."""
        for datagram in self._datagrams(sample):
            try:
                self._socket.sendto(datagram, self._address)
            except (BlockingIOError, ConnectionError):
                continue  # its buffer is full, or nobody listens there and the other machine said so
            except OSError as error:
                if not self._told:
                    self._told = True
                    self._tell(f"{self.title}: nothing can be sent ({error.strerror}); going on without it")

    def close(self) -> None:
        """Let the socket go."""
        self._socket.close()


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
