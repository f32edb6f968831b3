"""A simulated phone beside the camera: its delay comes out, its figures are right, and the take can be evaluated."""

import math
import socket
import struct
import time
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.runtime.sample import Sample
from tests.track.session.faces import talking_face
from track.comparison import phone as phones
from track.comparison.alignment import align
from track.comparison.comparison import compare_weights
from track.comparison.phone import MOST_TEXT_BYTES, Phone, on_this_clock, read_frame
from track.comparison.take import write_take
from track.errors import InputError
from track.sinks.live_link import LiveLink


def talk(seconds: float = 20.0, fps: float = 60.0, seed: int = 3) -> tuple[np.ndarray, np.ndarray]:
    """A face that moves as faces do: blinks, and ten shapes that wander at up to three Hertz."""
    rng = np.random.default_rng(seed)
    times_s = np.arange(0, seconds, 1 / fps)
    weights = np.zeros((len(times_s), 52))
    for name in ("jawOpen", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "browInnerUp", "mouthFunnel"):
        waves = [(rng.uniform(0.3, 3.0), rng.uniform(0, 6.28)) for _ in range(6)]
        wave = sum(np.sin(2 * math.pi * hz * times_s + phase) for hz, phase in waves)
        weights[:, BLENDSHAPE_INDEX[name]] = np.clip(0.3 + 0.1 * wave, 0, 1)
    for blink_s in np.cumsum(rng.uniform(1.5, 4.0, 20)):
        shut = np.clip(1 - np.abs(times_s - blink_s) / 0.1, 0, 1)
        weights[:, [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]] += shut[:, None]
    return times_s, np.clip(weights, 0, 1)


def seen_by_camera(times_s: np.ndarray, weights: np.ndarray, *, noise: float, seed: int) -> tuple:
    """Every second frame, with noise and with one shape that the network knows nothing of."""
    rng = np.random.default_rng(seed)
    tracked = weights[::2] + rng.normal(0, noise, weights[::2].shape)
    tracked[:, BLENDSHAPE_INDEX["mouthFunnel"]] = rng.uniform(0, 1, len(tracked))
    return times_s[::2], tracked


@settings(max_examples=12)
@given(st.floats(-0.9, 0.9), st.floats(0, 0.1), st.integers(0, 100))
def test_the_delay_comes_out_to_a_few_milliseconds(delay_s, noise, seed):
    times_s, weights = talk(seed=seed)
    camera_s, tracked = seen_by_camera(times_s, weights, noise=noise, seed=seed)
    found = align(camera_s, tracked, times_s + delay_s, weights)
    assert found.certain
    assert found.delay_s == pytest.approx(delay_s, abs=0.004)


def test_figures_are_those_of_the_aligned_frames():
    times_s, weights = talk()
    camera_s, tracked = seen_by_camera(times_s, weights, noise=0.05, seed=1)
    found = compare_weights(camera_s, tracked, times_s + 0.123, weights)
    assert found.shapes["jawOpen"].r == pytest.approx(
        np.corrcoef(tracked[:, BLENDSHAPE_INDEX["jawOpen"]], weights[::2, BLENDSHAPE_INDEX["jawOpen"]])[0, 1],
        abs=0.01,
    )
    assert found.shapes["jawOpen"].mae == pytest.approx(0.05 * np.sqrt(2 / np.pi), rel=0.1)
    assert found.shapes["mouthFunnel"].r == pytest.approx(0, abs=0.15)
    assert found.shapes["tongueOut"].r is None
    assert 0.9 < found.median_r <= 1


def test_another_face_is_told_from_the_same_one():
    times_s, weights = talk(seed=1)
    _, other = talk(seed=2)
    with pytest.raises(InputError, match="could not be aligned"):
        compare_weights(times_s[::2], weights[::2], times_s, other)


@pytest.mark.parametrize(
    ("camera", "phone", "words"),
    [(0, 100, "the camera gave 0 frames"), (100, 0, "the phone gave 0 frames .* Live Link Face")],
)
def test_a_side_that_gave_nothing_is_named(camera, phone, words):
    times_s, weights = talk()
    with pytest.raises(InputError, match=words):
        compare_weights(times_s[:camera], weights[:camera], times_s[:phone], weights[:phone])


