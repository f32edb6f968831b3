"""Models that come with the package: they load, their cards say what they hold, and commands know them by name."""

import json
import shutil
from pathlib import Path

import numpy as np
import pytest

from regress import load_model
from regress.cli.headset_input import model_and_dataset
from regress.errors import InputError
from regress.model_card import card_markdown, describe_model
from regress.runtime import ready_made
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.model import KEYPOINTS
from regress.runtime.ready_made import HEADSET, LANDMARKS, model_folder, ready_made_models
from tests.samples import FACE, PICTURES, assert_face_as_recorded, assert_headset_as_recorded


@pytest.fixture
def points(tmp_path: Path) -> Path:
    np.save(tmp_path / "points.npy", np.random.default_rng(0).normal(size=(3, 68, 2)))
    return tmp_path / "points.npy"


@pytest.mark.parametrize("name", ready_made_models())
def test_a_ready_made_model_loads_and_its_card_is_of_it(name: str):
    folder = ready_made_models()[name]
    card = describe_model(name, folder)
    (load_model if card.kind == KEYPOINTS.name else load_headset_predictor)(name)
    assert (folder / "CARD.md").read_text(encoding="utf-8") == card_markdown(name, folder)
    assert card.sha256 in (folder / "CARD.md").read_text(encoding="utf-8")
    assert card.size_bytes < 10e6


@pytest.mark.parametrize(
    ("rigs", "words"),
    [
        ({"name": "me"}, "All heads come from one rig (`me`), turned"),
        (
            [{"name": "anny", "share": 0.5}, {"name": "me", "share": 0.5}],
            "All heads come from several rigs (`anny`: 50%, `me`: 50%), turned",
        ),
        (None, "All heads come from rigs that its dataset does not name, turned"),
    ],
)
def test_a_card_says_whose_heads_there_were(tmp_path: Path, rigs: object, words: str):
    folder = tmp_path / "model"
    shutil.copytree(ready_made_models()[LANDMARKS], folder)
    model = json.loads((folder / "model.json").read_text())
    model["record"]["dataset"]["rig"] = rigs
    (folder / "model.json").write_text(json.dumps(model))
    assert words in card_markdown("mine", folder)


def test_predict_takes_the_ready_made_model_by_itself_by_name_and_by_folder(run, points: Path):
    folder = ready_made_models()[LANDMARKS]
    calls = [[points], [LANDMARKS, points], [folder, points], [points, "--model", LANDMARKS]]
    answers = [run("predict", *call) for call in calls]
    assert answers[0][0] == 0
    assert len(answers[0][1].splitlines()) == 4
    assert len(set(answers)) == 1


def test_the_samples_hold_what_the_models_answer_today(run, tmp_path: Path):
    assert run("predict", *FACE, "--out", tmp_path / "face.csv")[0] == 0
    assert_face_as_recorded(tmp_path / "face.csv")
    assert run("headset", "predict", *PICTURES, "--out", tmp_path / "headset.csv")[0] == 0
    assert_headset_as_recorded(tmp_path / "headset.csv")


def test_a_model_given_is_the_one_that_answers(run, points: Path, quick_model_folder: Path):
    ready, given = run("predict", points), run("predict", quick_model_folder, points)
    assert given[0] == 0
    assert given[1] != ready[1]
    assert run("predict", points, "--model", quick_model_folder) == given
    for words in ([LANDMARKS, points, "--model", "other"], [LANDMARKS, "other", points]):
        code, _, said = run("predict", *words)
        assert code == 2
        assert "one model and one INPUT are needed" in said


def test_a_folder_of_that_name_goes_before_the_ready_made_model(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.chdir(tmp_path)
    assert model_folder(LANDMARKS) == ready_made_models()[LANDMARKS]
    (tmp_path / LANDMARKS).mkdir()
    assert model_folder(LANDMARKS) == Path(LANDMARKS)
    assert model_folder("nosuch") == Path("nosuch")


def test_one_argument_of_headset_predict_is_a_dataset_if_it_has_pictures(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    dataset, model = tmp_path / "data", tmp_path / "model"
    (dataset / "renders").mkdir(parents=True)
    monkeypatch.setattr("regress.cli.headset_input.ready_made_models", lambda: {HEADSET: model})
    assert model_and_dataset([], None, cameras=True) == (HEADSET, None)
    assert model_and_dataset([dataset], None, cameras=False) == (HEADSET, dataset)
    assert model_and_dataset([model], None, cameras=True) == (model, None)
    assert model_and_dataset([model], None, cameras=False) == (model, None)
    assert model_and_dataset([dataset], "named", cameras=False) == ("named", dataset)
    assert model_and_dataset([], "named", cameras=True) == ("named", None)
    assert model_and_dataset([model, dataset], None, cameras=False) == (model, dataset)
    with pytest.raises(InputError, match="one model and one dataset at most"):
        model_and_dataset([model, dataset], "named", cameras=False)
    monkeypatch.setattr("regress.cli.headset_input.ready_made_models", dict)
    with pytest.raises(InputError, match="no model of headset pictures comes with this installation"):
        model_and_dataset([dataset], None, cameras=False)


def test_models_are_listed_with_the_honest_figure_first(run):
    code, out, _ = run("models")
    assert code == 0
    record = load_model(LANDMARKS).record
    honest, exact = (means["network"].mean_r2_visible for means in (record.as_detected, record.summary))
    assert f"R2 {honest:.3f} as a detector is guessed to put landmarks" in out
    assert out.index(f"{honest:.3f}") < out.index(f"{exact:.3f}")
    listed = json.loads(run("models", "--json")[1])
    assert [card["name"] for card in listed] == list(ready_made_models())
    assert all(Path(card["folder"]).is_dir() for card in listed)


def test_a_model_trained_again_is_compared_and_adopted(
    run, quick_model_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    folder = shutil.copytree(ready_made.FOLDER, tmp_path / "models")
    monkeypatch.setattr("regress.runtime.ready_made.FOLDER", folder)
    same = shutil.copytree(folder / LANDMARKS, tmp_path / "same")
    code, out, _ = run("models", "--against", f"{LANDMARKS}={same}")
    assert (code, "has the same weights" in out, "differs" in out) == (0, True, False)
    (same / "model.json").write_text((same / "model.json").read_text().replace("1.26.4", "2.2.0"))
    code, out, _ = run("models", "--against", f"{LANDMARKS}={same}")
    assert (code, "has the same weights" in out, "differs" in out) == (0, True, True)
    code, out, _ = run("models", "--against", f"{LANDMARKS}={quick_model_folder}")
    assert (code, "has other weights" in out) == (1, True)
    code, _, _ = run("models", "--against", f"{LANDMARKS}={quick_model_folder}", "--adopt")
    assert code == 0
    assert (folder / LANDMARKS / "weights.npz").read_bytes() == (
        quick_model_folder / "weights.npz"
    ).read_bytes()
    assert (folder / LANDMARKS / "CARD.md").read_text() == card_markdown(LANDMARKS, quick_model_folder)
    assert run("models", "--against", f"{LANDMARKS}={quick_model_folder}")[0] == 0


def test_adoption_needs_a_model(run):
    assert run("models", "--adopt")[0] == 2
    assert "is not NAME=FOLDER" in run("models", "--against", "models/default")[2]
