"""Arrow arrays by their buffers are those that pyarrow makes, and pandas stays where it is."""

import subprocess
import sys

import numpy as np
import pyarrow as pa
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.store.arrow_arrays import DTYPES, arrow_array

KINDS = list(DTYPES)


def numbers(kind: pa.DataType, shape: tuple[int, ...]) -> st.SearchStrategy[np.ndarray]:
    return arrays(DTYPES[kind], shape)


@given(st.data(), st.sampled_from(KINDS), st.integers(0, 20))
def test_numbers_are_as_pyarrow_has_them(data: st.DataObject, kind: pa.DataType, rows: int):
    values = data.draw(numbers(kind, (rows,)))
    assert str(arrow_array(values, kind)) == str(pa.array(values, kind))  # as words, in which NaN equals NaN
    arrow_array(values, kind).validate(full=True)


@given(st.data(), st.sampled_from(KINDS), st.integers(1, 20), st.integers(1, 5))
def test_lists_of_a_fixed_size(data: st.DataObject, kind: pa.DataType, rows: int, size: int):
    values = data.draw(numbers(kind, (rows, size)))
    made = arrow_array(values, pa.list_(kind, size))
    assert str(made) == str(pa.array(values.tolist(), pa.list_(kind, size)))
    made.validate(full=True)


@given(st.lists(st.text(max_size=9).filter(lambda word: not word.endswith("\0")), max_size=20))
def test_words_are_as_pyarrow_has_them(words: list[str]):
    made = arrow_array(np.array(words, dtype=str), pa.string())
    assert made.equals(pa.array(words, pa.string()))
    made.validate(full=True)


@pytest.mark.parametrize("rows", [0, 1, 9])
def test_empty_lists_are_as_pyarrow_has_them(rows: int):
    made = arrow_array(np.zeros((rows, 0)), pa.list_(pa.float32()))
    assert made.equals(pa.array([[]] * rows, pa.list_(pa.float32())))


def test_pandas_is_not_imported():
    program = """
import sys
import numpy as np, pyarrow as pa
from facegen.store.arrow_arrays import arrow_array
for kind in (pa.float32(), pa.bool_(), pa.string(), pa.list_(pa.float32(), 1), pa.list_(pa.float32())):
    arrow_array(np.zeros((3, 1)) if pa.types.is_nested(kind) else np.zeros(3), kind)
pa.table([arrow_array(np.zeros(3), pa.int64())], ["a"]).take(arrow_array(np.zeros(1), pa.int64()))
assert "pandas" not in sys.modules
"""
    subprocess.run([sys.executable, "-c", program], check=True)
