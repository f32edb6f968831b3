"""Times beside a film count for its frames, where they are as many and rise."""

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from regress.errors import InputError
from regress.runtime.headset.recordings.film_times import times_beside
from regress.runtime.headset.recordings.footage import Footage, line_up
from regress.runtime.headset.recordings.recording import read_recording

SIZES = {"left_eye": (64, 64), "right_eye": (64, 64)}
FRAMES = 40


def film(path: Path, *, seed: int) -> Path:
    random = np.random.default_rng(seed)
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), 30, (64, 64))
    for _ in range(FRAMES):
        writer.write(random.integers(40, 200, (64, 64, 3), dtype=np.uint8))
    writer.release()
    return path


def as_array(path: Path, time_s: np.ndarray) -> None:
    np.save(path.with_suffix(".npy"), time_s)


def as_seconds(path: Path, time_s: np.ndarray) -> None:
    rows = "\n".join(f"{one!r},{row}" for row, one in enumerate(time_s.tolist()))
    path.with_suffix(".csv").write_text(f"# timestamps [seconds],pts\n{rows}\n")


def as_nanoseconds(path: Path, time_s: np.ndarray) -> None:
    rows = "\n".join(f"a,{round(1e9 * one)}" for one in time_s.tolist())
    path.with_suffix(".csv").write_text(f"section id,timestamp [ns]\n{rows}\n")


def take(folder: Path) -> Footage:
    recordings = {name: read_recording(folder / f"{name}.avi", name, width=64, height=64) for name in SIZES}
    return line_up(recordings, SIZES)


@pytest.mark.parametrize("write", [as_array, as_seconds, as_nanoseconds])
def test_eyes_that_began_apart_are_matched_by_their_clock(
    tmp_path: Path, write: Callable[[Path, np.ndarray], None]
):
    for seed, name in enumerate(SIZES):
        film(tmp_path / f"{name}.avi", seed=seed)
        write(tmp_path / f"{name}_timestamps", 4000.0 + 0.2 * seed + np.arange(FRAMES) / 30)
    footage = take(tmp_path)
    assert sum("its frames' times are those of" in note for note in footage.notes) == 2
    assert len(footage.numbers) == FRAMES - 6
    left = read_recording(tmp_path / "left_eye.avi", "left_eye", width=64, height=64)
    right = read_recording(tmp_path / "right_eye.avi", "right_eye", width=64, height=64)
    np.testing.assert_array_equal(footage.pictures["left_eye"], left.pictures[6:])
    np.testing.assert_array_equal(footage.pictures["right_eye"], right.pictures[:-6])


@pytest.mark.parametrize("same_clock", [True, False])
def test_a_film_with_a_clock_and_pictures_named_by_it_are_matched_by_it(tmp_path: Path, same_clock: bool):
    """Of two clocks that share no time nothing is known."""
    began_s = 1_700_000_000.0
    film(tmp_path / "left_eye.avi", seed=0)
    as_seconds(tmp_path / "left_eye_timestamps", (began_s if same_clock else 4000.0) + np.arange(FRAMES) / 30)
    (tmp_path / "right_eye").mkdir()
    random = np.random.default_rng(1)
    for time_s in began_s + 0.2 + np.arange(FRAMES) / 30:
        picture = random.integers(40, 200, (64, 64), dtype=np.uint8)
        assert cv2.imwrite(str(tmp_path / "right_eye" / f"{time_s:.6f}.png"), picture)
    paths = {"left_eye": tmp_path / "left_eye.avi", "right_eye": tmp_path / "right_eye"}
    recordings = {name: read_recording(path, name, width=64, height=64) for name, path in paths.items()}
    if not same_clock:
        with pytest.raises(InputError, match="nothing in common"):
            line_up(recordings, SIZES)
        return
    footage = line_up(recordings, SIZES)
    assert len(footage.numbers) == FRAMES - 6
    np.testing.assert_array_equal(footage.pictures["left_eye"], recordings["left_eye"].pictures[6:])
    np.testing.assert_array_equal(footage.pictures["right_eye"], recordings["right_eye"].pictures[:-6])


def test_beside_a_film_without_one_a_clock_begins_with_the_film(tmp_path: Path):
    for seed, name in enumerate(SIZES):
        film(tmp_path / f"{name}.avi", seed=seed)
    as_array(tmp_path / "left_eye_timestamps", 4000.0 + np.arange(FRAMES) / 30)
    assert len(take(tmp_path).numbers) == FRAMES


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (np.arange(FRAMES - 1) / 30, "it has 39 times, and the film 40 frames"),
        (np.zeros(FRAMES), "its times do not rise"),
        (np.array(["a"] * FRAMES), "holds no numbers"),
        ("frame,time\n0,1\n", "none of its columns is called timestamp"),
        ("timestamp\nnever\n", "could not convert"),
        ("a,timestamp\n1\n", "too few cells"),
        ("", "none of its columns"),
    ],
)
def test_what_is_of_no_use_is_told_and_the_films_own_times_count(
    tmp_path: Path, content: np.ndarray | str, said: str
):
    path = tmp_path / "eye0_timestamps"
    if isinstance(content, str):
        path.with_suffix(".csv").write_text(content)
    else:
        as_array(path, content)
    found, told = times_beside(tmp_path / "eye0.mp4", FRAMES)
    assert found is None
    assert said in told
    assert times_beside(tmp_path / "eye1.mp4", FRAMES) == (None, "")
