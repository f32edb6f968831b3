"""Exports that take a neutral face while they run, against ``Model.calibrate(neutral).predict``."""

import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path

import hypothesis
import hypothesis.strategies as st
import numpy as np
import onnxruntime
import pytest

from regress.exporters import export_model
from regress.exporters.formula import formula_of
from regress.exporters.halves import STEP, halves_of
from regress.learning.training import KeypointDataset, Recipe, train
from tests.regress.drawn import drawn_dataset, drawn_faces
from tests.regress.exporters.readers import READERS
from tests.regress.exporters.test_exporters import AGREEMENT, FORMATS, skip_without_tool

pytestmark = pytest.mark.slow

NEUTRAL = drawn_faces(np.random.default_rng(61), 1)[0].astype(np.float32)
OTHER = drawn_faces(np.random.default_rng(62), 1)[0].astype(np.float32)


@pytest.fixture(scope="session")
def exported(calibratable, tmp_path_factory):
    """``exported(format) -> predict``, each made once."""
    folder = tmp_path_factory.mktemp("neutral")
    made = {}

    def get(chosen):
        skip_without_tool(chosen)
        if chosen not in made:
            made[chosen], _ = READERS[chosen](
                export_model(calibratable, folder, name="face", formats=[chosen])
            )
        return made[chosen]

    return get


@pytest.fixture(scope="module")
def files(calibratable, tmp_path_factory):
    folder = tmp_path_factory.mktemp("files")
    export_model(calibratable, folder, name="face", formats=("onnx", "c", "javascript"))
    return folder


def test_a_neutral_face_makes_a_difference(calibratable, faces):
    alone, one, other = (
        model.predict(faces)
        for model in (
            calibratable,
            calibratable.calibrate(NEUTRAL[None]),
            calibratable.calibrate(OTHER[None]),
        )
    )
    for first, second in ((alone, one), (alone, other), (one, other)):
        assert np.mean(np.abs(first - second)) > 0.05
    assert 0.1 < np.mean(one == 0) < 0.6
    assert np.max(one.std(axis=0)) > 0.2


