"""A person's own open and shut eye, found in a take: by blinks, and never by an eye that is shut all through."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.eyes.lid_ends import lid_ends_mm

USUAL_MM, SHUT = 6.4, 0.5
"""Of training; and what a network reads of a real shut eye, as a share of the open one."""


def times(count: int) -> np.ndarray:
    return np.arange(count) / 30


def blinking(blinks: int, *, depth: float = 1.0, own_mm: float = 6.0, frames: int = 300) -> np.ndarray:
    """Lids (frames,) in mm as a network reads them: open, but for so many blinks of a fifth of a second."""
    shut = np.zeros(frames)
    for number in range(blinks):
        at = 20 + number * (frames - 40) // max(blinks, 1)
        shut[at : at + 7] = np.maximum(shut[at : at + 7], [0.3, 0.8, 1.0, 0.9, 0.6, 0.3, 0.1])
    noise = 0.02 * np.random.default_rng(blinks).standard_normal(frames)
    return own_mm * (1 - depth * (1 - SHUT) * shut + noise)


def openness(apart_mm: np.ndarray) -> np.ndarray:
    own, shut = lid_ends_mm(apart_mm, times(len(apart_mm)), usual_mm=USUAL_MM)
    return (apart_mm - shut) / (own - shut)


@pytest.mark.parametrize("blinks", [3, 8, 12])
def test_three_blinks_make_a_shut_eye_read_zero_and_leave_open_ones(blinks: int):
    apart = blinking(blinks)
    seen = openness(apart)
    assert abs(seen.min()) < 0.01
    assert np.median(seen) == pytest.approx(1.0, abs=0.1)


def test_fewer_blinks_half_blinks_and_squints_leave_shut_where_it_was():
    squint = np.where((np.arange(300) // 60) % 2, 3.0, 6.0)
    for apart in (blinking(2), blinking(9, depth=0.5), squint):
        own, shut = lid_ends_mm(apart, times(len(apart)), usual_mm=USUAL_MM)
        assert shut == 0
        assert own == pytest.approx(6.0, rel=0.05)


@pytest.mark.parametrize("opened", [4, 6, 20, 60])
def test_an_eye_that_is_shut_for_the_most_part_is_not_the_open_one(opened: int):
    """Its own opening was that of the shut eye: shut read .99 and open 2.1."""
    apart = np.full(120, SHUT * 6.0)
    apart[-opened:] = 6.0
    seen = openness(apart)
    assert np.allclose(seen[-opened:], 1.0)
    assert np.allclose(seen[:-opened], SHUT)


def test_an_eye_that_is_shut_all_through_is_measured_by_training():
    assert openness(np.full(120, SHUT * USUAL_MM)).max() < 0.75
    assert openness(np.full(120, np.nan)).size == 120


@given(own_mm=st.floats(4.8, 9), times_as_large=st.floats(0.5, 2))
def test_of_open_eyes_the_ninetieth_percentile_counts_whatever_the_unit(own_mm: float, times_as_large: float):
    apart = own_mm + 0.2 * np.random.default_rng(1).standard_normal(200)
    found = lid_ends_mm(apart, times(200), usual_mm=USUAL_MM)
    np.testing.assert_allclose(found, (np.percentile(apart, 90), 0))
    larger = lid_ends_mm(times_as_large * apart, times(200), usual_mm=times_as_large * USUAL_MM)
    np.testing.assert_allclose(larger, times_as_large * np.array(found))
