"""Opens graphs in onnxruntime on one core, with its telemetry switched off, and makes one sentence of its errors."""

import os
from collections.abc import Iterator
from contextlib import contextmanager
from functools import cache
from typing import TYPE_CHECKING

from regress.errors import ModelError

if TYPE_CHECKING:
    from onnxruntime import InferenceSession as Session

_OPT_OUT = "ORT_DISABLE_TELEMETRY"
"""From 1.29 on, onnxruntime's wheels collect events in a database under the user's cache, mark the session in a file of
the temporary folder, and upload both to Microsoft. This variable stops all of that where it is set before the import;
``disable_telemetry_events`` comes after the first event and the files."""


def open_session(graph: bytes) -> "Session":
    """Open the bytes of an .onnx file on one core of the CPU.

    This module alone imports onnxruntime: the import takes a fifth of a second, which commands without a graph need
    not wait for.
    """
    _opt_out()
    import onnxruntime

    onnxruntime.disable_telemetry_events()  # for a program that had imported onnxruntime by itself before
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 4  # what it would log on standard error beside its exceptions spans lines
    return onnxruntime.InferenceSession(graph, options, providers=["CPUExecutionProvider"])


def _opt_out() -> None:
    """To be called before any import of onnxruntime."""
    os.environ[_OPT_OUT] = "1"


@contextmanager
def session_errors(what: str) -> Iterator[None]:
    """Turn what onnxruntime raises into `ModelError`: what it is about, and the first line of the reason."""
    try:
        yield
    except _raised() as error:
        reason = next(iter(str(error).splitlines()), "") or type(error).__name__
        raise ModelError(f"{what}: {reason}") from error


@cache
def _raised() -> tuple[type[Exception], ...]:
    """What onnxruntime raises; its own classes share no base but Exception."""
    _opt_out()
    from onnxruntime.capi import onnxruntime_pybind11_state as state

    own = [kind for kind in vars(state).values() if isinstance(kind, type) and issubclass(kind, Exception)]
    return (*own, RuntimeError, ValueError, MemoryError)
