"""Makes Arrow arrays of NumPy arrays by their buffers.

`pyarrow.array` imports pandas where it is installed, which takes every worker half a second.
"""

import numpy as np
import pyarrow as pa

DTYPES = {
    pa.float32(): np.float32,
    pa.float64(): np.float64,
    pa.int32(): np.int32,
    pa.int64(): np.int64,
    pa.uint8(): np.uint8,
    pa.bool_(): np.bool_,
}
"""NumPy's types of numbers; `to_pandas_dtype` would import pandas as well."""


def arrow_array(values: np.ndarray, kind: pa.DataType) -> pa.Array:
    """An array of one of the kinds that datasets have.

    Parameters
    ----------
    values
        Of shape (rows,), or (rows, ...) for lists of a fixed size; for lists of any size their number counts alone, and
        all of them are empty.
    kind
        Of the column; numbers are converted to it.
    """
    if pa.types.is_string(kind):
        return _words(values)
    if pa.types.is_fixed_size_list(kind):
        return pa.FixedSizeListArray.from_arrays(_numbers(values, kind.value_type), type=kind)
    if pa.types.is_list(kind):
        offsets = _numbers(np.zeros(len(values) + 1), pa.int32())
        return pa.ListArray.from_arrays(offsets, _numbers(np.zeros(0), kind.value_type), type=kind)
    return _numbers(values, kind)


def _numbers(values: np.ndarray, kind: pa.DataType) -> pa.Array:
    flat = np.ascontiguousarray(values, dtype=DTYPES[kind]).ravel()
    content = np.packbits(flat, bitorder="little") if pa.types.is_boolean(kind) else flat
    return pa.Array.from_buffers(kind, flat.size, [None, pa.py_buffer(content)])


def _words(values: np.ndarray) -> pa.Array:
    words = [str(word).encode() for word in values]
    offsets = np.cumsum([0, *map(len, words)]).astype(np.int32)
    return pa.StringArray.from_buffers(len(words), pa.py_buffer(offsets), pa.py_buffer(b"".join(words)))
