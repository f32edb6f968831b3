"""Ctrl-C and a scheduler's TERM at any moment: one exit code, no traceback of any process, nothing half-made left."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from facegen.children import block_stop_signals

pytestmark = pytest.mark.slow

ROOT = Path(__file__).resolve().parents[3]
CHILD = [sys.executable, "-c", "import time; time.sleep(0.5); print('lives')"]


def wait_until_answering(process: int) -> None:
    """Wait until a program answers a TERM by itself: before, Python starts, on a busy machine for a second."""
    status, until_s = Path(f"/proc/{process}/status"), time.monotonic() + 120
    while status.exists() and time.monotonic() < until_s:
        caught = next(line for line in status.read_text().splitlines() if line.startswith("SigCgt"))
        if int(caught.split()[1], 16) >> (signal.SIGTERM - 1) & 1:
            return
        time.sleep(0.005)


@pytest.mark.blender
@pytest.mark.usefixtures("anny")
@pytest.mark.parametrize("tenths", range(3, 34, 3))
def test_a_stop_in_the_first_seconds_is_one_sentence(tmp_path, tenths):
    arguments = ["generate", "datasets/tiny.toml", "--out", str(tmp_path / "out"), "--workers", "2"]
    process = subprocess.Popen(
        [sys.executable, "-m", "facegen", *arguments, "--grace", "0"],
        cwd=ROOT,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        start_new_session=True,
    )
    wait_until_answering(process.pid)
    time.sleep(tenths / 10)
    # as from a terminal, to the program and all its children
    os.killpg(process.pid, signal.SIGINT if tenths % 2 else signal.SIGTERM)
    _, said = process.communicate(timeout=300)
    assert process.returncode == 75, said
    assert "Traceback" not in said
    assert "Exception" not in said
    assert "run the same command" in said
    assert not list((tmp_path / "out").glob("tmp/*"))


STOPPED_AT = """
import importlib, os, signal
stop = lambda *_, **__: os.kill(os.getpid(), signal.{number})
setattr(importlib.import_module("{module}"), "{name}", stop)
from facegen.cli import main
main()
"""


@pytest.mark.usefixtures("anny")
@pytest.mark.parametrize("number", ["SIGINT", "SIGTERM"])
@pytest.mark.parametrize(
    ("module", "name"),
    [
        ("facegen.store", "resolve"),
        ("facegen.store.beginning", "commit_file"),
        ("facegen.work", "generate"),
    ],
)
def test_a_stop_before_the_first_worker_is_told(tmp_path, module, name, number):
    program = STOPPED_AT.format(module=module, name=name, number=number)
    command = [
        sys.executable,
        "-c",
        program,
        "generate",
        "datasets/tiny.toml",
        "--out",
        str(tmp_path / "out"),
    ]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 75
    assert done.stderr.splitlines()[-1] == "facegen: stopped; run the same command again"
    assert not list((tmp_path / "out").glob("tmp/*"))


def test_a_child_that_is_born_deaf_hears_no_stop():
    with block_stop_signals():
        child = subprocess.Popen(CHILD, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    for number in (signal.SIGINT, signal.SIGTERM):
        child.send_signal(number)
    assert child.communicate(timeout=300) == ("lives\n", "")


PARENT = """
import os, signal
from facegen.children import block_stop_signals
signal.signal(signal.SIGTERM, lambda *_: print("heard"))
with block_stop_signals():
    os.kill(os.getpid(), signal.SIGTERM)
    print("birth")
"""


def test_the_parent_hears_after_the_birth_what_came_in_it():
    # in a process of its own: a second thread, as pytest-xdist has, would take the signal at once
    said = subprocess.run(
        [sys.executable, "-c", PARENT], cwd=ROOT, capture_output=True, text=True, check=True
    )
    assert said.stdout.split() == ["birth", "heard"]
