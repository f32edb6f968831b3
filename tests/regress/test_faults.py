"""Rows that cannot be used: found, said with their numbers, left empty, and an end to a strict run."""

import io
import sys
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import MIRRORED_LANDMARKS
from regress.runtime.inputs import (
    Fault,
    Frames,
    TimeOrder,
    face_faults,
    fault_sentences,
    read_frames,
)
from regress.runtime.predict import predict_frames, predict_stream
from regress.runtime.sample import Sample
from regress.runtime.stages.filters import FILTERS
from regress.runtime.stages.output import Output
from regress.runtime.stages.soundness import Soundness
from tests.regress.drawn import drawn_face, drawn_faces

GOOD = drawn_faces(np.random.default_rng(8), 9)


def _judged(frames: Frames) -> list[Sample]:
    return Soundness(needs_times=False).run(frames.samples())


def _exchanged(faces: np.ndarray) -> np.ndarray:
    """Left and right named the wrong way round."""
    return faces[:, list(MIRRORED_LANDMARKS)]


def _on_a_line(faces: np.ndarray) -> np.ndarray:
    return np.stack([faces[..., 0], 2 * faces[..., 0] + 5], axis=-1)


NO_NEUTRAL = (
    "no neutral face is given, so weights are guesses; --neutral names frames at rest, as in {}, or looks for them "
    "by auto"
)
BAD_FACES = {
    "nan": (Fault.MISSING, lambda faces: np.where(np.arange(68)[:, None] == 30, np.nan, faces)),
    "inf": (Fault.MISSING, lambda faces: np.where(np.arange(68)[:, None] == 66, np.inf, faces)),
    "far away": (Fault.MISSING, lambda faces: np.where(np.arange(68)[:, None] == 5, -1e300, faces)),
    "huge": (Fault.MISSING, lambda faces: faces * 1e100),
    "tiny": (Fault.COLLAPSED, lambda faces: faces * 1e-100),
    "one place": (Fault.COLLAPSED, lambda faces: faces[:, :1] * np.ones((68, 1))),
    "on a line": (Fault.COLLAPSED, _on_a_line),
    "sides exchanged": (Fault.MIRRORED, _exchanged),
    "y upwards": (Fault.MIRRORED, lambda faces: faces * [1, -1]),
}


@given(seed=st.integers(0, 10**6), roll_deg=st.floats(-180, 180), size=st.floats(1e-3, 1e6))
@settings(max_examples=30, deadline=None)
def test_faces_are_told_from_mirrored_ones_however_they_are_turned(seed: int, roll_deg: float, size: float):
    face = drawn_face() + np.random.default_rng(seed).normal(size=(68, 2)) * 0.05
    turn = np.deg2rad(roll_deg)
    turned = size * (face @ [[np.cos(turn), np.sin(turn)], [-np.sin(turn), np.cos(turn)]] + [30, -7])[None]
    assert face_faults(turned) == [None]
    assert face_faults(_exchanged(turned)) == [Fault.MIRRORED]
    assert face_faults(_on_a_line(turned)) == [Fault.COLLAPSED]


def test_the_real_recordings_have_no_faults(real):
    for name in ("pyfeat_clip_001.csv", "openface_sequence.csv", "dlib_faces.xml", "breakingbad.pts"):
        (path,) = real.rglob(name)
        assert not any(sample.faults for sample in _judged(read_frames(path)))


def test_times_must_go_on_and_smoothing_wants_each_to_be_later():
    times = [0.0, 1.0, 1.0, 0.5, np.nan, 1.5]
    loose, strict = TimeOrder(strictly=False), TimeOrder(strictly=True)
    late, none = Fault.DISORDER, Fault.TIMELESS
    assert [loose.step(time) for time in times] == [None, None, None, late, None, None]
    assert [strict.step(time) for time in times] == [None, None, late, late, none, None]


@given(
    fps=st.integers(10, 120),
    wrong=st.sampled_from([9999.0, 1.7e9, 1e17]),
    before=st.integers(0, 20),
    strictly=st.booleans(),
)
def test_one_time_that_is_far_ahead_costs_itself_in_a_file_and_half_a_second_live(
    fps: int, wrong: float, before: int, strictly: bool
):
    times = (np.arange(200) / fps).tolist()
    times.insert(before, wrong)
    faults = TimeOrder(strictly=strictly).run(times)
    assert [row for row, fault in enumerate(faults) if fault] == [before]
    live = TimeOrder(strictly=strictly, set_after_s=0.5)
    late = [row for row, time in enumerate(times) if live.step(time)]
    assert late == list(range(before + 1, before + 1 + len(late)))
    assert 0.5 * fps <= len(late) <= max(0.5 * fps + 1, 4)


