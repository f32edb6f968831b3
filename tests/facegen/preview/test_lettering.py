"""Labels of drawn points cover neither one another nor a point."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.headsets import load_headset
from facegen.preview.headsets import SIDES_DEG, draw_headset
from facegen.preview.lettering import label_places
from facegen.preview.wearer import put_on, seen_landmarks

WINDOW_PX = (0.0, 400.0, 0.0, 300.0)
PLACES = st.tuples(st.floats(0, 400), st.floats(0, 300))


@given(points=st.lists(PLACES, max_size=25), others=st.lists(PLACES, max_size=25), wide=st.floats(4, 40))
@settings(max_examples=40)
def test_labels_cover_nothing_as_long_as_there_is_room(points, others, wide):
    points_px = np.array(points).reshape(-1, 2)
    others_px, sizes = np.array(others).reshape(-1, 2), np.tile((wide, 9.0), (len(points), 1))
    places = label_places(points_px, sizes, WINDOW_PX, others_px)
    low, high = places - sizes / 2, places + sizes / 2
    assert (low >= 0).all()
    assert (high <= WINDOW_PX[1::2]).all()
    for number, place in enumerate(places):
        covered = (np.abs(np.concatenate([points_px, others_px]) - place) < sizes[number] / 2).all(axis=1)
        assert not covered.any()
        assert (np.abs(np.delete(places, number, axis=0) - place) >= sizes[number]).any(axis=1).all()


def test_a_label_alone_touches_its_point():
    (place,) = label_places(np.array([[200.0, 150.0]]), np.array([[20.0, 8.0]]), WINDOW_PX, np.zeros((0, 2)))
    assert np.hypot(*np.maximum(np.abs(place - [200, 150]) - [10, 4], 0)) < 4


@pytest.mark.slow
@pytest.mark.parametrize("name", ["training9", "mouth1"])
def test_labels_of_headsets_do_not_overlap(anny, name):
    headset = load_headset(name)  # the cameras of tracking3 are among training9's
    figure = draw_headset(headset, anny)
    renderer = figure.canvas.get_renderer()
    labels = 0
    for axes in figure.axes:
        window = axes.get_window_extent(renderer)
        boxes = [text.get_window_extent(renderer) for text in axes.texts]
        labels += len(boxes)
        for number, box in enumerate(boxes):
            assert (box.p0 >= window.p0).all()
            assert (box.p1 <= window.p1).all()
            assert not any(box.overlaps(other) for other in boxes[:number])
    wearer = put_on(headset, anny)
    seen = sum(seen_landmarks(wearer, view)[1].sum() for view in wearer.views)
    assert labels == seen + len(SIDES_DEG) * len(headset.cameras)
