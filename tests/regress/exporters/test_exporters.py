"""Every exporter in the table against ``Model.predict``, which is the reference."""

import hashlib
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import hypothesis
import hypothesis.strategies as st
import numpy as np
import onnx
import onnxruntime
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from regress.errors import InputError, OutputError
from regress.exporters import EXPORTERS, export_model
from regress.exporters.answering import Answering, FormulaNetwork
from regress.exporters.c_source import export_c
from regress.exporters.formula import FORMAT_VERSION, Formula, formula_of
from regress.exporters.halves import STEP, halves_of
from regress.exporters.javascript import export_javascript
from regress.exporters.json_text import export_json
from regress.exporters.measures import Measures
from regress.exporters.onnx_graph import OPERATORS, OPSET, build_graph, build_networks_graph
from regress.learning.training import Recipe, train
from tests.regress.drawn import drawn_dataset, drawn_faces
from tests.regress.exporters.conftest import MODELS, random_model
from tests.regress.exporters.readers import READERS

AGREEMENT = 1e-4
"""What the project promises. float32 networks give about 1e-6 (measured); the rest is for other runtimes."""

FORMATS = [pytest.param(name, marks=[pytest.mark.compiler] if name == "c" else []) for name in EXPORTERS]
TOOLS = {"c": "cc", "javascript": "node"}
"""Straight from the table: a new exporter is tested the day it appears, and fails until it has a reader."""


def skip_without_tool(chosen: str) -> None:
    """Skip where the program that runs a format is missing."""
    tool = TOOLS.get(chosen)
    if tool is not None and shutil.which(tool) is None:
        pytest.skip(f"no {tool} on this machine")


@pytest.fixture(scope="session")
def exported(model, tmp_path_factory):
    """``exported(format) -> (predict, names)``, each made once."""
    folder = tmp_path_factory.mktemp("exports")
    made = {}

    def get(chosen):
        skip_without_tool(chosen)
        if chosen not in made:
            made[chosen] = READERS[chosen](export_model(model, folder, name="face", formats=[chosen]))
        return made[chosen]

    return get


def test_the_models_under_test_swing_like_trained_ones(model, faces):
    weights = model.predict(faces)
    assert 0.1 < np.mean(weights == 0) < 0.6
    assert 0.02 < np.mean(weights == 1) < 0.4
    assert np.median(weights.std(axis=0)) > 0.2


@pytest.mark.parametrize("chosen", FORMATS)
def test_agrees_with_predict(chosen, model, exported, faces):
    predict, names = exported(chosen)
    weights = predict(faces)
    assert names == BLENDSHAPES
    assert weights.shape == (len(faces), 52)
    np.testing.assert_allclose(weights, model.predict(faces), atol=AGREEMENT, rtol=0)
    assert (weights[:, BLENDSHAPE_INDEX["tongueOut"]] == 0).all()
    assert weights.min() >= 0
    assert weights.max() <= 1


