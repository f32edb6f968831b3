"""A trained model's page: every figure of the record, nothing from elsewhere."""

import dataclasses
import re
from html.parser import HTMLParser

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.errors import ModelError, OutputError
from regress.learning.training import Recipe, train
from regress.report import content_of, render_page, write_report
from regress.runtime.model import load_model, save_model
from regress.targets import VISIBLE_SHAPES
from tests.regress.drawn import drawn_dataset


@pytest.fixture(scope="module")
def model():
    dataset = drawn_dataset(np.random.default_rng(4), people=60)
    return train(dataset, Recipe(name="quick", steps=4, alphas=(1.0, 10.0)))


@pytest.fixture(scope="module")
def page(model):
    return render_page(content_of(model))


class Outline(HTMLParser):
    """Open tags and addresses of a page; complains of tags that do not close."""

    EMPTY = frozenset({"meta", "line", "rect", "path", "img"})

    def __init__(self):
        super().__init__()
        self.open, self.addresses, self.places = [], [], []

    def handle_starttag(self, tag, attrs):
        self.addresses += [value for key, value in attrs if key in ("src", "href", "xlink:href", "action")]
        self.places += [f"#{value}" for key, value in attrs if key == "id"]
        if tag not in self.EMPTY:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        pass

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def test_page_is_well_formed_and_fetches_nothing(page):
    outline = Outline()
    outline.feed(page)
    assert outline.open == []
    # the contents list names every section once, and nothing else is asked for
    assert outline.addresses == outline.places
    assert len(outline.addresses) == page.count("<h2")
    assert not re.search(r"https?://|@import|url\(", page)


def test_page_holds_every_shape_with_its_figures(model, page):
    rows = dict(re.findall(r"<tr><td>(\w+)</td>(.*?)</tr>", page))
    assert set(rows) == set(BLENDSHAPES) - {"tongueOut"}
    for shape, scores in model.record.scores.items():
        shown = re.findall(r">([^<]+)</td>", rows[shape])
        figures = [scores[method].r2 for method in ("network", "ridge", "mean")]
        figures += [scores[method].mae for method in ("network", "ridge", "mean")]
        figures += [scores[method].pearson for method in ("network", "ridge")]
        for text, figure in zip(shown, figures, strict=True):
            if figure is None:
                assert text == "\N{EN DASH}"
            else:
                assert float(text.replace("\N{MINUS SIGN}", "-")) == pytest.approx(figure, abs=6e-4)


def test_page_opens_with_both_figures_of_both_kinds_of_points(model, page):
    opening = page[: page.index("<nav")]
    shown = re.findall(r"<td><b>([^<]+)</b></td>", opening)
    recorded = [
        getattr(model.record, points)[networks].mean_r2_visible
        for points in ("summary", "as_detected")
        for networks in ("network", "calibrated")
    ]
    assert [float(text.replace("\N{MINUS SIGN}", "-")) for text in shown] == pytest.approx(recorded, abs=6e-4)
    floors = [
        figures[f"{of}{ridge}"].mean_r2_visible
        for figures, ridge in (
            (model.record.summary, "ridge"),
            (
                model.record.as_detected,
                "ridge_same_rows" if "ridge_same_rows" in model.record.as_detected else "ridge",
            ),
        )
        for of in ("", "calibrated_")
    ]
    shown = re.findall(r"</td><td>([^<]+)</td>", opening)
    assert [float(text.replace("\N{MINUS SIGN}", "-")) for text in shown] == pytest.approx(floors, abs=6e-4)
    assert "always the same way" not in opening
    assert "its ridge is trained on exact points, as the networks are, and a dash" in opening, (
        "nothing displaced"
    )
    record = dataclasses.replace(model.record, recipe=model.record.recipe | {"noise": {}})
    noisy = render_page(content_of(dataclasses.replace(model, record=record)))
    assert "its ridge is trained on the networks' own displaced rows, and a dash" in noisy
    old = {name: means for name, means in model.record.as_detected.items() if "ridge" not in name}
    old = dataclasses.replace(model, record=dataclasses.replace(model.record, as_detected=old))
    opening = render_page(content_of(old)).partition("<nav")[0]
    assert re.findall(r"</td><td>([^<]+)</td>", opening)[2:] == ["\N{EN DASH}"] * 2


