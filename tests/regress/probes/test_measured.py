"""All probes on a trained model, as the page and the JSON file tell them."""

import asyncio
import dataclasses
import json
import math
import re

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX
from regress.errors import InputError
from regress.learning.probes import figures_of, measure, read_faces
from regress.learning.probes.observability import NOISE_PERCENT
from regress.learning.training import Recipe, evaluate_model, read_dataset, train
from regress.learning.training.noise import DetectorNoise
from regress.report import write_report
from regress.runtime.model import save_model
from regress.targets import OUTPUTS, VISIBLE_SHAPES
from tests.browser import chromium, needs_chromium
from tests.regress.conftest import write_dataset
from tests.regress.drawn import drawn_heads

pytestmark = pytest.mark.slow

NOISY = Recipe(
    name="noisy",
    alphas=(1.0, 10.0),
    steps=4,
    hidden=4,
    noise=DetectorNoise(bias=0.5),
    calibrated_noise=DetectorNoise(bias=1.0),
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("heads") / "drawn"
    dataset, columns = drawn_heads(np.random.default_rng(8), people=50)
    write_dataset(dataset, folder, more=columns)
    return folder


@pytest.fixture(scope="module")
def model(folder):
    return train(read_dataset(folder), NOISY, seed=2)


@pytest.fixture(scope="module")
def measured(model, folder):
    return measure(model, folder)


@pytest.fixture(scope="module")
def page(model, measured, tmp_path_factory):
    return write_report(model, tmp_path_factory.mktemp("page") / "report.html", measured).read_text()


@needs_chromium
def test_the_page_fits_a_telephone(page, tmp_path):
    """Nothing reaches beyond a window of 400 pixels but what scrolls by itself, and no word of a bar is cut."""
    path = tmp_path / "report.html"
    path.write_text(page)
    beyond = (
        "[...document.querySelectorAll('main *')].filter(e => !e.closest('.wide')"
        " && e.getBoundingClientRect().right > innerWidth + 1).map(e => e.outerHTML.slice(0, 80))"
    )
    cut = (
        "[...document.querySelectorAll('.score > span')].filter(e => e.scrollWidth > e.clientWidth + 1)"
        ".map(e => e.textContent)"
    )

    async def looked() -> None:
        async with chromium() as browser, browser.open(path.as_uri()) as tab:
            await tab.look(width=400, height=900)
            await tab.until("document.readyState == 'complete'")
            await tab.ask("document.querySelectorAll('details').forEach(one => one.open = true)")
            assert await tab.ask("document.documentElement.scrollWidth") == 400
            assert await tab.ask(beyond) == []
            assert await tab.ask(cut) == []
            # every picture of a head is one that the browser can draw
            heads = "[...document.querySelectorAll('img.head')]"
            assert await tab.ask(f"{heads}.length") > 20
            assert await tab.ask(f"{heads}.every(one => one.complete && one.naturalWidth > 0)")
            assert all(url.startswith("data:") for url in tab.asked if url != path.as_uri())
            assert tab.complaints == []

    asyncio.run(looked())


def test_examples_go_from_well_read_to_badly_read(measured):
    alone = [one.readings[0] for one in measured.examples]
    assert not any(one.detected or one.calibrated for one in alone)
    assert sorted(one.mae for one in alone) == [one.mae for one in alone]
    for example in measured.examples:
        assert len({(one.detected, one.calibrated) for one in example.readings}) == 4
        for one in example.readings:
            error = np.abs(one.weights - example.true)[[BLENDSHAPE_INDEX[name] for name in VISIBLE_SHAPES]]
            assert error.mean() == pytest.approx(one.mae)


def test_columns_are_read_as_they_were_written(folder):
    dataset, columns = drawn_heads(np.random.default_rng(8), people=50)
    faces = read_faces(folder)
    np.testing.assert_allclose(faces.points_m, columns["points_3d"], atol=1e-7)
    np.testing.assert_allclose(faces.camera_from_head, columns["camera_from_head"], atol=1e-7)
    np.testing.assert_array_equal(faces.split, dataset.split)


def test_noiseless_figures_are_those_of_an_evaluation(model, measured, folder):
    scores = evaluate_model(model, read_dataset(folder), calibrated=True)
    (found,) = (one for one in measured.observability if one.method == "networks" and one.calibrated)
    for name, r2 in zip(OUTPUTS, found.r2[NOISE_PERCENT.index(0.0)], strict=True):
        if scores[name].r2 is None:
            assert math.isnan(r2)
        else:
            assert r2 == pytest.approx(scores[name].r2, abs=1e-4)


def test_both_floors_are_told_apart(model, measured):
    floors = {(one.method, one.calibrated): one.r2[0] for one in measured.observability}
    for calibrated, begins in ((False, ""), (True, "calibrated_")):
        for method, name in (("ridge, undisplaced rows", "ridge"), ("ridge, same rows", "ridge_same_rows")):
            # the record scores all faces where nothing is compared with a neutral one, probes those beside one
            tolerance = 1e-4 if calibrated else 0.15
            recorded = [
                model.record.scores[shape][begins + name].r2 for shape in OUTPUTS if shape != "browInnerUp"
            ]
            found = np.delete(floors[method, calibrated], OUTPUTS.index("browInnerUp"))
            np.testing.assert_allclose(found, recorded, atol=tolerance)
    assert not np.allclose(
        floors["ridge, same rows", True], floors["ridge, undisplaced rows", True], equal_nan=True
    )
    assert set(model.record.floors) == {
        "ridge",
        "ridge_same_rows",
        "calibrated_ridge",
        "calibrated_ridge_same_rows",
    }


def test_the_page_shows_every_probe(measured, page):
    for title in (
        "noise leaves",
        "Turned heads",
        "person to person",
        "leaks into",
        "One eye shut",
        "worst faces",
    ):
        assert title in page
    drawings = 3 + 1 + 31  # regressions, mean and small curves
    assert page.count("<svg") == drawings + 2 * 3 + len(measured.examples)
    heads = 5 * len(measured.examples) + 2 * 2 * len(measured.people_errors[0].worst)
    assert page.count('<img class="head"') == heads
    assert "The test curve lies under the others" in page
    start = page.index("What noise leaves")
    first = re.search(r"networks</td>((?:<td>[^<]+</td>)+)", page[start:]).group(1)
    shown = [float(text.replace("\N{MINUS SIGN}", "-")) for text in re.findall(r"<td>([^<]+)<", first)]
    visible = [OUTPUTS.index(name) for name in VISIBLE_SHAPES]
    assert shown == pytest.approx(np.nanmean(measured.observability[0].r2[:, visible], axis=1), abs=6e-4)


def test_the_command_writes_page_and_figures(model, measured, folder, run, tmp_path):
    save_model(model, tmp_path / "model")
    page, figures = tmp_path / "report.html", tmp_path / "figures.json"
    code, said, _ = run("report", tmp_path / "model", "--data", folder, "--out", page, "--figures", figures)
    assert code == 0
    assert said.strip() == str(page)
    found = json.loads(figures.read_text())  # measured a second time: equal to the last digit
    assert found == json.loads(json.dumps(figures_of(measured)))
    assert len(found["poses"][0]["loss"]) == len(OUTPUTS)


def test_probed_faces_of_known_people_are_not_called_unseen_peoples(model, measured, page, tmp_path):
    assert len(re.findall(r"[uU]nseen people", page)) == 3
    dataset = dataclasses.replace(model.record.dataset, people_in_training={"validation": 4, "test": 4})
    record = dataclasses.replace(model.record, dataset=dataset)
    said = write_report(
        dataclasses.replace(model, record=record), tmp_path / "report.html", measured
    ).read_text()
    assert "people, 4 of them in training too, with normal noise" in said
    assert "Test faces with the largest mean error" in said
    assert not re.search(r"[uU]nseen people", said)


def test_figures_without_data_are_refused(quick_model_folder, run, tmp_path):
    code, _, said = run("report", quick_model_folder, "--figures", tmp_path / "figures.json")
    assert code == 2
    assert "--data" in said


def test_another_dataset_than_the_models_is_refused(quick_model, folder):
    with pytest.raises(InputError, match=r"SHA-256 .*give the dataset that it was trained on"):
        measure(quick_model, folder)


def test_a_dataset_without_exact_points_is_refused(quick_model, dataset, dataset_folder):
    with pytest.raises(InputError, match=r"lacks the column 'points_2d'.*leave --data out"):
        read_faces(dataset_folder)


def test_a_dataset_without_neutral_faces_has_the_other_probes(model, folder, tmp_path):
    dataset, columns = drawn_heads(np.random.default_rng(8), people=50)
    rows = np.flatnonzero(~dataset.neutral)
    columns = {name: values[rows] for name, values in columns.items()}
    write_dataset(dataset.take(rows), tmp_path / "data", more=columns)
    given = read_dataset(tmp_path / "data")
    dataset = dataclasses.replace(model.record.dataset, keypoints_sha256=given.sha256)
    record = dataclasses.replace(model.record, dataset=dataset)
    alone = dataclasses.replace(model, calibrated=None, record=record)
    found = measure(alone, tmp_path / "data")
    assert found.cross_talk == ()
    assert len(found.poses) == len(found.stillness) == 1
    page = write_report(alone, tmp_path / "report.html", found).read_text()
    assert "no neutral faces" in page
    assert "leaks into" not in page


def test_people_without_a_neutral_face_are_said(folder):
    faces = read_faces(folder)
    expressive = faces.take(np.flatnonzero(~faces.neutral))
    with pytest.raises(InputError, match="no face of the test split beside a neutral one"):
        expressive.beside_neutral("test")
