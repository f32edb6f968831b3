"""Benchmark sets: a set's rows are measured again, other data are refused, and the docs show what the sets hold."""

import hashlib
import importlib.util
import json
import re
import sys
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.learning.training import read_dataset
from regress.runtime.ready_made import ready_made_models

ROOT = Path(__file__).parents[2]
SETS = sorted((ROOT / "benchmarks" / "sets").glob("*.toml"))


@pytest.fixture(scope="module")
def score():
    spec = importlib.util.spec_from_file_location("score", ROOT / "benchmarks" / "score.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules["score"] = module
    spec.loader.exec_module(module)
    return module


@pytest.fixture
def small(score, dataset_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A set of the drawn dataset."""
    sha256 = read_dataset(dataset_folder).sha256
    path = tmp_path / "small.toml"
    path.write_text(
        f'kind = "landmarks"\nspec = "drawn"\nkeypoints_sha256 = "{sha256}"\nsplit = "test"\nmodel = "yours"\n'
    )
    monkeypatch.setattr(score, "SETS", tmp_path)
    return path


@pytest.fixture
def run(score, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]):
    def call(*words: object) -> tuple[object, str, str]:
        monkeypatch.setattr(sys, "argv", ["score.py", *map(str, words)])
        code = 0
        try:
            score.main()
        except SystemExit as stop:
            code = stop.code
        return code, *capsys.readouterr()

    return call


def test_a_set_measures_its_own_rows_again(run, small: Path, dataset_folder: Path, quick_model_folder: Path):
    words = ("small", "--data", dataset_folder, "--model", quick_model_folder)
    code, rows, _ = run(*words, "--toml")
    assert code == 0
    small.write_text(small.read_text() + rows)
    # nearly exact and detected points, without and with a neutral face, for networks and ridge regression; the mean
    assert len(tomllib.loads(small.read_text())["row"]) == 2 * 2 * 2 + 1
    code, table, said = run(*words, "--check")
    assert (code, said.strip()) == (0, "every recorded row is measured again")
    assert table.count("\n") == 2 + 9
    first = re.search(r"r2 = \[(-?[\d.]+)", rows)
    worse = f"r2 = [{float(first[1]) - 0.01:.3f}"
    small.write_text(small.read_text().replace(first[0], worse, 1))
    code, _, said = run(*words, "--check")
    assert code == 1
    assert said.startswith("yours, nearly exact points: r2 is ")


def test_predictions_of_anybody_are_scored(run, small: Path, dataset_folder: Path, tmp_path: Path):
    dataset = read_dataset(dataset_folder)
    rows = (dataset.split == "test") & ~dataset.neutral & (dataset.neutral_rows() >= 0)
    np.save(tmp_path / "perfect.npy", dataset.weights[rows])
    code, table, _ = run("small", "--data", dataset_folder, "--predictions", tmp_path / "perfect.npy")
    assert code == 0
    assert "| yours |  | 1.000 (1.000 to 1.000) | 0.000 (0.000 to 0.000) |" in table
    np.save(tmp_path / "short.npy", dataset.weights[rows][:3])
    code, _, _ = run("small", "--data", dataset_folder, "--predictions", tmp_path / "short.npy")
    assert f"(3, {len(BLENDSHAPES)}), but must have ({rows.sum()}, {len(BLENDSHAPES)})" in code


def test_other_data_and_unknown_sets_are_refused(run, small: Path, dataset_folder: Path):
    small.write_text(re.sub(r'sha256 = "\w{4}', 'sha256 = "0000', small.read_text()))
    assert "make them from the set's spec" in run("small", "--data", dataset_folder)[0]
    assert "there are small" in run("large", "--data", dataset_folder)[0]


def test_other_frames_of_the_same_headset_data_are_refused(score):
    rng = np.random.default_rng(0)
    arrays = SimpleNamespace(
        split=np.array(["train", *["test"] * 4]),
        neutral=np.array([False, True, False, False, False]),
        sample=np.arange(5),
        person=np.array([0, 1, 1, 2, 2]),
        weights=rng.uniform(size=(5, 52)).astype(np.float32),
    )
    found = score.scored(arrays, "test")
    assert (found["rows"], found["people"]) == (3, 2)
    benchmark = {"split": "test", **found}
    score.check_scored("small", found, benchmark)
    order = SimpleNamespace(**{name: values[::-1] for name, values in vars(arrays).items()})
    score.check_scored("small", score.scored(order, "test"), benchmark)  # packed in another order
    fewer = SimpleNamespace(**{name: values[:4] for name, values in vars(arrays).items()})
    with pytest.raises(score.InputError, match="rows of the split test is 2, and small has 3"):
        score.check_scored("small", score.scored(fewer, "test"), benchmark)
    arrays.weights[3, 0] += 0.1
    with pytest.raises(score.InputError, match="scored_sha256"):
        score.check_scored("small", score.scored(arrays, "test"), benchmark)


def test_an_interval_of_r2_is_of_errors_and_not_of_who_moves(score):
    # all err by as much, half of them hardly move: whoever is drawn, the errors are the same
    person = np.repeat(np.arange(20), 10)
    true = np.where(person % 2, 0.01, 1.0)[:, None] * np.tile(np.linspace(-1, 1, 10), 20)[:, None]
    value, low, high = score.r2_interval(true + 0.1, true, person)
    assert low == pytest.approx(value)
    assert high == pytest.approx(value)


def test_intervals_hold_the_figure_and_shrink_with_more_people(score):
    rng = np.random.default_rng(2)
    widths = []
    for people in (20, 320):
        person = np.repeat(np.arange(people), 5)
        true = rng.uniform(size=(len(person), 3))
        # people differ in how well they are read, frames of one person hardly
        spread = rng.uniform(0.05, 0.3, people)[person][:, None]
        predicted = true + spread * rng.standard_normal(true.shape)
        value, low, high = score.r2_interval(predicted, true, person)
        assert value == pytest.approx(np.mean(1 - ((predicted - true) ** 2).mean(0) / true.var(0)))
        assert low < value < high
        widths.append(high - low)
        mean, low, high = score.interval(*score.by_person(np.abs(predicted - true).mean(axis=1), person))
        assert mean == pytest.approx(np.abs(predicted - true).mean())
        assert low < mean < high
    assert widths[1] < widths[0] / 2


@pytest.mark.parametrize("path", SETS, ids=lambda path: path.stem)
def test_a_set_goes_with_its_spec_model_and_docs(path: Path):
    benchmark = tomllib.loads(path.read_text())
    assert (ROOT / benchmark["spec"]).is_file()
    page = (ROOT / "docs" / "benchmarks.md").read_text()
    model = ready_made_models()[benchmark["model"]]
    record = json.loads((model / "model.json").read_text())
    if "replaced_by" in benchmark:  # its data are made by older commits, which its first lines name
        assert (path.parent / f"{benchmark['replaced_by']}.toml") in SETS
        assert f"`{path.stem}`" in page
        return
    # another network has other rows: measure them anew by benchmarks/score.py, and then write this key
    network = model / ("network.onnx" if benchmark["kind"] == "headset" else "weights.npz")
    assert hashlib.sha256(network.read_bytes()).hexdigest() == benchmark["network_sha256"]
    if benchmark["kind"] == "headset":
        assert record["dataset_hash"] == benchmark["dataset_hash"]
        assert {"rows", "people", "scored_sha256"} <= benchmark.keys()
    else:
        trained = record["record"]["dataset"]
        assert trained["keypoints_sha256"] == benchmark["keypoints_sha256"]
        assert trained["spec_hash"] == benchmark["spec_hash"]
    for row in benchmark["row"]:
        figures = (row[key] for key in row if key not in ("method", "given"))
        cells = " | ".join(
            f"{mean:.3f} ({ends[0]:.3f} to {ends[1]:.3f})" if ends else f"{mean:.3f}"
            for mean, *ends in figures
        )
        assert f"| {row['method']} | {row['given']} | {cells} |" in page
