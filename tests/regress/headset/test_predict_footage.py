"""Recordings side by side: what is matched, what is wrong with it, and that the rest goes on."""

import struct
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from regress.errors import InputError
from regress.runtime.headset.pictures.faults import (
    FROZEN_S,
    Fault,
    FrozenWatch,
    fault_sentences,
    is_black,
    picture_fault,
)
from regress.runtime.headset.recordings.footage import Footage, line_up
from regress.runtime.headset.recordings.recorded_paths import recorded_size
from regress.runtime.headset.recordings.recording import Recording, read_recording, read_rendered
from regress.runtime.headset.recordings.soundness import PictureSoundness
from regress.runtime.sample import Sample
from tests.lying_film import lying_film
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, recording, write_pictures

SIZES = {"left_eye": (WIDTH, HEIGHT), "right_eye": (WIDTH, HEIGHT), "mouth": (WIDTH, HEIGHT)}


@given(first=st.integers(0, 10**6), step=st.integers(1, 3), lost=st.sets(st.integers(0, 29), max_size=8))
@settings(max_examples=40, deadline=None)
def test_a_number_that_one_camera_lacks_is_missing_there_alone(first: int, step: int, lost: set[int]):
    numbers = first + step * np.arange(30)
    kept = [place for place in range(30) if place not in lost]
    eye, mouth = pictures([100] * 30), pictures([120] * 30, seed=1)
    footage = line_up(
        {
            "left_eye": recording("left_eye", eye, numbers=numbers),
            "mouth": recording("mouth", mouth[kept], numbers=numbers[kept]),
        },
        SIZES,
    )
    assert footage.numbers.tolist() == numbers.tolist()
    assert footage.present[:, 0].all()
    assert not footage.present[:, 1].any()
    assert np.flatnonzero(~footage.present[:, 2]).tolist() == sorted(lost)
    assert np.array_equal(footage.pictures["mouth"][kept], mouth[kept])
    assert not footage.pictures["mouth"][sorted(lost)].any()
    assert any("right_eye: not given" in note for note in footage.notes)
    assert any("mouth" in note and "no picture" in note for note in footage.notes) == bool(lost)


def test_numbers_that_all_cameras_lack_are_frames_without_pictures():
    numbers = [0, 1, 2, 6, 7]
    both = {
        name: recording(name, pictures([100] * 5, seed=2), numbers=numbers) for name in ("left_eye", "mouth")
    }
    footage = line_up(both, SIZES, fps=10)
    assert footage.numbers.tolist() == list(range(8))
    assert footage.present.any(axis=1).tolist() == [True] * 3 + [False] * 3 + [True] * 2
    assert footage.time_s == pytest.approx(np.arange(8) / 10)
    assert "mouth: 3 of 8 frames have no picture: 3-5" in footage.notes


def test_films_are_matched_by_their_times():
    def films(eye_fps: float, mouth_fps: float) -> dict[str, Recording]:
        rates = {"left_eye": eye_fps, "mouth": mouth_fps}
        return {
            name: recording(name, pictures([100] * 5, seed=2), numbered=False, film=True, fps=rate)
            for name, rate in rates.items()
        }

    assert line_up(films(30, 29.97), SIZES).time_s == pytest.approx(np.arange(5) / 30)
    quick = films(60, 30)
    footage = line_up(quick, SIZES)
    assert footage.time_s == pytest.approx(np.arange(5) / 60)
    assert np.array_equal(footage.pictures["left_eye"], quick["left_eye"].pictures)
    assert np.array_equal(footage.pictures["mouth"][[0, 2, 4]], quick["mouth"].pictures[:3])
    assert footage.notes == (
        "the cameras' times differ (left_eye 0.00-0.07 s, mouth 0.00-0.13 s); what they share counts",
        "right_eye: not given; its shapes come from the other cameras as far as these know them",
    )
    assert line_up(films(60, 30), SIZES, fps=10).time_s == pytest.approx(np.arange(5) / 10)


