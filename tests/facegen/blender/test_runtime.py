"""What Blender's absence is called; no Blender is started here."""

import os

import pytest

from facegen.blender.runtime import missing_library_sentence, quiet_stdout


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
    assert "pip install 'bpy==4.5.*'" in missing_library_sentence(error)


def test_stdout_is_quiet_and_comes_back(capfd):
    os.write(1, b"before\n")
    with quiet_stdout():
        os.write(1, b"hidden\n")
    os.write(1, b"after\n")
    assert capfd.readouterr().out == "before\nafter\n"
