"""Pupils of drawn eyes, as wide as they were drawn."""

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.runtime.headset.eyes.pupils import pupil_share
from tests.regress.headset.test_traced_eyes import EYE, IRIS, LIDS

SIDE, FINE = 96, 8


def drawn_eye(share: float, *, turn: float, flat: float, gap_px: float, pupil: int = 25, glints: int = 4):
    """A picture of an eye and its points: iris an ellipse of 12 pixels' radius, lids that cover what lies beyond."""
    middle = np.array([47.3, 49.1])
    picture = np.full((SIDE * FINE, SIDE * FINE), 150, np.uint8)

    def ellipse(radius: float, level: int) -> None:
        axes = (round(radius * FINE * 16), round(radius * flat * FINE * 16))
        at = tuple(np.rint(((middle + 0.5) * FINE - 0.5) * 16).astype(int).tolist())
        cv2.ellipse(picture, at, axes, np.degrees(turn), 0, 360, level, -1, cv2.LINE_AA, 4)

    ellipse(12.0, 80)
    ellipse(12.0 * share, pupil)
    for number in range(glints):
        spot = np.rint((middle + 5 * np.array([np.cos(number * 1.6), np.sin(number * 1.6)])) * FINE).astype(
            int
        )
        cv2.circle(picture, tuple(spot.tolist()), FINE, 255, -1)
    rotation = np.array([[np.cos(turn), -np.sin(turn)], [np.sin(turn), np.cos(turn)]])
    around = 2 * np.pi * np.arange(IRIS) / IRIS
    iris = middle + 12 * (np.column_stack([np.cos(around), flat * np.sin(around)]) @ rotation.T)
    across = np.linspace(-1, 1, LIDS)
    lid = np.column_stack([26 * across, gap_px / 2 * (1 - across**2)])
    upper, lower = middle + lid * [1, -1], middle + lid
    rows, columns = np.mgrid[: SIDE * FINE, : SIDE * FINE] / FINE
    bound = gap_px / 2 * (1 - ((columns - middle[0]) / 26) ** 2)
    picture[np.abs(rows - middle[1]) > bound] = 170
    small = cv2.resize(picture, (SIDE, SIDE), interpolation=cv2.INTER_AREA)
    return small, np.concatenate([middle[None], iris, upper, lower])


@settings(max_examples=40, deadline=None)
@given(st.floats(0.25, 0.65), st.floats(0, 3.1), st.floats(0.75, 1), st.floats(18, 40))
def test_a_pupil_is_as_wide_as_it_was_drawn(share: float, turn: float, flat: float, gap_px: float):
    picture, points = drawn_eye(share, turn=turn, flat=flat, gap_px=gap_px)
    assert pupil_share(picture, points, EYE) == pytest.approx(share, abs=0.05)


def test_what_cannot_be_seen_is_not_said():
    picture, points = drawn_eye(0.4, turn=0.0, flat=1.0, gap_px=3.0)
    assert np.isnan(pupil_share(picture, points, EYE))
    picture, points = drawn_eye(0.4, turn=0.0, flat=1.0, gap_px=40.0, pupil=79)
    assert np.isnan(pupil_share(picture, points, EYE))
    picture, points = drawn_eye(0.4, turn=0.0, flat=1.0, gap_px=40.0)
    assert np.isnan(pupil_share(picture, np.full_like(points, np.nan), EYE))
    assert np.isnan(pupil_share(picture, points + 60, EYE))  # beyond the edges