def test_a_film_is_matched_with_the_numbers_of_a_folder():
    eye, mouth = pictures([100] * 10), pictures([120] * 10, seed=1)
    film = recording("left_eye", eye, numbered=False, film=True, fps=30)

    def beside(numbers: list[int], **settings: bool) -> Footage:
        folder = recording("mouth", mouth[[number % 10 for number in numbers]], numbers=numbers)
        return line_up({"left_eye": film, "mouth": folder}, SIZES, **settings)

    lacking = [number for number in range(10) if number != 4]
    footage = beside(lacking)
    assert footage.numbers.tolist() == list(range(10))
    assert footage.time_s == pytest.approx(np.arange(10) / 30)
    assert np.array_equal(footage.pictures["left_eye"], eye)
    assert np.array_equal(footage.pictures["mouth"][lacking], mouth[lacking])
    assert footage.faults["mouth"][4] is Fault.MISSING
    assert not any("--from-start" in note for note in footage.notes)
    footage = beside(list(range(3, 13)))
    assert footage.numbers.tolist() == list(range(13))
    assert footage.present[:, [0, 2]].all(axis=1).tolist() == [False] * 3 + [True] * 7 + [False] * 3
    told = "left_eye: counted from 0, while the other cameras' numbers begin at 3; --from-start matches first frames"
    assert told in footage.notes
    assert beside(list(range(3, 13)), from_start=True).present[:, [0, 2]].all()
    with pytest.raises(InputError, match=r"in common \(left_eye 0-9, mouth 100-109\); --from-start"):
        beside(list(range(100, 110)))


def test_clock_times_for_numbers_are_no_grid():
    numbers = [1_700_000_000_000 + 33 * place + place % 2 for place in range(20)]
    both = {name: recording(name, pictures([100] * 20), numbers=numbers) for name in ("left_eye", "mouth")}
    assert line_up(both, SIZES).numbers.tolist() == numbers


def test_cameras_with_clocks_of_their_own_are_told():
    """Numbers in one range of which none is another's: each frame would have one camera."""
    clocks = {
        name: recording(name, pictures([100] * 10), numbers=range(1_000_000 + late, 1_300_000, 33_333))
        for late, name in enumerate(("left_eye", "right_eye", "mouth"))
    }
    with pytest.raises(InputError, match=r"few frame numbers of one camera are another's.*--from-start"):
        line_up(clocks, SIZES)
    assert len(line_up(clocks, SIZES, from_start=True).numbers) == 10
    assert len(line_up({"mouth": clocks["mouth"]}, SIZES).numbers) == 10


def test_takes_of_different_recordings_are_matched_from_the_start():
    eye = recording("left_eye", pictures([100] * 9), numbers=range(9))
    mouth = recording("mouth", pictures([90] * 12), numbers=range(500, 512))
    with pytest.raises(InputError, match=r"nothing in common \(left_eye 0-8, mouth 500-511\); --from-start"):
        line_up({"left_eye": eye, "mouth": mouth}, SIZES)
    footage = line_up({"left_eye": eye, "mouth": mouth}, SIZES, from_start=True)
    assert len(footage.numbers) == 9
    assert np.array_equal(footage.pictures["mouth"], mouth.pictures[:9])
    assert footage.notes[0] == (
        "the cameras have different numbers of frames (left_eye has 9, mouth has 12); the first 9 count"
    )