@pytest.mark.parametrize("chosen", FORMATS)
@hypothesis.settings(deadline=None, max_examples=25)
@hypothesis.given(
    seed=st.integers(0, 2**32 - 1),
    face_widths_away=st.tuples(st.floats(-30, 30), st.floats(-30, 30)),
    log10_width=st.floats(-6, 6),
)
def test_agrees_far_from_the_origin_and_at_any_scale(
    chosen, model, exported, seed, face_widths_away, log10_width
):
    predict, _ = exported(chosen)
    shapes = drawn_faces(np.random.default_rng(seed), 3)
    shapes = (shapes - shapes.mean(axis=1, keepdims=True)) / np.ptp(shapes[..., 0], axis=1)[:, None, None]
    faces = ((shapes + face_widths_away) * 10**log10_width).astype(np.float32)
    np.testing.assert_allclose(predict(faces), model.predict(faces), atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize(
    "chosen", [param for param in FORMATS if param.values[0] in ("onnx", "c", "javascript")]
)
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
@pytest.mark.parametrize("landmark", [0, 8, 30, 50, 67])
def test_a_missing_point_gives_nan_for_its_face_alone(chosen, exported, faces, bad, landmark):
    predict, _ = exported(chosen)
    broken = faces[:3].copy()
    broken[1, landmark, 1] = bad
    weights = predict(broken)
    assert np.isnan(weights[1]).all()
    np.testing.assert_array_equal(weights[[0, 2]], predict(faces[:3])[[0, 2]])


@pytest.mark.parametrize(
    "chosen", [param for param in FORMATS if param.values[0] in ("onnx", "c", "javascript")]
)
def test_a_face_in_one_point_gives_nan(chosen, exported):
    predict, _ = exported(chosen)
    assert np.isnan(predict(np.zeros((1, 68, 2), dtype=np.float32))).all()


@pytest.mark.parametrize(
    "chosen", [param for param in FORMATS if param.values[0] in ("onnx", "c", "javascript")]
)
@hypothesis.settings(deadline=None, max_examples=20)
@hypothesis.given(
    line=st.sampled_from([(1.0, 0.0), (0.0, 1.0), (1.0, 1.0), (2.0, -1.0)]),
    place=st.integers(-300, 300),
    log2_size=st.integers(-4, 10),
)
def test_a_face_on_one_line_gives_nan_where_predict_does(chosen, model, exported, line, place, log2_size):
    """Numbers that float32 has exactly: a line by rounding alone is one for none."""
    predict, _ = exported(chosen)
    along = np.arange(68) * 7 % 31 + place
    face = (2.0**log2_size * along[:, None] * line)[None].astype(np.float32)
    expected = model.predict(face)
    np.testing.assert_allclose(predict(face), expected, atol=AGREEMENT, rtol=0)
    assert np.isnan(expected).all() == (formula_of(model).alone.measures.alignment == "affine")


@pytest.mark.parametrize("chosen", list(EXPORTERS))
def test_equal_models_give_equal_bytes_and_no_leavings(chosen, tmp_path):
    def export(folder):
        return export_model(random_model(np.random.default_rng(7)), folder, name="face", formats=[chosen])

    first, second = export(tmp_path / "a"), export(tmp_path / "b")
    assert [path.read_bytes() for path in first] == [path.read_bytes() for path in second]
    before = [path.read_bytes() for path in first]
    assert export(tmp_path / "a") == first
    assert [path.read_bytes() for path in first] == before
    assert sorted((tmp_path / "a").iterdir()) == sorted(first)


@pytest.fixture(scope="module")
def trained():
    dataset = drawn_dataset(np.random.default_rng(3), people=60)
    return dataset, train(dataset, Recipe(name="quick", steps=3, alphas=(1.0,)))


@pytest.mark.parametrize("chosen", FORMATS)
def test_agrees_on_the_test_split_after_training(chosen, trained, tmp_path):
    skip_without_tool(chosen)
    dataset, model = trained
    predict, _ = READERS[chosen](export_model(model, tmp_path, name="face", formats=[chosen]))
    faces = dataset.points[dataset.rows("test")].astype(np.float32)
    np.testing.assert_allclose(predict(faces), model.predict(faces), atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize("chosen", FORMATS)
def test_the_shipped_model_agrees(chosen, shipped_model, tmp_path):
    skip_without_tool(chosen)
    predict, _ = READERS[chosen](export_model(shipped_model, tmp_path, name="face", formats=[chosen]))
    rng = np.random.default_rng(8)
    noise = rng.normal(size=(300, 68, 2)) * 0.01
    faces = ((shipped_model.features.mean_shape + noise) * 300 + 900).astype(np.float32)
    np.testing.assert_allclose(predict(faces), shipped_model.predict(faces), atol=AGREEMENT, rtol=0)


@pytest.mark.parametrize("kind", MODELS)
def test_units_that_come_in_pairs_are_written_once(kind):
    model = random_model(np.random.default_rng(5), **MODELS[kind])
    formula = formula_of(model)
    for answering in filter(None, (formula.alone, formula.calibrated)):
        halves = halves_of(answering)
        assert (halves is not None) == bool(MODELS[kind].get("symmetric"))
        if halves is not None:
            assert len(halves.hidden_weights) == len(answering.stacked().hidden_weights) / 2
            inputs = (
                answering.measures.count if answering.denoising is None else len(answering.denoising.axes)
            )
            assert halves.hidden_weights.shape[1] < inputs + 2 * STEP
            assert halves.hidden_weights.shape[1] % STEP == halves.even % STEP == 0


def tiny_formula() -> Formula:
    """A formula whose numbers are whole and the same on every machine, as the paper's recipe makes: no neutral face."""
    network = FormulaNetwork(
        name="mouth.jaw_open",
        outputs=("jawOpen", "mouthClose"),
        hidden_weights=np.array([[1.0, 2.0], [3.0, -4.0], [5.0, 6.5]]),
        hidden_bias=np.array([0.5, 0.25, -1.0]),
        output_weights=np.array([[1.0, 0.0, 2.0], [0.0, 0.5, 0.0]]),
        output_bias=np.array([0.125, -0.5]),
    )
    measures = Measures(
        depth=np.zeros(68),
        turn=np.zeros(68),
        alignment="affine",
        anchors=np.arange(3),
        reference=np.array([[1.0, 0.0], [-1.0, 0.5], [0.0, -0.5]]),
        edges=np.array([[0, 1], [36, 45]]),
        width_landmarks=np.array([0, 16]),
    )
    alone = Answering(
        measures=measures, feature_mean=np.array([0.5, 0.25]), denoising=None, networks=(network,)
    )
    about = {
        "recipe": "paper",
        "dataset": "none",
        "dataset_sha256": "0",
        "licence": "CC0-1.0",
        "program": "regress",
    }
    return Formula(alone=alone, calibrated=None, about=about)


@pytest.mark.compiler
def test_c_has_places_of_more_connections_than_16_bits_count(tmp_path: Path):
    """The one network gives what it gave, with idle units before its own, and a first one that makes runs long."""
    skip_without_tool("c")
    formula, idle = tiny_formula(), 66_000
    (network,) = formula.alone.networks
    weights = np.zeros((2, idle + 3))
    weights[:, idle:] = network.output_weights
    weights[0, 0] = 1.0  # of a unit that is 0
    wide = replace(
        network,
        hidden_weights=np.concatenate([np.zeros((idle, 2)), network.hidden_weights]),
        hidden_bias=np.concatenate([np.zeros(idle), network.hidden_bias]),
        output_weights=weights,
    )
    answers = []
    for name, used in (("narrow", network), ("wide", wide)):
        paths = []
        for file, content in export_c(
            replace(formula, alone=replace(formula.alone, networks=(used,))), name
        ).items():
            (tmp_path / file).write_bytes(content)
            paths.append(tmp_path / file)
        predict, _ = READERS["c"](tuple(paths))
        answers.append(predict(drawn_faces(np.random.default_rng(3), 5)))
    assert np.isfinite(answers[0]).all()
    np.testing.assert_allclose(answers[1], answers[0], atol=1e-6)


PAPER = {
    "face.c": "0dfc6f8d5043fa0cc5569e97c92188376433969f1cc7e7a7bec434000a85b046",
    "face.h": "a004f0cef493a05f4ea89ed71394779720c7b99abd6d66817c832d05b25172da",
    "face.js": "b46c4fb09ff0e81bd43571e042a958059eb7708847bea8e09703fd3a35fca347",
    "face.d.ts": "dc4faf26e758fcb51b3805c07af21b8801282a1029b1607378e03288bca1b487",
    "face.json": "978bcd4c2cf64433597009a4fd2ca97573e7d4f924e63ba6ecf0c112fb270e02",
}
"""SHA-256 by file, JSON's without its version: what readers of models of the paper's kind were written for."""


def test_exports_without_a_neutral_face_are_what_they_were():
    made = {}
    for export in (export_c, export_javascript, export_json):
        made |= export(tiny_formula(), "face")
    made["face.json"] = made["face.json"].replace(f'"version":{FORMAT_VERSION},'.encode(), b"")
    assert {name: hashlib.sha256(content).hexdigest() for name, content in made.items()} == PAPER


@pytest.mark.parametrize("calibrated", [None, "stable"])
def test_files_say_which_units_serve_and_the_paper_s_stay(calibrated):
    formula = formula_of(random_model(np.random.default_rng(9), calibrated=calibrated))
    for recipe in ("paper", "default"):
        about = {**formula.about, "recipe": recipe}
        made = export_c(replace(formula, about=about), "face")
        made |= export_javascript(replace(formula, about=about), "face")
        for name in ("face.h", "face.js", "face.d.ts"):
            told = "one unit: multiply shares" in " ".join(made[name].decode().replace("*", " ").split())
            assert told == (calibrated is not None or recipe != "paper"), name


def test_onnx_is_one_plain_graph(model):
    graph = build_graph(formula_of(model))
    assert {node.op_type for node in graph.graph.node} <= OPERATORS
    assert [(entry.domain, entry.version) for entry in graph.opset_import] == [("", OPSET)]
    points, *neutral = graph.graph.input
    (weights,) = graph.graph.output
    assert [value.name for value in neutral] == (["neutral"] if model.calibrated else [])
    rest = [(value, ["n or 1", 68, 2]) for value in neutral]
    for value, shape in ((points, ["n", 68, 2]), *rest, (weights, ["n", 52])):
        assert value.type.tensor_type.elem_type == onnx.TensorProto.FLOAT
        assert [size.dim_param or size.dim_value for size in value.type.tensor_type.shape.dim] == shape
    about = {prop.key: prop.value for prop in graph.metadata_props}
    assert set(about) == {"names", "recipe", "dataset", "dataset_sha256", "licence", "program"}


def test_the_networks_graph_gives_nan_where_a_feature_is_missing(model, tmp_path):
    path = tmp_path / "networks.onnx"
    path.write_bytes(build_networks_graph(formula_of(model)).SerializeToString())
    session = onnxruntime.InferenceSession(path, providers=["CPUExecutionProvider"])
    feed = {entry.name: np.ones((2, entry.shape[1]), dtype=np.float32) for entry in session.get_inputs()}
    assert feed["features"].shape[1] == model.features.count
    for zeros in (False, True) if model.calibrated else (False,):
        given = {key: values.copy() for key, values in feed.items()}
        for key in set(given) - {"neutral_features"}:
            given[key][1, 9] = np.nan
        if zeros:
            given["neutral_features"][:] = 0
        (weights,) = session.run(None, given)
        assert np.isfinite(weights[0]).all()
        assert np.isnan(weights[1]).all()
    assert {node.op_type for node in onnx.load(path).graph.node} <= OPERATORS


def test_onnx_runs_on_one_face(exported, faces):
    predict, _ = exported("onnx")
    np.testing.assert_allclose(predict(faces[:1]), predict(faces)[:1], atol=1e-5, rtol=0)


@pytest.mark.compiler
@pytest.mark.parametrize("calibrated", [None, "stable"], ids=["a face alone", "players"])
def test_c_header_serves_c_plus_plus(calibrated, tmp_path):
    if shutil.which("c++") is None:
        pytest.skip("no C++ compiler (c++) on this machine")
    model = random_model(np.random.default_rng(9), calibrated=calibrated)
    header, source = export_model(model, tmp_path, name="face", formats=["c"])
    player, given = ("", "") if calibrated is None else ("face_player player = {};", "&player, ")
    if calibrated is not None:
        player += " face_neutral(&player, points);"
    program = tmp_path / "main.cpp"
    program.write_text(
        f'#include "{header.name}"\n#include <cstdio>\n'
        "int main() { float points[68][2] = {{0}}, weights[FACE_WEIGHTS];\n"
        f"  {player} face_predict({given}points, weights); std::puts(face_names[17]); }}\n"
    )
    objects = tmp_path / "face.o"
    subprocess.run(["cc", "-std=c99", "-c", str(source), "-o", str(objects)], check=True)
    flags = ["-Wall", "-Wextra", "-Werror", "-pedantic"]
    executable = tmp_path / "main"
    subprocess.run(["c++", *flags, str(program), str(objects), "-o", str(executable), "-lm"], check=True)
    assert subprocess.run([str(executable)], capture_output=True, text=True).stdout == "jawOpen\n"


@pytest.mark.compiler
@pytest.mark.parametrize("calibrated", [None, "stable"], ids=["a face alone", "players"])
def test_two_models_go_into_one_build(calibrated, tmp_path):
    """Unreal puts files of a module together: what one keeps to itself had the names of the other's."""
    skip_without_tool("c")
    model = replace(random_model(np.random.default_rng(9), calibrated=calibrated), recipe="default")
    for name in ("one", "other"):
        export_model(model, tmp_path, name=name, formats=["c"])
    (tmp_path / "both.c").write_text('#include "one.c"\n#include "other.c"\n')
    flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-pedantic"]
    subprocess.run(["cc", *flags, "-c", "both.c", "-o", "both.o"], cwd=tmp_path, check=True)


@pytest.mark.compiler
@pytest.mark.parametrize("flag", ["-ffast-math", "-Ofast", "-ffinite-math-only"])
@pytest.mark.parametrize("calibrated", [None, "stable"], ids=["a face alone", "players"])
def test_c_refuses_flags_that_lose_nan(calibrated, flag: str, tmp_path: Path):
    """But the paper's file, whose bytes stay."""
    skip_without_tool("c")
    model = replace(random_model(np.random.default_rng(9), calibrated=calibrated), recipe="default")
    export_model(model, tmp_path, name="face", formats=["c"])
    command = ["cc", "-std=c99", flag, "-c", tmp_path / "face.c", "-o", tmp_path / "face.o"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode != 0
    assert "compile this file without -ffast-math" in done.stderr


def test_c_refuses_names_that_c_cannot_say(model, tmp_path):
    with pytest.raises(InputError, match="letters, digits and underscores"):
        export_model(model, tmp_path, name="my-face", formats=["c"])
    for taken in ("math", "Math"):
        with pytest.raises(InputError, match="taken by a header of C"):
            export_model(model, tmp_path, name=taken, formats=["c"])
    assert list(tmp_path.iterdir()) == []


def test_unknown_formats_and_names_with_folders_are_refused(model, tmp_path):
    with pytest.raises(InputError, match="known are onnx, onnx-networks, c, json, npz, javascript"):
        export_model(model, tmp_path, name="face", formats=["xml"])
    with pytest.raises(InputError, match="without a folder"):
        export_model(model, tmp_path, name="a/b")
    (tmp_path / "file").write_text("")
    with pytest.raises(OutputError, match="cannot be written"):
        export_model(model, tmp_path / "file", name="face", formats=["json"])
