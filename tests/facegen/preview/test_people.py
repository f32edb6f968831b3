"""Previewed people differ, have their whole heads in the picture, and mouths that can be read."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from facegen.avatars.haircuts import STYLES
from facegen.conventions import BLENDSHAPE_INDEX
from facegen.geometry import rotation_from_angles
from facegen.preview.looks import GREY_HAIR, MENS_HAIR, WOMENS_HAIR, draw_look
from facegen.preview.performance import FACE_M, WINDOW_M, face_window, pictures, play_weights
from facegen.preview.person import PAPER
from facegen.preview.portraits import VIEWS_DEG, draw_portraits

PAPER_RGB = np.round(255 * np.array(PAPER))


def drawn(rig, look, window_m=WINDOW_M, **weights: float) -> np.ndarray:
    values = np.zeros((1, 52))
    for name, weight in weights.items():
        values[0, BLENDSHAPE_INDEX[name]] = weight
    played = replace(play_weights(rig, values, np.zeros(1), title=""), look=look)
    (picture,) = pictures(played, height_px=120, landmarks=False, window_m=window_m)
    return picture.astype(float)


def test_looks_differ_and_repeat():
    looks = [draw_look(number) for number in range(48)]
    assert looks == [draw_look(number) for number in range(48)]
    skins = np.array([look.colours.skin for look in looks])
    assert skins.mean(axis=1).std() > 0.1  # from dark to fair
    assert len({look.colours.iris for look in looks}) > 3
    assert len({look.colours.hair for look in looks}) > 8
    assert {look.hair for look in looks} == {*WOMENS_HAIR, *MENS_HAIR} <= {*STYLES, "bald"}


@pytest.mark.parametrize(("ancestry", "low", "high"), [((1, 0, 0), 0.2, 0.42), ((0, 0, 1), 0.55, 0.92)])
def test_skin_goes_with_ancestry(ancestry, low, high):
    for number in range(20):
        assert low < np.mean(draw_look(number, ancestry=np.array(ancestry)).colours.skin) < high


def test_only_men_have_beards_and_only_the_old_are_grey():
    women, men = ([draw_look(seed, female=female) for seed in range(40)] for female in (True, False))
    assert {look.colours.beard for look in women} == {0.0}
    assert {look.colours.beard for look in men} == {0.0, 0.3, 0.55}
    young, old = (
        np.array([draw_look(seed, age_years=age).colours.hair for seed in range(40)]) for age in (25.0, 85.0)
    )
    assert np.abs(old - GREY_HAIR).max() < 0.12
    assert np.abs(young - GREY_HAIR).max(axis=1).mean() > 0.2


@pytest.mark.parametrize("seed", [0, 3])
def test_a_picture_holds_the_whole_head(anny, seed):
    picture = drawn(anny, draw_look(seed))
    upper = picture[: len(picture) * 3 // 4]
    for border in (picture[0], upper[:, 0], upper[:, -1]):
        assert np.abs(border - PAPER_RGB).max() < 1.0
    middle = picture[:, picture.shape[1] // 2]
    assert (np.abs(middle - PAPER_RGB).max(axis=1) > 8).mean() > 0.7


def test_hair_covers_the_head_and_no_eye(anny):
    look = draw_look(8, female=True)
    changed = np.abs(drawn(anny, look) - drawn(anny, replace(look, hair="bald"))).max(axis=2) > 12
    top, eyes = changed[: len(changed) // 3], changed[len(changed) // 2 : len(changed) * 3 // 5]
    assert top.mean() > 0.15
    assert eyes[:, int(eyes.shape[1] * 0.38) : int(eyes.shape[1] * 0.62)].mean() < 0.02


def test_a_strip_shows_a_mouth_twice_as_large(anny):
    look = draw_look(8, female=True)

    def moved(window_m) -> int:
        still, spoken = (drawn(anny, look, window_m, jawOpen=weight) for weight in (0.0, 0.6))
        return int((np.abs(still - spoken).max(axis=2) > 25).sum())

    assert moved(FACE_M) > 2 * moved(WINDOW_M)


def test_strips_follow_a_face_that_turns(anny):
    ahead = replace(play_weights(anny, np.zeros((3, 52)), np.arange(3.0), title=""), look=None)
    turns = np.stack([rotation_from_angles(np.radians(yaw), 0.0, 0.0) for yaw in (-22, -18, -14)])
    for played in (ahead, replace(ahead, rotation=turns), replace(ahead, rotation=turns.transpose(0, 2, 1))):
        for picture in pictures(played, height_px=120, landmarks=False, window_m=face_window(played)):
            cheeks = picture[50:80]
            assert (cheeks[:, [0, -1]] == 255).all()


def test_a_rig_s_sheet_cuts_no_head_off(anny, tmp_path):
    draw_portraits(anny, tmp_path / "rig.png", people=1)
    sheet = cv2.imread(str(tmp_path / "rig.png"))
    white = (sheet == 255).all(axis=-1)
    above_the_neck = white[: round(0.7 * len(white))]
    for view in np.split(above_the_neck, len(VIEWS_DEG), axis=1):
        assert view[25].all()  # below the title
        assert view[:, 0].all()
        assert view[:, -1].all()
        assert not view.all()
