"""Opens graphs in onnxruntime on one core, with its telemetry switched off."""

import os
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import onnxruntime

_OPT_OUT = "ORT_DISABLE_TELEMETRY"
"""From 1.29 on, onnxruntime's wheels collect events in a database under the user's cache, mark the session in a file of
the temporary folder, and upload both to Microsoft. This variable stops all of that where it is set before the import;
``disable_telemetry_events`` comes after the first event and the files."""


def open_session(graph: bytes) -> "onnxruntime.InferenceSession":
    """Open the bytes of an .onnx file on one core of the CPU.

    This is the only place that imports onnxruntime: the import takes a fifth of a second, which commands without a
    graph need not wait for.
    """
    os.environ[_OPT_OUT] = "1"
    import onnxruntime

    onnxruntime.disable_telemetry_events()  # for a program that had imported onnxruntime by itself before
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = options.inter_op_num_threads = 1
    options.log_severity_level = 3
    return onnxruntime.InferenceSession(graph, options, providers=["CPUExecutionProvider"])
