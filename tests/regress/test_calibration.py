"""Neutral frames: what calibrating a model does to predictions, exports and commands."""

import dataclasses
import json

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, LANDMARK_GROUPS
from regress.errors import InputError
from regress.exporters import export_model
from regress.learning.training import KeypointDataset, evaluate_model, train
from regress.learning.training.noise import DetectorNoise, displace, draw_bias, draw_displacements
from regress.learning.training.preparation import faces_of, prepare
from regress.runtime.features import extract
from regress.runtime.model import Model, load_model, save_model
from regress.runtime.networks import evaluate
from regress.runtime.sample import Sample
from regress.runtime.stages.networks import (
    AGAIN_AT_S,
    FORGOTTEN_S,
    SURE_FROM_S,
    AutomaticCalibration,
    LandmarkNetworks,
)
from regress.runtime.stages.neutral import SHARES, estimate_neutral, frame_rate
from tests.regress.conftest import QUICK, write_dataset
from tests.regress.drawn import SHAPE_MODES_SEED, drawn_face, drawn_faces, in_pictures
from tests.regress.exporters.readers import READERS

FACES = drawn_faces(np.random.default_rng(2), 40)


def test_a_calibrated_model_sees_differences_from_the_neutral_frame(quick_model: Model):
    neutral = FACES[:1]
    calibrated = quick_model.calibrate(neutral)
    differences = extract(quick_model.features, FACES) - extract(quick_model.features, neutral)
    expected = evaluate(quick_model.calibrated.networks, differences)
    assert np.allclose(calibrated.predict_raw(FACES), expected)
    assert calibrated.calibrated is None
    assert calibrated.outputs == quick_model.outputs


def test_the_median_of_neutral_frames_counts_and_missing_ones_do_not(quick_model: Model):
    frames = np.concatenate([np.repeat(FACES[:1], 5, axis=0), FACES[1:3], np.full((1, 68, 2), np.nan)])
    assert np.allclose(
        quick_model.calibrate(frames).predict(FACES), quick_model.calibrate(FACES[:1]).predict(FACES)
    )
    with pytest.raises(InputError, match="no neutral frame is usable"):
        quick_model.calibrate(frames[-1:])
    one = quick_model.calibrate(FACES[0])  # a single face needs no count
    assert np.array_equal(one.predict(FACES), quick_model.calibrate(FACES[:1]).predict(FACES))
    with pytest.raises(InputError, match=r"\(m, 68, 2\) is needed"):
        quick_model.calibrate(FACES[0, :67])


def test_one_odd_neutral_frame_does_no_harm_wherever_it_stands(quick_model: Model):
    odd, rest = FACES[1:2], np.repeat(FACES[:1], 2, axis=0)
    expected = quick_model.calibrate(rest).predict(FACES)
    for frames in ([odd, rest], [rest, odd], [rest[:1], odd, rest[:1]]):
        assert np.allclose(quick_model.calibrate(np.concatenate(frames)).predict(FACES), expected)


def test_a_model_without_calibrated_networks_says_so(quick_model: Model, dataset: KeypointDataset):
    bare = dataclasses.replace(quick_model, calibrated=None)
    for act in (
        lambda: bare.calibrate(FACES[:1]),
        lambda: estimate_neutral(bare, FACES),
        lambda: evaluate_model(bare, dataset, calibrated=True),
    ):
        with pytest.raises(InputError, match="no calibrated networks"):
            act()


def test_both_sets_are_saved_and_old_folders_serve_without(quick_model: Model, tmp_path):
    save_model(quick_model, tmp_path / "both")
    loaded = load_model(tmp_path / "both")
    assert np.array_equal(
        loaded.calibrate(FACES[:1]).predict(FACES), quick_model.calibrate(FACES[:1]).predict(FACES)
    )
    save_model(quick_model.calibrate(FACES[:1]), tmp_path / "person")
    person = load_model(tmp_path / "person")
    assert person.calibrated is None
    assert np.array_equal(person.predict(FACES), quick_model.calibrate(FACES[:1]).predict(FACES))


