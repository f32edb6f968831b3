"""Tables of weights: whoever wrote them."""

import os

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from facegen.formats import FormatError, live_link_csv
from facegen.formats.weight_table import read_weight_table


def table(weights: np.ndarray, *, time_s: np.ndarray | None = None) -> str:
    """As `regress predict` writes it."""
    lines = [",".join(["frame", *(["time_s"] if time_s is not None else []), *BLENDSHAPES])]
    for row, values in enumerate(weights):
        cells = ["" if np.isnan(value) else f"{value:.6f}" for value in values]
        lines.append(",".join([str(row), *([f"{time_s[row]:.6f}"] if time_s is not None else []), *cells]))
    return "\n".join(lines)


@settings(max_examples=20)
@given(rows=st.integers(1, 5), seed=st.integers(0, 9), timed=st.booleans())
def test_what_predict_writes_reads_back(tmp_path_factory, rows, seed, timed):
    rng = np.random.Generator(np.random.PCG64(seed))
    weights = rng.random((rows, 52))
    weights[rng.random(rows) < 0.3] = np.nan
    path = tmp_path_factory.mktemp("table") / "weights.csv"
    path.write_text(table(weights, time_s=2.0 + np.arange(rows) / 25 if timed else None))
    read, time_s = read_weight_table(path)
    np.testing.assert_allclose(read, weights, atol=1e-6)
    np.testing.assert_allclose(time_s, np.arange(rows) / (25 if timed else 30), atol=1e-5)
    np.testing.assert_allclose(read_weight_table(path, fps=10)[1], np.arange(rows) / 10)


def test_live_link_recordings_are_read_by_their_timecode(tmp_path):
    weights = np.linspace(0, 1, 3 * 52).reshape(3, 52)
    (tmp_path / "take.csv").write_text(live_link_csv(weights, np.arange(3) / 30))
    read, time_s = read_weight_table(tmp_path / "take.csv")
    np.testing.assert_allclose(read, weights, atol=1e-9)
    np.testing.assert_allclose(time_s, np.arange(3) / 30, atol=2e-5)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("a,b\n1,2\n", "52 of the 52 ARKit columns"),
        (",".join(BLENDSHAPES) + "\n", "no rows"),
        (",".join(BLENDSHAPES) + "\n" + ",".join(["x"] * 52), "no number"),
        (",".join(BLENDSHAPES) + "\n0,0\n", "row 2 has 2 cells"),
    ],
)
def test_what_is_no_table_is_refused(tmp_path, text, words):
    (tmp_path / "weights.csv").write_text(text)
    with pytest.raises(FormatError, match=words):
        read_weight_table(tmp_path / "weights.csv")
    with pytest.raises(FormatError, match="there is no such file"):
        read_weight_table(tmp_path / "none.csv")
    with pytest.raises(FormatError, match=r"cannot be read .*Is a directory"):
        read_weight_table(tmp_path)


def test_a_recording_comes_through_a_pipe(tmp_path):
    """As a shell's ``<(command)`` gives it: it can be opened once."""
    weights = np.linspace(0, 1, 3 * 52).reshape(3, 52)
    reader, writer = os.pipe()
    os.write(writer, live_link_csv(weights, np.arange(3) / 30).encode())
    os.close(writer)
    read, _ = read_weight_table(f"/dev/fd/{reader}")
    os.close(reader)
    np.testing.assert_allclose(read, weights, atol=1e-9)


def test_rows_without_a_time_have_that_of_the_row_before(tmp_path):
    """As of a first frame whose detector gave no time: all times were unknown by it."""
    path = tmp_path / "take.csv"
    names = ",".join(["time_s", *BLENDSHAPES])
    path.write_text("\n".join([names, *(f"{time}{',0.5' * 52}" for time in ("", "2.0", "", "2.5"))]))
    assert read_weight_table(path)[1].tolist() == [0, 0, 0, 0.5]
