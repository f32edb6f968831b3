"""Which of two answers leads without targets: traced points where they move farther, the network's own elsewhere."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPES
from regress.cli.headset_input import read_footage
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.predict import predict_footage
from regress.runtime.headset.answers.traced_eyes import traced_eyes
from regress.runtime.headset.eyes.gaze_lead import GazeLead, led_take
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.person.person import OwnEye, Person
from regress.runtime.headset.recordings.footage import Footage
from regress.runtime.stages.gaze import LOOKS, look_weights

TAKE = Path(__file__).parents[3] / "docs" / "samples" / "headset"
AHEAD = np.array([30.0, -40.0])


def looks(seconds: float, fps: float, seed: int, spread_deg: float = 8.0) -> np.ndarray:
    """Where eyes look (n, 2) in degrees that rest for a third of a second each time."""
    random = np.random.default_rng(seed)
    rests = random.normal(0, spread_deg, (int(3 * seconds) + 1, 2))
    return rests[(3 * np.arange(int(seconds * fps)) / fps).astype(int)]


def led(traced: np.ndarray, direct: np.ndarray, fps: float) -> tuple[np.ndarray, np.ndarray]:
    """Gaze (n, 2) and the traced answer's share (n,)."""
    lead, gazes, shares = GazeLead(), [], []
    for one, other in zip(traced, direct, strict=True):
        lead.step(1 / fps, one, other, seen=1.0)
        gazes.append(lead.led(one, other))
        shares.append(lead.share)
    return np.array(gazes), np.array(shares)


@given(st.floats(0.4, 0.9), st.floats(0, 3), st.floats(0, 10), st.integers(0, 2**32 - 1))
def test_where_points_move_less_the_network_leads_whatever_the_noise(
    farther: float, noise_deg: float, spread_deg: float, seed: int
):
    direct = looks(20, 30, seed, spread_deg)
    random = np.random.default_rng(seed + 1)
    traced = AHEAD + farther * direct + noise_deg * random.standard_normal(direct.shape)
    said, shares = led(traced, direct, 30)
    # noise of the points by itself moves nothing along with the network's answer
    assert shares.max() < 0.25
    if noise_deg < 1:
        assert shares.max() == 0
        np.testing.assert_array_equal(said, direct)


@given(st.floats(1.3, 3), st.sampled_from([30.0, 120.0]), st.integers(0, 2**32 - 1))
def test_where_points_move_farther_they_lead_within_seconds_about_the_same_middle(
    farther: float, fps: float, seed: int
):
    true = looks(20, fps, seed)
    direct, traced = 2.0 + true / farther, AHEAD + true
    said, shares = led(traced, direct, fps)
    late = slice(int(15 * fps), None)
    assert shares[late].min() > 0.8
    assert np.polyfit(true[late, 0], said[late, 0], 1)[0] == pytest.approx(1, abs=0.1)
    assert np.abs(said[late].mean(axis=0) - direct[late].mean(axis=0)).max() < 10
    # it comes in bit by bit
    assert np.abs(np.diff(shares)).max() < 0.04 * 30 / fps
    assert shares[: int(0.3 * fps)].max() == 0


def test_shut_eyes_and_what_is_not_traced_teach_nothing():
    true, lead = looks(20, 30, 0), GazeLead()
    for one in true:
        lead.step(1 / 30, AHEAD + 2 * one, one, seen=0.9)
        lead.step(1 / 30, np.full(2, np.nan), one, seen=1.0)
        lead.step(0.0, AHEAD + 2 * one, one, seen=1.0)
    assert lead.share == 0
    assert lead.led(np.full(2, np.nan), AHEAD) is AHEAD


def test_of_a_take_the_first_frames_are_led_as_the_last_are_but_shut_eyes_by_the_network():
    true = looks(20, 30, 1)
    direct, traced, seen = true / 2, AHEAD + true, np.ones(len(true))
    seen[:5], traced[5:10] = 0.0, np.nan
    said = led_take(traced, direct, seen=seen, seconds=np.full(len(true), 1 / 30))
    np.testing.assert_array_equal(said[:10], direct[:10])
    assert np.polyfit(true[10:, 0], said[10:, 0], 1)[0] == pytest.approx(1, abs=0.05)
    slower = led_take(AHEAD + true / 3, direct, seen=np.ones(len(true)), seconds=np.full(len(true), 1 / 30))
    np.testing.assert_array_equal(slower, direct)


