"""Live Link Face recordings: columns by name, weights as they are, time."""

import csv
import os
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.formats import FormatError, live_link_csv, read_live_link

REAL = Path(os.environ.get("FACEGEN_REAL", Path(__file__).parents[4] / "shared" / "real")) / "livelink"
needs_recordings = pytest.mark.skipif(
    not REAL.is_dir(), reason="the real recordings are not here (FACEGEN_REAL)"
)


def _write(path: Path, names: list[str], rows: list[list[str]], *, count: str = "BlendShapeCount") -> Path:
    with open(path, "w", newline="") as file:
        csv.writer(file).writerows([["Timecode", count, *names], *rows])
    return path


def _pascal(name: str) -> str:
    return name[0].upper() + name[1:]


@pytest.mark.parametrize("count", ["BlendShapeCount", "BlendshapeCount"])
def test_columns_are_read_by_name_whatever_their_order_and_capitals(tmp_path: Path, count: str):
    names = [_pascal(name) for name in reversed(BLENDSHAPES)]
    values = [f"{BLENDSHAPE_INDEX[name] / 40 - 0.02:.6f}" for name in reversed(BLENDSHAPES)]
    take = read_live_link(
        _write(tmp_path / "a.csv", names, [["00:00:01:00.000", "61", *values]], count=count)
    )
    assert np.allclose(take.weights, np.arange(52) / 40 - 0.02)  # -0.02 to 1.255: kept as they are


def test_time_comes_from_60_timecode_frames_a_second_and_passes_midnight(tmp_path: Path):
    codes = ["23:59:59:58.000", "23:59:59:59.500", "00:00:00:01.000"]
    rows = [[code, "61", *["0"] * 52] for code in codes]
    take = read_live_link(_write(tmp_path / "a.csv", list(BLENDSHAPES), rows))
    assert np.allclose(take.time_s, [0, 1.5 / 60, 3 / 60])
    assert take.timecodes == tuple(codes)
    assert np.allclose(read_live_link(tmp_path / "a.csv", fps=30).time_s, [0, 1 / 30, 2 / 30])


def test_drop_frame_timecode_has_steps_of_one_frame_over_a_minute_and_over_the_tenth(tmp_path: Path):
    """59.94 frames a second: behind 00:00:59;59 comes 00:01:00;04, and behind 00:09:59;59 comes 00:10:00;00."""
    for codes in (
        ["00:00:59;58", "00:00:59;59", "00:01:00;04", "00:01:00;05"],
        ["00:09:59;58", "00:09:59;59", "00:10:00;00", "00:10:00;01"],
    ):
        rows = [[code, "61", *["0"] * 52] for code in codes]
        take = read_live_link(_write(tmp_path / "a.csv", list(BLENDSHAPES), rows))
        assert np.allclose(take.time_s, np.arange(4) * 1001 / 60000)


def _coded(path: Path, codes: list[str]) -> np.ndarray:
    return read_live_link(
        _write(path, list(BLENDSHAPES), [[code, "61", *["0"] * 52] for code in codes])
    ).time_s


@pytest.mark.parametrize("rate", [24, 25, 30, 48, 60])
@pytest.mark.parametrize("start", [0, 7, 3599 * 30])
def test_timecode_may_count_slower_than_60(rate: int, start: int, tmp_path: Path):
    """Told by the largest frame of a take of two seconds; 48 is no rate of an app's, and read as 60."""
    numbers = start + np.arange(3 * rate)
    codes = [
        f"{n // rate // 3600:02d}:{n // rate // 60 % 60:02d}:{n // rate % 60:02d}:{n % rate:02d}.000"
        for n in numbers
    ]
    expected = np.arange(3 * rate) / rate
    if rate == 48:
        seconds, frames = numbers // rate, numbers % rate
        expected = seconds + frames / 60
        expected = expected - expected[0]
    np.testing.assert_allclose(_coded(tmp_path / "a.csv", codes), expected, atol=1e-9)


def test_short_and_slow_takes_count_60_as_they_did(tmp_path: Path):
    """Also one of two rows a second, of which no frame passes 30 but few differ."""
    short = [f"00:00:01:{frame:02d}.000" for frame in range(24)]
    np.testing.assert_allclose(_coded(tmp_path / "a.csv", short), np.arange(24) / 60)
    slow = [f"00:00:{second:02d}:{frame:02d}.000" for second in range(9) for frame in (0, 29)]
    np.testing.assert_allclose(_coded(tmp_path / "b.csv", slow)[:4], [0, 29 / 60, 1, 1 + 29 / 60])


