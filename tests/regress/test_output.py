"""After the networks: smoothing by time, adjustment, sides, and frames from a pipe."""

import dataclasses
import io
import json
import sys
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, MIRRORED_BLENDSHAPES
from regress.errors import InputError
from regress.runtime.inputs import Frames, read_lines
from regress.runtime.model import Model
from regress.runtime.predict import landmark_chain, predict_frames, predict_stream
from regress.runtime.sample import Sample
from regress.runtime.stages.adjustment import ShapeAdjustment, adjust, blend_sides, mirror
from regress.runtime.stages.adjustment_file import read_adjustments
from regress.runtime.stages.confidence import confidence
from regress.runtime.stages.networks import LandmarkNetworks
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output
from regress.runtime.stages.smoothing import OneEuroFilter, OneEuroSmoothing, by_region
from regress.runtime.stages.stage import Chain
from regress.runtime.writers.csv_table import csv_lines
from tests.regress.drawn import drawn_face, drawn_faces, in_pictures

WEIGHTS = np.random.default_rng(0).uniform(size=(20, 52))
TIMES = np.arange(20) / 30


def one_euro(weights: np.ndarray, time_s: np.ndarray, settings: OneEuro) -> np.ndarray:
    """Weights (n, 52) after the stage; frames are called after their rows, counted from 1."""
    samples = [
        Sample(label=str(row), time_s=float(time), weights=weights[row - 1])
        for row, time in enumerate(time_s, start=1)
    ]
    return np.array([sample.weights for sample in OneEuroSmoothing(settings).run(samples)])


def stream_csv(
    lines: Iterable[str], model: Model, output: Output, *, fps: float | None = None, **settings: Any
) -> Iterator[str]:
    """Lines in, lines out, each as soon as its frame is known."""
    return csv_lines(predict_stream(read_lines(lines, fps=fps), model, output, **settings), output.names)


def test_one_euro_calms_a_still_face_and_follows_a_quick_one():
    rng = np.random.default_rng(1)
    times = np.arange(300) / 60
    still = 0.3 + rng.normal(size=(300, 52)) * 0.02
    smooth = one_euro(still, times, OneEuro())
    mouth = BLENDSHAPE_INDEX["mouthPucker"]
    assert smooth[60:, mouth].std() < still[60:, mouth].std() / 2
    step = np.where(times < 2, 0.0, 1.0)[:, None] * np.ones(52)
    followed = one_euro(step, times, OneEuro())
    late = int(np.flatnonzero(times >= 2.2)[0])
    assert followed[late, mouth] > 0.8
    assert followed[late, BLENDSHAPE_INDEX["eyeBlinkLeft"]] > followed[late, mouth]


def test_one_euro_is_one_low_pass_for_the_textbooks_signal():
    """Without beta it is a first-order low pass of the cutoff, whatever the rate of frames."""
    for rate in (30, 120):
        times = np.arange(rate) / rate
        answer = one_euro(np.where(times[:, None] > 0, 1.0, np.zeros(52)), times, OneEuro(beta=0.0))
        expected = 1 - (1 / (1 + 2 * np.pi / rate)) ** (rate - 1)
        assert answer[-1, BLENDSHAPE_INDEX["jawOpen"]] == pytest.approx(expected)


def test_one_euro_knows_gaps_empty_rows_and_disorder():
    weights = WEIGHTS.copy()
    weights[5] = np.nan
    times = TIMES.copy()
    times[10:] += 2
    smooth = one_euro(weights, times, OneEuro())
    assert np.isnan(smooth[5]).all()
    assert np.isfinite(np.delete(smooth, 5, axis=0)).all()
    assert np.array_equal(smooth[10], weights[10])  # two seconds later nothing is carried over
    times[12] = times[11]
    with pytest.raises(InputError, match=r"frame 13: .* in order"):
        one_euro(weights, times, OneEuro())
    with pytest.raises(InputError, match="frame 1 has no time"):
        one_euro(weights, np.full(20, np.nan), OneEuro())
    times[12] = times[11] + 0.01
    expected = one_euro(weights, times, OneEuro())
    times[5] = np.nan  # of a row that is empty, so nobody needs it
    assert np.array_equal(one_euro(weights, times, OneEuro()), expected, equal_nan=True)


def test_one_euro_steps_as_it_runs():
    stream = OneEuroFilter(OneEuro())
    rows = [stream.step(float(time), row) for time, row in zip(TIMES, WEIGHTS, strict=True)]
    assert np.array_equal(rows, one_euro(WEIGHTS, TIMES, OneEuro()))
    assert by_region(OneEuro(cutoff_hz=2))[BLENDSHAPE_INDEX["eyeBlinkLeft"]] == 6


