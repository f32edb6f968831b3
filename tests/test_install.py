"""The wheel, alone in clean environments of other Pythons: it installs, predicts, and says what it lacks."""

import os
import re
import shutil
import subprocess
import sys
import zipfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from regress.runtime.ready_made import HEADSET, LANDMARKS, ready_made_models
from tests.regress.headset.takes import pictures, write_take
from tests.regress.headset.tiny import write_tiny_model
from tests.samples import (
    FACE,
    PICTURES,
    SAMPLES,
    assert_face_as_recorded,
    assert_headset_as_recorded,
    rows,
)
from tests.skips import in_ci

ROOT = Path(__file__).parents[1]

ENVIRONMENTS = {
    "3.10-numpy1": ("3.10", "numpy<2"),
    "3.10-numpy2": ("3.10", "numpy>=2"),
    "3.12-numpy1": ("3.12", "numpy<2"),
    "3.13-numpy2": ("3.13", "numpy>=2"),
}
"""Python, and what is asked of NumPy: 1.26 is the newest that Blender's module takes, and 3.13 has none of it."""

PACKAGES = ("facegen", "regress", "track", "room")

IMPORT_ALL = """
import importlib, pkgutil
import facegen.cli, facegen.formats, facegen.geometry, regress.cli, regress.runtime, room.cli, track.cli
for package in (facegen.cli, facegen.formats, facegen.geometry, regress.cli, regress.runtime, room.cli, track.cli):
    for module in pkgutil.walk_packages(package.__path__, package.__name__ + "."):
        importlib.import_module(module.name)
"""

pytestmark = pytest.mark.slow


def interpreter(version: str) -> Path | None:
    """A Python of this version that runs: of the path, or of pyenv, whose shims run only what is switched on."""
    pyenv = Path(os.environ.get("PYENV_ROOT", Path.home() / ".pyenv"))
    candidates = [shutil.which(f"python{version}"), *sorted(pyenv.glob(f"versions/{version}.*/bin/python"))]
    program = "import sys; print('%d.%d' % sys.version_info[:2])"
    for candidate in filter(None, candidates):
        answer = subprocess.run([str(candidate), "-c", program], capture_output=True, text=True)
        if answer.stdout.strip() == version:
            return Path(candidate)
    return None


def clean_environment() -> dict[str, str]:
    return {name: value for name, value in os.environ.items() if not name.startswith("PYTHON")}


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    source, out = (tmp_path_factory.mktemp(name) for name in ("source", "wheel"))
    for name in ("pyproject.toml", "README.md", "LICENSE", "NOTICE"):
        shutil.copy(ROOT / name, source)
    for name in PACKAGES:
        shutil.copytree(ROOT / name, source / name, ignore=shutil.ignore_patterns("__pycache__"))
    command = [sys.executable, "-m", "pip", "wheel", "--quiet", "--no-deps", "--wheel-dir", out, source]
    subprocess.run(list(map(str, command)), check=True)
    (path,) = out.glob("*.whl")
    return path


@pytest.fixture(scope="module")
def folders() -> Iterator[dict[str, Path]]:
    """Environments by version of Python; one that is there gets another NumPy in the place of its own."""
    made: dict[str, Path] = {}
    yield made
    for folder in made.values():
        shutil.rmtree(folder)


@pytest.fixture(scope="module", params=ENVIRONMENTS)
def installed(
    request: pytest.FixtureRequest,
    wheel: Path,
    folders: dict[str, Path],
    tmp_path_factory: pytest.TempPathFactory,
):
    """A function that runs a console script of a clean environment which has the wheel and what it asks for."""
    version, numpy = ENVIRONMENTS[request.param]
    python = interpreter(version)
    if python is None:
        sentence = f"no Python {version} on this machine"
        if request.config.getoption("--require-pythons") or in_ci():
            pytest.fail(sentence)
        pytest.skip(sentence)
    if version not in folders:
        folders[version] = tmp_path_factory.mktemp("environment")
        make = [python, "-m", "venv", "--without-pip", folders[version]]
        subprocess.run(make, check=True, env=clean_environment())
    scripts = folders[version] / ("Scripts" if os.name == "nt" else "bin")
    pip = [
        sys.executable,
        "-m",
        "pip",
        "--python",
        scripts / "python",
    ]  # one for all: to install it takes seconds
    command = [*pip, "install", "--quiet", "--no-compile", wheel, numpy]
    subprocess.run(list(map(str, command)), check=True, env=clean_environment())

    def run(script: str, *arguments: object, cwd: Path) -> subprocess.CompletedProcess:
        temporary = cwd / "temporary"
        temporary.mkdir(exist_ok=True)
        done = subprocess.run(
            [scripts / script, *map(str, arguments)],
            cwd=cwd,
            env={**clean_environment(), "TMPDIR": str(temporary)},
            capture_output=True,
            text=True,
        )
        assert not list(temporary.iterdir())
        return done

    return run


