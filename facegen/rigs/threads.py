"""Holds BLAS to one thread: matrix products split over other numbers of threads end in other last bits."""

from contextlib import AbstractContextManager
from functools import cache

from threadpoolctl import ThreadpoolController


@cache
def _controller() -> ThreadpoolController:
    return ThreadpoolController()  # looks through the process's libraries, which takes milliseconds


def one_blas_thread() -> AbstractContextManager:
    """Context in which NumPy's and SciPy's matrix products use one thread."""
    return _controller().limit(limits=1, user_api="blas")
