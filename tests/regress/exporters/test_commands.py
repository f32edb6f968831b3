"""``regress export`` and ``regress report``, as a person runs them."""

from importlib import import_module

import numpy as np
import pytest

from regress.cli import main
from regress.learning.training import Recipe, train
from regress.runtime.model import save_model
from tests.regress.drawn import drawn_dataset


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    dataset = drawn_dataset(np.random.default_rng(4), people=40)
    path = tmp_path_factory.mktemp("models") / "quick"
    save_model(train(dataset, Recipe(name="quick", steps=2, alphas=(1.0,))), path)
    return path


@pytest.fixture
def run(monkeypatch):
    """``run(*arguments)`` gives the exit code."""

    def call(*arguments):
        monkeypatch.setattr("sys.argv", ["regress", *map(str, arguments)])
        with pytest.raises(SystemExit) as stopped:
            main()
        return int(stopped.value.code or 0)

    return call


def test_export_writes_all_formats_and_names_them(run, folder, tmp_path, capsys):
    assert run("export", folder, "--out", tmp_path / "out", "--name", "avatar") == 0
    written = {path.name for path in (tmp_path / "out").iterdir()}
    assert written == {
        "avatar.onnx",
        "avatar-networks.onnx",
        "avatar.h",
        "avatar.c",
        "avatar.json",
        "avatar.npz",
        "avatar.js",
        "avatar.d.ts",
    }
    printed = capsys.readouterr().out
    assert all(name in printed for name in written)


def test_export_writes_one_format(run, folder, tmp_path):
    assert run("export", folder, "--format", "npz", "--out", tmp_path) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["face.npz"]


def test_export_of_something_else_is_bad_input(run, tmp_path, capsys):
    assert run("export", tmp_path, "--out", tmp_path / "out") == 2
    assert "model.json" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_a_bad_name_writes_nothing_in_any_format(run, folder, tmp_path, capsys):
    assert run("export", folder, "--out", tmp_path / "out", "--name", "my-face") == 2
    assert "letters, digits and underscores" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


def test_report_writes_one_page(run, folder, tmp_path, capsys):
    assert run("report", folder, "--out", tmp_path / "report.html") == 0
    assert capsys.readouterr().out.strip() == str(tmp_path / "report.html")
    assert [path.name for path in tmp_path.iterdir()] == ["report.html"]


def test_export_without_the_learn_extra_leaves_onnx_out_and_says_so(
    run, folder, tmp_path, capsys, monkeypatch
):
    monkeypatch.setattr(import_module("regress.cli.export"), "find_spec", lambda name: None)
    assert run("export", folder, "--out", tmp_path / "out") == 0
    suffixes = {path.suffix for path in (tmp_path / "out").iterdir()}
    assert suffixes == {".h", ".c", ".json", ".npz", ".js", ".ts"}
    assert "pip install 'facegen[learn]'" in capsys.readouterr().err


def test_a_wrong_model_is_told_alone_without_the_learn_extra_too(run, capsys, monkeypatch):
    monkeypatch.setattr(import_module("regress.cli.export"), "find_spec", lambda name: None)
    assert run("export", "landmark-default") == 2
    (said,) = capsys.readouterr().err.splitlines()
    assert said.endswith("ready-made one: landmarks-default, or of headsets headset-any, headset-tracking3")