@pytest.mark.parametrize("chosen", ["json", "npz", "onnx"])
def test_exports_of_a_calibrated_model_agree_with_it(chosen: str, quick_model: Model, tmp_path):
    calibrated = quick_model.calibrate(FACES[:3])
    predict, _ = READERS[chosen](export_model(calibrated, tmp_path, name="face", formats=[chosen]))
    faces = FACES.astype(np.float32)
    np.testing.assert_allclose(predict(faces), calibrated.predict(faces), atol=1e-4, rtol=0)


def test_datasets_without_neutral_faces_train_one_set(dataset: KeypointDataset):
    quick = dataclasses.replace(QUICK, steps=2, alphas=(1.0,))
    model = train(dataclasses.replace(dataset, neutral=np.zeros(len(dataset.split), dtype=bool)), quick)
    assert model.calibrated is None
    assert "calibrated" not in model.record.summary


def test_every_row_has_its_persons_neutral_row(dataset: KeypointDataset):
    rows = dataset.neutral_rows()
    assert np.array_equal(dataset.person[rows], dataset.person)
    assert dataset.neutral[rows].all()
    few = dataclasses.replace(dataset, neutral=dataset.neutral & (dataset.person > 0))
    assert (few.neutral_rows()[few.person == 0] == -1).all()
    assert not faces_of(few, "test", calibrated=True).weights.sum(axis=1).min() == 0


def test_calibration_removes_a_bias(quick_model: Model, dataset: KeypointDataset):
    """A constant displacement changes calibrated weights far less than weights of a frame alone."""
    rows = dataset.rows("test")
    neutral = dataset.points[dataset.neutral_rows()[rows]]
    offset = 0.5 * np.repeat(draw_bias(np.random.default_rng(1), 1), len(rows), axis=0)
    moved, moved_neutral = displace(dataset.points[rows], offset), displace(neutral, offset)
    alone = np.abs(quick_model.predict(moved) - quick_model.predict(dataset.points[rows])).mean()
    networks = quick_model.calibrated.networks

    def compared(points: np.ndarray, neutral: np.ndarray) -> np.ndarray:
        features = extract(quick_model.features, points) - extract(quick_model.features, neutral)
        return np.clip(evaluate(networks, features), 0, 1)

    change = np.abs(compared(moved, moved_neutral) - compared(dataset.points[rows], neutral)).mean()
    assert change < alone / 2


def test_bias_is_as_large_as_measured_and_follows_size_and_roll():
    bias = draw_bias(np.random.default_rng(0), 4000)
    measured = {"jaw": 0.083, "left_brow": 0.060, "nose_bridge": 0.031, "left_eye": 0.024, "inner_lip": 0.032}
    for group, distance in measured.items():
        found = np.sqrt((bias[:, list(LANDMARK_GROUPS[group])] ** 2).sum(axis=2).mean())
        assert found == pytest.approx(distance, rel=0.03), group
    face = drawn_face()[None]
    moved = displace(face, bias[:1]) - face
    turn = np.array([[0.0, 1.0], [-1.0, 0.0]])
    assert np.allclose(displace(3 * face @ turn, bias[:1]) - 3 * face @ turn, 3 * moved @ turn)
    across = np.linalg.norm(face[0, 45] - face[0, 36])
    assert np.allclose(moved, bias[:1] * across, atol=1e-9)


def test_a_frame_and_its_neutral_share_the_bias_and_nothing_else():
    noise = DetectorNoise(bias=1.0, drift=0.0, jitter=0.0, clean=0.25)
    frame, neutral = draw_displacements(noise, np.random.default_rng(0), 400)
    assert np.array_equal(frame, neutral)
    assert np.mean(np.abs(frame).max(axis=(1, 2)) == 0) == pytest.approx(0.25, abs=0.06)
    frame, neutral = draw_displacements(
        dataclasses.replace(noise, bias=0, jitter=0.01), np.random.default_rng(0), 400
    )
    moved = np.abs(frame).max(axis=(1, 2)) > 0
    assert abs(np.corrcoef(frame[moved].ravel(), neutral[moved].ravel())[0, 1]) < 0.02