def test_blending_sides_levels_a_face_and_keeps_its_direction():
    levelled = blend_sides(WEIGHTS, 1.0)
    left, right = BLENDSHAPE_INDEX["mouthSmileLeft"], BLENDSHAPE_INDEX["mouthSmileRight"]
    assert np.allclose(levelled[:, left], WEIGHTS[:, [left, right]].mean(axis=1))
    assert np.allclose(levelled[:, left], levelled[:, right])
    for name in ("jawLeft", "mouthRight", "eyeLookInLeft", "eyeLookOutRight", "jawOpen"):
        assert np.array_equal(levelled[:, BLENDSHAPE_INDEX[name]], WEIGHTS[:, BLENDSHAPE_INDEX[name]])
    assert np.array_equal(blend_sides(WEIGHTS, 0.0), WEIGHTS)
    assert np.allclose(blend_sides(WEIGHTS, 0.5), (levelled + WEIGHTS) / 2)


def test_mirroring_exchanges_sides():
    assert np.array_equal(mirror(WEIGHTS), WEIGHTS[:, list(MIRRORED_BLENDSHAPES)])
    assert np.array_equal(mirror(mirror(WEIGHTS)), WEIGHTS)


def test_adjusting_goes_offset_dead_zone_gain_limits():
    entry = ShapeAdjustment(gain=2.0, offset=0.1, dead_zone=0.2, low=0.0, high=0.9)
    weights = np.full((1, 52), 0.5)
    adjusted = adjust(weights, {"jawOpen": entry, "*": ShapeAdjustment(gain=0.5)})
    assert adjusted[0, BLENDSHAPE_INDEX["jawOpen"]] == pytest.approx(0.9)
    weights[:] = 0.3
    adjusted = adjust(weights, {"jawOpen": entry, "*": ShapeAdjustment(gain=0.5)})
    assert adjusted[0, BLENDSHAPE_INDEX["jawOpen"]] == pytest.approx(2 * (0.4 - 0.2) / 0.8)
    assert adjusted[0, BLENDSHAPE_INDEX["cheekPuff"]] == pytest.approx(0.15)
    assert np.isnan(adjust(np.full((1, 52), np.nan), {"*": entry})).all()


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("{", "is not JSON"),
        ("[]", "a JSON object is needed"),
        ('{"format": "other"}', "format = \"other\": must be 'regress-adjustment'"),
        (
            '{"format": "regress-adjustment", "shapes": {"jawOpened": {}}}',
            'shapes.jawOpened = "jawOpened": is not one of the 52',
        ),
        (
            '{"format": "regress-adjustment", "shapes": {"jawOpen": {"gian": 1}}}',
            "did you mean 'gain'?",
        ),
        (
            '{"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": "1"}}}',
            'gain = "1": must be a number',
        ),
        ('{"format": "regress-adjustment", "shapes": {"jawOpen": {"dead_zone": 1}}}', "must be less than 1"),
        ('{"format": "regress-adjustment", "shapes": {"jawOpen": {"low": 2}}}', "low 2.0 is above high 1.0"),
        (
            '{"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": Infinity}}}',
            "jawOpen.gain is a number",
        ),
        (
            '{"format": "regress-adjustment", "shapes": {"*": {"offset": NaN}}}',
            "offset is a number that is not",
        ),
        (
            '{"format": "regress-adjustment", "shapes": {"*": {"high": 1e308}}}',
            "is not finite or beyond 1e+100",
        ),
        (
            '{"format": "regress-adjustment", "shapes": {"*": {"gain": -1e9}}}',
            "must be greater than or equal to",
        ),
        ("[" * 100_000, "nested too deeply"),
        ("5", "a JSON object is needed"),
        ("null", "a JSON object is needed"),
        (f'{{"format": {"1" * 5000}}}', "too many digits"),
        (" " * 2_000_000, "at most 1,048,576 are read here"),
    ],
)
def test_a_bad_adjustment_file_is_refused(content: str, said: str, tmp_path):
    path = tmp_path / "mine.json"
    path.write_text(content)
    with pytest.raises(InputError) as caught:
        read_adjustments(path)
    assert said in str(caught.value)


