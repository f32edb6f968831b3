"""Compiles loops over arrays to machine code, for the few that NumPy's whole-array steps make many times slower.

A module of compiled loops is imported inside the function that needs it: Numba takes half a second to import.
It imports nothing else of facegen. Numba compiles constants in, and sees that a kept result is old by the function's
own file alone: a constant of another module comes as an argument.
"""

from collections.abc import Callable

from numba import njit


def compiled(function: Callable) -> Callable:
    """The function, compiled at its first call; the result is kept for later processes.

    It is kept beside the source, or in the user's cache folder where that is read-only, or in ``NUMBA_CACHE_DIR``;
    where none of them can be written each process compiles anew, which takes seconds and nothing else.

    Arithmetic is IEEE's, in the order written: no fused or reordered operations, so results are equal to the last
    bit on every processor. Division by zero gives inf or NaN as in NumPy.
    """
    try:
        return njit(cache=True, error_model="numpy")(function)
    except RuntimeError:  # Numba's "no locator available": no folder for its cache can be written
        return njit(error_model="numpy")(function)
