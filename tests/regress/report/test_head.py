"""The head of reports: what weights say is seen, and its file is what the rig gives."""

import runpy
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.report.head import FILE, WINDOW_M, drawn_head, head_image, load_head

MAKER = Path(__file__).parents[3] / "docs" / "figures" / "report_head.py"


def one(name: str, weight: float = 1.0) -> np.ndarray:
    weights = np.zeros(len(BLENDSHAPES))
    weights[BLENDSHAPE_INDEX[name]] = weight
    return weights


@pytest.fixture(scope="module")
def still() -> np.ndarray:
    return drawn_head(np.zeros(len(BLENDSHAPES)), height_px=105).astype(int)


@pytest.mark.parametrize(
    ("name", "rows"),
    [
        ("jawOpen", (56, 105)),
        ("eyeBlinkLeft", (38, 58)),
        ("browInnerUp", (22, 52)),
        ("eyeLookOutLeft", (38, 58)),
    ],
)
def test_a_shape_changes_the_picture_where_it_moves_the_face(still, name, rows):
    changed = np.abs(drawn_head(one(name), height_px=105) - still).sum(axis=(1, 2))
    assert changed.sum() > 500
    assert changed[slice(*rows)].sum() > 0.9 * changed.sum()


@pytest.mark.parametrize("name", BLENDSHAPES)
def test_no_head_is_cut(name):
    there = drawn_head(one(name), height_px=105)[..., 3] > 0
    assert not there[:2].any()
    assert not there[:80, [0, -1]].any()  # below, shoulders begin
    face = load_head().rest[:, 1] > -0.10
    assert load_head().posed(one(name))[face, 1].min() > WINDOW_M[3] + 4e-3


def test_eyes_turn_without_growing():
    head = load_head()
    rows = slice(head.eye_rows[0], head.eye_rows[1])
    turned = head.posed(one("eyeLookUpLeft"))[rows] - head.eye_center_m[0]
    rest = head.rest[rows] - head.eye_center_m[0]
    np.testing.assert_allclose(np.linalg.norm(turned, axis=1), np.linalg.norm(rest, axis=1), atol=1e-9)
    assert turned[np.argmax(rest[:, 2]), 1] > 4e-3  # the pupil goes up


def test_names_are_escaped():
    assert "<script>" not in head_image(np.zeros(len(BLENDSHAPES)), '"<script>')


def test_the_file_is_what_its_command_makes():
    made = runpy.run_path(str(MAKER))["head_arrays"]()
    with np.load(FILE) as file:
        assert set(file) == set(made)
        for name, values in made.items():
            # the last bits of products differ between processors: by one step of 0.02 mm at most
            np.testing.assert_allclose(file[name].astype(float), values.astype(float), atol=1)