def test_shapes_are_adjusted_before_they_are_mirrored():
    """A profile is of the person's own sides."""
    left, right = (BLENDSHAPE_INDEX[f"mouthSmile{side}"] for side in ("Left", "Right"))
    weights = np.zeros(52)
    weights[[left, right]] = 0.8, 0.2
    halved = {"mouthSmileLeft": ShapeAdjustment(gain=0.5)}
    (sample,) = Chain(Output(adjustments=halved, mirror=True).stages()).run([Sample(weights=weights)])
    assert sample.weights[[left, right]] == pytest.approx([0.2, 0.4])


def test_the_command_does_it_in_order(run, quick_model: Model, quick_model_folder, tmp_path):
    frames = drawn_faces(np.random.default_rng(4), 12)
    np.save(tmp_path / "take.npy", frames)
    mine = {"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": 0.5}}}
    (tmp_path / "mine.json").write_text(json.dumps(mine))
    options = ("--one-euro", 2, "--fps", 30, "--adjust", tmp_path / "mine.json", "--left-right-blend", 0.3)
    code, out, err = run("predict", quick_model_folder, tmp_path / "take.npy", *options, "--mirror")
    assert code == 0, err
    rows = np.array([line.split(",") for line in out.splitlines()[1:]], dtype=float)
    output = Output(
        one_euro=OneEuro(cutoff_hz=2),
        adjustments=read_adjustments(tmp_path / "mine.json"),
        left_right_blend=0.3,
        mirror=True,
    )
    timed = Frames(
        points=frames, labels=tuple(map(str, range(12))), time_s=np.arange(12) / 30, source="take.npy"
    )
    expected = predict_frames(quick_model, timed, output=output).weights
    assert np.allclose(rows[:, 2:], expected, atol=1e-6)
    assert np.allclose(rows[:, 1], timed.time_s, atol=1e-6)
    code, _, err = run("predict", quick_model_folder, tmp_path / "take.npy", "--one-euro", 2)
    assert code == 2
    assert "--fps" in err


def _lines(frames: np.ndarray, times: np.ndarray | None = None) -> list[str]:
    lines = []
    for row, frame in enumerate(frames):
        numbers = [] if times is None else [times[row]]
        lines.append(" ".join(repr(float(value)) for value in [*numbers, *frame.ravel()]) + "\n")
    return lines


def test_a_pipe_gives_what_a_file_gives(run, quick_model: Model, quick_model_folder, monkeypatch):
    frames = drawn_faces(np.random.default_rng(4), 6)
    lines = _lines(frames)
    lines[2] = "\n"
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(lines)))
    code, out, err = run("predict", quick_model_folder, "-", "--smooth", 3)
    assert code == 0, err
    with_gap = frames.copy()
    with_gap[2] = np.nan
    source = Frames(points=with_gap, labels=tuple("123456"), time_s=None, source="-")
    expected = predict_frames(quick_model, source, output=Output(smooth=3)).weights
    header, *rows = out.splitlines()
    assert header.split(",") == ["frame", *BLENDSHAPES]
    assert rows[2] == "3" + "," * 52
    assert [row.endswith(",,") for row in rows] == [number == 2 for number in range(6)]
    for row, weights in zip(rows, expected, strict=True):
        if not row.endswith(",,"):
            assert np.allclose([float(cell) for cell in row.split(",")[1:]], weights, atol=1e-6)


def test_the_first_line_with_a_face_is_neutral_where_a_person_says_so(run, monkeypatch, tmp_path):
    frames = drawn_faces(np.random.default_rng(4), 6)
    lines = _lines(frames)
    lines[0], lines[1] = "\n", "0 " * 136 + "\n"
    frames[0], frames[1] = np.nan, 0
    np.save(tmp_path / "faces.npy", frames)
    options = ("--neutral", "first", "--keep-guessed-gaze")
    code, of_file, err = run("predict", "landmarks-default", tmp_path / "faces.npy", *options)
    assert code == 0, err
    monkeypatch.setattr(sys, "stdin", io.StringIO("".join(lines)))
    code, of_lines, err = run("predict", "landmarks-default", "-", *options)
    assert code == 0, err
    found, expected = (
        [line.split(",")[1:] for line in text.splitlines()[1:]] for text in (of_lines, of_file)
    )
    assert found[:2] == expected[:2] == [[""] * 52] * 2
    np.testing.assert_allclose(np.float64(found[2:]), np.float64(expected[2:]), atol=1e-5)
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n" * 3))
    code, of_lines, err = run("predict", "landmarks-default", "-", *options)
    assert (code, len(of_lines.splitlines())) == (0, 4), err


