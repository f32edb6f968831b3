"""How long tests take: measured by ``make durations``, so that the quick ones come first.

The file beside this module has the seconds of each test function, all its cases and their fixtures together, on two
cores with nothing beside them. A function that is not in it, as a new one, counts as quick until it is measured.
"""

import json
from collections import Counter, defaultdict
from collections.abc import Iterable
from pathlib import Path

import pytest

DURATIONS = Path(__file__).with_suffix(".json")

LEAST_S = 0.1
"""Functions that take less are not written down."""

LONG_CASE_S, LONG_FUNCTION_S = 0.2, 6.0
"""From which on average a case, or a function with all its cases, is not quick. Some 4,700 quick tests take about three
minutes on two cores."""


class Recorder:
    """Plugin of the process that hears of every test: adds up what functions take, and writes it at the end."""

    def __init__(self, path: Path = DURATIONS) -> None:
        self.path = path
        self._seconds: defaultdict[str, float] = defaultdict(float)

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Hear of a test's setup, call or end."""
        self._seconds[function_of(report.nodeid)] += report.duration

    def pytest_sessionfinish(self, exitstatus: int) -> None:
        """Write what was measured, unless the run was stopped or a test failed."""
        if exitstatus:
            return
        seconds = {name: round(took, 2) for name, took in sorted(self._seconds.items()) if took >= LEAST_S}
        self.path.write_text(json.dumps(seconds, indent=0) + "\n", encoding="utf-8")


def function_of(node: str) -> str:
    """File and function of a test: its name without its case."""
    return node.split("[", 1)[0]


def mark_longer(items: Iterable[pytest.Item], seconds: dict[str, float]) -> None:
    """Mark what is not quick by measured ``seconds`` of functions."""
    cases = Counter(function_of(item.nodeid) for item in items)
    for item in items:
        took = seconds.get(function_of(item.nodeid), 0.0)
        if took > LONG_FUNCTION_S or took > LONG_CASE_S * cases[function_of(item.nodeid)]:
            item.add_marker("longer")


def measured() -> dict[str, float]:
    """Seconds by function."""
    return json.loads(DURATIONS.read_text(encoding="utf-8"))
