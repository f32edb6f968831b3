"""Quick tests come first by what was measured, and what was measured is of tests that there are."""

import ast
from pathlib import Path

import pytest

from tests.durations import LONG_CASE_S, Recorder, mark_longer, measured

ROOT = Path(__file__).parents[1]


class Item:
    """What marking needs of a test."""

    def __init__(self, nodeid: str) -> None:
        self.nodeid, self.marks = nodeid, []

    def add_marker(self, mark: str) -> None:
        self.marks.append(mark)


def test_what_is_measured_is_there() -> None:
    functions = {}
    for name in measured():
        file, *_, function = name.split("::")
        if file not in functions:
            tree = ast.parse((ROOT / file).read_text(encoding="utf-8"))
            functions[file] = {
                node.name
                for node in ast.walk(tree)
                if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
            }
        assert function in functions[file], f"{name} is no more: run make durations"


def test_a_case_is_long_by_the_mean_of_its_function() -> None:
    items = [
        Item("a.py::test_many[one]"),
        Item("a.py::test_many[two]"),
        Item("a.py::test_new"),
        Item("a.py::test_long"),
    ]
    mark_longer(items, {"a.py::test_many": 1.9 * LONG_CASE_S, "a.py::test_long": 1.1 * LONG_CASE_S})
    assert [item.marks for item in items] == [[], [], [], ["longer"]]
    items = [Item(f"a.py::test_many[{case}]") for case in range(100)]
    mark_longer(items, {"a.py::test_many": 7.0})
    assert all(item.marks == ["longer"] for item in items)


def test_setup_counts_and_cases_add_up(tmp_path: Path) -> None:
    recorder = Recorder(tmp_path / "durations.json")
    for node, when, took in (
        ("a[1]", "setup", 0.3),
        ("a[1]", "call", 0.1),
        ("a[2]", "call", 0.2),
        ("b", "call", 0.01),
    ):
        report = pytest.TestReport(node, ("a.py", 0, node), {}, "passed", None, when, duration=took)
        recorder.pytest_runtest_logreport(report)
    recorder.pytest_sessionfinish(pytest.ExitCode.INTERRUPTED)
    assert not list(tmp_path.iterdir())
    recorder.pytest_sessionfinish(pytest.ExitCode.OK)
    assert (tmp_path / "durations.json").read_text() == '{\n"a": 0.6\n}\n'
