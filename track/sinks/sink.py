"""The one interface of what takes answers."""

from collections.abc import Callable

import numpy as np

from regress.runtime.sample import Sample

Datagrams = Callable[[Sample], list[bytes]]
"""A wire format: what one sample is in it; a sample without weights has datagrams too, if the format can say so."""

Tell = Callable[[str], None]
"""Takes one sentence for the person: a receiver that cannot be reached, a recording that ends."""


class Sink:
    """Takes every answer as it comes; must never wait for a receiver.

    Attributes
    ----------
    title
        What a person calls it: ``"vmc to 127.0.0.1:39539"``.
    kept
        Whether a recording of it is there, known behind `close`.
    """

    title: str
    kept: bool = False

    def send(self, sample: Sample) -> None:
        """Hand a sample over; weights (52,) by ARKit's names, time, gaze, head, faults."""
        raise NotImplementedError

    def close(self) -> None:
        """Write what is unfinished; a recording appears whole, or not at all."""


def has_face(sample: Sample) -> bool:
    """Whether a sample has weights to show."""
    return sample.weights is not None and not np.isnan(sample.weights).any()
