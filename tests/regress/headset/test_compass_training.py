"""Training of the compass on drawn arrays: views in every orientation, a graph, a stop, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from regress.errors import InputError, Interrupted  # noqa: E402
from regress.learning.headset.arrays import HeadsetArrays, read_arrays  # noqa: E402
from regress.learning.headset.compass import train_compass  # noqa: E402
from regress.learning.headset.compass.views import draw_views, eyes_of  # noqa: E402
from regress.runtime.headset.placing.compass import COMPASS_SIDE, EyeCompass  # noqa: E402
from regress.runtime.onnx_session import open_session  # noqa: E402
from tests.regress.headset.drawn import write_drawn_arrays  # noqa: E402

pytestmark = pytest.mark.slow


def corner_pictures(count: int) -> np.ndarray:
    """Pictures (n, 40, 40) whose upper left corner is bright, the upper right one half so: they tell orientations."""
    pictures = np.zeros((count, 40, 40), np.uint8)
    pictures[:, :20, :20], pictures[:, :20, 20:] = 240, 120
    return pictures


def test_a_view_has_the_orientation_that_is_said():
    views, orientations = draw_views(np.random.default_rng(0), corner_pictures(400))
    assert views.shape == (400, COMPASS_SIDE, COMPASS_SIDE)
    assert np.bincount(orientations, minlength=8).min() > 25
    near, far = slice(8, 28), slice(36, 56)
    corners = {
        "upper left": (near, near),
        "upper right": (near, far),
        "lower right": (far, far),
        "lower left": (far, near),
    }
    # a view that is turned clockwise shows what lies there turned to the left
    brightest = {0: "upper left", 2: "lower left", 4: "lower right", 6: "upper right"}
    mirrored = {1: "upper right", 3: "lower right", 5: "lower left", 7: "upper left"}
    for orientation, expected in (brightest | mirrored).items():
        mean = views[orientations == orientation].mean(axis=0)
        levels = {name: mean[place].mean() for name, place in corners.items()}
        assert max(levels, key=levels.__getitem__) == expected


def test_right_eyes_are_seen_as_left_ones(arrays: HeadsetArrays):
    rows = arrays.rows("train")
    eyes = eyes_of(arrays, rows)
    np.testing.assert_array_equal(eyes[: len(rows)], arrays.pictures["left_eye"][rows])
    np.testing.assert_array_equal(eyes[len(rows) :], arrays.pictures["right_eye"][rows][:, :, ::-1])


def test_a_stopped_training_goes_on_to_the_same_compass(arrays: HeadsetArrays, tmp_path: Path):
    def stop(stage: str, done: int, total: int) -> None:
        raise KeyboardInterrupt

    whole, stopped = tmp_path / "whole.onnx", tmp_path / "stopped.onnx"
    scores = train_compass(arrays, whole, epochs=2)
    assert 0 <= scores.orientation <= min(scores.side, scores.quarter) <= 1
    with pytest.raises(Interrupted, match="after 1 of 4 epochs; run the same command again"):
        train_compass(arrays, stopped, epochs=2, progress=stop)
    with pytest.raises(InputError, match="a training with other settings or data; remove it"):
        train_compass(arrays, stopped, epochs=3)
    train_compass(arrays, stopped, epochs=2)
    assert stopped.read_bytes() == whole.read_bytes()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["stopped.onnx", "whole.onnx"]
    shares = EyeCompass(session=open_session(whole.read_bytes())).log_shares(
        arrays.pictures["left_eye"][:4], of_right_eye=False
    )
    assert shares.shape == (8,)


def test_it_learns_to_tell_orientations(tmp_path: Path):
    """Corners of known brightness are told after a few passes; drawn at random an eighth would be right."""
    arrays = read_arrays(write_drawn_arrays(tmp_path / "arrays", people=30))
    for name in ("left_eye", "right_eye"):
        corners = corner_pictures(len(arrays.person))
        arrays.pictures[name] = corners if name == "left_eye" else corners[:, :, ::-1]
    scores = train_compass(arrays, tmp_path / "compass.onnx", epochs=8, members=1)
    assert scores.orientation > 0.7


def test_what_cannot_be_learned_from_is_refused(
    arrays: HeadsetArrays, arrays_folder: Path, run, tmp_path: Path
):
    (tmp_path / ".damaged.onnx.0.checkpoint").write_bytes(b"no checkpoint")
    with pytest.raises(InputError, match="is not a checkpoint of a compass"):
        train_compass(arrays, tmp_path / "damaged.onnx", epochs=1)
    code, _, said = run("headset", "compass", arrays_folder, "--out", tmp_path / "compass.txt")
    assert (code, "a graph ends with .onnx" in said) == (2, True)
