"""Bars round a camera's pictures: they are found, left out and told; rims, dark corners and renders stay."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.person.neutral import read_neutral
from regress.runtime.headset.pictures.bars import FEWEST_PICTURES, LOOKED_AT, bars_of
from regress.runtime.headset.pictures.picture_file import fit_picture
from regress.runtime.headset.pictures.placement import NO_CUT, CameraPlacement
from regress.runtime.headset.recordings.film_frames import Film
from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.recording import read_recording
from regress.runtime.headset.recordings.soundness import PictureSoundness
from regress.runtime.sample import Sample
from tests.regress.headset.takes import write_pictures

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
VIEW = (64, 64)


def shown(height: int, width: int, count: int = LOOKED_AT) -> np.ndarray:
    """Pictures (count, height, width) that show something and change, bright enough for a face."""
    random = np.random.default_rng(2)
    coarse = random.integers(40, 250, (count, 6, 6), dtype=np.uint8)
    return np.stack([cv2.resize(one, (width, height), interpolation=cv2.INTER_CUBIC) for one in coarse])


def barred(pictures: np.ndarray, bars: tuple[int, int, int, int], level: int = 0) -> np.ndarray:
    """Pictures with so many pixels of bars at the left, top, right and bottom."""
    left, top, right, bottom = bars
    return np.pad(pictures, ((0, 0), (top, bottom), (left, right)), constant_values=level)


@given(bars=st.tuples(*[st.sampled_from((0, 0, 12, 31, 60))] * 4), level=st.sampled_from((0, 16)))
def test_bars_are_found_to_the_pixel(bars, level):
    seen = barred(shown(120, 160), bars, level)
    width, height = seen.shape[2], seen.shape[1]
    found = np.array(bars_of(seen)) * (width, height, width, height)
    np.testing.assert_allclose(found, bars, atol=1e-9)


def test_a_burnt_in_time_and_compression_hide_no_bar():
    seen = barred(shown(120, 160), (0, 28, 0, 28))
    for number, picture in enumerate(seen):
        cv2.putText(picture, f"12:00:{number:02d}", (6, 20), 0, 0.6, 255, 1)
    for pictures in (seen, jpeg(seen)):
        np.testing.assert_allclose(np.array(bars_of(pictures)) * 176, [0, 28, 0, 28], atol=1.01)


@pytest.mark.parametrize("radius", [0.3, 0.4, 0.5, 0.6])
@pytest.mark.parametrize("level", [0, 12])
def test_a_round_rim_is_no_bar(radius: float, level: int):
    rows, columns = np.mgrid[:120, :160]
    inside = np.hypot((columns - 79.5) / 160, (rows - 59.5) / 120) < radius
    assert bars_of(np.where(inside, shown(120, 160), np.uint8(level))) == NO_CUT


def recorded(camera: str, size: tuple[int, int]) -> np.ndarray:
    """Pictures (n, h, w) of our sample take, all over it."""
    files = sorted((TAKE / camera).glob("*.png"))[::8]
    read = [cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files]
    return np.stack([cv2.resize(one, size, interpolation=cv2.INTER_CUBIC) for one in read])


def jpeg(pictures: np.ndarray, quality: int = 95) -> np.ndarray:
    written = [cv2.imencode(".jpg", one, [cv2.IMWRITE_JPEG_QUALITY, quality])[1] for one in pictures]
    return np.stack([cv2.imdecode(one, cv2.IMREAD_GRAYSCALE) for one in written])


def seen_through(pictures: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """Pictures of which something black and still covers all but such shares (h, w)."""
    return np.rint(pictures * np.clip(shares, 0, 1)).astype(np.uint8)


@pytest.mark.parametrize("camera", ["left_eye", "mouth"])
@pytest.mark.parametrize("size", [(96, 96), (240, 240), (320, 240)])
@pytest.mark.parametrize("middle", [(0.5, 0.5), (0.45, 0.5), (0.6, 0.6)])
def test_a_soft_round_rim_is_no_bar(camera: str, size: tuple[int, int], middle: tuple[float, float]):
    pictures, (width, height) = recorded(camera, size), size
    rows, columns = np.mgrid[:height, :width]
    away = np.hypot((columns + 0.5) / width - middle[0], (rows + 0.5) / height - middle[1])
    for radius in (0.4, 0.46, 0.52):
        for fade in (0.01, 0.05, 0.1, 0.15):
            rimmed = seen_through(pictures, (radius - away) / fade)
            assert bars_of(rimmed) == bars_of(jpeg(rimmed)) == NO_CUT, (radius, fade)


@pytest.mark.parametrize("camera", ["left_eye", "mouth"])
@pytest.mark.parametrize("size", [(96, 96), (240, 240), (320, 240)])
@pytest.mark.parametrize("turned_deg", [1, -1, 2, 3, 5])
def test_a_slanted_edge_is_no_bar(camera: str, size: tuple[int, int], turned_deg: float):
    """JPEG's blocks hide a slant of less than two of a small picture's lines."""
    pictures, (width, height) = recorded(camera, size), size
    rows, columns = np.mgrid[:height, :width]
    for at in (0.1, 0.15, 0.25):
        away = rows - at * height - (columns - width / 2) * np.tan(np.radians(turned_deg))
        for fade in (1, 3):
            covered = seen_through(pictures, away / fade + 0.5)
            kinds = (covered, jpeg(covered)) if min(size) > 96 or abs(turned_deg) > 2 else (covered,)
            for seen in kinds:
                assert bars_of(seen) == bars_of(seen.transpose(0, 2, 1)) == NO_CUT, (at, fade)


@pytest.mark.parametrize("camera", ["left_eye", "mouth"])
@pytest.mark.parametrize("bars", [(0, 36, 0, 36), (29, 0, 29, 0), (0, 48, 0, 0), (12, 17, 29, 48)])
def test_bars_round_a_headsets_dark_pictures_are_found_to_the_pixel(camera: str, bars: tuple[int, ...]):
    """Their own edges are as dark, and grain alone tells them from a bar."""
    for level in (0, 16):
        seen = barred(recorded(camera, (240, 240)), bars, level)
        height, width = seen.shape[1:]
        np.testing.assert_allclose(np.array(bars_of(seen)) * (width, height, width, height), bars, atol=1e-9)


def test_dark_parts_of_rendered_headsets_are_no_bars():
    for camera in ("left_eye", "right_eye", "mouth"):
        files = sorted((TAKE / camera).glob("*.png"))
        pictures = np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files])
        for first in range(0, len(pictures) - LOOKED_AT, LOOKED_AT):
            assert bars_of(pictures[first : first + LOOKED_AT]) == NO_CUT


def test_grain_is_no_bar_and_few_pictures_say_nothing():
    grain = np.random.default_rng(0).normal(14, 1.0, (LOOKED_AT, 30, 160)).round().astype(np.uint8)
    assert bars_of(np.concatenate([grain, shown(120, 160)], axis=1)) == NO_CUT
    assert bars_of(barred(shown(120, 160), (0, 30, 0, 30))[: FEWEST_PICTURES - 1]) == NO_CUT
    assert bars_of(np.zeros((LOOKED_AT, 50, 50), np.uint8)) == NO_CUT


@given(
    placement=st.builds(
        CameraPlacement,
        x=st.floats(0, 1),
        y=st.floats(0, 1),
        size=st.floats(0.2, 3),
        roll_deg=st.floats(-180, 180),
        mirror=st.booleans(),
        stretch=st.sampled_from((1.0, 2.0)),
    ),
    bars=st.tuples(*[st.integers(0, 40)] * 4),
)
def test_what_is_cut_is_as_if_it_had_never_been_there(placement, bars):
    """The view is the same to the bit, and points come out in the recorded picture's pixels."""
    plain = shown(90, 120, 1)[0]
    wide = barred(plain[None], bars)[0]
    sides = np.array([wide.shape[1], wide.shape[0]] * 2)
    cut = CameraPlacement(**{**vars(placement), "cut": tuple(np.array(bars) / sides)})
    np.testing.assert_array_equal(
        cut.view(wide, width=64, height=48), placement.view(plain, width=64, height=48)
    )
    moved = cut.picture_from_view((wide.shape[1], wide.shape[0]), (64, 48))
    np.testing.assert_allclose(
        moved - placement.picture_from_view((120, 90), (64, 48)),
        [[0, 0, bars[0]], [0, 0, bars[1]]],
        atol=1e-9,
    )


