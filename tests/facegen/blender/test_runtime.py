"""What Blender's absence is called, and that spawned processes find it."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from facegen.blender.runtime import missing_library_sentence, quiet_stdout

ROOT = Path(__file__).resolve().parents[3]


@pytest.mark.parametrize(
    ("library", "package"),
    [("libXrender.so.1", "libxrender1"), ("libSM.so.6", "libsm6"), ("libGL.so.1", "libgl1")],
)
def test_a_missing_library_is_named_with_its_package(library, package):
    error = ImportError(f"{library}: cannot open shared object file: No such file or directory")
    sentence = missing_library_sentence(error)
    assert f"the system library {library.rsplit('.', 1)[0]} is missing" in sentence
    assert f"apt-get install --no-install-recommends {package}`" in sentence


def test_an_unknown_library_is_still_named():
    error = ImportError("libodd-1.2.so.3: cannot open shared object file: No such file or directory")
    assert "libodd-1.2.so is missing" in missing_library_sentence(error)


def test_a_missing_module_says_what_to_install():
    error = ModuleNotFoundError("No module named 'bpy'", name="bpy")
    assert "pip install 'facegen[factory]' in Python 3.11" in missing_library_sentence(error)


def test_stdout_is_quiet_and_comes_back(capfd):
    os.write(1, b"before\n")
    with quiet_stdout():
        os.write(1, b"hidden\n")
    os.write(1, b"after\n")
    assert capfd.readouterr().out == "before\nafter\n"


@pytest.mark.blender
def test_a_process_spawned_by_one_with_blender_finds_all_of_bpy(tmp_path):
    program = """
import multiprocessing, sys
from facegen.blender.runtime import import_bpy

def child():
    sys.exit(0 if import_bpy().app.version[0] == 4 else 3)

if __name__ == "__main__":
    import_bpy()
    process = multiprocessing.get_context("spawn").Process(target=child)
    process.start()
    process.join()
    sys.exit(process.exitcode)
"""
    (tmp_path / "parent.py").write_text(program)
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    result = subprocess.run([sys.executable, tmp_path / "parent.py"], cwd=ROOT, env=environment)
    assert result.returncode == 0