def test_each_line_leaves_before_the_next_arrives(quick_model: Model):
    taken = []

    def lines():
        for number, line in enumerate(_lines(drawn_faces(np.random.default_rng(4), 3))):
            taken.append(number)
            yield line

    stream = stream_csv(lines(), quick_model, Output())
    assert next(stream).startswith("frame,")
    assert next(stream).startswith("1,")
    assert taken == [0]


def test_a_pipe_finds_the_neutral_face_while_it_runs(quick_model: Model):
    rng = np.random.default_rng(5)
    frames = in_pictures(rng, np.stack([drawn_face()] * 320))
    said: list[str] = []
    rows = list(
        stream_csv(_lines(frames, np.arange(320) / 30), quick_model, Output(), auto=True, say=said.append)
    )
    assert len(said) == 1
    assert "neutral face found" in said[0]
    last = np.array(rows[-1].split(",")[2:], dtype=float)
    assert np.allclose(last, quick_model.calibrate(frames).predict(frames)[-1], atol=1e-4)
    first = np.array(rows[1].split(",")[2:], dtype=float)
    assert np.allclose(first, quick_model.predict(frames)[0], atol=1e-4)


def test_the_trust_is_in_the_networks_that_answer(quick_model: Model):
    """Those that were calibrated on the way, from the frame on of which it is told."""
    faces = in_pictures(np.random.default_rng(5), np.stack([drawn_face()] * 320))
    said: list[str] = []
    chain = landmark_chain(quick_model, confident=True, auto=True, say=said.append)
    samples = [Sample(label=str(row), time_s=row / 30, points=face) for row, face in enumerate(faces)]
    found = [answer.confidence for answer in chain.stream(samples)]
    (networks,) = (stage for stage in chain.stages if isinstance(stage, LandmarkNetworks))
    began = int(said[0].split()[1].rstrip(":"))
    np.testing.assert_allclose(found[:began], confidence(quick_model, faces[:began]), rtol=1e-12)
    np.testing.assert_allclose(found[began:], confidence(networks.model, faces[began:]), rtol=1e-12)
    assert not np.allclose(found[began:], confidence(quick_model, faces[began:]))


def test_fps_goes_before_times_of_lines(quick_model: Model):
    lines = _lines(drawn_faces(np.random.default_rng(4), 4), np.array([7.0, 8.0, 8.0, np.nan]))
    lines[1] = "\n"
    rows = [line.split(",") for line in stream_csv(lines, quick_model, Output(), fps=10)]
    assert [row[1] for row in rows] == ["time_s", "0.000000", "0.100000", "0.200000", "0.300000"]
    assert [row[2] == "" for row in rows] == [False, False, True, False, False]


@pytest.mark.parametrize("timed", [True, False])
@pytest.mark.parametrize("empty", ["\n", "," * 135 + "\n"])
def test_empty_lines_at_the_start_leave_the_columns_to_the_first_face(
    quick_model: Model, timed: bool, empty: str
):
    times = np.array([0.5, 0.6]) if timed else None
    lines = [empty, empty, *_lines(drawn_faces(np.random.default_rng(4), 2), times)]
    header, *rows = (line.strip().split(",") for line in stream_csv(lines, quick_model, Output()))
    assert header == ["frame", *(["time_s"] if timed else []), *BLENDSHAPES]
    assert [row[0] for row in rows] == ["1", "2", "3", "4"]
    assert {len(row) for row in rows} == {len(header)}
    if timed:
        assert [row[1] for row in rows] == ["", "", "0.500000", "0.600000"]


def test_a_pipe_of_empty_lines_has_a_header_and_a_row_each(quick_model: Model):
    rows = list(stream_csv(["\n", "\n"], quick_model, Output()))
    assert [row.split(",")[0] for row in rows] == ["frame", "1", "2"]
    assert list(stream_csv([], quick_model, Output())) == []


def test_a_neutral_face_is_not_looked_for_by_a_model_without_calibrated_networks(quick_model: Model):
    bare = dataclasses.replace(quick_model, calibrated=None)
    lines = _lines(drawn_faces(np.random.default_rng(4), 2))
    with pytest.raises(InputError, match="no calibrated networks"):
        next(stream_csv(lines, bare, Output(), auto=True))


@pytest.mark.parametrize(
    ("line", "said"),
    [("1 2 3\n", "line 1 has 3 numbers"), ("a\n", "not a number"), ("nan" + " 1" * 136, "nan for")],
)
def test_a_bad_line_is_named(line: str, said: str, quick_model: Model):
    with pytest.raises(InputError, match=said):
        list(stream_csv([line], quick_model, Output()))
