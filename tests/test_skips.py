"""What is skipped in CI turns it red, unless the list of tests/skips.py allows it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.skips import ALLOWED, in_ci, is_allowed

ROOT = Path(__file__).parents[1]

CONFTEST = """
from tests.skips import SkipGuard
def pytest_configure(config):
    config.pluginmanager.register(SkipGuard())
"""
ALLOWED_SKIP = "import pytest\ndef test_a(): pytest.skip('root is not refused by permissions')\n"
SKIP = "import pytest\n@pytest.mark.skipif(True, reason='no such tool')\ndef test_a(): pass\ndef test_b(): pass\n"
FILE = "import pytest\npytest.importorskip('no_such_library')\ndef test_a(): pass\n"
XFAIL = "import pytest\n@pytest.mark.xfail\ndef test_a(): assert False\n"


@pytest.mark.parametrize(
    ("content", "code", "said"),
    [
        (ALLOWED_SKIP, 0, ""),
        (XFAIL, 0, ""),
        (SKIP, 1, "test_it.py::test_a: no such tool"),
        (FILE, 1, "test_it.py: could not import 'no_such_library'"),
    ],
    ids=["allowed", "expected to fail", "a test", "a file"],
)
@pytest.mark.parametrize("processes", [0, 1])
def test_a_run_with_other_skips_fails(content, code, said, processes, tmp_path):
    (tmp_path / "conftest.py").write_text(CONFTEST)
    (tmp_path / "test_it.py").write_text(content)
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "-c",
            os.devnull,
            "--rootdir",
            tmp_path,
            f"-n{processes}",
            "test_it.py",
        ],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(ROOT), "PYTEST_ADDOPTS": ""},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stdout + done.stderr
    assert said in done.stdout
    assert ("tests/skips.py does not allow" in done.stdout) == bool(code)


def test_every_allowed_reason_is_one_that_a_test_gives():
    sources = [
        path.read_text(encoding="utf-8")
        for path in (ROOT / "tests").glob("**/*.py")
        if path.stem not in ("skips", "test_skips")
    ]
    for pattern in ALLOWED:
        for part in pattern.split("|"):
            words = part.lstrip("^").rstrip(" :")
            assert any(words in source for source in sources), f"no test is skipped for {words!r} any more"


def test_a_tool_that_is_missing_is_not_allowed():
    for reason in (
        "no node on this machine",
        "needs Mono (Debian: mono-mcs, mono-runtime)",
        "no Slurm here",
        "",
    ):
        assert not is_allowed(reason)
    assert is_allowed("no real recordings in /x; FACEGEN_REAL names another folder")


def test_skips_are_told_alone_where_a_tool_could_not_be_installed(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.delenv("SKIPS_ARE_TOLD", raising=False)
    monkeypatch.setenv("CI", "true")
    assert in_ci()
    monkeypatch.setenv("SKIPS_ARE_TOLD", "1")
    assert not in_ci()
