"""`make` in a clone that somebody has used before."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make on this machine")
def test_an_environment_of_another_python_is_named_and_left_alone(tmp_path):
    """A page of ours makes `.venv` by any Python from 3.10 on; pip then ended with a traceback."""
    python = tmp_path / "bin" / "python"
    python.parent.mkdir()
    python.write_text("#!/bin/sh\nexit 1\n")
    python.chmod(0o755)
    ended = subprocess.run(
        ["make", "--no-print-directory", "--directory", ROOT, f"VENV={tmp_path}", "setup"],
        capture_output=True,
        text=True,
        # these tests run under `make` as well, whose jobs it would ask for
        env={
            name: value
            for name, value in os.environ.items()
            if name not in ("MAKEFLAGS", "MFLAGS", "MAKELEVEL")
        },
    )
    assert ended.returncode == 2
    assert ended.stderr.startswith(f"{tmp_path} is of another Python than 3.11")
    assert "VENV=.venv-3.11" in ended.stderr
    assert sorted(tmp_path.rglob("*")) == [python.parent, python]


@pytest.mark.skipif(shutil.which("make") is None, reason="there is no make on this machine")
@pytest.mark.parametrize("words", [(), ("FACEGEN_RIGS=/elsewhere",)])
def test_the_rigs_of_make_are_the_clones_own(words):
    """docs/farm.md lets a shell export another folder; make then built there, and looked here for ever."""
    show = '--eval=show: ; @echo "[$$FACEGEN_RIGS]"'
    said = subprocess.run(
        ["make", "--no-print-directory", "--directory", ROOT, show, *words, "show"],
        capture_output=True,
        text=True,
        env=os.environ | {"FACEGEN_RIGS": "/shared/rigs", "MAKEFLAGS": "", "MFLAGS": "", "MAKELEVEL": ""},
        check=True,
    )
    assert said.stdout == "[]\n"