@example(start=5, length=8, fps=30, seed=0)
@example(start=5, length=9, fps=30, seed=0)
@given(
    start=st.integers(1, 20),
    length=st.integers(1, 120),
    fps=st.sampled_from([15, 30, 90, 120]),
    seed=st.integers(0, 99),
)
@settings(max_examples=40, deadline=None)
def test_a_camera_is_frozen_where_it_repeats_for_long_while_others_move(
    start: int, length: int, fps: int, seed: int
):
    rng = np.random.default_rng(seed)
    frozen, moving = (rng.integers(0, 255, (150, 6, 6), dtype=np.uint8) for _ in range(2))
    frozen[start : start + length] = frozen[start - 1]
    watch = FrozenWatch()
    steps = [watch.step(1 / fps, {"eye": frozen[row], "mouth": moving[row]}) for row in range(150)]
    assert [row for row in range(150) if "eye" in steps[row]] == list(
        range(start + int(FROZEN_S * fps), start + length)
    )
    assert not any("mouth" in step for step in steps)


def test_a_scene_in_which_nothing_moves_is_not_frozen_nor_is_a_camera_alone():
    still = np.repeat(pictures([100]), 40, axis=0)
    for cameras in (("a", "b"), ("a",)):
        watch = FrozenWatch()
        assert not any(watch.step(1 / 30, dict.fromkeys(cameras, picture)) for picture in still)
    assert any(watch.step(1 / 30, {"a": still[0], "b": picture}) for picture in pictures([100] * 40))


