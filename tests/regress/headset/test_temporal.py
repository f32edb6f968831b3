"""The convolution over the frames before: what taps do, how they are found, and what a person is told."""

import json
import shutil
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, MIRRORED_BLENDSHAPES
from regress.errors import InputError
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.taps import fit_taps, fit_temporal
from regress.runtime.headset.network.estimates import Estimates
from regress.runtime.headset.network.figures import ClipSummary
from regress.runtime.headset.network.folder import describe_headset_model, read_headset_model
from regress.runtime.headset.network.model import HeadsetTraining, Temporal
from regress.runtime.headset.network.temporal import TAPS, convolve
from tests.regress.headset.drawn import SIDE
from tests.regress.headset.takes import pictures, write_take
from tests.regress.headset.tiny import NAMES, write_tiny_model

LENGTH = 20
"""Frames of a clip here."""


def clips(count: int, seed: int, noise: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Slow sines, what is said of them, and where clips start."""
    random = np.random.default_rng(seed)
    phase, pace = random.uniform(0, 6, (2, count, 1, 56))
    true = 0.5 + 0.4 * np.sin(phase + 0.05 * pace * np.arange(LENGTH)[:, None])
    said = true + noise * random.standard_normal(true.shape)
    starts = np.tile(np.arange(LENGTH) == 0, count)
    return said.reshape(-1, 56), true.reshape(-1, 56), starts


@given(taps=st.lists(st.floats(-1, 1), min_size=TAPS - 1, max_size=TAPS - 1), seed=st.integers(0, 99))
def test_a_held_face_stays_and_clips_do_not_mix(taps: list[float], seed: int):
    random = np.random.default_rng(seed)
    held = np.repeat(random.random((4, 3)), 6, axis=0)  # four clips of six equal frames
    starts = np.arange(24) % 6 == 0
    weighed = np.tile([1 - sum(taps), *taps], (3, 1))
    np.testing.assert_allclose(convolve(held, starts, weighed), held, atol=1e-12)


def test_each_frame_is_weighed_with_those_before_it():
    values = np.array([[1.0], [2.0], [4.0], [np.nan], [8.0], [16.0]])
    taps = np.array([[0.5, 0.25, 0.25, 0.0, 0.0]])
    found = convolve(values, np.arange(6) == 0, taps)[:, 0]
    # the first frame stands in for what lacks; so does the first after a frame without a picture
    np.testing.assert_allclose(found, [1.0, 1.5, 2.75, np.nan, 8.0, 12.0])


def test_taps_take_noise_off_unseen_clips_and_leave_clean_ones_alone():
    said, true, starts = clips(40, seed=0, noise=0.1)
    taps = fit_taps(said, true, starts)
    np.testing.assert_allclose(taps.sum(axis=1), 1)
    said, true, starts = clips(40, seed=1, noise=0.1)
    error = np.square(convolve(said, starts, taps) - true).mean()
    assert error < 0.6 * np.square(said - true).mean()
    assert error < np.square(convolve(said, starts, np.full_like(taps, 1 / TAPS)) - true).mean()
    clean = fit_taps(true, true, starts)
    np.testing.assert_allclose(clean, np.eye(TAPS)[[0] * 56], atol=1e-9)


def test_taps_are_least_squares_and_the_same_for_both_sides():
    said, true, starts = clips(10, seed=2, noise=0.2)
    taps = fit_taps(said, true, starts)
    left, right = BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]
    np.testing.assert_allclose(taps[left], taps[right])
    assert MIRRORED_BLENDSHAPES[left] == right
    columns = [left, right]

    def squares(changed: np.ndarray) -> float:
        off = convolve(said[:, columns], starts, np.stack([changed, changed])) - true[:, columns]
        return float(np.square(off).sum())

    least = squares(taps[left])
    for place in range(1, TAPS):
        for step in (-0.03, 0.03):  # the ridge moves the least by less
            other = taps[left].copy()
            other[[0, place]] += [-step, step]
            assert squares(other) > least


class Noisy:
    """Says the truth with noise; rows are told apart by how many they are."""

    def __init__(self, arrays: HeadsetArrays, noise: float) -> None:
        random = np.random.default_rng(0)
        self._said = {}
        for split in ("train", "test"):
            rows = arrays.rows(split)
            weights, gaze = arrays.weights[rows], arrays.gaze[rows].reshape(-1, 2, 2)
            self._said[len(rows)] = Estimates(
                weights=weights + noise * random.standard_normal(weights.shape),
                deviation=weights,
                gaze=gaze + noise * random.standard_normal(gaze.shape),
                shares=weights,
                same_seat=weights[:, 0],
            )

    def run(self, pictures: dict[str, np.ndarray]) -> Estimates:
        return self._said[len(pictures["mouth"])]


@pytest.fixture
def as_clips(arrays: HeadsetArrays) -> HeadsetArrays:
    """The drawn arrays with slow faces, ten frames a clip; fewer test frames than training ones."""
    rows = len(arrays.sample)
    number = np.arange(rows) // 10
    random = np.random.default_rng(3)
    weights = np.repeat(random.random((number.max() + 1, 52)), 10, axis=0)[:rows].astype(np.float32)
    split = np.where(number % 3 == 0, "test", "train")
    return replace(
        arrays,
        person=number,
        session=0 * number,
        clip=0 * number,
        frame=np.arange(rows) % 10,
        time_s=np.arange(rows) % 10 / 60,
        split=split,
        weights=weights,
        gaze=0 * arrays.gaze,
    )


def test_a_models_taps_are_judged_on_other_people(as_clips: HeadsetArrays):
    model = SimpleNamespace(
        cameras=as_clips.cameras, camera_names=NAMES, dataset_hash="", training=HeadsetTraining()
    )
    found = fit_temporal(SimpleNamespace(model=model, graph=Noisy(as_clips, 0.1)), as_clips)
    assert not found.unseen, "nothing tells which data the network is of"
    assert found.fps == pytest.approx(60)
    assert found.people == len(np.unique(as_clips.person[as_clips.split == "train"]))
    assert np.shape(found.taps) == (56, TAPS)
    alone, even, taps = (found.scores[name] for name in ("one frame", "mean of five", "taps"))
    assert alone.rmse == pytest.approx(0.1, rel=0.2)  # clipped at 0 and 1
    assert taps.rmse < 0.7 * alone.rmse
    assert taps.rmse == pytest.approx(even.rmse, rel=0.1)  # faces that are held want even taps
    assert taps.shake < 0.5 * alone.shake
    assert taps.rows == (as_clips.split == "test").sum()


def test_people_of_clips_are_unseen_where_neither_training_has_them(as_clips: HeadsetArrays):
    """Of data of one seed people may be the same; and sessions of one person may be in both splits of the clips."""
    clips = replace(as_clips, description=as_clips.description | {"seed": 8, "dataset_hash": "clips"})
    sessions = replace(clips, person=clips.person // 3, session=clips.person % 3)
    for arrays, seed, unseen in ((clips, 7, True), (clips, 8, False), (sessions, 7, False)):
        training = HeadsetTraining(data_seed=seed)
        model = SimpleNamespace(
            cameras=clips.cameras, camera_names=NAMES, dataset_hash="network's", training=training
        )
        found = fit_temporal(SimpleNamespace(model=model, graph=Noisy(arrays, 0.1)), arrays)
        assert found.unseen == unseen


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"frame": 0}, "no frames that follow one another"),
        ({"split": "train"}, "has no test people"),
    ],
)
def test_arrays_that_cannot_tell_are_refused(as_clips: HeadsetArrays, changes: dict, message: str):
    wrong = replace(
        as_clips, **{name: np.full(len(as_clips.split), value) for name, value in changes.items()}
    )
    model = SimpleNamespace(cameras=as_clips.cameras, camera_names=NAMES)
    with pytest.raises(InputError, match=message):
        fit_temporal(SimpleNamespace(model=model, graph=Noisy(as_clips, 0.1)), wrong)


@pytest.fixture
def model(tmp_path: Path) -> Path:
    return write_tiny_model(tmp_path / "tiny")


def test_predicting_weighs_the_frames_before(run, model: Path, tmp_path: Path):
    steps = {name: pictures([51] * 6 + [153] * 6) for name in NAMES}
    take = write_take(tmp_path / "take", steps)
    code, out, said = run("headset", "predict", model, *take, "--temporal")
    assert (code, out) == (2, "")
    assert "`regress headset temporal` finds it on clips" in said
    taps = tuple((0.5, 0.25, 0.25, 0.0, 0.0) for _ in range(56))
    known = replace(
        read_headset_model(model), temporal=Temporal(fps=30.0, taps=taps, people=1, dataset_hash="")
    )
    (model / "report.html").write_text("kept")
    assert describe_headset_model(known, model) == known
    assert (model / "report.html").read_text() == "kept"
    for options, wanted in (([], [0.2, 0.6, 0.6, 0.6]), (["--temporal"], [0.2, 0.4, 0.5, 0.6])):
        code, out, said = run("headset", "predict", model, *take, *options)
        assert code == 0, said
        header, *rows = out.splitlines()
        column = header.split(",").index("jawOpen")
        found = [float(row.split(",")[column]) for row in rows]
        np.testing.assert_allclose(found[5:9], wanted, atol=0.01)
    code, _, said = run("headset", "export", model, "--out", tmp_path / "exports")
    assert code == 0, said
    assert json.loads((tmp_path / "exports" / "headset.json").read_text())["temporal"]["taps"][0] == list(
        taps[0]
    )


@pytest.mark.parametrize(
    ("options", "said_so"),
    [
        (
            ["--temporal", "--fps", "60"],
            "30 frames a second and the take has 60; they reach 67 ms back in place of 133",
        ),
        (["--temporal", "--fps", "29.97"], ""),
        (["--temporal"], ""),
        (["--fps", "60"], ""),
    ],
)
def test_taps_of_another_rate_are_told(run, model: Path, tmp_path: Path, options: list[str], said_so: str):
    taps = tuple((0.5, 0.25, 0.25, 0.0, 0.0) for _ in range(56))
    temporal = Temporal(fps=30.0, taps=taps, people=1, dataset_hash="")
    describe_headset_model(replace(read_headset_model(model), temporal=temporal), model)
    # pictures that change with every frame, so that none is frozen
    take = write_take(tmp_path / "take", {name: pictures(range(60, 120, 5)) for name in NAMES})
    code, _, said = run("headset", "predict", model, *take, *options)
    assert code == 0, said
    assert ("taps are for" in said) == bool(said_so)
    assert said_so in said


def test_stills_have_no_frames_before(run, model: Path, arrays_folder: Path, tmp_path: Path):
    before = (model / "model.json").read_bytes()
    code, out, said = run("headset", "temporal", model, arrays_folder)
    assert (code, out) == (2, "")
    assert 'pack a dataset of kind "sequence"' in said
    assert (model / "model.json").read_bytes() == before
    for option in (["--temporal"], ["--smooth", 5], ["--one-euro", 1.0], ["--bits", 10]):
        code, _, said = run("headset", "predict", model, tmp_path, *option)
        assert code == 2
        assert f"{option[0]} needs a take, and this is a dataset: its pictures " in said


def test_by_command_taps_go_into_the_model(run, arrays_folder: Path, tmp_path: Path):
    model = write_tiny_model(tmp_path / "tiny", width=SIDE, height=SIDE)
    clips = tmp_path / "clips"
    shutil.copytree(arrays_folder, clips)
    table = pq.read_table(clips / "labels.parquet")
    number, frame = np.divmod(np.arange(len(table)), 10)
    split = np.where(number % 3 == 0, "test", "train")
    for name, values in {
        "person": number,
        "clip": number,
        "frame": frame,
        "time_s": frame / 30,
        "split": split,
    }.items():
        table = table.set_column(table.column_names.index(name), name, pa.array(values))
    pq.write_table(table, clips / "labels.parquet")
    code, out, said = run("headset", "temporal", model, clips)
    assert code == 0, said
    assert [line.split("  ")[0] for line in out.splitlines()[1:-1]] == ["one frame", "mean of five", "taps"]
    assert "taps for 30 frames a second" in out
    assert "the clips are of the headset drawn3, and the model's is tracking3" in said
    found = read_headset_model(model).temporal
    assert np.shape(found.taps) == (56, TAPS)
    np.testing.assert_allclose(np.sum(found.taps, axis=1), 1)


def test_what_comes_with_the_package_is_not_written_into(
    run, arrays_folder: Path, tmp_path: Path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    code, _, said = run("headset", "temporal", "headset-tracking3", arrays_folder)
    assert code == 2
    assert "headset-tracking3 comes with the package, which is not written into; copy " in said
    assert list(tmp_path.iterdir()) == []


def test_taps_that_make_it_worse_are_told(
    run, arrays_folder: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    figures = ClipSummary(
        rows=9,
        geometry_mm=0.0,
        r2=None,
        mae=0.1,
        rmse=0.1,
        blink_r2=None,
        gaze_deg=1.0,
        gaze_open_deg=None,
        shake=0.1,
    )
    errors_mm = {"one frame": 0.5, "mean of five": 0.7, "taps": 0.6}
    found = Temporal(
        fps=30,
        taps=((1.0, 0.0, 0.0, 0.0, 0.0),) * 56,
        people=1,
        dataset_hash="",
        scores={name: replace(figures, geometry_mm=error) for name, error in errors_mm.items()},
    )
    monkeypatch.setattr("regress.learning.headset.taps.fit_temporal", lambda predictor, arrays: found)
    code, _, said = run(
        "headset", "temporal", write_tiny_model(tmp_path / "tiny", headset="drawn3"), arrays_folder
    )
    assert code == 0
    assert said.startswith("with the taps these people's faces err by 0.6000 mm, and by 0.5000 mm without")
