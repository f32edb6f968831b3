"""Samples to send, and receivers on this machine that hold what was sent."""

import socket
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from regress.runtime.sample import Sample


def acted(seed: int = 0, *, time_s: float = 1.5) -> Sample:
    """A face with weights, a gaze and a head."""
    rng = np.random.default_rng(seed)
    return Sample(
        time_s=time_s,
        weights=rng.uniform(size=52),
        gaze=rng.uniform(-0.4, 0.4, size=4),
        head=np.concatenate([[0.1, -0.05, 0.6], rng.uniform(-0.6, 0.6, size=3)]),
    )


def lost(*, time_s: float = 2.5) -> Sample:
    """A frame in which there is no face."""
    return Sample(
        time_s=time_s, weights=np.full(52, np.nan), gaze=np.full(4, np.nan), head=np.full(6, np.nan)
    )


ANY_SAMPLE = st.builds(
    Sample,
    time_s=st.none() | st.just(float("nan")) | st.floats(-1e6, 1e6),
    weights=st.none() | arrays(np.float64, 52, elements=st.floats(-0.2, 1.6)) | st.just(np.full(52, np.nan)),
    gaze=st.none() | arrays(np.float64, 4, elements=st.floats(-1, 1)) | st.just(np.full(4, np.nan)),
    head=st.none() | arrays(np.float64, 6, elements=st.floats(-1, 1)) | st.just(np.full(6, np.nan)),
)
"""What stages may leave: something missing, weights beyond their range, times that go anywhere."""


@contextmanager
def receiver(host: str = "127.0.0.1") -> Iterator[socket.socket]:
    """A socket that takes datagrams, with patience for a busy machine."""
    family = socket.AF_INET6 if ":" in host else socket.AF_INET
    with socket.socket(family, socket.SOCK_DGRAM) as taken:
        taken.bind((host, 0))
        taken.settimeout(30)
        yield taken


def received(taken: socket.socket, count: int) -> list[bytes]:
    """That many datagrams, in their order."""
    return [taken.recv(65536) for _ in range(count)]
