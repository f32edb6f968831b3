"""Keypoint labels: a row follows from its own sample alone, and a picture's labels are the table's."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLOCK, Visibility
from facegen.labels import Keypoints, label_keypoints
from facegen.labels.keypoints import AT_ONCE
from facegen.rigs import Rig, evaluate
from facegen.sampling import Samples, draw_samples, plan_dataset
from facegen.spec import Spec, parse_spec


@pytest.fixture(scope="module")
def turned() -> Spec:
    """Heads turned far before a small picture: all three kinds of visibility occur."""
    table = {
        "version": 1,
        "kind": "still",
        "seed": 12,
        "people": 300,
        "head": {"yaw_deg": {"uniform": [-60, 60]}, "pitch_deg": {"uniform": [-30, 30]}},
        "camera": {"fov_deg": 25, "offset_px": {"uniform": [-150, 150]}},
        "landmarks": {"sliding_contour": True},
    }
    return parse_spec(table, where="test")


@pytest.fixture(scope="module")
def block(anny: Rig, turned: Spec) -> tuple[Samples, Keypoints]:
    """A block of samples and its labels, made at once."""
    samples = draw_samples(plan_dataset(turned), anny, 1)
    return samples, label_keypoints(turned, anny, samples)


def test_every_visibility_occurs(block: tuple[Samples, Keypoints]) -> None:
    share = {kind: np.mean(block[1].visibility == kind) for kind in Visibility}
    assert min(share.values()) > 0.02


@given(first=st.integers(0, BLOCK - 1), count=st.integers(1, 2 * AT_ONCE + 1))
@settings(max_examples=6, deadline=None)
def test_any_slice_is_the_same_rows_of_the_whole(
    anny: Rig, turned: Spec, block: tuple[Samples, Keypoints], first: int, count: int
) -> None:
    samples, whole = block
    rows = slice(first, min(first + count, BLOCK))
    some = label_keypoints(turned, anny, samples.rows(rows))
    for name, values in some.columns.items():
        np.testing.assert_array_equal(values, whole.columns[name][rows])


def test_a_face_evaluated_for_a_picture_has_the_same_labels(
    anny: Rig, turned: Spec, block: tuple[Samples, Keypoints]
) -> None:
    samples, whole = block
    one = samples.rows(slice(417, 418))
    face = evaluate(anny, one.identity, one.weights, one.gaze)
    labels = label_keypoints(turned, anny, one, face)
    assert "contour_2d" in labels.columns
    for name, values in labels.columns.items():
        np.testing.assert_array_equal(values, whole.columns[name][417:418])


def test_no_samples_give_no_labels(anny: Rig, turned: Spec, block: tuple[Samples, Keypoints]) -> None:
    assert label_keypoints(turned, anny, block[0].rows(slice(0, 0))).visibility.shape == (0, 68)