@pytest.mark.parametrize("hangs", [False, True])
def test_live_a_slow_cameras_picture_stands_and_one_that_hangs_is_frozen(hangs: bool):
    """A mouth of two pictures a second beside eyes of 60: the same array stands; who hangs gives it anew."""
    soundness = PictureSoundness(SIZES)
    eyes, mouths = pictures([100] * 120), list(pictures([110] * 4, seed=1))
    faults = []
    for row in range(120):
        mouth = mouths[0].copy() if hangs else mouths[row // 30]
        sample = Sample(pictures={"left_eye": eyes[row], "mouth": mouth}, time_s=row / 60)
        faults.append(soundness.step(sample).faults.get("mouth"))
    assert (Fault.FROZEN in faults) is hangs


@given(st.floats(0.08, 0.12), st.floats(0, 0.6), st.integers(0, 99))
def test_an_eye_in_little_light_is_no_black_picture(light: float, grain: float, seed: int):
    """Levelled, films of real eyes in a tenth of their light are traced as well as in all of it."""
    rows, columns = np.mgrid[:96, :96]
    iris = np.hypot(rows - 48, columns - 50)
    eye = np.where(iris < 9, 20.0, np.where(iris < 22, 90.0, 170.0 - 0.6 * np.abs(rows - 48)))
    noise = grain * np.random.default_rng(seed).standard_normal(eye.shape)
    picture = np.rint(light * eye + noise).clip(0, 255).astype(np.uint8)
    assert np.percentile(picture, 98) < 24
    assert picture_fault(picture) is None
    assert picture_fault((picture + 100).astype(np.uint8)) is None  # a lamp that shines into the lens


@given(st.floats(0, 9), st.floats(0.4, 6), st.floats(0, 12), st.integers(0, 99))
def test_a_lens_cap_is_black_whatever_its_noise_glow_and_tint(
    level: float, grain: float, glow: float, seed: int
):
    noise = grain * np.random.default_rng(seed).standard_normal((96, 96))
    rows, columns = np.mgrid[:96, :96]
    cap = min(level, 21 - glow - 2 * grain) + glow * np.exp(-np.hypot(rows, columns) / 40) + noise
    picture = np.rint(cap).clip(0, 255).astype(np.uint8)
    assert picture_fault(picture) is Fault.BLACK
    assert is_black(np.stack([picture // 2, picture, picture // 3], axis=2))
    if grain < 2 and glow < 6:
        assert picture_fault((picture + 100).astype(np.uint8)) is Fault.FLAT


def test_black_and_flat_pictures_are_told_from_dark_ones():
    rng = np.random.default_rng(4)
    assert picture_fault(rng.normal(8, 3, (96, 96)).clip(0, 255).astype(np.uint8)) is Fault.BLACK
    assert picture_fault(np.full((96, 96), 255, dtype=np.uint8)) is Fault.FLAT
    assert picture_fault(pictures([60])[0]) is None


def test_sentences_list_runs_and_end():
    faults = [Fault.BLACK if number % 3 else None for number in range(60)]
    (line,) = fault_sentences("mouth", range(60), faults)
    assert line.startswith("mouth: 40 of 60 frames have a black picture: 1-2, 4-5, ")
    assert line.endswith(" and 12 more")
    assert fault_sentences("mouth", [1, 2], [Fault.BLACK] * 2) == [
        "mouth: all of its 2 frames have a black picture"
    ]


def test_folders_are_read_by_number_scaled_and_with_their_faults(tmp_path: Path):
    large = np.array([cv2.resize(one, (WIDTH * 3, HEIGHT * 3)) for one in pictures([90] * 11)])
    folder = write_pictures(tmp_path / "eye", large, name="{}.png")  # 10.png sorts before 2.png
    (folder / "5.png").write_bytes(b"not a picture")
    (folder / "6.png").write_bytes(b"")
    cv2.imwrite(str(folder / "7.png"), np.full((30, 20), 99, dtype=np.uint8))
    cv2.imwrite(str(folder / "8.png"), np.zeros((HEIGHT, WIDTH), dtype=np.uint8))
    (folder / "notes.txt").write_text("12")
    found = read_recording(folder, "left_eye", width=WIDTH, height=HEIGHT)
    assert found.numbers.tolist() == list(range(11))
    faults = {number: fault for number, fault in enumerate(found.faults) if fault}
    assert faults == {5: Fault.UNREADABLE, 6: Fault.UNREADABLE, 7: Fault.SHAPE, 8: Fault.BLACK}
    large = [[WIDTH * 3, HEIGHT * 3]]
    assert found.scaled_from.tolist() == 5 * large + 4 * [[WIDTH, HEIGHT]] + 2 * large
    assert found.pictures.shape == (11, HEIGHT, WIDTH)
    footage = line_up({"left_eye": found}, SIZES)
    told = [
        note
        for note in footage.notes
        if note.startswith("left_eye: pictures of 48 x 36 are scaled to 16 x 12")
    ]
    assert ["check" in note for note in told] == [True], "square pictures too may show the eye elsewhere"
    assert "left_eye: 1 of 11 frames have a picture of another shape: 7" in footage.notes


def test_each_picture_of_a_folder_of_several_sizes_keeps_its_own(tmp_path: Path):
    for number, (picture, times) in enumerate(zip(pictures([90] * 4), (1, 2, 1, 3), strict=True)):
        large = cv2.resize(picture, (WIDTH * times, HEIGHT * times))
        assert cv2.imwrite(str(tmp_path / f"{number + (number > 1)}.png"), large)
    found = read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)
    footage = line_up({"left_eye": found, "mouth": recording("mouth", pictures([99] * 5))}, SIZES)
    # frame 2 has no picture
    expected = np.outer([1, 2, 1, 1, 3], (WIDTH, HEIGHT))
    assert {name: one.tolist() for name, one in footage.scaled_from.items()} == {
        "left_eye": expected.tolist()
    }
    assert any(
        "left_eye: pictures of 32 x 24, 48 x 36 are scaled to 16 x 12" in note for note in footage.notes
    )


def test_files_without_numbers_of_their_own_are_counted(tmp_path: Path):
    folder = write_pictures(tmp_path / "eye", pictures([90] * 3), name="take1_{:c}.png", first=ord("a"))
    found = read_recording(folder, "left_eye", width=WIDTH, height=HEIGHT)
    assert (found.numbers.tolist(), found.numbered) == ([0, 1, 2], False)


@pytest.mark.parametrize(
    ("names", "numbers"),
    [
        (["frame_0003", "frame_0011"], [3, 11]),
        (["0003", "0011"], [3, 11]),
        (["left-eye.0003", "left-eye.0011"], [3, 11]),
        (["take2_3", "take2_11"], [3, 11]),
        (["12.3.left", "12.11.left"], [3, 11]),
        # clock times: what follows the point says nothing without what stands before it
        (["1700000000.900012", "1700000001.100021", "1700000002.000003"], None),
        (["1700000000.200021", "1700000000.25", "1700000000.9"], None),
        (["9.5", "10.25", "10.5"], None),
        (["1700000000_900012", "1700000001_100021"], None),
        (["left_1700000000.25", "left_1700000000.5", "left_1700000001.125"], None),
        (["take2_9", "take10_1"], None),
        # of several numbers the one that differs counts
        (["000123_eye0", "000124_eye0", "001000_eye0"], [123, 124, 1000]),
        (["frame_9_240x240", "frame_10_240x240"], [9, 10]),
        (["v1.9", "v1.10"], [9, 10]),
    ],
)
def test_frames_are_in_the_order_that_their_names_say(
    tmp_path: Path, names: list[str], numbers: list[int] | None
):
    stack = pictures(np.linspace(60, 120, len(names)))
    for name, picture in zip(names, stack, strict=True):
        assert cv2.imwrite(str(tmp_path / f"{name}.png"), picture)
    found = read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)
    assert np.array_equal(found.pictures, stack)
    assert found.numbered is (numbers is not None)
    assert found.numbers.tolist() == (numbers or list(range(len(names))))


def test_what_macos_writes_beside_pictures_is_none(tmp_path: Path):
    stack = pictures([80, 90, 100])
    write_pictures(tmp_path, stack, first=1000)
    plain = read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)
    for file in list(tmp_path.iterdir()):
        (tmp_path / f"._{file.name}").write_bytes(b"\0\x05\x16\x07")
    found = read_recording(tmp_path, "left_eye", width=WIDTH, height=HEIGHT)
    assert found.numbers.tolist() == plain.numbers.tolist() == [1000, 1001, 1002]
    assert np.array_equal(found.pictures, plain.pictures)


def test_films_are_read_with_their_rate(tmp_path: Path):
    film = tmp_path / "eye.avi"
    writer = cv2.VideoWriter(str(film), cv2.VideoWriter_fourcc(*"MJPG"), 25, (WIDTH * 8, HEIGHT * 8))
    stack = pictures(np.linspace(60, 120, 12))
    for one in stack:
        large = cv2.resize(one, (WIDTH * 8, HEIGHT * 8), interpolation=cv2.INTER_NEAREST)
        writer.write(cv2.cvtColor(large, cv2.COLOR_GRAY2BGR))
    writer.release()
    found = read_recording(film, "left_eye", width=WIDTH, height=HEIGHT)
    assert (len(found.numbers), found.fps, found.numbered) == (12, 25, False)
    assert found.pictures.mean(axis=(1, 2)) == pytest.approx(stack.mean(axis=(1, 2)), abs=2)
    footage = line_up({"left_eye": found}, SIZES)
    assert footage.time_s == pytest.approx(np.arange(12) / 25)


def test_a_picture_is_turned_as_its_exif_says(tmp_path: Path):
    """Telephones write them so; orientation 6 is a quarter turn."""
    lying = cv2.resize(pictures(np.array([90.0]))[0], (4 * HEIGHT, 4 * WIDTH))
    jpeg = cv2.imencode(".jpg", lying)[1].tobytes()
    entry = struct.pack(">HHIHH", 0x0112, 3, 1, 6, 0)
    exif = b"Exif\0\0MM\0*" + struct.pack(">IH", 8, 1) + entry + struct.pack(">I", 0)
    folder = tmp_path / "eye"
    folder.mkdir()
    (folder / "0.jpg").write_bytes(
        jpeg[:2] + b"\xff\xe1" + struct.pack(">H", len(exif) + 2) + exif + jpeg[2:]
    )
    assert recorded_size(folder) == (4 * WIDTH, 4 * HEIGHT)
    assert read_recording(folder, "left_eye", width=WIDTH, height=HEIGHT).faults == (None,)


def test_a_film_is_turned_as_it_says(tmp_path: Path):
    upright = np.zeros((8 * HEIGHT, 8 * WIDTH, 3), np.uint8)
    upright[: 4 * HEIGHT] = 220
    film = lying_film(tmp_path / "eye.mp4", [upright] * 2)
    assert recorded_size(film) == (8 * WIDTH, 8 * HEIGHT)
    found = read_recording(film, "left_eye", width=WIDTH, height=HEIGHT)
    assert (found.pictures[:, : HEIGHT // 2 - 2] > 200).all()
    assert (found.pictures[:, HEIGHT // 2 + 2 :] < 20).all()


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("nowhere", "does not exist; a folder of left_eye's pictures or a film of them is needed"),
        ("empty", r"has no pictures of left_eye; \.png"),
        ("words.txt", "is neither a folder nor a film"),
        ("broken.mp4", "cannot be read as a film"),
    ],
)
def test_what_is_no_recording_is_refused(tmp_path: Path, name: str, message: str):
    (tmp_path / "empty").mkdir()
    (tmp_path / "words.txt").write_text("words")
    (tmp_path / "broken.mp4").write_bytes(b"\0" * 100)
    with pytest.raises(InputError, match=message):
        read_recording(tmp_path / name, "left_eye", width=WIDTH, height=HEIGHT)


def test_a_dataset_is_read_by_sample_and_none_of_it_is_frozen(tmp_path: Path):
    same = np.repeat(pictures([100]), 20, axis=0)
    for camera, stack in {"left_eye": same, "mouth": pictures([100] * 20)}.items():
        for sample, picture in enumerate(stack):
            folder = tmp_path / "renders" / "000" / f"{3 * sample:06d}"
            write_pictures(folder, picture[None], name=f"{camera}.png")
    found = {
        name: read_rendered(tmp_path, name, width=WIDTH, height=HEIGHT) for name in ("left_eye", "mouth")
    }
    footage = line_up(found, SIZES, still=True)
    assert footage.numbers.tolist() == list(range(0, 60, 3))
    assert footage.present[:, [0, 2]].all()
    with pytest.raises(InputError, match="has no rendered pictures of right_eye"):
        read_rendered(tmp_path, "right_eye", width=WIDTH, height=HEIGHT)


def test_footage_without_a_usable_picture_is_refused():
    black = np.zeros((3, HEIGHT, WIDTH), dtype=np.uint8)
    found = recording("mouth", black, faults=(Fault.BLACK,) * 3)
    with pytest.raises(
        InputError, match=r"no picture is usable: .*mouth: all of its 3 frames have a black picture"
    ):
        line_up({"mouth": found}, SIZES)


def test_pictures_of_another_shape_alone_are_told_what_helps():
    found = recording("mouth", np.zeros((3, HEIGHT, WIDTH), dtype=np.uint8), faults=(Fault.SHAPE,) * 3)
    with pytest.raises(InputError, match="`regress headset check` finds a placement"):
        line_up({"mouth": found}, SIZES)


def test_what_is_at_fault_leaves_no_picture():
    stacks = {name: pictures([100] * 30, seed=seed) for seed, name in enumerate(("left_eye", "mouth"))}
    stacks["mouth"][5:25] = stacks["mouth"][4]
    footage = line_up({name: recording(name, stack) for name, stack in stacks.items()}, SIZES)
    assert footage.faults["mouth"][5:25] == (None,) * 8 + (Fault.FROZEN,) * 12
    for name, there in zip(footage.cameras, footage.present.T, strict=True):
        assert not footage.pictures[name][~there].any()
        assert (footage.pictures[name][there].max(axis=(1, 2)) > 0).all()