@given(fps=st.integers(1, 120), last_s=st.floats(5, 1e6))
def test_a_live_clock_that_begins_anew_is_followed_and_single_late_rows_are_not(fps: int, last_s: float):
    live = TimeOrder(strictly=True, set_after_s=0.5)
    for row in range(20):
        assert live.step(last_s + row / fps) is None
        if row % 3 == 0:
            assert live.step(row / fps) is Fault.DISORDER
    faults = [live.step(row / fps) for row in range(4 * fps + 10)]
    anew = faults.index(None)
    assert anew == max(int(np.ceil(fps / 2)), 4)
    assert not any(faults[anew:])
    assert any(TimeOrder(strictly=True).run([last_s, *(row / fps for row in range(4))]))


@pytest.mark.parametrize("name", FILTERS)
def test_a_pipe_whose_detector_begins_anew_goes_on_by_every_filter(name: str, quick_model):
    """Its filter starts afresh, as after a pause: nothing of the time before is in the faces behind."""
    faces = drawn_faces(np.random.default_rng(8), 60)
    times = [*(100 + np.arange(30) / 30), *(np.arange(30) / 30)]
    output = Output(filter=name, smooth_landmarks_hz=1.0)
    samples = [
        Sample(label=str(row), time_s=time, points=face)
        for row, (time, face) in enumerate(zip(times, faces, strict=True))
    ]
    answers = list(predict_stream(samples, quick_model, output))
    assert [row for row, answer in enumerate(answers) if answer.faults] == list(range(30, 45))
    paused = [*samples[:30], *(replace(sample, time_s=sample.time_s + 200) for sample in samples[45:])]
    for answer, expected in zip(
        answers[45:], list(predict_stream(paused, quick_model, output))[30:], strict=True
    ):
        np.testing.assert_allclose(answer.weights, expected.weights, atol=1e-9)


def test_runs_of_rows_are_joined():
    faults = [None, Fault.MISSING, Fault.MISSING, None, Fault.MISSING, Fault.MIRRORED]
    assert fault_sentences(faults)[0] == "3 of 6 rows have no face: 2-3, 5"
    assert fault_sentences(faults)[1].endswith("y pointing up: 6")


@pytest.mark.parametrize("kind", BAD_FACES)
def test_the_program_says_which_rows_are_bad_and_leaves_them_empty(
    kind: str, run, quick_model, quick_model_folder, tmp_path
):
    fault, spoil = BAD_FACES[kind]
    faces = GOOD.copy()
    faces[[2, 5, 6]] = spoil(faces[[2, 5, 6]])
    take = tmp_path / "take.npy"
    np.save(take, faces)
    code, out, err = run("predict", quick_model_folder, take, "--keep-guessed-gaze")
    assert code == 0
    said = [f"3 of 9 rows have {fault.value}: 3, 6-7", NO_NEUTRAL.format(0)]
    assert err.splitlines() == [f"{take}: {sentence}" for sentence in said]
    rows = [line.split(",")[1:] for line in out.splitlines()[1:]]
    assert [set(row) == {""} for row in rows] == [row in (2, 5, 6) for row in range(9)]
    good = np.delete(np.arange(9), [2, 5, 6])
    written = np.array([rows[row] for row in good], dtype=float)
    np.testing.assert_allclose(written, quick_model.predict(GOOD[good]), atol=1e-6)
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.npy", "--strict")
    assert (code, out) == (2, "")
    assert "3 of 9 rows" in err
    np.save(tmp_path / "all.npy", spoil(GOOD))
    code, out, err = run("predict", quick_model_folder, tmp_path / "all.npy")
    assert (code, out) == (2, "")
    assert "no usable frame" in err


def _openface(path, faces: np.ndarray, times: list[float]):
    names = ["frame", "timestamp", "success", *(f"{a}_{i}" for a in "xy" for i in range(68))]
    rows = [
        [str(row + 1), str(time), "1", *map(repr, np.concatenate([face[:, 0], face[:, 1]]).tolist())]
        for row, (face, time) in enumerate(zip(faces, times, strict=True))
    ]
    path.write_text("\n".join(", ".join(cells) for cells in [names, *rows]) + "\n")


