"""Calm frames stand for a neutral face where they are enough, and early ones agree with late ones."""

import numpy as np
import pytest

from regress.runtime.calm import calm_frames


@pytest.mark.parametrize(
    ("frames", "between", "sure", "words"),
    [
        (32, 0.0, True, "8 calm frames of 32 agree to 0.00"),
        (28, 0.0, False, "28 frames are usable, and 32 are needed"),
        (32, 0.1, True, "agree to 0.10"),
        (32, 0.11, False, "differ by weights of 0.11, and 0.1 is allowed"),
    ],
)
def test_the_calmest_quarter_must_be_enough_and_agree(frames, between, sure, words):
    activity = np.arange(frames)[::-1] / frames  # the latest frames are the calmest
    found = calm_frames(activity, np.arange(frames) + 100, difference=lambda *_: between, agreement=0.1)
    assert found.sure == sure
    assert words in found.reason
    np.testing.assert_array_equal(found.frames, 100 + np.arange(frames)[-frames // 4 :])