@pytest.mark.parametrize("kind", ["folder", "folder of 10 bits", "film", "film without a length"])
def test_a_take_with_bars_is_seen_without_them_and_it_is_told(tmp_path: Path, kind: str):
    plain = shown(64, 64, 64)
    seen = barred(plain, (0, 16, 0, 16))
    path = write_pictures(tmp_path / "left_eye", seen.astype(np.uint16) * 4 if "bits" in kind else seen)
    if kind == "film":
        path = tmp_path / "left_eye.avi"
        film = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 30, (64, 96))
        for picture in seen:
            film.write(cv2.cvtColor(picture, cv2.COLOR_GRAY2BGR))
        film.release()
    if kind == "film without a length":
        path = tmp_path / "left_eye.mjpeg"
        path.write_bytes(b"".join(cv2.imencode(".jpg", one)[1].tobytes() for one in seen))
        with Film(path) as opened:
            assert opened.length == 0
    bits = 10 if "bits" in kind else None
    found = read_recording(path, "left_eye", width=VIEW[0], height=VIEW[1], bits=bits)
    assert np.abs(found.pictures.astype(int) - plain).mean() < 4
    assert found.pictures[:, [0, -1]].mean() > 60
    (note,) = line_up({"left_eye": found}, {"left_eye": VIEW}).notes
    assert "bars, which are left out (0 % at the left, 17 % at the top" in note
    write_pictures(tmp_path / "rest", seen[:1], name="left_eye.png")
    neutral = read_neutral(tmp_path / "rest", {"left_eye": VIEW}, placement={"left_eye": found.placement})
    assert np.abs(neutral["left_eye"].astype(int) - found.pictures[0]).mean() < 4


def test_a_live_camera_with_bars_is_told_and_seen_as_before():
    soundness = PictureSoundness({"left_eye": VIEW, "mouth": VIEW})
    placed = PictureSoundness({"left_eye": VIEW}, {"left_eye": CameraPlacement()})
    plain, seen = shown(64, 64), barred(shown(64, 64), (0, 16, 0, 16))
    for left, mouth in zip(seen, plain, strict=True):
        step = soundness.step(Sample(pictures={"left_eye": left, "mouth": mouth}))
        placed.step(Sample(pictures={"left_eye": left}))
        whole = fit_picture(left, width=64, height=64, placement=soundness._placement["left_eye"])
        np.testing.assert_array_equal(step.pictures["left_eye"], whole.picture)
    assert soundness.barred == {"left_eye"}
    assert not placed.barred, "who wrote a placement has seen them"