@dataclass(frozen=True)
class _PulledIn:
    """A graph whose gaze is pulled to the middle, as of pictures that look strange."""

    graph: Any
    factor: float

    def __getattr__(self, name: str) -> Any:
        return getattr(self.graph, name)

    def see(self, *arguments: Any, **words: Any) -> tuple[Any, Mapping[str, np.ndarray]]:
        estimates, points = self.graph.see(*arguments, **words)
        return replace(estimates, gaze=estimates.gaze * self.factor), points

    def run(self, *arguments: Any, **words: Any) -> Any:
        estimates = self.graph.run(*arguments, **words)
        return replace(estimates, gaze=estimates.gaze * self.factor)


@pytest.fixture(scope="module")
def home() -> HeadsetPredictor:
    return load_headset_predictor("headset-tracking3")


@pytest.fixture(scope="module")
def footage(home: HeadsetPredictor) -> Footage:
    """Five times the sample's frames, whose eyes look about."""
    given = {name: TAKE / name for name in ("left_eye", "right_eye", "mouth")}
    take = read_footage(home, None, given, from_start=False, fps=None)
    rows = np.tile(np.arange(len(take.numbers)), 5)
    return replace(
        take,
        numbers=np.arange(len(rows)),
        pictures={name: frames[rows] for name, frames in take.pictures.items()},
        faults={name: tuple(found[row] for row in rows) for name, found in take.faults.items()},
        time_s=np.arange(len(rows)) / 30,
    )


def test_at_home_predict_says_what_the_network_says(home: HeadsetPredictor, footage: Footage):
    said, still = (predict_footage(home, footage, still=each)[0].samples for each in (False, True))
    for one, other in zip(said, still, strict=True):
        np.testing.assert_array_equal(one.gaze, other.gaze)
        np.testing.assert_array_equal(one.weights, other.weights)


def test_of_a_strange_camera_predict_goes_by_traced_points(home: HeadsetPredictor, footage: Footage):
    strange = replace(home, graph=_PulledIn(home.graph, 0.4))
    true, said, still = (
        predict_footage(one, footage, still=each)[0].samples
        for one, each in ((home, False), (strange, False), (strange, True))
    )
    # from the first frame on: all of a take is seen before
    gazes = [np.array([sample.gaze for sample in samples])[:100] for samples in (true, said, still)]
    spreads = [each[:, [0, 2]].std() for each in gazes]
    assert spreads[1] > 0.6 * spreads[0]
    assert spreads[2] == pytest.approx(0.4 * spreads[0], rel=1e-3)
    assert np.corrcoef(gazes[0][:, 0], gazes[1][:, 0])[0, 1] > 0.8
    last = said[-1]
    np.testing.assert_allclose(last.weights[LOOKS], look_weights(last.gaze), atol=1e-3)
    others = [row for row in range(len(BLENDSHAPES)) if row not in LOOKS]
    np.testing.assert_array_equal(last.weights[others], still[-1].weights[others])


def test_eyes_of_many_headsets_go_by_what_leads_where_no_target_decided(footage: Footage):
    many = load_headset_predictor("headset-any")
    pulled = replace(many, graph=_PulledIn(many.graph, 0.4))
    own, led_ = (traced_eyes(one, footage)["left_eye"] for one in (many, pulled))
    seen = own.openness > 0.5
    assert led_.gaze_deg[seen, 0].std() > 0.6 * own.gaze_deg[seen, 0].std()


@pytest.mark.parametrize("known", ["nothing", "the middle"])
def test_live_eyes_go_by_what_leads_where_no_target_decided(
    home: HeadsetPredictor, footage: Footage, known: str
):
    straight = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))
    eye = OwnEye() if known == "nothing" else OwnEye(traced=straight, direct=straight)
    spreads = {}
    for factor in (1.0, 0.4):
        strange = replace(home, graph=_PulledIn(home.graph, factor))
        reader = EyeReader(strange, Person(eyes={"left_eye": eye, "right_eye": eye}))
        estimates, points = strange.see(footage.pictures)
        gazes = []
        for row, direct in enumerate(estimates.gaze):
            seen, traced = (
                {name: one[row] for name, one in table.items()} for table in (footage.pictures, points)
            )
            gazes.append(reader.read(1 / 30, seen, traced, direct.astype(np.float64).ravel())[1])
        spreads[factor] = np.array(gazes)[300:, [0, 2]].std()
    assert spreads[0.4] > 0.6 * spreads[1.0]
