"""Pictures that are turned, mirrored or of another camera are told, by what training's looked like."""

from collections.abc import Callable

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.pictures.typical import typical_picture
from regress.runtime.headset.placing.orientation import told_orientation
from regress.runtime.headset.recordings.footage import Footage, line_up
from tests.regress.headset.takes import recording

SIDE = 32
SIZES = {"left_eye": (SIDE, SIDE), "right_eye": (SIDE, SIDE), "mouth": (SIDE, SIDE)}


def face(camera: str) -> np.ndarray:
    """(32, 32) grey levels without a symmetry: a nose on one side of an eye, dark corners; a mouth below."""
    down, across = np.mgrid[:SIDE, :SIDE] / SIDE
    if camera == "mouth":
        return (
            60
            + 120 * np.exp(-20 * (down - 0.25) ** 2)
            - 40 * np.exp(-30 * ((across - 0.5) ** 2 + (down - 0.7) ** 2))
        )
    eye = (
        150 * np.exp(-8 * (across - 0.1) ** 2)
        + 80 * down**2
        - 60 * np.exp(-40 * ((across - 0.6) ** 2 + (down - 0.5) ** 2))
    )
    return 40 + (eye if camera == "left_eye" else eye[:, ::-1])


TYPICAL = {
    name: np.rint(cv2.resize(face(name), (24, 24), interpolation=cv2.INTER_AREA)).astype(np.uint8)
    for name in SIZES
}


def footage(stacks: dict[str, np.ndarray]) -> Footage:
    return line_up({name: recording(name, stack) for name, stack in stacks.items()}, SIZES)


def stacks(seed: int, gain: float = 1.0, offset: float = 0.0) -> dict[str, np.ndarray]:
    """Ten noisy pictures of each camera."""
    random = np.random.default_rng(seed)
    return {
        name: np.clip(gain * face(name) + offset + random.normal(0, 15, (10, SIDE, SIDE)), 0, 255).astype(
            np.uint8
        )
        for name in SIZES
    }


@given(seed=st.integers(0, 2**32 - 1), gain=st.floats(0.5, 1.0), offset=st.floats(0, 30))
def test_nothing_is_said_of_pictures_as_training_had_them(seed: int, gain: float, offset: float):
    assert told_orientation(footage(stacks(seed, gain, offset)), TYPICAL) == []


@pytest.mark.parametrize(
    ("camera", "turn", "said"),
    [
        ("left_eye", lambda p: np.rot90(p, 1, (1, 2)), "its own turned by 90° to the left"),
        ("right_eye", lambda p: np.rot90(p, -1, (1, 2)), "its own turned by 90° to the right"),
        ("left_eye", lambda p: p[:, ::-1, ::-1], "its own turned by 180°"),
        ("right_eye", lambda p: p[:, ::-1], "its own upside down in a mirror"),
        ("left_eye", lambda p: p[:, :, ::-1], "those of right_eye or its own in a mirror"),
        ("mouth", lambda p: p[:, ::-1, ::-1], "its own upside down"),
        ("mouth", lambda p: p[:, ::-1], "its own upside down"),
    ],
)
def test_a_turned_camera_is_told_with_its_turn(camera: str, turn: Callable, said: str):
    taken = stacks(1)
    (told,) = told_orientation(footage(taken | {camera: turn(taken[camera])}), TYPICAL)
    assert told.startswith(f"{camera}: its pictures look more like {said} than like those it had in training")


def test_exchanged_cameras_are_told_both():
    taken = stacks(2)
    told = told_orientation(
        footage(taken | {"left_eye": taken["right_eye"], "right_eye": taken["left_eye"]}), TYPICAL
    )
    assert [line.split(":")[0] for line in told] == ["left_eye", "right_eye"]
    assert "those of right_eye" in told[0]
    told = told_orientation(
        footage(taken | {"left_eye": taken["mouth"], "mouth": taken["left_eye"]}), TYPICAL
    )
    assert "those of mouth" in told[0]
    assert "those of left_eye" in told[1]