def test_drop_frame_timecode_of_30_leaves_two_numbers_out(tmp_path: Path):
    """Behind 00:00:59;29 comes 00:01:00;02."""
    codes = [f"00:00:{second:02d};{frame:02d}" for second in range(57, 60) for frame in range(30)]
    codes += [f"00:01:00;{frame:02d}" for frame in range(2, 30)]
    np.testing.assert_allclose(
        _coded(tmp_path / "a.csv", codes), np.arange(len(codes)) * 1001 / 30000, atol=1e-9
    )


def test_what_is_no_recording_is_refused(tmp_path: Path):
    path = tmp_path / "a.csv"
    path.write_text("a,b\n1,2\n")
    with pytest.raises(FormatError, match="column eyeBlinkLeft is missing and 51 more"):
        read_live_link(path)
    path.write_text("")
    with pytest.raises(FormatError, match="is missing"):
        read_live_link(path)
    names = list(BLENDSHAPES)
    with pytest.raises(FormatError, match="no rows"):
        read_live_link(_write(path, names, []))
    with pytest.raises(FormatError, match="row 2 has 3 cells"):
        read_live_link(_write(path, names, [["00:00:00:00.0", "61", "0"]]))
    with pytest.raises(FormatError, match="not a number"):
        read_live_link(_write(path, names, [["00:00:00:00.0", "61", "x", *["0"] * 51]]))
    with pytest.raises(FormatError, match="timecode 'soon'"):
        read_live_link(_write(path, names, [["soon", "61", *["0"] * 52]]))


@given(
    weights=hnp.arrays(np.float64, (4, 52), elements=st.floats(-0.02, 1.4)),
    start_s=st.floats(0, 80_000),
    steps_s=hnp.arrays(np.float64, 4, elements=st.floats(0, 30)),
    gap=st.integers(0, 3),
)
@settings(max_examples=60, deadline=None)
def test_what_is_written_is_read_again(tmp_path_factory, weights, start_s, steps_s, gap):
    weights[gap] = np.nan
    time_s = start_s + np.cumsum(steps_s)
    path = tmp_path_factory.mktemp("takes") / "a.csv"
    path.write_text(live_link_csv(weights, time_s))
    take = read_live_link(path)
    np.testing.assert_allclose(take.weights, weights, atol=1e-10, rtol=0)
    np.testing.assert_allclose(take.time_s, time_s - time_s[0], atol=2e-5)  # 1/60000 s is 1.7e-5


def test_columns_are_the_apps(tmp_path: Path):
    weights = np.zeros((2, 52))
    weights[0, BLENDSHAPE_INDEX["jawLeft"]] = 0.25
    text = live_link_csv(weights, np.array([0.0, 3661.9999999]), rotations=np.full((2, 9), -0.5))
    header, *rows = csv.reader(text.splitlines())
    assert len(header) == 63
    assert header[16:20] == ["JawForward", "JawRight", "JawLeft", "JawOpen"]
    assert header[-10:-7] == ["TongueOut", "HeadYaw", "HeadPitch"]
    assert rows[0][:2] == ["00:00:00:00.000", "61"]
    assert rows[0][18] == "0.2500000000"
    assert rows[1][0] == "01:01:02:00.000"
    assert rows[1][-1] == "-0.5000000000"


@needs_recordings
@pytest.mark.parametrize("name", ["alex_rom_3.csv", "S07-001.csv"])
def test_a_real_recording_written_again_has_its_columns_and_timecodes(name: str, tmp_path: Path):
    with open(REAL / name, newline="") as file:
        header, *rows = list(csv.reader(file))
    take = read_live_link(REAL / name)
    hours, minutes, seconds, frames = (float(part) for part in take.timecodes[0].split(":"))
    start = hours * 3600 + minutes * 60 + seconds + frames / 60
    ours_header, *ours = list(csv.reader(live_link_csv(take.weights, start + take.time_s).splitlines()))
    assert [column.lower() for column in ours_header] == [column.lower() for column in header]
    assert [row[0] for row in ours] == [row[0] for row in rows]
    assert [float(cell) for cell in ours[5][2:54]] == pytest.approx(
        [float(c) for c in rows[5][2:54]], abs=1e-9
    )


@needs_recordings
@pytest.mark.parametrize(("name", "rows"), [("alex_rom_3.csv", 4030), ("S07-001.csv", 2028)])
def test_real_recordings(name: str, rows: int):
    take = read_live_link(REAL / name)
    assert take.weights.shape == (rows, 52)
    assert take.weights.min() >= 0
    assert take.weights.max() <= 1.0034
    # Rows come at 30 a second: two timecode frames of 1/60 s apart.
    assert np.median(np.diff(take.time_s)) == pytest.approx(1 / 30, abs=1e-6)
    with open(REAL / name, newline="") as file:
        first = next(csv.DictReader(file))
    for column in ("JawRight", "JawLeft", "MouthRight", "MouthLeft"):
        assert take.weights[0, BLENDSHAPE_INDEX[column[0].lower() + column[1:]]] == float(first[column])
