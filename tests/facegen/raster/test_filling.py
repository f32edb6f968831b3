"""The compiled z-buffer gives the bytes of the one in NumPy, which stays where Numba is not installed."""

import subprocess
import sys

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.raster import Nearest, nearest_triangles, z_buffer

SHAPE = (9, 12)
VERTICES = 8
NUMBERS = st.one_of(
    st.integers(-4, 16).map(float),  # corners on pixels' centres, and triangles seen edge on
    st.floats(-20, 30, width=32),
    st.just(np.nan),
)
# no negative zero: which of two equal zeros stays is the processor's business
VALUES = st.one_of(st.integers(0, 3).map(float), st.floats(0.125, 9, width=32))
TYPES = st.sampled_from([np.float32, np.float64])


def in_numpy(*mesh: np.ndarray, batch_pixels: int) -> Nearest:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(z_buffer, "_filler", lambda: z_buffer.fill_in_numpy)
        patch.setattr(z_buffer, "BATCH_PIXELS", batch_pixels)
        return nearest_triangles(*mesh, shape=SHAPE)


@settings(deadline=None, max_examples=100)  # the first call compiles
@given(
    arrays(np.float64, (VERTICES, 2), elements=NUMBERS),
    arrays(np.float64, VERTICES, elements=VALUES),
    arrays(np.int64, (20, 3), elements=st.integers(0, VERTICES - 1)),
    TYPES,
    TYPES,
    st.sampled_from([40, 4_000_000]),
)
def test_both_fillings_give_equal_bytes(vertices, value, triangles, of_vertices, of_value, batch_pixels):
    mesh = vertices.astype(of_vertices), value.astype(of_value), triangles
    compiled, whole = nearest_triangles(*mesh, shape=SHAPE), in_numpy(*mesh, batch_pixels=batch_pixels)
    assert compiled.triangle.tobytes() == whole.triangle.tobytes()
    assert compiled.value.tobytes() == whole.value.tobytes()


def test_of_equal_values_the_last_triangle_counts_whichever_filled():
    square = np.array([[0.0, 0.0], [11.0, 0.0], [11.0, 8.0], [0.0, 8.0]])
    triangles = np.array([[0, 1, 2], [0, 2, 3], [2, 1, 0]])
    for drawn in (
        nearest_triangles(square, np.ones(4), triangles, shape=SHAPE),
        in_numpy(square, np.ones(4), triangles, batch_pixels=4_000_000),
    ):
        assert (drawn.value == 1.0).all()
        assert (drawn.triangle[0, 1:] == 2).all()
        assert (drawn.triangle[1:, 0] == 1).all()


def test_without_numba_pictures_are_filled_by_numpy():
    program = (
        "import sys; sys.modules['numba'] = None; "
        "from facegen.raster import z_buffer; assert z_buffer._filler() is z_buffer.fill_in_numpy"
    )
    subprocess.run([sys.executable, "-c", program], check=True)
