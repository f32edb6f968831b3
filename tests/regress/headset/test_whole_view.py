"""Pictures of another shape than the network's that nobody placed: all of each is seen, and it is told."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.headset.person.neutral import read_neutral
from regress.runtime.headset.pictures.faults import FROZEN_S, Fault
from regress.runtime.headset.pictures.picture_file import STRANGE_ASPECT, fit_picture, whole_of_shape
from regress.runtime.headset.pictures.placement import whole_view
from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.recording import read_recording
from regress.runtime.headset.recordings.soundness import PictureSoundness
from regress.runtime.sample import Sample
from tests.regress.headset.takes import write_pictures

VIEW = (64, 64)
SIDES = st.integers(40, 900)


def noise(height: int, width: int, count: int = 1) -> np.ndarray:
    """Pictures (count, height, width) that show something."""
    return np.random.default_rng(3).integers(60, 200, (count, height, width), dtype=np.uint8)


@given(width=SIDES, height=SIDES, across=SIDES, down=SIDES)
def test_no_corner_is_lost_and_one_side_is_filled(width, height, across, down):
    """Edges of the picture, in shares of the view about its middle."""
    placement = whole_view((width, height), (across, down))
    step = placement.picture_from_view((width, height), (across, down))[0, 0]
    filled = np.array([width / across, height / down]) / step
    assert filled.max() == pytest.approx(1)


@pytest.mark.parametrize(("width", "height"), [(160, 120), (120, 160), (160, 90), (80, 150)])
def test_live_and_recorded_pictures_and_neutral_ones_are_seen_alike(tmp_path: Path, width: int, height: int):
    pictures = noise(height, width, 3)
    placement = whole_view((width, height), VIEW)
    folder = write_pictures(tmp_path / "left_eye", pictures)
    recorded = read_recording(folder, "left_eye", width=VIEW[0], height=VIEW[1])
    assert (recorded.placement, recorded.whole) == (placement, True)
    soundness = PictureSoundness({"left_eye": VIEW})
    for picture, kept in zip(pictures, recorded.pictures, strict=True):
        live = soundness.step(Sample(pictures={"left_eye": picture}))
        expected = placement.view(picture, width=VIEW[0], height=VIEW[1])
        np.testing.assert_array_equal(live.pictures["left_eye"], expected)
        np.testing.assert_array_equal(kept, expected)
    assert soundness.whole == {"left_eye": (width, height)}
    write_pictures(tmp_path / "rest", pictures[:1], name="left_eye.png")
    neutral = read_neutral(tmp_path / "rest", {"left_eye": VIEW})["left_eye"]
    np.testing.assert_array_equal(neutral, recorded.pictures[0])
    (note,) = line_up({"left_eye": recorded}, {"left_eye": VIEW}).notes
    assert note.startswith(f"left_eye: pictures of {width} x {height} have another shape")


@given(width=SIDES, height=SIDES)
def test_two_eyes_side_by_side_are_no_view_of_one(width, height):
    ratio = max(width / height, height / width)
    found = fit_picture(
        noise(height, width)[0], width=64, height=64, placement=whole_of_shape((width, height), VIEW)
    )
    assert (found.fault is Fault.SHAPE) == (ratio > STRANGE_ASPECT)


def test_the_shape_of_most_pictures_is_a_takes(tmp_path: Path):
    folder = write_pictures(tmp_path / "eye", noise(90, 120, 6))
    write_pictures(folder, noise(64, 64), first=6)
    found = read_recording(folder, "left_eye", width=VIEW[0], height=VIEW[1])
    assert found.faults == (*[None] * 6, Fault.SHAPE)


def test_a_live_camera_keeps_the_shape_of_its_first_picture():
    """Another one shows another part of what it sees, and a face would jump."""
    soundness = PictureSoundness({"left_eye": VIEW, "mouth": VIEW})
    wide, square = noise(90, 120)[0], noise(80, 80)[0]
    first = soundness.step(Sample(pictures={"left_eye": wide, "mouth": square}))
    assert not first.faults
    other = soundness.step(Sample(pictures={"left_eye": square, "mouth": wide}))
    assert other.faults == {"left_eye": Fault.SHAPE, "mouth": Fault.SHAPE}


def test_a_folder_without_a_picture_is_told_as_before(tmp_path: Path):
    (tmp_path / "0.png").write_bytes(b"none")
    found = read_recording(tmp_path, "left_eye", width=VIEW[0], height=VIEW[1])
    assert found.faults == (Fault.UNREADABLE,)
    with pytest.raises(InputError, match="no neutral picture"):
        read_neutral(tmp_path, {"left_eye": VIEW})


def test_a_program_may_fill_one_buffer_again_and_again():
    """The neutral picture stays what it was, and moving pictures in one buffer are not frozen."""
    frames = noise(64, 64, 40)
    buffer = frames[0].copy()
    soundness = PictureSoundness({"left_eye": VIEW, "mouth": VIEW})
    neutral = soundness.neutral({"left_eye": buffer})
    step_s = FROZEN_S / 4
    for number, frame in enumerate(frames):
        buffer[:] = frame
        seen = {"left_eye": buffer[:], "mouth": noise(64, 64)[0] + np.uint8(number % 2)}
        assert not soundness.step(Sample(time_s=number * step_s, pictures=seen)).faults
    np.testing.assert_array_equal(neutral["left_eye"], frames[0])
