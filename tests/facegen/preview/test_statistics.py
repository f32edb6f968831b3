"""The page of statistics says what the keypoints say."""

import re
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError
from facegen.preview import dataset_statistics, statistics_page
from facegen.rigs import measures_mm
from facegen.rigs.callipers import MEASURES
from facegen.sampling.people import draw_people
from facegen.spec import parse_spec
from facegen.store import Dataset, resolve
from facegen.work import generate

pytestmark = pytest.mark.slow

SPEC = {
    "version": 1,
    "kind": "still",
    "seed": 4,
    "people": 60,
    "still": {"neutral": 1, "faces": 3},
    "head": {"yaw_deg": 20.0, "pitch_deg": {"uniform": [-8, -4]}, "roll_deg": 3.0},
    "gaze": {"yaw_deg": {"uniform": [5, 15]}, "pitch_deg": -7.0, "distance_m": 100.0},
}


@pytest.fixture(scope="module")
def dataset(anny, tmp_path_factory) -> Dataset:
    made = resolve(parse_spec(SPEC, where="test"), tmp_path_factory.mktemp("statistics") / "out")
    generate(made, workers=1)
    return made


def test_figures_are_those_of_the_spec(dataset):
    found = dataset_statistics(dataset)
    assert (found.rows, found.people, found.counts["component"]["neutral"]) == (240, 60, 60)
    assert sum(found.counts["split"].values()) == sum(found.counts["sex"].values()) == 240
    yaw, pitch, roll = found.head_deg.T
    np.testing.assert_allclose(yaw, 20, atol=1e-6)
    np.testing.assert_allclose(roll, 3, atol=1e-6)
    assert -8 <= pitch.min() < -7
    assert -5 < pitch.max() <= -4
    assert len(found.gaze_deg) == 180
    assert found.age_years.shape == (60,)


def test_heads_are_measured_in_millimetres_each_person_once(dataset):
    measures = dataset_statistics(dataset).measures
    by_name = {name: [m for m in measures if m.name == name] for name in {m.name for m in measures}}
    assert {sum(m.people for m in of) for of in by_name.values()} == {60}
    for measure in by_name["interpupillary distance"]:
        assert 50 < measure.low < measure.mean < measure.high < 80
    # the rig is linear in identity, so a mean over people is measured on the people themselves
    _, first = np.unique(dataset.array("person"), return_index=True)
    (rig,) = dataset.rigs
    people = measures_mm(rig, dataset.array("identity")[first].astype(float))
    assert set(people) == set(by_name) == set(MEASURES)
    for name, values in people.items():
        weighed = sum(m.people * m.mean for m in by_name[name]) / 60
        assert weighed == pytest.approx(values.mean(), rel=1e-6)


def test_measures_are_those_of_the_docs(anny):
    """Tables of docs/population.md: 2,000 people by the default spec."""
    text = (Path(__file__).parents[3] / "docs" / "population.md").read_text()
    rows = re.findall(r"^\| ([a-z ]+) \| (women|men) \| ([\d.]+) \| ([\d.]+) \|", text, re.MULTILINE)
    assert len(rows) == 2 * len(MEASURES)
    table = {
        "version": 1,
        "kind": "still",
        "people": 1000,
        "rig": "anny",
        "still": {"neutral": 1, "faces": 0},
    }
    drawn = [draw_people(parse_spec(table | {"seed": seed}, where="docs"), anny, 0) for seed in (1, 2)]
    found = measures_mm(anny, np.concatenate([block.identity for block in drawn]))
    female = np.concatenate([block.female for block in drawn])
    for name, sex, mean, sd in rows:
        values = found[name][female == (sex == "women")]
        assert (f"{values.mean():.1f}", f"{values.std():.1f}") == (mean, sd), (name, sex)


def test_the_page_is_one_file_and_equal_data_give_equal_text(dataset):
    page = statistics_page(dataset, dataset_statistics(dataset))
    assert page == statistics_page(dataset, dataset_statistics(dataset))
    assert page.count("<svg") == 4
    # what is wider than a telephone moves sideways in a box of its own
    assert len(re.findall(r'<div class="wide">\s*<(?:table|\?xml|svg)', page)) == page.count("<svg") + 1
    assert not re.search(r'(src|href)="http', page)
    assert "browInnerUp" in page


def test_one_person_has_no_standard_deviation(anny, tmp_path):
    spec = parse_spec(SPEC | {"people": 3}, where="test")
    made = resolve(spec, tmp_path / "out")
    generate(made, workers=1)
    found = dataset_statistics(made)
    assert all((measure.sd is None) == (measure.people == 1) for measure in found.measures)
    assert {1, 2} == {measure.people for measure in found.measures}
    assert "<td>–</td>" in statistics_page(made, found)


@pytest.mark.parametrize(("flag", "value"), [("--no-exr", []), ("--exr", []), ("--views", ["left_eye"])])
def test_options_of_pictures_are_refused_where_there_are_none(dataset, tmp_path, flag, value):
    refusal = (
        CliRunner()
        .invoke(app, ["pack", str(dataset.folder.path), "--out", str(tmp_path / "packs"), flag, *value])
        .exception
    )
    assert isinstance(refusal, InputError)
    assert f"packed as keypoints, and {flag} is about pictures" in str(refusal)
    assert not (tmp_path / "packs").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--clip", "0", "--fps", "10", "--out", "a.webm"], "--clip takes no --fps"),
        (["--clip", "0", "--rig", "ict", "--out", "a.webm"], "--clip takes no --rig"),
        (["--frames", "0-9", "--out", "a.png"], "a contact sheet takes no --frames"),
        (["--size", "300", "--out", "a.png"], "a contact sheet takes no --size"),
        (["--samples", "0", "--out", "a.html"], "a page of statistics takes no --samples"),
        (
            ["--no-landmarks", "--out", "a.html"],
            "a page of statistics takes no --landmarks or --no-landmarks",
        ),
        (["--weights", "t.csv", "--clip", "0", "--out", "a.png"], "--weights takes no --clip"),
        (["--weights", "t.csv", "--columns", "3", "--out", "a.png"], "--weights takes no --columns"),
    ],
)
def test_options_that_would_do_nothing_are_refused(dataset, words, said):
    where = [] if "--weights" in words else [str(dataset.folder.path)]
    refusal = CliRunner().invoke(app, ["preview", *where, *words]).exception
    assert isinstance(refusal, InputError)
    assert f"{said}; leave that out" in str(refusal)
