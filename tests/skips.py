"""Where tests may be skipped in CI: for these reasons alone, so that a tool which went away is no green run."""

import os
import re

import pytest

ALLOWED = {
    r"real recordings|FACEGEN_REAL": "recordings of people are not the project's to carry",
    r"^root is not refused by permissions": "CI runs as root",
    r"^PyLiveLinkFace is not installed": "it names no licence, so nothing installs it",
    r"^this file system takes no devices|cannot be mounted here": "containers may make and mount none",
    r"^this machine has no IPv6": "containers have none, unless they are told to",
    r"^the compiler sums up no stack": "GCC does, others do not",
    r"cannot be installed here: ": "of libraries that a pack is opened with, and nothing else needs",
}
"""Reasons, as patterns, and why each may be."""

OF_LIBRARIES = {
    r"^could not import 'torch'": "`make test-headset` installs it, and runs the tests that ask for it",
    r"^SCIPY_ARRAY_API is not set": "scikit-learn's own check of arrays that are not NumPy's",
}
"""The same, in words of pytest and others."""


def in_ci() -> bool:
    """Whether skips turn a run red: in continuous integration, by the variable that all services set.

    Where `.ci/run` said of a tool that it cannot be installed, its tests are skipped and told, and the others count.
    """
    return os.environ.get("CI", "false") != "false" and "SKIPS_ARE_TOLD" not in os.environ


def is_allowed(reason: str) -> bool:
    """Whether a test may be skipped for a reason in CI."""
    return any(re.search(pattern, reason) for pattern in ALLOWED | OF_LIBRARIES)


class SkipGuard:
    """Plugin of the process that hears of every test: turns a run red whose skips are not all allowed."""

    def __init__(self) -> None:
        self._unforeseen: list[str] = []

    def pytest_runtest_logreport(self, report: pytest.TestReport) -> None:
        """Hear of a test's setup, call or end."""
        self._look(report)

    def pytest_collectreport(self, report: pytest.CollectReport) -> None:
        """Hear of a file, which may be skipped whole."""
        self._look(report)

    @pytest.hookimpl(tryfirst=True)
    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Fail a run that would have passed."""
        if self._unforeseen and session.exitstatus in (
            pytest.ExitCode.OK,
            pytest.ExitCode.NO_TESTS_COLLECTED,
        ):
            session.exitstatus = pytest.ExitCode.TESTS_FAILED

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Say which ones, and what to do."""
        if self._unforeseen:
            terminalreporter.section("skipped in CI, which tests/skips.py does not allow")
            for line in self._unforeseen:
                terminalreporter.write_line(line)

    def _look(self, report: pytest.TestReport | pytest.CollectReport) -> None:
        # an expected failure is told as a skip with a text, and has no reason of this kind
        if report.skipped and not isinstance(report.longrepr, str) and not hasattr(report, "wasxfail"):
            reason = report.longrepr[2].removeprefix("Skipped: ")
            if not is_allowed(reason):
                self._unforeseen.append(f"{report.nodeid}: {reason}")
