"""What an avatar shows while the face is gone, and when it comes back: in small steps, whatever comes."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.sample import Sample
from track.session.fading import BACK_S, HOLD_S, REST_S, SILENT_S, Fading

FPS = 30
MOST_STEP = 0.3


def sample_at(time_s: float, weight: float | None, *, x: float = 0.0) -> Sample:
    """A face all of whose weights are the same, or none, in a place."""
    if weight is None:
        return Sample(time_s=time_s, weights=np.full(52, np.nan))
    points = np.stack([np.linspace(0, 100, 68) + x, np.linspace(0, 100, 68)], axis=1)
    return Sample(
        time_s=time_s, weights=np.full(52, weight), gaze=np.full(4, 0.2), head=np.full(6, 0.3), points=points
    )


def shown(weights: list[float | None], *, fps: float = FPS) -> np.ndarray:
    """What is shown of a sequence of faces: the weights' first column."""
    fading = Fading()
    return np.array([fading.step(sample_at(row / fps, each)).weights[0] for row, each in enumerate(weights)])


def test_the_face_is_held_then_rests_then_nothing_is_said():
    seen = FPS
    values = shown([0.8] * seen + [None] * (3 * FPS))
    times_s = (np.arange(len(values)) - seen + 1) / FPS
    held = (times_s >= 0) & (times_s <= HOLD_S)
    np.testing.assert_allclose(values[held], 0.8)
    resting = (times_s >= REST_S) & (times_s <= SILENT_S)
    np.testing.assert_allclose(values[resting], 0.0, atol=1e-12)
    assert resting.sum() > 20
    assert np.isnan(values[times_s > SILENT_S + 1 / FPS]).all()
    assert np.all(np.diff(values[: np.flatnonzero(np.isnan(values))[0]][seen:]) <= 1e-12)


def test_it_comes_back_within_a_fifth_of_a_second():
    values = shown([0.0] * FPS + [None] * FPS + [1.0] * FPS)
    back = values[2 * FPS :]
    assert back[int(np.ceil(BACK_S * FPS))] == 1.0
    assert back[0] <= MOST_STEP


@pytest.mark.parametrize("gone_s", [1.0, 3.0], ids=["at rest", "given up"])
def test_the_head_comes_back_without_a_jump(gone_s: float):
    """An avatar was told that its head looks ahead, also where nothing more was said for a while."""
    fading, angles = Fading(), []
    for row, weight in enumerate([0.5] * FPS + [None] * int(gone_s * FPS) + [0.5] * FPS):
        angles.append(fading.step(sample_at(row / FPS, weight)).head[3])
    back = np.array(angles[-FPS:])
    assert back[0] <= MOST_STEP * 0.3
    assert np.diff(back, prepend=0.0).max() <= 1.01 * 0.3 / (BACK_S * FPS)
    assert back[int(np.ceil(BACK_S * FPS))] == 0.3


def test_one_missed_frame_in_two_changes_nothing():
    weights = [0.5 + 0.4 * np.sin(row / 5) if row % 2 else None for row in range(4 * FPS)]
    values = shown(weights)
    seen = np.arange(len(values)) % 2 == 1
    late = np.arange(len(values)) > FPS
    expected = np.array([np.nan if each is None else each for each in weights])
    np.testing.assert_allclose(values[seen & late], expected[seen & late])


def test_another_face_is_faded_to():
    fading = Fading()
    values = []
    for row in range(2 * FPS):
        other = row >= FPS
        values.append(fading.step(sample_at(row / FPS, float(other), x=300.0 * other)).weights[0])
    assert np.abs(np.diff(values[FPS // 2 :])).max() <= MOST_STEP
    assert values[-1] == 1.0


@given(
    st.lists(st.one_of(st.none(), st.floats(0, 1)), min_size=2, max_size=120),
    st.sampled_from([24.0, 30.0, 60.0, 120.0]),
)
def test_no_weight_moves_by_more_than_the_face_did(weights, fps):
    """Beyond what seen faces moved in the blending time, a step is never larger than `MOST_STEP`."""
    values = shown(weights, fps=fps)
    known = [0.0 if each is None else each for each in weights]
    window = int(np.ceil(BACK_S * fps)) + 2
    for row in range(1, len(values)):
        if np.isnan(values[row - 1 : row + 1]).any():
            continue
        around = known[max(0, row - window) : row + 1]
        face = max(around) - min(around) if None not in weights[max(0, row - window) : row + 1] else 1.0
        assert abs(values[row] - values[row - 1]) <= MOST_STEP + face + 1e-9
        assert -1e-9 <= values[row] <= 1 + 1e-9


@pytest.mark.parametrize("gone_s", [0.1, 0.25, 0.5, 0.9, 1.5, 4.0])
def test_gaze_and_head_go_with_the_weights(gone_s):
    fading = Fading()
    count = round(gone_s * FPS)
    for row in range(10):
        fading.step(sample_at(row / FPS, 1.0))
    for row in range(10, 10 + count):
        last = fading.step(sample_at(row / FPS, None))
    if gone_s < HOLD_S:
        np.testing.assert_allclose(last.gaze, 0.2)
    elif gone_s < SILENT_S:
        share = 1 - np.clip((gone_s - HOLD_S) / (REST_S - HOLD_S), 0, 1)
        np.testing.assert_allclose(last.gaze, 0.2 * share, atol=1e-9)
        np.testing.assert_allclose(last.head, [0.3, 0.3, 0.3, *[0.3 * share] * 3], atol=1e-9)
    else:
        assert np.isnan(last.head).all()