@pytest.mark.parametrize(
    ("recipe", "said"),
    [
        (
            Recipe(name="s", denoise=True, symmetric=True),
            ("179 of a frame: the 178 edges", "20 trained a network, 40 run"),
        ),
        (Recipe(name="p"), ("178 of a frame: the edges", "<dd>20 a network</dd>")),
    ],
)
def test_page_explains_how_many_distances_and_units(recipe, said):
    dataset = drawn_dataset(np.random.default_rng(4), people=40)
    quick = dataclasses.replace(recipe, steps=2, alphas=(1.0,), search_rows=100)
    page = render_page(content_of(train(dataset, quick)))
    for words in said:
        assert words in page


def test_page_says_what_a_neutral_frame_brings(model, page):
    start = page.index(">What a neutral frame brings</h2>")
    shown = re.findall(r"<td>([^<]+)</td>\s*</tr>", page[start : page.index("<h2", start)])
    recorded = [
        getattr(getattr(model.record, landmarks)["calibrated"], key)
        for landmarks in ("summary", "as_detected")
        for key in ("mean_r2_visible", "mean_r2")
    ]
    assert [float(text.replace("\N{MINUS SIGN}", "-")) for text in shown] == pytest.approx(recorded, abs=6e-4)
    without = dataclasses.replace(model, calibrated=None)
    summary = {key: value for key, value in model.record.summary.items() if key != "calibrated"}
    without = dataclasses.replace(without, record=dataclasses.replace(model.record, summary=summary))
    assert "neutral frame" not in render_page(content_of(without))


def test_page_says_plainly_what_cannot_be_seen(model, page):
    start = page.index(">What 68 points cannot show</h2>")
    section = page[start : page.index("<h2", start)]
    named = set(re.findall(r"<code>(\w+)</code>", section))
    scores = {shape: scores["network"].r2 for shape, scores in model.record.scores.items()}
    weak = {shape for shape, r2 in scores.items() if r2 is not None and r2 < 0.3}
    inferred = set(scores) - set(VISIBLE_SHAPES) - weak
    assert weak, "the drawn faces are meant to hide some shapes"
    assert named == weak | inferred | {"tongueOut", "browInnerUp"}
    assert "never moves" in section


def _of_sessions(model, known):
    return _of_dataset(model, people_in_training={"validation": known, "test": known})


def _of_dataset(model, **changes: object):
    dataset = dataclasses.replace(model.record.dataset, **changes)
    return dataclasses.replace(model, record=dataclasses.replace(model.record, dataset=dataset))


def test_page_calls_nobody_unseen_whom_training_knows(model, page):
    assert page.count("people they have never seen") == 1
    assert "people that appear nowhere in training. 1" in page
    assert "on unseen people" in page
    said = render_page(content_of(_of_sessions(model, 12)))
    assert "faces of people of whom 12 are in training too." in said
    assert "faces that appear nowhere in training, though 12 of their people do. 1" in said
    assert "on faces the networks have never seen" in said
    assert "on unseen faces" in said
    assert "session" not in said, "no one looked whether they are others"
    assert not re.search(r"unseen people|people (they|the networks) have never|people that appear", said)
    old = _of_dataset(model, people_in_training={})
    assert render_page(content_of(old)) == page


def test_page_says_how_the_model_was_made(model, page):
    dataset = model.record.dataset
    for value in (
        dataset.spec_hash,
        dataset.keypoints_sha256,
        "CC0-1.0",
        model.features.reference_sha256,
    ):
        assert value in page


def test_figures_are_drawn(page):
    assert page.count("<svg") == 3 + 1 + 31


def test_names_from_a_dataset_are_escaped(model):
    assert "<script>" not in render_page(content_of(_of_dataset(model, name="<script>alert(1)</script>")))


def test_a_model_read_back_gives_the_same_page(model, page, tmp_path):
    save_model(model, tmp_path / "model")
    path = write_report(load_model(tmp_path / "model"), tmp_path / "new" / "report.html")
    assert path.read_text() == page
    assert list(path.parent.iterdir()) == [path]


def test_a_model_without_a_record_is_refused(model, tmp_path):
    with pytest.raises(ModelError, match=r"no training record.*regress train"):
        write_report(dataclasses.replace(model, record=None), tmp_path / "report.html")


def test_a_place_that_cannot_be_written_is_said(model, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        write_report(model, tmp_path / "file" / "report.html")
