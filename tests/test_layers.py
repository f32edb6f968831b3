"""The direction of imports (DESIGN: data flows one way), and that every package says what is public."""

import ast
import graphlib
import importlib
import os
import pkgutil
import shutil
import subprocess
import sys
import tomllib
from collections import Counter
from pathlib import Path

import grimp
import pytest

import facegen
import regress
import room
import track

ROOT = Path(__file__).resolve().parents[1]


BREAKAGES = {
    "facegen: data flows one way": ("facegen/geometry/rotations.py", "import facegen.cli"),
    "regress: data flows one way, and what runs never imports what learns": (
        "regress/runtime/model/model.py",
        "from regress.learning.training import train",
    ),
    "regress.runtime: data flows one way": (
        "regress/runtime/inputs/frames.py",
        "import regress.runtime.stages",
    ),
    "regress.runtime.stages: data flows one way": (
        "regress/runtime/stages/smoothing.py",
        "import regress.runtime.stages.output",
    ),
    "regress.runtime.heads: data flows one way": (
        "regress/runtime/heads/shape.py",
        "import regress.runtime.heads.fit",
    ),
    "regress.runtime.headset: data flows one way": (
        "regress/runtime/headset/pictures/typical.py",
        "import regress.runtime.headset.answers.predict",
    ),
    "packages of regress.runtime.headset: no modules import each other in a circle": (
        "regress/runtime/headset/recordings/moments.py",
        "import regress.runtime.headset.recordings.matching",
    ),
    "regress.learning: data flows one way": (
        "regress/learning/networks/ridge.py",
        "import regress.learning.probes",
    ),
    "regress.learning.headset: data flows one way": (
        "regress/learning/headset/geometry.py",
        "import regress.learning.headset.evaluation",
    ),
    "track: data flows one way": ("track/sources/source.py", "import track.cli"),
    "room: data flows one way": ("room/errors.py", "import room.cli"),
    "every package imports only the libraries": ("facegen/packing/coco.py", "import bpy"),
}
"""For each contract, by the start of its name, a line that breaks it, and the file that the line is put into."""


def _lint(root: Path) -> str:
    """What import-linter says of a tree, white space folded; raises nothing where a contract is broken."""
    program = "from importlinter.cli import lint_imports_command; lint_imports_command()"
    command = [sys.executable, "-c", program, "--no-cache"]
    environment = {**os.environ, "PYTHONPATH": str(root)}
    result = subprocess.run(command, cwd=root, capture_output=True, text=True, env=environment)
    return " ".join((result.stdout + result.stderr).split())


@pytest.fixture
def copied(tmp_path: Path) -> Path:
    """The Python files of both packages, and the contracts, in another folder."""
    for package in ("facegen", "regress", "track", "room"):
        shutil.copytree(
            ROOT / package,
            tmp_path / package,
            ignore=shutil.ignore_patterns("__pycache__", "*.npz", "static"),
        )
    (tmp_path / "tests").mkdir()
    shutil.copy(ROOT / "tests" / "allowed_imports.py", tmp_path / "tests")
    shutil.copy(ROOT / "pyproject.toml", tmp_path)
    return tmp_path


def _contracts() -> list[str]:
    with (ROOT / "pyproject.toml").open("rb") as file:
        return [contract["name"] for contract in tomllib.load(file)["tool"]["importlinter"]["contracts"]]


def test_import_contracts_hold():
    assert f"Contracts: {len(_contracts())} kept, 0 broken." in _lint(ROOT)


def test_each_contract_breaks(copied: Path):
    assert len(BREAKAGES) == len(_contracts())
    for file, line in BREAKAGES.values():
        path = copied / file
        path.write_text(f"{path.read_text()}\n{line}\n")
    said = _lint(copied)
    assert f"Contracts: 0 kept, {len(BREAKAGES)} broken." in said
    for name in _contracts():
        assert any(name.startswith(start) for start in BREAKAGES)
        assert f"{name} BROKEN" in said
    assert "facegen.packing.coco imports bpy, which the line of facegen.packing does not allow" in said


@pytest.mark.parametrize(
    ("file", "line", "said"),
    [
        (
            "regress/runtime/sample.py",
            "import facegen.geometry",
            "facegen.geometry, which the line of regress.runtime",
        ),
        (
            "regress/runtime/sample.py",
            "import scipy.stats",
            "imports scipy, which the line of regress.runtime",
        ),
        ("regress/targets.py", "import pyarrow", "imports pyarrow, which the line of regress does not allow"),
        (
            "regress/newcomer.py",
            "import requests",
            "imports requests, which the line of regress does not allow",
        ),
        (
            "facegen/newcomer.py",
            "import regress.errors",
            "imports regress.errors, which the line of facegen does",
        ),
        ("facegen/newcomer.py", "", "facegen.newcomer"),
        ("regress/runtime/newcomer.py", "", "regress.runtime.newcomer"),
    ],
)
def test_what_no_line_allows_breaks_a_contract(copied: Path, file: str, line: str, said: str):
    path = copied / file
    path.write_text(f"{path.read_text() if path.exists() else ''}\n{line}\n")
    result = _lint(copied)
    assert ", 0 broken." not in result
    assert said in result


def test_no_module_imports_itself_by_way_of_others():
    graph = grimp.build_graph("facegen", "regress", "track", "room", cache_dir=None)
    imported = {module: graph.find_modules_directly_imported_by(module) for module in graph.modules}
    # for who asks for it, inside __getattr__
    imported["regress"] -= {"regress.learning.training.estimator"}
    graphlib.TopologicalSorter(imported).prepare()  # raises CycleError, which names the circle


def test_what_is_compiled_takes_no_constant_of_another_module():
    """Numba keeps the result with the constants of that day, and looks at the function's own file alone."""
    graph = grimp.build_graph("facegen", "regress", "track", "room", cache_dir=None)
    maker = "facegen.compilation"
    compiling = graph.find_modules_that_directly_import(maker)
    assert "facegen.rigs.lid_closing" in compiling
    others = {module: graph.find_modules_directly_imported_by(module) - {maker} for module in compiling}
    assert not {module: sorted(names) for module, names in others.items() if names}


PROGRAMS = ("facegen", "regress", "track", "room", "benchmarks", "blender_assets", "docs", "tests")


def test_no_constant_has_two_values():
    """No linter's rule finds it, and what reads the first value breaks: so a script of docs/figures did."""
    twice = []
    for path in (path for program in PROGRAMS for path in sorted((ROOT / program).rglob("*.py"))):
        lines = [
            line for line in ast.parse(path.read_text(encoding="utf-8")).body if isinstance(line, ast.Assign)
        ]
        names = Counter(name.id for line in lines for name in line.targets if isinstance(name, ast.Name))
        twice += [f"{path.relative_to(ROOT)}: {name}" for name, times in names.items() if times > 1]
    assert not twice


def _packages() -> list[str]:
    names = []
    for root in (facegen, regress, room, track):
        names.append(root.__name__)
        names += [m.name for m in pkgutil.walk_packages(root.__path__, root.__name__ + ".") if m.ispkg]
    return names


EXTRAS = {
    "regress.learning.headset.compass": "torch",
    "regress.learning.headset.training": "torch",
}
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
    program = "import facegen.cli, regress.cli, room.cli, track.cli, sys; sys.exit('bpy' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", program], cwd=ROOT).returncode == 0