def test_frames_are_read_as_our_own_sink_writes_them():
    weights = np.linspace(0, 1, 52)
    (datagram,) = LiveLink()(Sample(time_s=12.34, weights=weights))
    frame = read_frame(datagram)
    np.testing.assert_allclose(frame.weights, weights, atol=1e-6)
    assert frame.timecode_s == pytest.approx(12.34, abs=1e-4)
    (nobody,) = LiveLink()(Sample(time_s=12.34, weights=np.full(52, np.nan)))
    assert read_frame(nobody).weights is None


@given(st.binary(max_size=400))
def test_what_is_no_frame_is_nothing(datagram):
    assert read_frame(datagram) is None or len(datagram) > 20


@given(st.integers(0, 312), st.binary(min_size=1, max_size=8))
@example(107, b"\x00\x7f\x81")  # a signalling NaN
def test_damaged_frames_are_nothing_or_finite(place, bytes_there):
    (datagram,) = LiveLink()(Sample(time_s=1.0, weights=np.full(52, 0.5)))
    frame = read_frame(datagram[:place] + bytes_there + datagram[place + len(bytes_there) :])
    assert frame is None or frame.weights is None or np.isfinite(frame.weights).all()


def test_names_that_claim_to_be_endless_are_nothing():
    assert read_frame(struct.pack("!Bi", 6, MOST_TEXT_BYTES + 1) + b"x" * 400) is None


def test_the_phone_s_own_clock_takes_the_network_s_jitter_away():
    rng = np.random.default_rng(0)
    timecode_s = 5000 + np.arange(600) / 60
    arrival_s = timecode_s - 4000 + 0.02 + rng.exponential(0.02, 600)
    found = on_this_clock(arrival_s, timecode_s)
    assert np.ptp(found - (timecode_s - 4000)) < 1e-9
    assert abs((found - (timecode_s - 4000)).mean() - 0.02) < 0.005
    np.testing.assert_array_equal(on_this_clock(arrival_s, np.zeros(600)), arrival_s)


def test_a_simulated_phone_on_the_network_is_aligned(monkeypatch):
    """Our own sink, 180 ms late and with noise, over a real socket; both by this machine's clock, which is played."""
    times_s, weights = talk(seconds=10.0)
    camera_s, tracked = seen_by_camera(times_s, weights, noise=0.03, seed=5)
    phone, sending = Phone(0), socket.socket(socket.AF_INET, socket.SOCK_DGRAM)
    rng, late_s, encode = np.random.default_rng(6), 0.180, LiveLink()
    start_s = now_s = 1000.0
    monkeypatch.setattr(phones, "time", SimpleNamespace(perf_counter=lambda: now_s))
    until_s = time.monotonic() + 120
    for count, (time_s, row) in enumerate(zip(times_s, weights, strict=True), start=1):
        now_s = start_s + late_s + time_s
        noisy = np.clip(row + rng.normal(0, 0.02, 52), 0, 1)
        for datagram in encode(Sample(time_s=time_s + 3600, weights=noisy)):
            sending.sendto(datagram, ("127.0.0.1", phone.port))
        while phone.count < count and time.monotonic() < until_s:
            time.sleep(0.0002)
    phone.close()
    sending.close()
    found = compare_weights(camera_s + start_s, tracked, *phone.frames())
    assert found.alignment.delay_s == pytest.approx(late_s, abs=0.008)
    assert found.shapes["jawOpen"].r > 0.9


def test_a_port_that_is_taken_is_told():
    phone = Phone(0)
    with pytest.raises(InputError, match=f"livelink:{phone.port}: nothing can listen there"):
        Phone(phone.port)
    phone.close()


def test_the_take_is_what_regress_evaluate_reads(tmp_path):
    from regress.learning.training import evaluate_model, read_dataset
    from regress.runtime.model import load_model
    from regress.runtime.ready_made import model_folder

    points = talking_face().points[:300]
    model = load_model(model_folder("landmarks-default"))
    answers = model.calibrate(points[:60]).predict(points)
    folder = write_take(tmp_path / "take", points=points, weights=answers, neutral=points[:16])
    dataset = read_dataset(folder, splits=("test",))
    assert len(dataset.points) == 316
    assert dataset.neutral.sum() == 16
    scores = evaluate_model(model, dataset, split="test", calibrated=True)
    assert scores["jawOpen"].pearson > 0.95
    assert set(scores) <= set(BLENDSHAPES)
    with pytest.raises(InputError, match="is there already"):
        write_take(folder, points=points, weights=answers, neutral=points[:1])
    assert [path.name for path in tmp_path.iterdir()] == ["take"]
