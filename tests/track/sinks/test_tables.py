"""Recorded tables: the same rows as `regress predict`, whole or not at all, and no growth while they are made."""

import csv
import errno
import tracemalloc
from dataclasses import replace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from facegen.errors import OutputError
from facegen.formats import read_live_link
from regress.runtime.prediction import Prediction
from regress.runtime.writers.csv_table import GAZE_COLUMNS, HEAD_COLUMNS, weights_csv
from regress.runtime.writers.live_link import live_link_text
from tests.track.sinks.receivers import acted, lost
from track.sinks.recording import free_names
from track.sinks.tables import open_take
from track.sinks.targets import open_sink, parse_target

TABLES = ("csv", "livelink-csv")


def take(count: int = 5, start_s: float = 100.0) -> list:
    """Faces 25 a second, of which the fourth is lost."""
    samples = [
        replace(acted(number, time_s=start_s + number / 25), label=str(number)) for number in range(count)
    ]
    samples[3] = replace(lost(time_s=start_s + 3 / 25), label="3")
    return samples


@pytest.mark.parametrize("name", TABLES)
def test_the_table_is_that_of_regress_predict(name, tmp_path):
    samples = take()
    sink = open_sink(parse_target(f"{name}:{tmp_path / 'a.csv'}"), pytest.fail)
    for sample in samples:
        sink.send(sample)
    assert [path.name for path in tmp_path.iterdir() if path.is_file()] == []
    sink.close()
    assert [path.name for path in tmp_path.iterdir()] == ["a.csv"]
    from_start = [replace(sample, time_s=sample.time_s - 100.0) for sample in samples]
    write = {"csv": weights_csv, "livelink-csv": live_link_text}[name]
    assert (tmp_path / "a.csv").read_text() == write(Prediction(samples=from_start))


def test_columns_stay_where_the_first_frame_knows_nothing(tmp_path):
    sink = open_sink(parse_target(f"csv:{tmp_path / 'a.csv'}"), pytest.fail)
    for sample in (replace(lost(), weights=None, gaze=None, head=None, time_s=None), acted()):
        sink.send(sample)
    sink.close()
    with open(tmp_path / "a.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    assert tuple(rows[0]) == ("frame", "time_s", *BLENDSHAPES, *GAZE_COLUMNS, *HEAD_COLUMNS)
    assert set(rows[0].values()) == {"0", ""}
    assert all(rows[1].values())


def test_live_link_reads_the_take_back(tmp_path):
    samples = take()
    sink = open_sink(parse_target(f"livelink-csv:{tmp_path / 'a.csv'}"), pytest.fail)
    for sample in samples:
        sink.send(sample)
    sink.close()
    read = read_live_link(tmp_path / "a.csv")
    np.testing.assert_allclose(read.weights, [sample.weights for sample in samples], atol=1e-9)
    np.testing.assert_allclose(read.time_s, np.arange(5) / 25, atol=2e-5)


@pytest.mark.parametrize("name", TABLES)
def test_nothing_recorded_is_no_file(name, tmp_path):
    told = []
    (tmp_path / "a.csv").write_text("old")
    open_sink(parse_target(f"{name}:{tmp_path / 'a.csv'}"), told.append).close()
    assert [(path.name, path.read_text()) for path in tmp_path.iterdir()] == [("a.csv", "old")]
    assert told == [f"{name} to {tmp_path / 'a.csv'}: nothing was recorded, so there is no file"]


@pytest.fixture(params=[True, False], ids=["links", "no links"])
def links(request, monkeypatch):
    """File systems with hard links, and those without."""

    def refuse(*_: object) -> None:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    if not request.param:
        monkeypatch.setattr("os.link", refuse)


@pytest.mark.usefixtures("links")
def test_a_take_replaces_none_that_came_meanwhile(tmp_path, monkeypatch):
    """Two programs in one folder, whose takes begin before either of them is whole."""
    monkeypatch.chdir(tmp_path)
    takes = [open_take(free_names(), pytest.fail) for _ in range(2)]
    assert {take.title for take in takes} == {"csv to track-001.csv"}
    assert [path for path in tmp_path.iterdir() if path.is_file()] == []
    for count, take in enumerate(takes, start=1):
        for number in range(count):
            take.send(acted(number, time_s=number))
        take.close()
        assert take.title == f"csv to track-00{count}.csv"
    assert {path.name: len(path.read_text().splitlines()) for path in tmp_path.iterdir()} == {
        "track-001.csv": 2,
        "track-002.csv": 3,
    }


def test_each_take_of_one_program_has_a_name_of_its_own(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "track-002.csv").touch()
    names = free_names({tmp_path / "track-003.csv"})
    assert [next(names).name for _ in range(3)] == ["track-001.csv", "track-004.csv", "track-005.csv"]


@pytest.mark.parametrize("name", TABLES)
def test_a_folder_that_is_not_there_is_said_before_anything_is_recorded(name, tmp_path):
    with pytest.raises(OutputError, match=r"there is no folder .*none; make it"):
        open_sink(parse_target(f"{name}:{tmp_path / 'none' / 'a.csv'}"), pytest.fail)


@pytest.mark.parametrize("name", TABLES)
def test_a_long_recording_takes_no_more_memory(name, tmp_path):
    sink, sample = open_sink(parse_target(f"{name}:{tmp_path / 'a.csv'}"), pytest.fail), acted()
    for _ in range(50):
        sink.send(sample)
    tracemalloc.start()
    for _ in range(400):
        sink.send(sample)
    grown, _ = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    sink.close()
    assert grown < 20_000  # 400 rows have 200,000 bytes