def test_cameras_of_other_shapes_are_no_answer():
    sizes = {"left_eye": (SIDE, SIDE // 2), "right_eye": (SIDE, SIDE // 2), "mouth": (SIDE, SIDE)}
    taken = stacks(5)
    wide = {name: taken[name][:, ::2] for name in ("left_eye", "right_eye")}
    given = {"left_eye": wide["right_eye"], "right_eye": wide["left_eye"], "mouth": taken["mouth"]}
    found = line_up({name: recording(name, stack) for name, stack in given.items()}, sizes)
    told = told_orientation(found, TYPICAL | {"mouth": TYPICAL["right_eye"]})
    assert "those of right_eye or its own in a mirror" in told[0], (
        "not those of the mouth, which look the same"
    )


def test_pictures_that_are_not_square_cannot_have_been_turned_by_a_quarter():
    turned = np.rot90(stacks(7)["left_eye"], 1, (1, 2))
    typical = {"left_eye": TYPICAL["left_eye"]}
    for stack, size, count in ((turned, (SIDE, SIDE), 1), (turned[:, ::2], (SIDE, SIDE // 2), 0)):
        found = line_up({"left_eye": recording("left_eye", stack)}, {"left_eye": size})
        assert len([line for line in told_orientation(found, typical) if "90°" in line]) == count


def test_one_camera_alone_and_one_without_a_partner():
    taken = stacks(6)["left_eye"][:, :, ::-1]
    alone = line_up({"left_eye": recording("left_eye", taken)}, {"left_eye": (SIDE, SIDE)})
    (told,) = told_orientation(alone, {"left_eye": TYPICAL["left_eye"]})
    assert "more like its own in a mirror than" in told


def test_what_looks_like_nothing_of_training_is_left_alone():
    noise = np.random.default_rng(3).integers(0, 255, (10, SIDE, SIDE), dtype=np.uint8)
    taken = stacks(3)
    assert told_orientation(footage(taken | {"left_eye": noise}), TYPICAL) == []
    assert told_orientation(footage({"mouth": taken["left_eye"]}), {}) == [], "an older model"
    flat = {name: np.full((24, 24), 90, np.uint8) for name in SIZES}
    assert told_orientation(footage(taken), flat) == []


def test_pictures_at_fault_and_cameras_that_are_absent_do_not_count():
    taken = stacks(4)
    del taken["right_eye"]
    taken["left_eye"][3:] = 0
    assert told_orientation(footage(taken), TYPICAL) == []
    taken["left_eye"][:3] = taken["left_eye"][:3, ::-1, ::-1]
    assert len(told_orientation(footage(taken), TYPICAL)) == 1


def test_a_typical_picture_is_the_mean_of_the_rows_that_count():
    pictures = np.repeat(np.arange(4, dtype=np.uint8)[:, None, None] * 50, 48, axis=1).repeat(96, axis=2)
    assert (typical_picture(pictures, np.array([1, 3])) == 100).all()
    assert typical_picture(pictures, np.array([0])).shape == (24, 24)
    for count in (
        3000,
        5000,
    ):  # every fifth frame of datasets/headset.toml is a neutral one, and no other is the same
        many = (
            np.where(np.arange(count) % 5 == 0, 200, 0)
            .astype(np.uint8)[:, None, None]
            .repeat(2, 1)
            .repeat(2, 2)
        )
        assert abs(int(typical_picture(many, np.arange(count))[0, 0]) - 40) <= 8


def test_a_mouth_that_is_a_little_like_one_on_its_side_is_not_told():
    """A real one, upright, has .55 with training's on its side, and .25 with training's as it is."""
    own = TYPICAL["mouth"].astype(float)
    own = (own - own.mean()) / own.std()
    turned = np.rot90(own)
    random = cv2.GaussianBlur(np.random.default_rng(4).normal(size=own.shape), (0, 0), 3.0)
    basis = np.linalg.qr(np.stack([np.ones(own.size), own.ravel(), turned.ravel(), random.ravel()], axis=1))[
        0
    ]
    rest = basis[:, 3].reshape(own.shape) * np.sqrt(own.size)
    alike = float((own * turned).mean())
    for wanted, told in ((0.55, False), (0.9, True)):
        # so much of each that it correlates by .25 with the own and by as much as wanted with the turned one
        shares = np.linalg.solve([[1, alike], [alike, 1]], [0.25, wanted])
        explained = float(shares @ [0.25, wanted])
        picture = shares[0] * own + shares[1] * turned + np.sqrt(max(1 - explained, 0)) * rest
        seen = np.clip(120 + 30 * picture, 0, 255).astype(np.uint8)
        stack = np.stack([cv2.resize(seen, (SIDE, SIDE), interpolation=cv2.INTER_AREA)] * 4)
        said = told_orientation(footage({"mouth": stack}), TYPICAL)
        assert any("its own turned by 90°" in line for line in said) is told, said
