"""Arrays of strangers are read only where the file bears out what its header claims."""

import contextlib
import io
import pickle
import resource
import tracemalloc
import warnings
import zipfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as npst

from facegen.archives import MOST_BYTES, check_shapes, load_npy, load_npz, parse_npz
from facegen.errors import FormatError, InputError

PLAIN = st.sampled_from([np.float32, np.float64, np.int32, np.uint8, np.bool_, "<U5"])


def npy(array: np.ndarray) -> bytes:
    content = io.BytesIO()
    np.save(content, array)
    return content.getvalue()


def npz(arrays: dict[str, np.ndarray]) -> bytes:
    content = io.BytesIO()
    np.savez_compressed(content, **arrays)
    return content.getvalue()


@given(npst.arrays(PLAIN, npst.array_shapes(min_dims=0, min_side=0)), st.booleans())
def test_arrays_read_as_they_were_written(tmp_path_factory, array, fortran):
    array = np.asarray(array, order="F" if fortran else "C")
    path = tmp_path_factory.mktemp("arrays") / "a.npy"
    path.write_bytes(npy(array))
    for read in (load_npy(path), load_npy(path, mmap=True), parse_npz(npz({"a": array}), where="a")["a"]):
        assert read.dtype == array.dtype
        np.testing.assert_array_equal(read, array)


@given(st.data())
def test_a_changed_byte_or_a_cut_gives_the_array_or_a_sentence(tmp_path_factory, data):
    whole = data.draw(st.sampled_from([npy(np.eye(4)), npz({"a": np.eye(4), "b": np.arange(9)})]))
    place = data.draw(st.integers(0, len(whole) - 1))
    cut = data.draw(st.booleans())
    damaged = whole[:place] if cut else whole[:place] + data.draw(st.binary(max_size=3)) + whole[place + 1 :]
    path = tmp_path_factory.mktemp("arrays") / "a"
    path.write_bytes(damaged)
    for load in (load_npy, load_npz):
        with contextlib.suppress(FormatError):
            load(path)


@pytest.mark.parametrize(
    ("shape", "sentence"),
    [
        ("(1000000000, 68, 2)", "claims 1,088,000,000,000 bytes, and 8 are there"),
        ("(-1,)", "lengths must be whole numbers from 0"),
        ("(0, 9223372036854775807, 9)", "is cut or damaged"),
        ("(" * 300 + "1" + ")" * 300, "is no .npy file"),
        ("(True,)", "lengths must be whole numbers from 0"),
    ],
)
@pytest.mark.parametrize("mmap", [False, True])
def test_headers_that_lie_allocate_nothing(tmp_path, shape, sentence, mmap):
    text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n".encode()
    content = b"\x93NUMPY\x01\x00" + len(text).to_bytes(2, "little") + text + bytes(8)
    (tmp_path / "a.npy").write_bytes(content)
    with pytest.raises(FormatError, match=sentence):
        load_npy(tmp_path / "a.npy", mmap=mmap)


def test_an_archive_that_unpacks_to_gigabytes_is_refused_before_it_does(tmp_path):
    path = tmp_path / "bomb.npz"
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        with archive.open("a.npy", "w") as member:
            member.write(npy(np.zeros(0))[:64])
            for _ in range(5):
                member.write(bytes(64 * 1024**2))
    assert path.stat().st_size < 500_000
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    with pytest.raises(FormatError, match=r"unpacks to 335,544,384 bytes .* at most 268,435,456 bytes"):
        load_npz(path)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 50_000


@pytest.mark.skipif(not Path("/dev/zero").exists(), reason="the system has no such device")
def test_a_device_without_an_end_is_no_archive():
    tracemalloc.start()
    try:
        with pytest.raises(FormatError, match="at most 1,049,576 are read here"):
            load_npz("/dev/zero", most_bytes=1000)
        assert tracemalloc.get_traced_memory()[1] < 10_000_000
    finally:
        tracemalloc.stop()


def test_what_is_no_plain_array_is_refused(tmp_path):
    path = tmp_path / "a"
    for content, sentence in (
        (npy(np.array([{}], dtype=object)), "holds object, but only arrays of numbers"),
        (pickle.dumps({}), r"is no \.npy file"),
        (npy(np.zeros(3, "V0")), "holds \\|V0, but only"),
        (npz({"a": np.zeros(3)}), r"is no \.npy file"),
    ):
        path.write_bytes(content)
        with pytest.raises(FormatError, match=sentence):
            load_npy(path)
    path.write_bytes(npy(np.zeros(3)))
    with pytest.raises(FormatError, match="is no archive of NumPy's arrays"):
        load_npz(path)
    for name in (tmp_path, tmp_path / "none"):
        for load in (load_npy, load_npz):
            with pytest.raises(InputError, match="cannot be read"):
                load(name)


def test_an_array_twice_and_a_file_that_is_none_are_refused(tmp_path):
    for names in (("a.npy", "a.npy"), ("a.txt",)):
        content = io.BytesIO()
        with zipfile.ZipFile(content, "w") as archive, warnings.catch_warnings(action="ignore"):
            for name in names:
                archive.writestr(name, npy(np.zeros(3)))
        with pytest.raises(FormatError, match=r"is no array, or stands there twice"):
            parse_npz(content.getvalue(), where="b")


def test_large_arrays_are_read_where_the_reader_allows_it(tmp_path):
    path = tmp_path / "a.npy"
    np.save(path, np.zeros(4_000_000))
    assert load_npy(path).shape == (4000000,)
    with pytest.raises(FormatError, match="has 32,000,000 bytes of numbers, but at most 1,000"):
        load_npy(path, most_bytes=1000)
    assert load_npy(path, most_bytes=1000, mmap=True).shape == (4000000,)
    assert MOST_BYTES > 32_000_000


def test_shapes_are_checked_by_name():
    arrays = {"a": np.zeros((3, 2)), "b": np.array(["x"]), "c": np.array([np.nan])}
    check_shapes(arrays, {"a": (None, 2)}, where="m")
    for shapes, sentence in (
        ({"a": (3,)}, r"m: array 'a' is float64 of shape \(3, 2\), but must be numbers of 3"),
        ({"a": (None, 3)}, "numbers of any x 3"),
        ({"b": (1,)}, "array 'b' is <U1"),
        ({"c": (1,)}, "not finite"),
        ({"d": (1,)}, "array 'd' is missing; it has a, b, c"),
    ):
        with pytest.raises(FormatError, match=sentence):
            check_shapes(arrays, shapes, where="m")
