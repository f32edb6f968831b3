"""Numbers of ``sample.json``: the float32 of the shards, and no digit more than that takes."""

import json

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.store.record import numbers


@given(
    arrays(
        np.float32, st.sampled_from([(), (1,), (4, 2)]), elements=st.floats(width=32, allow_infinity=False)
    )
)
def test_numbers_read_back_as_the_same_float32_and_are_short(values: np.ndarray):
    text = json.dumps(numbers(values), allow_nan=False)
    read = np.array(json.loads(text), np.float64)  # None becomes NaN
    np.testing.assert_array_equal(read.astype(np.float32), values)
    for given_number, written in zip(
        values.ravel(), np.ravel(np.array(json.loads(text), object)), strict=True
    ):
        if written is not None:
            assert written == float(str(given_number))
