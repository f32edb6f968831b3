"""Progress, and what a program says of a part of the installation that is absent."""

import importlib.metadata
import os
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from facegen.cli import app
from facegen.console import counted, progress, say
from facegen.errors import InputError
from facegen.extras import FACTORY, HEADSET, LEARN, missing_extra
from tests.facegen.cli.commands import ROOT, calls, sub_commands

pytestmark = pytest.mark.slow

HEAVY = {"matplotlib", "OpenEXR", "pyarrow", "scipy", "numba", "cv2", "bpy", "sklearn", "onnxruntime"}

NOT_IN_BASE = {*FACTORY.modules, "sklearn", "onnx", "torch"} - {"tomllib"}

HIDING = f"""
import sys

class Absent:
    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] in {sorted(NOT_IN_BASE)!r}:
            raise ModuleNotFoundError(f"No module named {{name!r}}", name=name)

sys.meta_path.insert(0, Absent())
from facegen.cli import main
main()
"""

MAY_WORK_ALONE = ("headset", "rig", "spec")
"""Groups with commands that read text files alone."""


def python(program: str, *arguments: str, folder: Path = ROOT) -> subprocess.CompletedProcess:
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-c", program, *arguments]
    return subprocess.run(command, cwd=folder, env=environment, capture_output=True, text=True, timeout=60)


@pytest.mark.parametrize("words", sub_commands(app), ids=" ".join)
def test_help_imports_nothing_heavy(words):
    program = f"""
import sys
from facegen.cli import main
try:
    main()
finally:
    print({HEAVY!r} & set(sys.modules), file=sys.stderr)
"""
    shown = python(program, *words, "--help")
    assert shown.returncode == 0
    assert "Usage: " in shown.stdout
    assert shown.stderr == "set()\n"


@pytest.mark.parametrize("arguments", [["--help"], ["--version"]])
def test_the_base_alone_says_what_there_is(arguments):
    shown = python(HIDING, *arguments)
    assert (shown.returncode, shown.stderr) == (0, "")


@pytest.mark.parametrize("words", calls(app, Path()), ids=" ".join)
@pytest.mark.usefixtures("anny")
def test_a_command_works_or_says_how_to_get_what_it_needs(words, tmp_path):
    called = python(HIDING, *words, *calls(app, tmp_path)[words], folder=tmp_path)
    if words[0] in MAY_WORK_ALONE and called.returncode == 0:
        assert called.stderr == ""
        return
    assert called.returncode == 2, called.stderr
    command = f"facegen {' '.join(words)}"
    assert called.stderr.startswith(f"facegen: {command} needs the factory extra, which is not installed")
    assert called.stderr.endswith("): pip install 'facegen[factory]' in Python 3.11\n")
    assert called.stderr.count("\n") == 1
    assert called.stdout == ""
    assert not list(tmp_path.iterdir())


def test_the_first_extra_with_the_module_is_named_and_a_fault_of_the_program_is_none():
    absent = ModuleNotFoundError("No module named 'pyarrow.parquet'", name="pyarrow.parquet")
    assert missing_extra(absent, "regress train", (LEARN, HEADSET)) == (
        "regress train needs the learn extra, which is not installed (no module named 'pyarrow'): "
        "pip install 'facegen[learn]'"
    )
    assert "facegen[headset]" in missing_extra(ModuleNotFoundError(name="torch"), "regress", (LEARN, HEADSET))
    assert missing_extra(ModuleNotFoundError(name="facegen.typo"), "facegen", (FACTORY,)) is None


@pytest.mark.parametrize("extra", [FACTORY, LEARN, HEADSET], ids=lambda extra: extra.name)
def test_extras_bring_the_modules_that_they_are_said_to_bring(extra):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    declared = {canonicalize_name(Requirement(text).name) for text in _all_of(extra.name, project)}
    # OpenEXR 3.5 says of its modules only that there is Imath
    homes = {"OpenEXR": ["OpenEXR"], **importlib.metadata.packages_distributions()}
    for module in extra.modules & set(homes):
        assert declared & {canonicalize_name(name) for name in homes[module]}, module
    named = {canonicalize_name(name) for module in extra.modules for name in homes.get(module, ())}
    own = project["optional-dependencies"][extra.name]
    wanted = {canonicalize_name(Requirement(text).name) for text in own} - {"facegen"}
    installed = {canonicalize_name(name) for names in homes.values() for name in names}
    assert wanted & installed <= named


def _all_of(name: str, project: dict) -> list[str]:
    """Requirements of an extra, those of extras that it names among them."""
    own = project["optional-dependencies"][name]
    inner = [
        extra for text in own if Requirement(text).name == "facegen" for extra in Requirement(text).extras
    ]
    return [*own, *(text for extra in inner for text in _all_of(extra, project))]


def test_plain_lines_come_at_the_end_of_a_stage_and_seldom_before(capsys, monkeypatch):
    clock = iter([0.0, 4.0, 11.0, 20.0, 30.0])
    monkeypatch.setattr(time, "monotonic", lambda: next(clock))
    with progress(unit="steps") as show:
        for done in (1, 2, 4):
            show("rows", done, 4)
        show("columns", 1, 1)
    captured = capsys.readouterr()
    assert captured.out == ""
    assert captured.err.splitlines() == [
        "rows: 2 of 4 steps, 11 s, about 14 s left",
        "rows: 4 of 4 steps, 20 s",
        "columns: 1 of 1 steps, 0 s",
    ]


def test_what_a_stage_began_with_says_nothing_of_its_pace(capsys, monkeypatch):
    """The first of 1,000 frames may wait a minute for what the others share; a resumed run has most of them already."""
    clock = iter([0.0, 60.0, 100.0, 4000.0])
    monkeypatch.setattr(time, "monotonic", lambda: next(clock))
    with progress() as show:
        for done in (1, 41, 600):
            show("frames", done, 1000)
    assert capsys.readouterr().err.splitlines() == [
        "frames: 1 of 1000, 60 s",
        "frames: 41 of 1000, 100 s, about 16 min left",
        "frames: 600 of 1000, 67 min, about 44 min left",
    ]


def test_a_farm_reads_shares_and_an_unknown_style_is_refused(capsys):
    with progress(style="openjd") as show:
        show("samples", 1, 4)
    assert capsys.readouterr().out == "openjd_progress: 25.0\nopenjd_status: 1 of 4 samples\n"
    with pytest.raises(InputError, match="must be auto or openjd"), progress(style="bars"):
        pass


def test_a_count_of_one_is_told_in_the_singular():
    assert [counted(number, "file") for number in (0, 1, 2)] == ["0 files", "1 file", "2 files"]
    assert [counted(number, "person", "people") for number in (1, 12)] == ["1 person", "12 people"]


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs a disk that is always full")
def test_a_log_that_cannot_be_written_stops_no_work(monkeypatch):
    with open(os.open("/dev/full", os.O_WRONLY), "w", closefd=False) as full:
        monkeypatch.setattr("sys.stderr", full)
        for _ in range(10_000):
            say("a line")
        monkeypatch.undo()
        os.dup2(os.open(os.devnull, os.O_WRONLY), full.fileno())
