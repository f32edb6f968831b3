"""A reader who has gone, as `| head` does, ends the command quietly; one who only listened does not end it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
COMMAND = "from facegen.cli import main; main()"


def unread(stream: str, *arguments: object, program: str = COMMAND) -> tuple[int, str, str]:
    """Run a program with nobody at the end of a stream; exit code, standard output and standard error."""
    buffered = {name: value for name, value in os.environ.items() if name != "PYTHONUNBUFFERED"}
    command = [sys.executable, "-c", program, *map(str, arguments)]
    process = subprocess.Popen(
        command, cwd=ROOT, env=buffered, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True
    )
    getattr(process, stream).close()
    setattr(process, stream, None)
    out, err = process.communicate(timeout=60)
    return process.returncode, out or "", err or ""


@pytest.mark.parametrize("arguments", [("spec", "schema"), ("--version",), ("--help",)])
def test_results_that_nobody_reads_end_it_quietly(arguments: tuple[str, ...]):
    """More than a buffer, which fails on the way; less, which fails at the end; and help, which rich writes."""
    assert unread("stdout", *arguments) == (0, "", "")


@pytest.mark.parametrize("stream", ["stdout", "stderr"])
def test_an_error_keeps_its_code_whoever_reads(stream: str, tmp_path: Path):
    assert unread(stream, "spec", "check", tmp_path / "none.toml")[0] == 2


def test_work_goes_on_where_nobody_listens():
    program = """
from facegen.console import progress
with progress() as show:
    show("shards", 2, 2)
    show("shards", 2, 2)
print("all there")
"""
    assert unread("stderr", program=program) == (0, "all there\n", "")
