"""The supervisor with workers that misbehave: failing, hanging, growing, dying, unable to start."""

import functools
import json
import sys

import pytest

from facegen.errors import OutputError, WorkersFailed
from facegen.spec import parse_spec
from facegen.store import resolve
from facegen.work import (
    Limits,
    attempt_logs,
    crew_note,
    generate,
    plan_work,
    quarantined_tasks,
    read_journals,
    wanted_tasks,
)
from facegen.work.supervisor import Outcome, Supervisor
from tests.facegen.work import faults

SPEC = {"version": 1, "kind": "still", "seed": 5, "people": 60, "still": {"neutral": 1, "faces": 0}}

pytestmark = pytest.mark.usefixtures("anny")


@pytest.fixture
def make(tmp_path, monkeypatch):
    """Makes samples with the worker given; returns the dataset and the summary."""
    dataset = resolve(parse_spec(SPEC, where="test"), tmp_path / "out")

    def run(target, samples, *, workers=1, **limits):
        supervisor = functools.partial(Supervisor, target=target)
        monkeypatch.setattr(sys.modules[generate.__module__], "Supervisor", supervisor)
        limits = Limits(**({"start_wait_s": 0.05} | limits))
        return dataset, generate(dataset, samples, shards="", workers=workers, limits=limits, grace_s=10)

    return run


@pytest.mark.parametrize(
    ("samples", "workers", "memory", "expected"),
    [
        ("0", None, None, (1, 16, int(0.8 * 64e9))),
        ("0-2", None, None, (3, 5, int(0.8 * 64e9 / 3))),
        ("0-31", None, None, (16, 1, int(0.8 * 4e9))),
        ("0-31", 2, 0, (2, 8, 0)),
    ],
)
def test_processes_share_all_processors_and_memory(tmp_path, monkeypatch, samples, workers, memory, expected):
    module, told = sys.modules[generate.__module__], []

    class Told:
        def __init__(self, *, workers, threads, limits, **_):
            told.append((workers, threads, limits.memory))

        def run(self, tasks):
            return Outcome(made=len(tasks), found=0, quarantined=())

    monkeypatch.setattr(module, "available_cpus", lambda: 16)
    monkeypatch.setattr(module, "available_memory", lambda: 64e9)
    monkeypatch.setattr(module, "Supervisor", Told)
    dataset = resolve(parse_spec(SPEC, where="test"), tmp_path / "out")
    generate(dataset, samples, shards="", workers=workers, limits=Limits(memory=memory))
    assert told == [expected]


def test_too_little_memory_is_told_of_pictures_alone(tmp_path, monkeypatch):
    module = sys.modules[generate.__module__]
    monkeypatch.setattr(module, "available_cpus", lambda: 8)
    monkeypatch.setattr(module, "available_memory", lambda: 4 << 30)
    dataset = resolve(parse_spec(SPEC, where="test"), tmp_path / "out")
    pictures, keypoints = (
        plan_work(dataset, samples, shards=shards) for samples, shards in (("0-9", ""), ("", "0"))
    )
    assert crew_note(pictures, None).startswith("8 workers in 4.3 GB")
    assert crew_note(plan_work(dataset, "0-2", shards=""), None) == ""
    assert crew_note(pictures, 4) == crew_note(keypoints, None) == ""


def outcomes(dataset) -> list[str]:
    return sorted(attempt.outcome for attempt in read_journals(dataset.folder))


def makers(dataset) -> list[int]:
    paths = sorted((dataset.folder.path / "renders").glob("*/*/sample.json"))
    return [json.loads(path.read_text())["process"] for path in paths]


def test_three_failures_quarantine_a_sample_with_all_its_logs_and_the_rest_goes_on(make):
    dataset, summary = make(faults.fails_at_odd, "0-4")
    assert (summary.made, summary.left) == (3, 0)
    assert [task.name for task in summary.quarantined] == ["sample-000001", "sample-000003"]
    logs = sorted((dataset.folder.path / "quarantine" / "sample-000001").iterdir())
    assert len(logs) == 3
    assert all("odd numbers are not made" in log.read_text() for log in logs)
    assert "attempt 1 of 3 failed" in attempt_logs(dataset.folder, summary.quarantined[0])[0].read_text()
    assert outcomes(dataset) == ["done"] * 3 + ["failed"] * 6
    _, again = make(faults.sound, "0-4")
    assert (again.made, again.quarantined) == (0, summary.quarantined)
    assert quarantined_tasks(dataset, wanted_tasks(dataset, "0-4")) == set(summary.quarantined)


@pytest.mark.slow
def test_a_sample_whose_worker_dies_or_hangs_is_made_by_the_next_one(make):
    for number, (target, limits) in enumerate(
        [
            (faults.dies_once, {}),
            (faults.stops_once, {"silence_s": 5.0}),  # a busy machine gives a starting process little
            (faults.loops_once, {"phase_s": 10.0}),  # starting is a step too, and slow on a busy machine
        ]
    ):
        dataset, summary = make(target, str(number), **limits)
        assert (summary.made, summary.quarantined) == (1, ()), target
        log = attempt_logs(dataset.folder, next(wanted_tasks(dataset, str(number), "").tasks()))[
            0
        ].read_text()
        assert "died with exit code -9" in log
        assert ("killed by its supervisor" in log) == bool(limits)
    assert not list((dataset.folder.path / "tmp").iterdir())


def test_processes_are_renewed_after_so_many_tasks_and_when_they_have_grown(make):
    dataset, summary = make(faults.sound, "0-4", renew_after=2)
    assert summary.made == 5
    first = makers(dataset)
    assert [first.count(process) for process in dict.fromkeys(first)] == [2, 2, 1]
    make(faults.grows, "10-12", memory=250_000_000)
    assert len(set(makers(dataset)[5:])) == 3
    make(faults.sound, "20-22", memory=2_000_000_000)
    assert len(set(makers(dataset)[8:])) == 1


def test_no_room_is_nobodys_fault_and_running_work_ends_first(make):
    with pytest.raises(OutputError, match="no space left"):
        make(faults.finds_no_room, "0-5", workers=2)
    dataset, summary = make(faults.sound, "0-5")
    assert summary.found >= 1, "the sample that the other worker was at is there"
    assert (summary.made + summary.found, summary.quarantined) == (6, ())
    assert "failed" not in outcomes(dataset)
    assert not list((dataset.folder.path / "tmp").iterdir())


def test_what_a_file_server_fails_at_once_is_tried_again_and_what_it_forbids_ends_the_run(make):
    dataset, summary = make(faults.hiccups_once, "0-2")
    assert (summary.made, summary.quarantined) == (3, ())
    assert outcomes(dataset) == ["done"] * 3 + ["failed"] * 3
    with pytest.raises(OutputError, match="cannot be written"):
        make(faults.may_not_write, "3")


def test_workers_that_cannot_start_blame_no_sample(make):
    with pytest.raises(WorkersFailed, match=r"exit code 3; it said:\nlibGL.so.1 is missing"):
        make(faults.cannot_start, "0-5")
    _, summary = make(faults.sound, "0-5")
    assert (summary.made, summary.quarantined) == (6, ())


def test_a_run_in_which_everything_fails_is_given_up(make):
    with pytest.raises(WorkersFailed, match="4 things failed three times and only 0 were made"):
        make(faults.fails_always, "0-49", failed_tasks=4)
    _, summary = make(faults.sound, "0-49")
    assert (summary.made, len(summary.quarantined)) == (46, 4)
