"""`regress headset report`: one page with every figure, a rival, a learning curve and the worst frames."""

import base64
import json
import re
import shutil
from dataclasses import replace
from html.parser import HTMLParser
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.comparison import compare
from regress.learning.headset.evaluation import evaluate
from regress.learning.headset.worst import worst_frames
from regress.report.headset_page import Judged, write_headset_report
from regress.runtime.headset.network.figures import ClipSummary, evaluation_to_json
from regress.runtime.headset.network.folder import describe_headset_model, read_headset_model
from regress.runtime.headset.network.model import HeadsetTraining, Temporal
from regress.runtime.headset.network.predictor import load_headset_predictor
from tests.regress.headset.drawn import SIDE
from tests.regress.headset.tiny import NAMES, write_tiny_model

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def models(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Two models of which the second says less, and says that it was trained on fewer people."""
    folder = tmp_path_factory.mktemp("models")
    few = HeadsetTraining(people=5, rows=30)
    return (
        write_tiny_model(folder / "many", width=SIDE, height=SIDE),
        write_tiny_model(folder / "few", width=SIDE, height=SIDE, gain=0.4, training=few),
    )


class Outline(HTMLParser):
    """Open tags and addresses of a page; complains of tags that do not close."""

    EMPTY = frozenset({"meta", "line", "rect", "path", "img"})

    def __init__(self):
        super().__init__()
        self.open, self.addresses, self.places, self.pictures = [], [], [], []

    def handle_starttag(self, tag, attrs):
        named = dict(attrs)
        self.addresses += [value for key, value in attrs if key in ("src", "href") and tag != "img"]
        self.places += [f"#{value}" for key, value in attrs if key == "id"]
        if tag == "img":
            self.pictures.append((named["alt"], named["src"]))
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_the_page_is_whole_and_fetches_nothing(
    run, models: tuple[Path, Path], arrays_folder: Path, arrays: HeadsetArrays, tmp_path: Path
):
    many, few = models
    out, figures = tmp_path / "deep" / "report.html", tmp_path / "figures.json"
    other = shutil.copytree(arrays_folder, tmp_path / "other" / arrays_folder.name)
    words = ["--data", arrays_folder, "--data", other, "--against", few, "--curve", few, "--no-time"]
    code, printed, said = run("headset", "report", many, *words, "--out", out, "--figures", figures)
    assert (code, printed.strip()) == (0, str(out)), said
    page = out.read_text()
    outline = Outline()
    outline.feed(page)
    assert outline.open == []
    assert outline.addresses == outline.places
    assert len(outline.places) == page.count("<h2")
    assert not re.search(r"https?://|@import|url\(", page)
    for word in (
        *BLENDSHAPES,
        "Against few",
        "floor: always the resting face",
        "combined",
        "dense",
        "only mouth",
    ):
        assert word in page
    document = json.loads(figures.read_text())
    predictor = load_headset_predictor(many)
    found = evaluate(predictor.graph, predictor.model, arrays)
    assert page.count(found.few.replace("R2", "R²")) == 1
    assert found.few
    assert not replace(found, rows=200).few
    assert document["data"] == dict.fromkeys(map(str, (arrays_folder, other)), evaluation_to_json(found))
    assert [(one["model"], one["people"]) for one in document["curve"]] == [("few", 5), ("many", 20)]
    assert f"{found.conditions['uncalibrated'].geometry_mm:.3f}" in page
    assert f"{found.shapes['jawOpen']['same_seat'].r2:.3f}".replace("-", "−") in page
    # the worst frames' own pictures, three cameras each and two heads, in both sections
    worst = worst_frames(predictor, arrays)
    assert len(outline.pictures) == 2 * (3 + 2) * len(worst)
    name, source = outline.pictures[0]
    data = base64.b64decode(source.removeprefix("data:image/png;base64,"))
    picture = cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_GRAYSCALE)
    row = int(np.flatnonzero(arrays.sample == worst[0].sample)[0])
    assert np.array_equal(picture, arrays.pictures[name][row])
    again = tmp_path / "again.html"
    run("headset", "report", many, *words, "--out", again)
    assert again.read_bytes() == out.read_bytes()


def test_people_are_called_unseen_in_no_split_that_training_knows(
    run, models: tuple[Path, Path], arrays_folder: Path, arrays: HeadsetArrays, tmp_path: Path
):
    out = tmp_path / "report.html"
    words = ("headset", "report", models[0], "--data", arrays_folder, "--no-time", "--out", out)
    for split, whose in {
        "train": "people of the training split, whom it may have learned from.",
        "test": "people of the test split.",  # the model does not say which data it is of
    }.items():
        assert run(*words, "--split", split)[0] == 0
        page = out.read_text()
        assert f"{len(set(arrays.person[arrays.split == split]))} {whose}" in page
        assert "never seen" not in page
    hashed = arrays.description["dataset_hash"]
    for seed, dataset_hash, unseen in (
        (arrays.description["seed"], "of more people", False),
        (arrays.description["seed"], hashed, True),
        (99, "of more people", True),
        (None, "of more people", False),
    ):
        place = tmp_path / f"{seed}-{dataset_hash}"
        training = HeadsetTraining(people=20, rows=100, data_seed=seed)
        write_tiny_model(place, width=SIDE, height=SIDE, dataset_hash=dataset_hash, training=training)
        assert run("headset", "report", place, *words[3:])[0] == 0
        whose = "people that it has never seen." if unseen else "people of the test split."
        assert f"{len(set(arrays.person[arrays.split == 'test']))} {whose}" in out.read_text()
    predictor = load_headset_predictor(models[0])
    known = np.where(np.arange(len(arrays.split)) % 3 == 0, "train", arrays.split)
    figures = evaluate(predictor.graph, predictor.model, replace(arrays, split=known))
    assert figures.people_in_training == figures.people  # a third of each one's frames
    path = write_headset_report(
        predictor.model, out, [Judged(title="sessions", figures=figures)], name="tiny"
    )
    assert f"{figures.people} people, of whom {figures.people} are in the training split too." in (
        path.read_text()
    )


def test_a_model_is_reported_by_its_own_scores_without_data(
    run, models: tuple[Path, Path], arrays_folder, tmp_path
):
    many, _ = models
    predictor = load_headset_predictor(many)
    from regress.learning.headset.arrays import read_arrays

    scored = write_tiny_model(
        tmp_path / "scored",
        width=SIDE,
        height=SIDE,
        scores=evaluate(predictor.graph, predictor.model, read_arrays(arrays_folder)),
    )
    code, _, said = run("headset", "report", scored, "--out", tmp_path / "report.html")
    assert code == 0, said
    assert "a frame in onnxruntime on one core" in (tmp_path / "report.html").read_text()
    bare = write_tiny_model(tmp_path / "bare", scores=None)
    code, _, said = run("headset", "report", bare, "--out", tmp_path / "none.html")
    assert (code, len(said.splitlines())) == (2, 1)
    assert "give --data to measure some" in said
    code, _, said = run("headset", "report", scored, "--curve", bare, "--out", tmp_path / "none.html")
    assert (code, said.strip()) == (
        2,
        "regress: bare has no scores on a test split; give --data to measure some",
    )
    code, _, said = run("headset", "report", scored, "--data", arrays_folder, "--data", arrays_folder)
    assert (code, said.strip()) == (2, f"regress: --data {arrays_folder} is given twice")


def test_a_report_is_not_written_over_what_is_read(run, models: tuple[Path, Path], arrays_folder: Path):
    many, few = models
    for read in (many / "model.json", few / "model.json", arrays_folder / "arrays.json"):
        before = read.read_bytes()
        given = ("headset", "report", many, "--data", arrays_folder, "--against", few)
        code, _, said = run(*given, "--figures", read)
        assert (code, len(said.splitlines())) == (2, 1)
        assert f"--figures {read} is also what is read" in said
        assert read.read_bytes() == before


def test_what_the_frames_before_add_is_reported(run, arrays_folder: Path, tmp_path: Path):
    folder = write_tiny_model(tmp_path / "tiny", width=SIDE, height=SIDE)
    figures = ClipSummary(
        rows=1234,
        geometry_mm=0.6789,
        r2=0.5,
        mae=0.05,
        rmse=0.1,
        blink_r2=None,
        gaze_deg=2.0,
        gaze_open_deg=None,
        shake=0.01,
    )
    temporal = Temporal(fps=30, taps=((1.0,) * 5,) * 56, people=3, dataset_hash="", scores={"taps": figures})
    describe_headset_model(replace(read_headset_model(folder), temporal=temporal), folder)
    out = tmp_path / "report.html"
    code, _, said = run("headset", "report", folder, "--data", arrays_folder, "--no-time", "--out", out)
    assert code == 0, said
    page = out.read_text()
    for word in ("What the frames before add", "frames before, by their taps", "1,234", "0.679"):
        assert word in page
    assert "clips of the test split" in page
    known = replace(temporal, unseen=True)
    describe_headset_model(replace(read_headset_model(folder), temporal=known), folder)
    assert run("headset", "report", folder, "--data", arrays_folder, "--no-time", "--out", out)[0] == 0
    assert "people whom neither the network nor the taps have seen" in out.read_text()


def test_comparison_is_even_with_itself_and_turns_round(models: tuple[Path, Path], arrays: HeadsetArrays):
    one, other = map(load_headset_predictor, models)
    even = compare(one, one, arrays)
    assert all(entry.better == entry.people == 0.5 for part in vars(even).values() for entry in part.values())
    assert set(even.components) == {"combined", "dense", "lower_face", "upper_face"}
    assert set(even.conditions) >= {"uncalibrated", "same_seat", *(f"without_{name}" for name in NAMES)}
    there, back = compare(one, other, arrays), compare(other, one, arrays)
    figures = evaluate(one.graph, one.model, arrays)
    for part, entries in vars(there).items():
        for name, entry in entries.items():
            turned = getattr(back, part)[name]
            assert entry.better + turned.better == pytest.approx(1)
            assert (entry.geometry_mm, entry.rival_mm) == (turned.rival_mm, turned.geometry_mm)
            if part != "components":
                assert entry.geometry_mm == pytest.approx(getattr(figures, part)[name].geometry_mm)


def test_worst_frames_are_the_worst_of_different_people(models: tuple[Path, Path], arrays: HeadsetArrays):
    found = worst_frames(load_headset_predictor(models[0]), arrays, count=8)
    errors = [frame.geometry_mm for frame in found]
    assert errors == sorted(errors, reverse=True)
    assert len({frame.person for frame in found}) == len(found) == 8
    predictor = load_headset_predictor(models[0])
    people = evaluate(predictor.graph, predictor.model, arrays).people_mm
    assert all(frame.geometry_mm > people[str(frame.person)].mm["uncalibrated"] for frame in found[:1])