def test_jitter_differs_from_face_to_face_and_some_faces_have_nothing_else():
    noise = DetectorNoise(bias=1.0, drift=0.1, jitter=0.001, jitter_most=0.02, clean=0.2, unbiased=0.5)
    frame, neutral = draw_displacements(noise, np.random.default_rng(0), 4000)
    passing = (frame - neutral).std(axis=(1, 2)) / np.sqrt(2)
    alone = np.abs(frame).mean(axis=(1, 2)) < 0.02  # a bias moves a face by 0.03
    still = passing == 0
    assert still.mean() == pytest.approx(0.2, abs=0.02)
    jittered = alone & ~still
    assert jittered.mean() == pytest.approx(0.5, abs=0.03)
    levels = np.log(passing[jittered])
    assert np.median(levels) == pytest.approx(np.log(0.001 * 0.02) / 2, abs=0.15)
    assert np.log(0.0008) < levels.min() < levels.max() < np.log(0.024)


def test_rows_that_noise_left_alone_are_known(quick_model: Model, dataset: KeypointDataset):
    noise = DetectorNoise(bias=1.0, clean=0.4, copies=3)
    splits = prepare(dataset, quick_model.features, mirror=True, noise=noise).splits
    assert splits["train"].exact.mean() == pytest.approx(0.4, abs=0.05)
    assert splits["test"].exact.all()
    plain = prepare(dataset, quick_model.features, mirror=True).splits
    assert plain["train"].exact.all()


def _recording(dataset: KeypointDataset, *, calm: int, moving: int) -> tuple[np.ndarray, np.ndarray]:
    """One person's frames, neutral ones at the end, with some jitter; and which are neutral."""
    rng = np.random.default_rng(3)
    faces = np.stack([drawn_face()] * calm)
    drawn = dataset.points[~dataset.neutral][:moving]
    frames = np.concatenate([drawn, in_pictures(rng, faces)])
    across = np.linalg.norm(frames[:, 45] - frames[:, 36], axis=1)[:, None, None]
    return frames + rng.normal(size=frames.shape) * 3e-4 * across, np.arange(len(frames)) >= moving


def test_auto_finds_the_calm_frames_and_says_when_they_are_too_few(
    quick_model: Model, dataset: KeypointDataset
):
    frames, calm = _recording(dataset, calm=40, moving=40)
    frames[70] = np.nan
    estimate = estimate_neutral(quick_model, frames)
    assert estimate.sure, estimate.reason
    assert calm[estimate.frames].all()
    assert 70 not in estimate.frames
    short = estimate_neutral(quick_model, frames[30:50])
    assert short.sure, short.reason
    assert calm[30:50][short.frames].all()
    few = estimate_neutral(quick_model, frames[30:49])
    assert not few.sure
    assert few.reason == "19 frames are usable, and 20 are needed"
    restless = estimate_neutral(quick_model, dataset.points[~dataset.neutral][:40])
    assert not restless.sure
    assert "differ by weights" in restless.reason


