"""The direction of imports (DESIGN: data flows one way), and that every package says what is public."""

import importlib
import pkgutil
import subprocess
import sys
from pathlib import Path

import pytest

import facegen
import regress

ROOT = Path(__file__).resolve().parents[1]


def test_import_contracts_hold():
    program = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    result = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert result.returncode == 0, result.stdout + result.stderr


def _packages() -> list[str]:
    names = []
    for root in (facegen, regress):
        names.append(root.__name__)
        names += [m.name for m in pkgutil.walk_packages(root.__path__, root.__name__ + ".") if m.ispkg]
    return names


EXTRAS = {"regress.learning.headset.training": "torch"}
"""Packages that need an optional extra; `make test-headset` has it."""


@pytest.mark.parametrize("name", _packages())
def test_public_names_exist(name):
    if name in EXTRAS:
        pytest.importorskip(EXTRAS[name])
    package = importlib.import_module(name)
    assert package.__doc__, f"{name} does not say what it is for"
    public = getattr(package, "__all__", [])
    assert len(set(public)) == len(public)
    for symbol in public:
        assert hasattr(package, symbol), f"{name}.__all__ names {symbol}, which is not there"


def test_importing_the_command_line_does_not_start_blender():
    program = "import facegen.cli, regress.cli, sys; sys.exit('bpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], cwd=ROOT).returncode == 0
