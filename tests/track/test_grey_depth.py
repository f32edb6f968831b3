"""Grey cameras of 10 and 12 bits in 16 are seen in eight, at the light that they have."""

import numpy as np
import pytest

from tests.track.fake_webcams import FakeCapture
from track.sources.faults import PictureWatch
from track.sources.grey_depth import GreyDepth
from track.sources.source import Picture
from track.sources.webcams import WebcamSource

SIZE = (64, 48)


def raw(bits: int, share: float) -> np.ndarray:
    """A picture's bytes as OpenCV gives what it does not convert; its brightest pixel has a share of the most."""
    width, height = SIZE
    ramp = np.linspace(0, share * (2**bits - 1), width * height).astype("<u2")
    return ramp.view(np.uint8).reshape(1, -1)


@pytest.mark.parametrize("bits", [8, 10, 12, 14, 16])
def test_the_brightest_pixel_says_how_many_bits_there_are(bits: int):
    depth = GreyDepth(width=SIZE[0], height=SIZE[1])
    bright = depth.step(raw(bits, 1.0))
    assert (bright.shape, bright.dtype, bright.max()) == ((48, 64), np.uint8, 255)
    assert depth.step(raw(bits, 0.2)).max() == pytest.approx(51, abs=1)  # a darker one stays darker
    assert (np.diff(bright.reshape(-1).astype(int)) >= 0).all()


def test_a_picture_that_came_in_part_is_none():
    assert GreyDepth(width=SIZE[0], height=SIZE[1]).step(raw(10, 1.0)[:, :-2]) is None


@pytest.mark.parametrize("bits", [10, 12])
def test_a_camera_of_few_bits_is_not_black(monkeypatch: pytest.MonkeyPatch, bits: int):
    capture = FakeCapture(fourcc="Y16 ", size=SIZE, raw=lambda: raw(bits, 0.9))
    monkeypatch.setattr("track.sources.webcams.opened", lambda *_: capture)
    picture = WebcamSource("0").read()
    assert capture.asked == [("CONVERT_RGB", 0)]
    assert PictureWatch(moving=True).step(Picture(time_s=0.0, pixels=picture.pixels)) is None
    assert picture.pixels.max() > 200


def test_other_cameras_are_left_alone(monkeypatch: pytest.MonkeyPatch):
    capture = FakeCapture(fourcc="GREY")
    monkeypatch.setattr("track.sources.webcams.opened", lambda *_: capture)
    assert WebcamSource("0").read().pixels.shape == (480, 640, 3)
    assert capture.asked == []
