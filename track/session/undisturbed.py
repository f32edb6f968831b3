"""Keeps away from a session what would pause it: threads of BLAS that wait, and full walks of the garbage collector."""

import gc
from collections.abc import Iterator
from contextlib import contextmanager

from threadpoolctl import threadpool_limits


@contextmanager
def undisturbed() -> Iterator[None]:
    """Answer frames inside: one thread of BLAS, and a collector that looks at nothing that was there before.

    One face's products are too small to share: BLAS' other threads only wait, and burn 29 ms of CPU a frame.
    A full collection walks over all that libraries made when they were imported, 13 to 17 ms; of what frames leave it
    takes less than one.
    """
    gc.freeze()
    try:
        with threadpool_limits(limits=1, user_api="blas"):
            yield
    finally:
        gc.unfreeze()