def _talk(rng: np.random.Generator, frames: int, *, rests: bool) -> np.ndarray:
    """A mouth whose shapes come and go, 30 frames a second; it may rest in the first half."""
    weights = np.zeros((frames, len(BLENDSHAPES)))
    for name, cycles_s in (
        ("jawOpen", 4.1),
        ("mouthFunnel", 2.3),
        ("mouthSmileLeft", 0.9),
        ("mouthPucker", 3.1),
    ):
        weights[:, BLENDSHAPES.index(name)] = 0.5 - 0.5 * np.cos(
            2 * np.pi * cycles_s * np.arange(frames) / 30
        )
    weights[: frames // 2] *= not rests
    modes = np.random.default_rng(SHAPE_MODES_SEED).normal(size=(len(BLENDSHAPES), 68, 2)) * 0.03
    faces = drawn_face() + np.einsum("nk,kpd->npd", weights, modes)
    return faces + rng.normal(size=faces.shape) * 3e-4 * np.ptp(faces[0, :, 0])


@pytest.mark.parametrize("frames", [60, 300])
def test_auto_does_not_take_talk_for_a_resting_face(quick_model: Model, frames: int):
    talk = estimate_neutral(quick_model, _talk(np.random.default_rng(1), frames, rests=False))
    assert not talk.sure
    rest = estimate_neutral(quick_model, _talk(np.random.default_rng(1), frames, rests=True))
    assert rest.sure, rest.reason
    assert np.mean(rest.frames < frames // 2) > 0.7  # a mouth that talks is shut at times


def test_auto_finds_two_seconds_of_rest_before_a_minute_of_talk(quick_model: Model):
    """A tenth of the minute is six seconds: more than the face rests."""
    rng = np.random.default_rng(1)
    talk = _talk(rng, 1740, rests=False)
    minute = np.concatenate([_talk(rng, 120, rests=True)[:60], talk])
    found = estimate_neutral(quick_model, minute)
    assert found.sure, found.reason
    assert np.mean(found.frames < 60) > 0.7
    assert not estimate_neutral(quick_model, minute, shares=SHARES[:1]).sure
    assert not estimate_neutral(quick_model, talk).sure


@pytest.mark.parametrize("fps", [10, 60, 120])
def test_auto_tells_rest_by_seconds_at_any_rate(quick_model: Model, fps: int):
    for rests in (False, True):
        film = _talk(np.random.default_rng(1), 300, rests=rests)
        times = np.linspace(0, len(film) - 1, len(film) * fps // 30)
        shown = np.array([np.interp(times, np.arange(300), each) for each in film.reshape(300, -1).T]).T
        estimate = estimate_neutral(quick_model, shown.reshape(-1, 68, 2), fps)
        assert estimate.sure is rests, estimate.reason


def test_the_rate_of_frames_is_that_of_most_and_usual_where_nobody_knows():
    assert frame_rate(None) == frame_rate(np.array([0.0])) == frame_rate(np.full(5, np.nan)) == 30
    assert frame_rate(np.array([0, 1, 2, 3, 90]) / 60) == pytest.approx(60)


def test_auto_does_not_hang_on_looks_place_or_size(quick_model: Model, dataset: KeypointDataset):
    frames, _ = _recording(dataset, calm=40, moving=40)
    found = estimate_neutral(quick_model, frames)
    moved = estimate_neutral(quick_model, 3.0 * frames + [50.0, -7.0])
    assert np.array_equal(found.frames, moved.frames)
    assert found.sure is moved.sure


def test_live_auto_wants_to_be_sure_twice_and_says_when_it_takes_long(quick_model: Model):
    rng = np.random.default_rng(2)
    said: list[str] = []
    talk, rest = _talk(rng, 320, rests=False), _talk(rng, 600, rests=True)[:300]
    networks = LandmarkNetworks(quick_model)
    stage = AutomaticCalibration(networks, said.append)
    stage.step(Sample(label="1", points=np.full((68, 2), np.nan)))  # counts as a line, and as no face
    for number, face in enumerate(talk, start=2):
        stage.step(Sample(label=str(number), points=face))
    assert networks.model is quick_model
    assert len(said) == 1
    assert said[0].startswith("frame 301: no neutral face found so far (the face is not at rest")
    for face in rest:
        stage.step(Sample(points=face))
    assert networks.model is not quick_model
    assert "neutral face found" in said[1]


@pytest.mark.parametrize("fps", [20, 30, 120])
def test_live_auto_takes_as_many_seconds_at_any_frame_rate(quick_model: Model, fps: int):
    rng = np.random.default_rng(2)
    said: list[str] = []
    networks = LandmarkNetworks(quick_model)
    stage = AutomaticCalibration(networks, said.append)
    talk = _talk(rng, 330, rests=False)
    for row in range(11 * fps):
        stage.step(Sample(label=str(row), time_s=row / fps, points=talk[int(row * 30 / fps)]))
    assert networks.model is quick_model
    (line,) = said
    told_s = int(line.split()[1].rstrip(":")) / fps
    assert told_s == pytest.approx(10, abs=0.3)


class Live:
    """Faces before `AutomaticCalibration` as they come, 30 a second, with times or without."""

    def __init__(self, model: Model, *, timed: bool = True) -> None:
        self.said: list[str] = []
        self.networks = LandmarkNetworks(model)
        self.stage = AutomaticCalibration(self.networks, self.said.append)
        self._timed, self._row = timed, 0
        self._rng = np.random.default_rng(4)

    def show(self, face: np.ndarray, seconds: float, fps: float = 30) -> None:
        """Show a face at rest, with a detector's noise."""
        for _ in range(round(seconds * fps)):
            time_s = self._row / fps if self._timed else None
            points = face + self._rng.normal(size=face.shape) * 3e-4 * np.ptp(face[:, 0])
            self.stage.step(Sample(label=str(self._row), time_s=time_s, points=points))
            self._row += 1

    def shows(self, face: np.ndarray) -> bool:
        """Whether frames are compared with this face."""
        found = self.stage.neutral
        return found is not None and np.allclose(np.median(found, axis=0), face, atol=0.003)


REST, SMILE = drawn_face(), drawn_face() + 0.02
SMILE[48:] += 0.05
GONE = np.full((68, 2), np.nan)


@pytest.mark.parametrize("fps", [20, 30, 120])
def test_live_auto_is_not_sure_before_ten_seconds_of_a_face(quick_model: Model, fps: int):
    """Two seconds at rest may be a look at something, held."""
    live = Live(quick_model)
    live.show(GONE, 12, fps)
    live.show(REST, SURE_FROM_S - 0.1, fps)
    assert live.networks.model is quick_model
    live.show(REST, 0.2, fps)
    assert live.shows(REST)
    assert np.array_equal(live.networks.model.predict(FACES), _calibrated(quick_model, live).predict(FACES))


def _calibrated(model: Model, live: Live) -> Model:
    return model.calibrate(live.stage.neutral)


def test_live_auto_replaces_what_it_found_first_and_then_lets_it_be(quick_model: Model):
    """Who is taken for neutral with a smile need only rest longer than that once."""
    live = Live(quick_model)
    live.show(SMILE, 10.1)
    assert live.shows(SMILE)
    first = live.networks.model
    live.show(REST, AGAIN_AT_S[-1] - 10)
    assert live.shows(REST)
    assert np.array_equal(live.networks.model.predict(FACES), _calibrated(quick_model, live).predict(FACES))
    assert not np.allclose(live.networks.model.predict(FACES), first.predict(FACES))
    assert len(live.said) == 1
    live.show(SMILE, 40)
    assert live.shows(REST)


@pytest.mark.parametrize("timed", [False, True])
def test_live_auto_begins_anew_where_the_face_was_away(quick_model: Model, timed: bool):
    """Somebody else may sit down. A hand before the face is no such thing."""
    live = Live(quick_model, timed=timed)
    live.show(REST, 10.1)
    live.show(GONE, FORGOTTEN_S - 0.1)
    live.show(SMILE, 1)
    assert live.shows(REST)
    live.show(GONE, FORGOTTEN_S + 0.1)
    assert live.shows(REST)
    live.show(SMILE, 9)
    assert live.stage.neutral is None
    assert live.networks.model is quick_model
    live.show(SMILE, 2)
    assert live.shows(SMILE)
    assert [line.split(": ")[1].split(" (")[0] for line in live.said] == [
        "neutral face found",
        "a face is back; its neutral face is looked for anew",
        "neutral face found",
    ]


@pytest.fixture
def recording(dataset: KeypointDataset, tmp_path):
    frames, _ = _recording(dataset, calm=40, moving=40)
    np.save(tmp_path / "take.npy", frames)
    return tmp_path / "take.npy"


def test_predict_takes_a_frame_a_range_a_file_or_auto(run, quick_model_folder, quick_model, recording):
    frames = np.load(recording)
    np.save(recording.with_name("neutral.npy"), frames[50:52])
    expected = {
        "none": quick_model.predict(frames),
        "50": quick_model.calibrate(frames[50:51]).predict(frames),
        "50-51": quick_model.calibrate(frames[50:52]).predict(frames),
        str(recording.with_name("neutral.npy")): quick_model.calibrate(frames[50:52]).predict(frames),
        "auto": quick_model.calibrate(frames[estimate_neutral(quick_model, frames).frames]).predict(frames),
    }
    for neutral, weights in expected.items():
        code, out, err = run(
            "predict", quick_model_folder, recording, "--neutral", neutral, "--keep-guessed-gaze"
        )
        assert code == 0, err
        lines = [line.split(",") for line in out.splitlines()]
        assert np.allclose(np.array([line[1:] for line in lines[1:]], dtype=float), weights, atol=1e-6)
        assert ("neutral face found" in err) == (neutral == "auto")
    code, _, err = run("predict", quick_model_folder, recording, "--neutral", "500")
    assert code == 2
    assert "neither a frame" in err


def test_auto_that_is_not_sure_serves_without_and_says_so(run, quick_model_folder, quick_model, recording):
    frames = np.load(recording)[:20]
    np.save(recording, frames)
    code, out, err = run("predict", quick_model_folder, recording, "--neutral", "auto")
    assert code == 0
    assert "not calibrated" in err
    jaw = [float(line.split(",")[1 + BLENDSHAPES.index("jawOpen")]) for line in out.splitlines()[1:]]
    assert np.allclose(jaw, quick_model.predict(frames)[:, BLENDSHAPE_INDEX["jawOpen"]], atol=1e-6)


def test_export_takes_a_neutral_file(run, quick_model_folder, quick_model, recording):
    neutral = recording.with_name("neutral.npy")
    np.save(neutral, np.load(recording)[50:52])
    code, _, err = run(
        "export", quick_model_folder, "--format", "json", "--out", recording.parent, "--neutral", neutral
    )
    assert code == 0, err
    document = json.loads((recording.parent / "face.json").read_text())
    calibrated = quick_model.calibrate(np.load(neutral))
    assert np.allclose(document["feature_mean"], calibrated.normalisation.feature_mean)


def test_evaluate_counts_calibrated_weights(run, quick_model_folder, quick_model, dataset_folder):
    code, out, _ = run("evaluate", quick_model_folder, dataset_folder, "--calibrated", "--json")
    assert code == 0
    figures = json.loads(out)
    assert figures["calibrated"]
    recorded = quick_model.record.scores["jawOpen"]["calibrated"].r2
    assert figures["scores"]["jawOpen"]["r2"] == pytest.approx(recorded, abs=1e-4)


def test_calibrated_figures_need_neutral_faces(run, quick_model_folder, dataset: KeypointDataset, tmp_path):
    write_dataset(dataclasses.replace(dataset, neutral=dataset.split == "none"), tmp_path / "data")
    for words in ([], ["--json"]):
        code, out, err = run("evaluate", quick_model_folder, tmp_path / "data", "--calibrated", *words)
        assert (code, out, len(err.splitlines())) == (2, "", 1)
        assert "no face in the test split beside a neutral frame of its person" in err


def test_evaluating_needs_the_split_that_is_scored_and_no_other(
    run, quick_model_folder, quick_model, dataset: KeypointDataset, tmp_path
):
    write_dataset(dataset.take(dataset.rows("test")), tmp_path / "data")
    code, out, err = run("evaluate", quick_model_folder, tmp_path / "data", "--json")
    assert code == 0, err
    recorded = quick_model.record.scores["jawOpen"]["network"].r2
    assert json.loads(out)["scores"]["jawOpen"]["r2"] == pytest.approx(recorded, abs=1e-4)
    code, _, err = run("evaluate", quick_model_folder, tmp_path / "data", "--split", "train")
    assert code == 2
    assert "no sample in the train split" in err
