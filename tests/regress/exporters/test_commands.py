"""``regress export`` and ``regress report``, as a person runs them."""

import io
import re
from importlib import import_module
from pathlib import Path

import numpy as np
import onnxruntime
import pytest

from regress.cli import main
from regress.cli.export import export
from regress.learning.training import Recipe, train
from regress.runtime.inputs import read_frames
from regress.runtime.model import save_model
from tests.regress.drawn import drawn_dataset, drawn_faces

DOCS = Path(__file__).resolve().parents[3] / "docs"
TALKING = DOCS / "samples" / "talking-face.csv"


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


def test_the_command_with_which_exports_agree_is_the_one_that_is_named(run, tmp_path, capsys):
    page, said = (DOCS / "exports.md").read_text(encoding="utf-8"), " ".join(export.__doc__.split())
    (options,) = {
        named for text in (page, said) for named in re.findall(r"`regress predict (--[^`]+)`", text)
    }
    assert run("predict", "landmarks-default", TALKING, "--neutral", "1", *options.split()) == 0
    said = np.loadtxt(io.StringIO(capsys.readouterr().out), delimiter=",", skiprows=1)[:, -52:]
    assert run("export", "landmarks-default", "--format", "onnx", "--out", tmp_path) == 0
    points = read_frames(TALKING).points.astype(np.float32)
    session = onnxruntime.InferenceSession(tmp_path / "face.onnx")
    (weights,) = session.run(None, {"points": points, "neutral": points[:1]})
    np.testing.assert_allclose(said, weights, atol=1e-4, rtol=0)


def test_export_writes_one_format(run, folder, tmp_path):
    assert run("export", folder, "--format", "npz", "--out", tmp_path) == 0
    assert [path.name for path in tmp_path.iterdir()] == ["face.npz"]


def test_export_writes_every_format_that_is_named(run, folder, tmp_path):
    """The last one alone was written, without a word."""
    assert run("export", folder, "--format", "npz", "--format", "json", "--out", tmp_path) == 0
    assert sorted(path.name for path in tmp_path.iterdir()) == ["face.json", "face.npz"]


def test_an_export_is_new_as_a_whole_or_not_at_all(run, folder, tmp_path, capsys):
    """A header of another model than its source gives weights by wrong names."""
    for name in ("face.c", "face.h", "face.js"):
        (tmp_path / name).write_text("old")
    (tmp_path / "face.d.ts").mkdir()
    assert run("export", folder, "--format", "c", "--format", "javascript", "--out", tmp_path) == 2
    assert "face.d.ts: is a folder" in capsys.readouterr().err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["face.c", "face.d.ts", "face.h", "face.js"]
    assert {(tmp_path / name).read_text() for name in ("face.c", "face.h", "face.js")} == {"old"}


def test_a_neutral_face_in_shares_of_a_picture_is_put_into_pixels(run, tmp_path, capsys):
    """An export for good: a wide picture taken for a square is another person's face."""
    (face,) = drawn_faces(np.random.default_rng(2), 1)
    face = 300 * (face - face.mean(axis=0)) / np.ptp(face) + [640, 360]
    np.save(tmp_path / "pixels.npy", face[None])
    np.save(tmp_path / "shares.npy", (face[None] + 0.5) / [1280, 720])
    given = ("landmarks-default", "--format", "npz", "--neutral")

    def exported(name, *options):
        assert run("export", *given, tmp_path / f"{name}.npy", *options, "--out", tmp_path / "out") == 0
        with np.load(tmp_path / "out" / "face.npz") as numbers:
            return numbers["feature_mean"]

    pixels = exported("pixels")
    capsys.readouterr()
    np.testing.assert_allclose(exported("shares", "--picture", "1280x720"), pixels, atol=1e-6)
    assert capsys.readouterr().err == ""
    assert np.abs(exported("shares") - pixels).max() > 0.01
    assert "as shares of a picture's width and height" in capsys.readouterr().err
    assert run("export", "landmarks-default", "--picture", "1280x720") == 2
    assert "give --neutral as well" in capsys.readouterr().err


@pytest.mark.parametrize("option", ["--figures", "--out"])
def test_a_report_is_not_written_over_what_is_read(option, run, folder, tmp_path, capsys):
    """Figures end as a model's own file does."""
    before = (folder / "model.json").read_bytes()
    link = tmp_path / ("figures.json" if option == "--figures" else "page.html")
    link.symlink_to(folder / "model.json")
    assert run("report", folder, "--data", tmp_path, option, link) == 2
    assert f"{option} {link} is also what is read" in capsys.readouterr().err
    assert run("report", folder, "--data", tmp_path, "--figures", folder / "model.json") == 2
    assert (folder / "model.json").read_bytes() == before


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