def test_frames_out_of_order_are_left_out_and_the_others_smoothed(
    run, quick_model, quick_model_folder, tmp_path
):
    times = [0.0, 0.1, 0.2, 0.15, 0.3, 0.3, 0.4, 0.5, 0.6]
    _openface(tmp_path / "take.csv", GOOD, times)
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.csv", "--smooth-landmarks", 2)
    assert code == 0
    assert f"2 of 9 rows have {Fault.DISORDER.value}: 4, 6" in err
    rows = [line.split(",")[2:] for line in out.splitlines()[1:]]
    assert [set(row) == {""} for row in rows] == [row in (3, 5) for row in range(9)]
    kept = [0, 1, 2, 4, 6, 7, 8]
    frames = Frames(
        points=GOOD[kept], labels=tuple(map(str, kept)), time_s=np.array(times)[kept], source="take"
    )
    expected = predict_frames(quick_model, frames, output=Output(smooth_landmarks_hz=2)).weights
    np.testing.assert_allclose(np.array([rows[row] for row in kept], dtype=float), expected, atol=1e-6)
    code, _, err = run("predict", quick_model_folder, tmp_path / "take.csv", "--one-euro", 2, "--strict")
    assert code == 2
    assert ": 4, 6" in err


def test_a_frame_without_a_time_is_left_out_and_the_others_smoothed(run, quick_model_folder, tmp_path):
    _openface(tmp_path / "take.csv", GOOD, [0.0, 0.1, float("nan"), *np.arange(3, 9) / 10])
    for smoothing in ("--one-euro", "--smooth-landmarks"):
        code, out, err = run("predict", quick_model_folder, tmp_path / "take.csv", smoothing, 2)
        said = [f"1 of 9 rows have {Fault.TIMELESS.value}: 3", NO_NEUTRAL.format(1)]
        assert (code, err.splitlines()) == (0, [f"{tmp_path / 'take.csv'}: {sentence}" for sentence in said])
        rows = [line.split(",")[2:] for line in out.splitlines()[1:]]
        assert [set(row) == {""} for row in rows] == [row == 2 for row in range(9)]


def test_a_neutral_face_the_wrong_way_round_is_refused(run, quick_model_folder, tmp_path):
    np.save(tmp_path / "take.npy", GOOD)
    np.save(tmp_path / "rest.npy", _exchanged(GOOD[:2]))
    arguments = ("predict", quick_model_folder, tmp_path / "take.npy", "--neutral", tmp_path / "rest.npy")
    for refused in (
        arguments,
        ("export", quick_model_folder, "--neutral", tmp_path / "rest.npy", "--out", tmp_path),
    ):
        code, _, err = run(*refused)
        assert code == 2
        assert "left and right exchanged" in err
    assert not (tmp_path / "face.onnx").exists()


def test_a_pipe_tells_runs_of_bad_lines_and_goes_on(run, quick_model_folder, monkeypatch):
    faces = GOOD.copy()
    faces[2:4] = _exchanged(faces[2:4])
    faces[8] = np.nan
    times = [0.0, 0.1, 0.2, 0.3, 0.4, 0.25, 0.5, 0.6, 0.7]
    lines = [
        " ".join(map(repr, [time, *face.ravel().tolist()])) for time, face in zip(times, faces, strict=True)
    ]
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
    code, out, err = run("predict", quick_model_folder, "-", "--one-euro", 2, "--smooth-landmarks", 2)
    assert code == 0
    assert err.splitlines() == [
        f"lines 3-4 have {Fault.MIRRORED.value}",
        f"line 6 has {Fault.DISORDER.value}",
        "line 9 has no face",
    ]
    rows = [line.split(",") for line in out.splitlines()]
    assert {len(row) for row in rows} == {54}
    assert [row[3] == "" for row in rows[1:]] == [False, False, True, True, False, True, False, False, True]
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
    code, out, err = run("predict", quick_model_folder, "-", "--strict")
    assert code == 2
    assert "line 3 has left and right exchanged" in err
    assert len(out.splitlines()) == 3


def test_a_line_without_a_face_keeps_the_columns_of_a_timed_pipe(run, quick_model_folder, monkeypatch):
    line = " ".join(map(repr, [0.5, *GOOD[0].ravel().tolist()]))
    monkeypatch.setattr(sys, "stdin", io.StringIO(f"{line}\n\n"))
    code, out, _ = run("predict", quick_model_folder, "-")
    assert code == 0
    assert out.splitlines()[2] == "2" + "," * 53


def test_a_faulty_face_leaves_and_the_rest_stay():
    points = GOOD.copy()
    points[4, 30] = np.nan
    judged = _judged(Frames(points=points, labels=tuple("012345678"), time_s=None, source="here"))
    assert [sample.faults.get("points") for sample in judged] == [None] * 4 + [Fault.MISSING] + [None] * 4
    left = np.array([sample.points for sample in judged])
    assert np.isnan(left[4]).all()
    np.testing.assert_array_equal(np.delete(left, 4, axis=0), np.delete(GOOD, 4, axis=0))
