"""The harness sees each promise that is broken, and a check that is taken out."""

from dataclasses import replace

import pytest

from tests.hostile.readers import READERS
from tests.hostile.summary import lines, verdicts
from tests.hostile.trial import HONEST, Case

QUICK = {"cpu_s": 1, "wall_s": 3.0, "memory_bytes": 300_000_000}


@pytest.mark.parametrize(
    ("rogue", "kind"),
    [
        ("crash", "traceback"),
        ("unforeseen", "internal"),
        ("abort", "signal"),
        ("eat", "memory"),
        ("spin", "time"),
        ("sleep", "time"),
        ("babble", "sentence"),
        ("drone", "sentence"),
        ("mumble", "sentence"),
        ("litter", "leftovers"),
        ("hide", "leftovers"),
        ("spoil", "touched"),
        ("haunt", "running"),
        ("invent", "code"),
        ("warn", "noise"),
        ("die", "signal"),
        ("refuse", "refused"),
    ],
)
def test_a_broken_promise_is_seen(attempt, rogue, kind):
    case = Case(reader=READERS["npy"], mutator=HONEST, seed=0)
    outcome = attempt(case, broken=f"tests.hostile.rogues:{rogue}", limits=QUICK)
    assert outcome.verdict.kind == kind, outcome.verdict


@pytest.mark.parametrize(
    ("check", "reader", "mutator"),
    [("unbounded_json", "rig-json", "extreme")],
)
def test_a_check_that_is_taken_out_turns_the_harness_red(attempt, check, reader, mutator):
    cases = [Case(reader=READERS[reader], mutator=mutator, seed=seed) for seed in range(8)]
    sound = [attempt(case).verdict.good for case in cases]
    broken = [attempt(case, broken=f"tests.hostile.rogues:{check}").verdict.good for case in cases]
    assert sum(broken) < sum(sound)


def test_a_case_repeats(attempt):
    case = Case(reader=READERS["coco"], mutator="replace", seed=3)
    one, other = attempt(case), attempt(case)
    assert (one.verdict, one.stderr) == (other.verdict, other.stderr)
    assert case.command == "python -m tests.hostile coco replace 3"
    assert attempt(replace(case, seed=4)).words == one.words


def test_verdicts_are_counted():
    seen = [("npy", "accepted"), ("npy", "refused"), ("coco", "traceback"), ("coco", "time")]
    *_, last = lines(seen)
    assert last == (
        "4 hostile cases: 1 accepted, 1 refused, 1 tracebacks, 1 over limits of time or memory, 2 failures in all"
    )
    assert list(lines([])) == []


def test_a_test_counts_once_though_three_reports_tell_of_it():
    told = [("hostile", [["npy", "accepted"], ["coco", "refused"]]), ("other", 1)]
    reports = [
        pytest.TestReport("a", ("a.py", 0, "a"), {}, "passed", None, when, user_properties=known)
        for when, known in (("setup", []), ("call", told), ("teardown", told))
    ]
    assert verdicts([*reports, "a warning"]) == [("npy", "accepted"), ("coco", "refused")]
