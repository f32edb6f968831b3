"""Batches of headset training: whose pictures a frame shows, what is displaced, mirrored and lit anew."""

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from facegen.conventions import BLENDSHAPE_INDEX  # noqa: E402
from regress.learning.headset.arrays import HeadsetArrays  # noqa: E402
from regress.learning.headset.recipe import HeadsetRecipe  # noqa: E402
from regress.learning.headset.training.batches import TrainingFrames  # noqa: E402
from regress.learning.headset.training.photometry import draw_photometry  # noqa: E402
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN  # noqa: E402

pytestmark = pytest.mark.slow


def test_plain_frames_keep_their_light_and_are_displaced_little(arrays: HeadsetArrays):
    random, plain = np.random.default_rng(0), np.arange(6) % 2 == 0
    seen = torch.from_numpy(arrays.pictures["mouth"][:6].astype(np.float32))[:, None]
    pictures, neutral = draw_photometry(random, seen, seen, 1.0, plain)
    for given in (pictures, neutral):
        assert torch.equal(given[plain], seen[plain])
        assert (given[~plain] != seen[~plain]).any(dim=(1, 2, 3)).all()

    def moved(share: float, shift: float = 0.3) -> float:
        still = {"scale": 0.0, "rotation_deg": 0.0}
        recipe = HeadsetRecipe(
            input_size=16, batch=len(arrays.rows("train")), plain=share, shift=shift, **still
        )
        frames = TrainingFrames(arrays, recipe, arrays.rows("train"))
        (batch,) = frames.draw_epoch(np.random.default_rng(0))
        assert (batch.plain == bool(share)).all()
        return float(np.nanvar(batch.positions[2]))

    by_itself = moved(0.0, shift=0.0)
    assert moved(1.0) - by_itself < 0.5**2 * (moved(0.0) - by_itself)


def test_batches_pair_frames_with_neutral_pictures_of_the_same_person(arrays: HeadsetArrays):
    still = {
        "plain": 0.0,
        "shift": 0.0,
        "scale": 0.0,
        "rotation_deg": 0.0,
        "mirror": False,
        "camera_dropout": 0.0,
    }
    recipe = HeadsetRecipe(
        input_size=16, batch=len(arrays.rows("train")), other_seat=0.5, jitter_neutral=0, **still
    )
    assert recipe.square_size == 24  # as the pictures
    frames = TrainingFrames(arrays, recipe, arrays.rows("train"))
    (batch,) = frames.draw_epoch(np.random.default_rng(0))
    left, mouth = arrays.pictures["left_eye"].astype(int), arrays.pictures["mouth"].astype(int)
    own, other = arrays.neutral_rows(), arrays.neutral_rows(other_seat=True)
    for place in range(len(batch.outputs)):
        unlike = np.abs(left - batch.pictures[place, 0]) + np.abs(mouth - batch.pictures[place, 2])
        row = int(np.argmin(unlike.sum(axis=(1, 2))))
        np.testing.assert_array_equal(batch.pictures[place, 0], left[row])
        np.testing.assert_array_equal(batch.outputs[place, :52], arrays.weights[row])
        neutral = left[(own if batch.same_seat[place] else other)[row]]
        expected = neutral if batch.calibrated[place] else 0 * neutral
        np.testing.assert_array_equal(batch.neutral[place, 0], expected)
    assert 0.3 < batch.same_seat.mean() < 0.7
    assert 0.45 < batch.calibrated.mean() < 0.75


def test_a_mirrored_frame_is_the_frame_of_the_mirrored_face(arrays: HeadsetArrays):
    still = {"plain": 0.0, "shift": 0.0, "scale": 0.0, "rotation_deg": 0.0, "camera_dropout": 0.0}
    recipe = HeadsetRecipe(input_size=16, batch=len(arrays.rows("train")), **still)
    frames = TrainingFrames(arrays, recipe, arrays.rows("train"))
    (batch,) = frames.draw_epoch(np.random.default_rng(0))
    left, right, mouth = (arrays.pictures[name].astype(int) for name in ("left_eye", "right_eye", "mouth"))
    counted = [0, 0]
    for place in range(len(batch.outputs)):
        seen = batch.pictures[place].astype(int)
        # a face whose mouth rests has the neutral face's mouth picture: the eyes tell them apart
        plain = (np.abs(mouth - seen[2]) + np.abs(left - seen[0])).sum(axis=(1, 2))
        turned = (np.abs(mouth - seen[2][:, ::-1]) + np.abs(left - seen[1])).sum(axis=(1, 2))
        mirrored = bool(turned.min() < plain.min())
        row = int(np.argmin(turned if mirrored else plain))
        # the right eye goes through the left's encoder mirrored: its slot holds a left eye's picture
        expected = (right[row][:, ::-1], left[row]) if mirrored else (left[row], right[row][:, ::-1])
        np.testing.assert_array_equal(seen[:2], expected)
        outputs = np.concatenate([arrays.weights[row], arrays.gaze[row]])
        np.testing.assert_allclose(
            batch.outputs[place], outputs[MIRROR] * MIRROR_SIGN if mirrored else outputs
        )
        counted[mirrored] += 1
    assert min(counted) > 20


def test_an_epoch_shows_frames_with_shut_eyes_again(arrays: HeadsetArrays):
    rows = arrays.rows("train")
    blink = arrays.weights[:, [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]].max(
        axis=1
    )
    recipe = HeadsetRecipe(input_size=16, batch=1, mirror=False, shut_eyes=2, plain=0.0)
    frames = TrainingFrames(arrays, recipe, rows)
    shown = np.concatenate([batch.outputs for batch in frames.draw_epoch(np.random.default_rng(0))])
    assert len(shown) == frames.batches == len(rows) + 2 * np.sum(blink[rows] > 0.5)
    expected = frames.outputs[np.concatenate([rows, np.repeat(rows[blink[rows] > 0.5], 2)])]
    assert len(expected) > len(rows)
    np.testing.assert_array_equal(shown[np.lexsort(shown.T)], expected[np.lexsort(expected.T)])