@pytest.mark.parametrize("chosen", FORMATS)
def test_agrees_with_a_calibrated_model(chosen, calibratable, exported, faces):
    predict = exported(chosen)
    for neutral in (NEUTRAL, OTHER):
        weights = calibratable.calibrate(neutral[None]).predict(faces)
        np.testing.assert_allclose(predict(faces, neutral), weights, atol=AGREEMENT, rtol=0)
    np.testing.assert_allclose(predict(faces), calibratable.predict(faces), atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize("chosen", FORMATS)
@hypothesis.settings(deadline=None, max_examples=15)
@hypothesis.given(
    seed=st.integers(0, 2**32 - 1),
    face_widths_away=st.tuples(st.floats(-30, 30), st.floats(-30, 30)),
    log10_width=st.floats(-6, 6),
)
def test_a_neutral_face_may_be_anywhere_and_of_any_size(
    chosen, calibratable, exported, faces, seed, face_widths_away, log10_width
):
    (shape,) = drawn_faces(np.random.default_rng(seed), 1)
    shape = (shape - shape.mean(axis=0)) / np.ptp(shape[:, 0])
    neutral = ((shape + face_widths_away) * 10**log10_width).astype(np.float32)
    weights = calibratable.calibrate(neutral[None]).predict(faces[:3])
    np.testing.assert_allclose(exported(chosen)(faces[:3], neutral), weights, atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize("chosen", ["onnx", "javascript", pytest.param("c", marks=pytest.mark.compiler)])
def test_a_missing_point_of_the_face_gives_nan_for_it_alone(chosen, exported, faces):
    broken = faces[:3].copy()
    broken[1, 50, 0] = np.nan
    weights = exported(chosen)(broken, NEUTRAL)
    assert np.isnan(weights[1]).all()
    np.testing.assert_array_equal(weights[[0, 2]], exported(chosen)(faces[:3], NEUTRAL)[[0, 2]])


def test_onnx_takes_a_neutral_face_for_each_row_and_zeros_for_none(calibratable, exported, faces):
    neutral = np.stack([NEUTRAL, OTHER, np.zeros_like(OTHER), NEUTRAL])
    neutral[3, 8, 0] = np.nan
    weights = exported("onnx")(faces[:4], neutral)
    for row, model in (
        (0, calibratable.calibrate(NEUTRAL[None])),
        (1, calibratable.calibrate(OTHER[None])),
        (2, calibratable),
    ):
        np.testing.assert_allclose(
            weights[row], model.predict(faces[row : row + 1])[0], atol=AGREEMENT, rtol=0
        )
    assert np.isnan(weights[3]).all()


C_PROGRAM = """
#include <math.h>
#include <stdio.h>
#include "face.h"

static float face[FACE_POINTS][2], neutral[2][FACE_POINTS][2], none[FACE_POINTS][2], weights[FACE_WEIGHTS];

static void read_points(float points[FACE_POINTS][2])
{
    for (int i = 0; i < FACE_POINTS; i++)
        if (scanf("%f %f", &points[i][0], &points[i][1]) != 2) points[i][0] = NAN;
}

static void answer(const face_player *player)
{
    face_predict(player, (const float (*)[2])face, weights);
    for (int i = 0; i < FACE_WEIGHTS; i++) printf("%.7f ", weights[i]);
    printf("\\n");
}

int main(void)
{
    face_player players[3] = {{0}};
    read_points(face);
    for (int i = 0; i < 2; i++) {
        read_points(neutral[i]);
        if (!face_neutral(&players[i], (const float (*)[2])neutral[i])) return 1;
    }
    for (int i = 0; i < 3; i++) answer(&players[i]);
    answer(&players[0]);
    neutral[1][9][0] = NAN;
    if (face_neutral(&players[0], (const float (*)[2])neutral[1])) return 2;
    answer(&players[0]);
    if (!face_neutral(&players[0], (const float (*)[2])none)) return 3;
    answer(&players[0]);
    answer(0);
    for (int i = 0; i < 68; i++) {
        neutral[1][i][0] = 320.3f;
        neutral[1][i][1] = 240.7f;
    }
    if (face_neutral(&players[0], (const float (*)[2])neutral[1])) return 4;
    return 0;
}
"""


@pytest.mark.compiler
def test_several_players_in_one_c_program(calibratable, files, faces):
    skip_without_tool("c")
    (files / "players.c").write_text(C_PROGRAM)
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror"]
    subprocess.run(["cc", *flags, "players.c", "face.c", "-o", "players", "-lm"], cwd=files, check=True)
    given = " ".join(repr(float(value)) for value in np.stack([faces[0], NEUTRAL, OTHER]).ravel())
    done = subprocess.run([files / "players"], input=given, capture_output=True, text=True, check=True)
    written = np.array([line.split() for line in done.stdout.splitlines()], dtype=float)
    one, other = (calibratable.calibrate(rest[None]) for rest in (NEUTRAL, OTHER))
    # a neutral face that is refused leaves what was, zeros forget it
    models = [one, other, calibratable, one, one, calibratable, calibratable]
    weights = np.concatenate([model.predict(faces[:1]) for model in models])
    np.testing.assert_allclose(written, weights, atol=AGREEMENT, rtol=0)


@pytest.mark.compiler
def test_c_says_the_stack_that_it_needs(files: Path, tmp_path: Path):
    """By GCC's own sums, without optimisation: an answer, and the largest of what it calls."""
    skip_without_tool("c")
    flags = ["-std=c99", "-O0", "-fstack-usage"]
    subprocess.run(
        ["cc", *flags, "-c", files / "face.c", "-o", tmp_path / "face.o"], cwd=tmp_path, check=True
    )
    sums = next(tmp_path.glob("*.su"), None)
    if sums is None:
        pytest.skip("the compiler sums up no stack")
    rows = [line.split() for line in sums.read_text().splitlines()]
    used = {row[0].rpartition(":")[2]: int(row[1]) for row in rows}
    answers = [used.pop("face_alone_predict"), used.pop("face_calibrated_predict")]
    within = max(answers) + max(used.values()) + used["face_predict"]
    (told,) = re.findall(r"needs (\d+) kB of stack", (files / "face.h").read_text())
    assert within / 1024 <= int(told) <= within / 1024 + 2


JAVASCRIPT_PROGRAM = """
import { player, predict } from "./face.js";
import { readFileSync } from "node:fs";

const [face, one, other] = JSON.parse(readFileSync(0));
const none = one.map(() => [0, 0]);
const players = [player(one), player(Float32Array.from(other.flat())), player(none), player(none.flat())];
const kept = new Float32Array(52);
const weights = [...players, players[0]].map((answer) => Array.from(answer(face)));
weights.push(Array.from(players[0](face.flat(), kept)), Array.from(kept));
const lacking = (point) => one.map((known, i) => (i === 9 ? point : known));
const none68 = one.map(() => [320.3, 240.7]);
const refused = [
  lacking([1, NaN]), lacking([1, null]), lacking(null), lacking([1, null]).flat(), none68,
  one.map(([x, y]) => ({ x, y })), one.slice(1),
].map((neutral) => {
  try { player(neutral); return "taken"; } catch (error) { return `${error.name}: ${error.message}`; }
});
const blind = [lacking([null, null]), lacking(null), lacking([null, null]).flat()].flatMap((face) => [
  predict(face), players[0](face),
]);
const unseen = blind.every((weights) => weights.every(Number.isNaN));
console.log(JSON.stringify({ weights, refused, unseen, same: players[2] === predict }));
"""


def test_several_players_in_one_javascript_program(calibratable, files, faces):
    skip_without_tool("javascript")
    (files / "package.json").write_text('{"type": "module"}')
    (files / "players.js").write_text(JAVASCRIPT_PROGRAM)
    given = json.dumps([points.astype(float).tolist() for points in (faces[0], NEUTRAL, OTHER)])
    done = subprocess.run(
        ["node", "players.js"], cwd=files, input=given, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    written = json.loads(done.stdout)
    one, other = (calibratable.calibrate(rest[None]) for rest in (NEUTRAL, OTHER))
    models = [one, other, calibratable, calibratable, one, one, one]
    weights = np.concatenate([model.predict(faces[:1]) for model in models])
    np.testing.assert_allclose(written["weights"], weights, atol=AGREEMENT, rtol=0)
    assert written["same"]
    assert written["unseen"], "JSON has null for NaN"
    for refusal, word in zip(written["refused"], [*["missing"] * 6, "length 67"], strict=True):
        assert re.match(f"RangeError: .*{word}", refusal)


@pytest.mark.parametrize("chosen", ["onnx", "c", "javascript"])
def test_a_face_without_size_has_no_answer(chosen, exported):
    """The mean of equal numbers is off by rounding: what is left of them has a shape."""
    places = np.random.default_rng(5).uniform(0, [1280, 720], (100, 1, 2))
    collapsed = np.repeat(places, 68, axis=1).astype(np.float32)
    for neutral in (None, NEUTRAL):
        assert np.isnan(exported(chosen)(collapsed, neutral)).all()


@pytest.mark.parametrize("chosen", FORMATS)
def test_a_model_that_is_calibrated_already_takes_no_neutral_face(chosen, calibratable, faces, tmp_path):
    skip_without_tool(chosen)
    person = calibratable.calibrate(NEUTRAL[None])
    paths = export_model(person, tmp_path, name="face", formats=[chosen])
    predict, _ = READERS[chosen](paths)
    np.testing.assert_allclose(predict(faces), person.predict(faces), atol=AGREEMENT, rtol=0)
    assert not any(word in path.read_bytes() for path in paths for word in (b"neutral", b"calibrated"))


def test_onnx_says_what_it_takes(calibratable, files):
    session = onnxruntime.InferenceSession(files / "face.onnx", providers=["CPUExecutionProvider"])
    assert [(entry.name, entry.shape) for entry in session.get_inputs()] == [
        ("points", ["n", 68, 2]),
        ("neutral", ["n or 1", 68, 2]),
    ]


@pytest.fixture(scope="module")
def trained():
    dataset = drawn_dataset(np.random.default_rng(3), people=60)
    recipe = Recipe(name="quick", steps=3, alphas=(1.0,), symmetric=True, calibrated_alignment="stable")
    return dataset, train(dataset, recipe)


@pytest.mark.parametrize("chosen", FORMATS)
def test_agrees_on_the_test_split_after_training(chosen, trained, tmp_path):
    skip_without_tool(chosen)
    dataset, model = trained
    predict, _ = READERS[chosen](export_model(model, tmp_path, name="face", formats=[chosen]))
    agree_on_test_split(model, predict, dataset)


@pytest.mark.parametrize("chosen", FORMATS)
def test_the_shipped_model_agrees_on_a_test_split(chosen, shipped_model, shipped_people, tmp_path):
    skip_without_tool(chosen)
    predict, _ = READERS[chosen](export_model(shipped_model, tmp_path, name="face", formats=[chosen]))
    agree_on_test_split(shipped_model, predict, shipped_people)


def agree_on_test_split(model, predict, dataset) -> None:
    """Person by person, with their neutral face and without."""
    rows, neutral_rows = dataset.rows("test"), dataset.neutral_rows()
    points = dataset.points.astype(np.float32)
    np.testing.assert_allclose(predict(points[rows]), model.predict(points[rows]), atol=AGREEMENT, rtol=0)
    for row in np.unique(neutral_rows[rows]):
        person = points[rows[neutral_rows[rows] == row]]
        weights = model.calibrate(points[row][None]).predict(person)
        np.testing.assert_allclose(predict(person, points[row]), weights, atol=AGREEMENT, rtol=0)


def test_units_of_half_a_symmetric_set_are_whole_fours(dataset: KeypointDataset):
    """By as many zeros as are needed: of a rest C makes single steps, and takes half as long again."""
    quick = Recipe(name="quick", alphas=(0.3,), steps=2, search_rows=100, hidden=5, symmetric=True)
    model = train(dataset, replace(quick, calibrated_alignment="stable", calibrated_linear=0.3))
    assert model.calibrated.networks.hidden % 4
    halves = halves_of(formula_of(model).calibrated)
    units = len(halves.hidden_weights)
    assert units % STEP == 0
    assert halves.hidden_bias.shape == (2 * units,)
    assert halves.output_weights.shape[1] == 2 * units
