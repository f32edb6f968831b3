"""The page of statistics says what the keypoints say."""

import re

import numpy as np
import pytest

from facegen.preview import dataset_statistics, statistics_page
from facegen.spec import parse_spec
from facegen.store import Dataset, resolve
from facegen.work import generate

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
    points = dataset.array("points_3d")[dataset.array("neutral")]
    width = 1e3 * np.linalg.norm(points[:, 0] - points[:, 16], axis=1)
    weighed = sum(m.people * m.mean for m in by_name["face width"]) / 60
    assert weighed == pytest.approx(width.mean(), rel=1e-5)


def test_the_page_is_one_file_and_equal_data_give_equal_text(dataset):
    page = statistics_page(dataset, dataset_statistics(dataset))
    assert page == statistics_page(dataset, dataset_statistics(dataset))
    assert page.count("<svg") == 4
    assert not re.search(r'(src|href)="http', page)
    assert "browInnerUp" in page