def test_the_wheel_holds_programs_and_models_and_no_tests(wheel: Path):
    with zipfile.ZipFile(wheel) as archive:
        names = archive.namelist()
    folders = {name.split("/")[0] for name in names}
    assert {name for name in folders if not name.endswith(".dist-info")} == set(PACKAGES)
    for name in ready_made_models():
        assert {f"regress/models/{name}/{file}" for file in ("model.json", "CARD.md")} < set(names)
    assert f"regress/models/{LANDMARKS}/weights.npz" in names
    assert not [name for name in names if name.endswith((".pyc", ".parquet"))]


def test_a_release_has_one_number(wheel: Path):
    number = wheel.name.split("-")[1]
    assert f"\nversion: {number}\n" in (ROOT / "CITATION.cff").read_text()
    releases = re.findall(r"^## (\d\S*)", (ROOT / "CHANGELOG.md").read_text(), re.MULTILINE)
    assert releases[0] == number


def test_the_wheel_alone_predicts_as_recorded(installed, tmp_path: Path):
    version = installed("regress", "--version", cwd=tmp_path)
    assert (version.returncode, version.stdout.startswith("regress ")) == (0, True), version.stderr
    assert LANDMARKS in installed("regress", "models", cwd=tmp_path).stdout
    done = installed(
        *("regress", "predict", *FACE, "--out", "weights.csv"),
        cwd=tmp_path,
    )
    assert (done.returncode, done.stdout) == (0, "")
    blinks, written = done.stderr.splitlines()
    assert blinks.startswith("the fullest blinks read ")
    assert blinks.endswith(" and are stretched towards 1")
    assert written.startswith("weights.csv: 1,800 frames of 52 weights")
    assert_face_as_recorded(tmp_path / "weights.csv")


def test_the_wheel_alone_predicts_from_pictures(installed, tmp_path: Path):
    write_tiny_model(tmp_path / "tiny")
    stacks = {name: pictures([51, 102, 153]) for name in ("left_eye", "right_eye", "mouth")}
    options = write_take(tmp_path / "take", stacks)
    done = installed("regress", "headset", "predict", "tiny", *options, "--out", "weights.csv", cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    header, weights = rows(tmp_path / "weights.csv")
    np.testing.assert_allclose(weights[:, header.index("jawOpen")], [0.2, 0.4, 0.6], atol=0.01)
    if HEADSET not in ready_made_models():
        pytest.skip(f"{HEADSET} is not in this clone; a small network answered")
    done = installed(*("regress", "headset", "predict", *PICTURES, "--out", "sample.csv"), cwd=tmp_path)
    assert done.returncode == 0, done.stderr
    assert_headset_as_recorded(tmp_path / "sample.csv")


def test_all_that_runs_imports_and_what_is_absent_is_named(installed, tmp_path: Path):
    done = installed("python", "-c", IMPORT_ALL, cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    for program in PACKAGES:
        assert installed(program, "--help", cwd=tmp_path).returncode == 0
    lacking = {
        "live": ("track", "run", "--camera", SAMPLES / "headset" / "left_eye", "--no-page"),
        "room": ("room", "serve"),
        "factory": ("facegen", "generate", ROOT / "datasets" / "tiny.toml", "--out", "data"),
        "learn": ("regress", "train", "data", "--out", "model"),
        "headset": ("regress", "headset", "train", "data", "--out", "model"),
    }
    for extra, words in lacking.items():
        done = installed(*words, cwd=tmp_path)
        assert (done.returncode, done.stdout, len(done.stderr.splitlines())) == (2, "", 1), done.stderr
        assert f"needs the {extra} extra" in done.stderr
        assert f"pip install 'facegen[{extra}]'" in done.stderr
    assert {path.name for path in tmp_path.iterdir()} == {"temporary"}
