"""Headset models, graphs and arrays from strangers: refused in one sentence, or good throughout."""

import hashlib
import json
import shutil
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import onnx
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from onnx import TensorProto, helper

from regress.errors import InputError, ModelError
from regress.exporters.headset_interface import interface_of
from regress.learning.headset.arrays import read_arrays
from regress.report.headset_page import write_headset_report
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.onnx_file import MOST_NODES, graph_fault
from tests.regress.headset.tiny import NAMES, tiny_graph, write_tiny_model
from tests.regress.test_model_damage import OTHER, paths_of, set_at

SIDE = 16


def resealed(folder: Path, *, graph: bytes | None = None, edit: Callable[[dict], Any] = len) -> Path:
    """Change a model's description, put another graph beside it, and let its hash fit."""
    document = json.loads((folder / "model.json").read_text())
    if graph is not None:
        (folder / "network.onnx").write_bytes(graph)
        document["network_sha256"] = hashlib.sha256(graph).hexdigest()
    edit(document)
    (folder / "model.json").write_text(json.dumps(document))
    return folder


@pytest.fixture
def tiny(tmp_path: Path) -> Path:
    return write_tiny_model(tmp_path / "tiny", width=SIDE, height=SIDE)


def refused(folder: Path) -> str:
    """The one sentence of a refusal."""
    with pytest.raises(ModelError) as caught:
        load_headset_predictor(folder)
    text = str(caught.value)
    assert "\n" not in text
    assert len(text) < 1000
    return text


DESCRIPTIONS = {
    **{f"a width of {size!r}": set_at("cameras", 0, "width", to=size) for size in (0, -1, 10**9, "x", 16.5)},
    "another width than the graph's": set_at("cameras", 0, "width", to=17),
    "a height of a billion": set_at("cameras", 2, "height", to=10**9),
    "no cameras": set_at("cameras", to=[]),
    "a thousand cameras": set_at("cameras", to=lambda cameras: cameras * 400),
    "a camera twice": set_at("cameras", to=lambda cameras: [cameras[0], *cameras]),
    "a camera that leaves its folder": set_at("cameras", 0, "name", to="../../etc/passwd"),
    "a camera of two lines": set_at("cameras", 0, "name", to="left\neye"),
    "a mirror of nobody": set_at("cameras", 0, "mirrored_of", to="nobody"),
    "parts of nobody": set_at("parts", to={"nobody": ["jawOpen"]}),
    "parts that there are not": set_at("parts", "mouth", to=["jawOpened"]),
    "points of nobody": set_at("points", to={"nobody": []}),
    "points that there are not": set_at("points", to={"mouth": ["ear"]}),
    "weights in another order": set_at("weights", to=lambda names: names[::-1]),
    "a weight less": set_at("weights", to=lambda names: names[:-1]),
    "an output less": set_at("outputs", to=["weights"]),
    "an output that nobody knows": set_at("outputs", to=lambda names: [*names, "passwords"]),
    "points that the graph does not give": lambda document: document.update(
        outputs=[*document["outputs"], "points_mouth"], points={"mouth": ["lip_top"]}
    ),
    "taps of one number": set_at("temporal", to={"fps": 30, "taps": [[1]], "people": 1, "dataset_hash": ""}),
    "no frames a second": set_at(
        "temporal", to={"fps": 0, "taps": [[1, 0, 0, 0, 0]] * 56, "people": 1, "dataset_hash": ""}
    ),
    "scores without a shape": lambda document: document["scores"]["shapes"].pop("jawOpen"),
    "scores of a camera without a shape": lambda document: document["scores"]["cameras"]["mouth"].pop(
        "jawOpen"
    ),
    "a shape that was judged otherwise": set_at("scores", "shapes", "jawOpen", to={}),
    "groups of numbers": set_at("scores", "components", to={"dense": 5}),
    "groups as a list": set_at("scores", "people_mm", to=[1]),
    "scores of a number": set_at("scores", to=5),
    "an error below nothing": set_at("scores", "shapes", "jawOpen", "uncalibrated", "rmse", to=-1),
    "means of 51 weights": set_at("training", "mean_weights", to=[0.0] * 51),
    "a number that is none": set_at("modulation", to=float("nan")),
    "half of a character": set_at("rig", to="\ud800"),
    "another version": set_at("version", to=[1]),
    "typical pictures of another size": set_at("typical", to={"mouth": [[0]]}),
}


@pytest.mark.parametrize("damage", DESCRIPTIONS)
def test_edited_descriptions_are_refused_in_one_sentence(tiny: Path, damage: str):
    refused(resealed(tiny, edit=DESCRIPTIONS[damage]))


def changed(change: Callable[[onnx.ModelProto], Any]) -> bytes:
    model = onnx.load_from_string(tiny_graph(SIDE, SIDE, 1.0))
    change(model)
    return model.SerializeToString()


def renamed(model: onnx.ModelProto) -> None:
    model.graph.input[0].name = "pictures_nose"


def elsewhere(model: onnx.ModelProto) -> None:
    tensor = model.graph.initializer[0]
    tensor.data_location = TensorProto.EXTERNAL
    tensor.external_data.add(key="location", value="/etc/passwd")
    tensor.ClearField("raw_data")


def looping(model: onnx.ModelProto) -> None:
    body = helper.make_graph([], "body", [], [])
    model.graph.node.insert(0, helper.make_node("If", ["one"], ["never"], then_branch=body, else_branch=body))


def of_another_domain(model: onnx.ModelProto) -> None:
    model.graph.node[0].domain = "com.microsoft"


def hidden_elsewhere(model: onnx.ModelProto) -> None:
    tensor = helper.make_tensor("inside", TensorProto.FLOAT, [1], [1.0])
    tensor.data_location = TensorProto.EXTERNAL
    model.graph.node.insert(0, helper.make_node("Constant", [], ["never"], value=tensor))


def with_function(model: onnx.ModelProto) -> None:
    model.functions.append(helper.make_function("mine", "f", [], [], [], [helper.make_opsetid("", 15)]))


def of_type(kind: int) -> Callable[[onnx.ModelProto], None]:
    def change(model: onnx.ModelProto) -> None:
        model.graph.input[0].type.tensor_type.elem_type = kind

    return change


def lacking(name: str) -> Callable[[onnx.ModelProto], None]:
    def change(model: onnx.ModelProto) -> None:
        kept = [output for output in model.graph.output if output.name != name]
        del model.graph.output[:]
        model.graph.output.extend(kept)

    return change


GRAPHS = {
    "no ONNX": b"not this",
    "nothing": b"",
    "a cut graph": tiny_graph(SIDE, SIDE, 1.0)[:-100],
    "a picture": b"\x89PNG\r\n\x1a\n" + bytes(100),
    "an input of another name": changed(renamed),
    "an input of another type": changed(of_type(TensorProto.FLOAT)),
    "pictures of another size": tiny_graph(SIDE + 1, SIDE, 1.0),
    "numbers in another file": changed(elsewhere),
    "numbers of a constant in another file": changed(hidden_elsewhere),
    "a branch": changed(looping),
    "an operator of another domain": changed(of_another_domain),
    "functions": changed(with_function),
    "no weights": changed(lacking("weights")),
    "a node that there is not": changed(lambda model: setattr(model.graph.node[0], "op_type", "Castle")),
    "a node without inputs": changed(lambda model: model.graph.node[-1].ClearField("input")),
    "a side with a name of other bytes": tiny_graph(SIDE, SIDE, 1.0).replace(b"\x12\x01n", b"\x12\x01\x80"),
    "a future version": changed(lambda model: setattr(model, "ir_version", 1000)),
}


@pytest.mark.parametrize("damage", GRAPHS)
def test_graphs_that_are_not_the_models_are_refused_in_one_sentence(
    tiny: Path, damage: str, capfd: pytest.CaptureFixture[str]
):
    refused(resealed(tiny, graph=GRAPHS[damage]))
    assert capfd.readouterr() == ("", "")


def sparse(model: onnx.ModelProto, *, elsewhere: bool) -> None:
    """A weight of which most is zero; its numbers may lie in another file."""
    values = helper.make_tensor("sparse", TensorProto.FLOAT, [1], [1.0])
    if elsewhere:
        values.ClearField("float_data")
        values.data_location = TensorProto.EXTERNAL
        values.external_data.add(key="location", value="/etc/passwd")
    places = helper.make_tensor("places", TensorProto.INT64, [1], [0])
    model.graph.sparse_initializer.append(helper.make_sparse_tensor(values, places, [4]))


def crowded(model: onnx.ModelProto, *, nodes: int) -> None:
    del model.graph.node[:]
    model.graph.node.extend([helper.make_node("Identity", ["one"], ["other"])] * nodes)


@pytest.mark.parametrize(
    ("graph", "said"),
    [
        (GRAPHS["a branch"], "an operator 'If' with a graph of its own"),
        (GRAPHS["an operator of another domain"], "of the domain 'com.microsoft'"),
        (GRAPHS["functions"], "defines functions of its own"),
        (GRAPHS["numbers in another file"], "keeps numbers in other files"),
        (GRAPHS["numbers of a constant in another file"], "keeps numbers in other files"),
        (changed(partial(sparse, elsewhere=True)), "keeps numbers in other files"),
        (changed(partial(sparse, elsewhere=False)), None),
        (changed(partial(crowded, nodes=MOST_NODES)), None),
        (changed(partial(crowded, nodes=MOST_NODES + 1)), "has 100,001 nodes; at most 100,000 are run"),
        (tiny_graph(SIDE, SIDE, 1.0), None),
    ],
)
def test_what_is_not_run_is_named_before_anything_runs_it(graph: bytes, said: str | None):
    fault = graph_fault(graph)
    assert fault is None if said is None else said in fault


@settings(max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_graph_with_changed_bytes_is_refused_or_runs(tmp_path: Path, data: st.DataObject):
    folder = tmp_path / "tiny"
    if not folder.exists():
        write_tiny_model(folder, width=SIDE, height=SIDE)
    content = bytearray(tiny_graph(SIDE, SIDE, 1.0))
    for _ in range(data.draw(st.integers(1, 3))):
        place = data.draw(st.integers(0, len(content) - 1))
        content[place] = data.draw(st.integers(0, 255))
    resealed(folder, graph=bytes(content))
    pictures = {name: np.full((2, SIDE, SIDE), 100, np.uint8) for name in NAMES}
    try:
        estimates = load_headset_predictor(folder).predict(pictures)
    except ModelError as error:
        said = str(error)
    else:
        said = ""
        assert estimates.weights.shape == (2, 52)
    assert "\n" not in said


def test_a_graph_that_answers_otherwise_than_it_declares_is_refused(tiny: Path):
    def lying(model: onnx.ModelProto) -> None:
        for output in model.graph.output:
            if output.name == "same_seat":
                output.type.tensor_type.ClearField("shape")
        model.graph.node[-1].ClearField("input")
        model.graph.node[-1].input.extend(["same", "two"])
        model.graph.initializer.append(helper.make_tensor("two", TensorProto.INT64, [2], [-1, 1]))

    folder = resealed(tiny, graph=changed(lying))
    pictures = {name: np.zeros((2, SIDE, SIDE), np.uint8) for name in NAMES}
    with pytest.raises(ModelError, match=r"same_seat of (float32|tensor\(float\)) "):
        load_headset_predictor(folder).predict(pictures)


def test_what_onnxruntime_says_at_a_frame_is_one_sentence(tiny: Path, capfd: pytest.CaptureFixture[str]):
    def impossible(model: onnx.ModelProto) -> None:
        shape = next(tensor for tensor in model.graph.initializer if tensor.name == "eyes")
        shape.CopyFrom(helper.make_tensor("eyes", TensorProto.INT64, [3], [-1, 3, 2]))

    folder = resealed(tiny, graph=changed(impossible))
    with pytest.raises(ModelError, match=r"network\.onnx") as caught:
        load_headset_predictor(folder).predict({name: np.zeros((1, SIDE, SIDE), np.uint8) for name in NAMES})
    assert "\n" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_an_edited_record_is_refused_or_reported(
    pytestconfig: pytest.Config, tmp_path: Path, data: st.DataObject
):
    source = Path(pytestconfig.rootpath) / "regress" / "models" / "headset-tracking3"
    document = json.loads((source / "model.json").read_text())
    path = data.draw(st.sampled_from([path for path in paths_of(document) if path]))
    drop, other = data.draw(st.booleans()), data.draw(st.sampled_from(OTHER))

    def edit(changed: dict) -> None:
        place: Any = changed
        for key in path[:-1]:
            place = place[key]
        if drop:
            del place[path[-1]]
        else:
            place[path[-1]] = other

    folder = tmp_path / "model"
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    resealed(folder, edit=edit)
    try:
        model = load_headset_predictor(folder).model
        page = write_headset_report(model, tmp_path / "report.html", name="edited").read_text(
            encoding="utf-8"
        )
        json.dumps(interface_of(model, graph="g.onnx"), allow_nan=False)
    except InputError as error:
        said = str(error)
    else:
        said = ""
        assert "<script>" not in page
    assert "\n" not in said


def labels(change: Callable[[pa.Table], pa.Table]) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        path = folder / "labels.parquet"
        pq.write_table(change(pq.read_table(path)), path)

    return damage


def column(name: str, values: Callable[[pa.ChunkedArray], Any]) -> Callable[[Path], None]:
    return labels(lambda table: table.set_column(table.column_names.index(name), name, values(table[name])))


def about(*path: str | int, to: Any) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        document = json.loads((folder / "arrays.json").read_text())
        set_at(*path, to=to)(document)
        (folder / "arrays.json").write_text(json.dumps(document))

    return damage


def lying_header(shape: tuple[int, ...], *, after: int = 0) -> Callable[[Path], None]:
    def damage(folder: Path) -> None:
        with open(folder / "mouth.npy", "wb") as file:
            np.lib.format.write_array_header_1_0(
                file, {"descr": "|u1", "fortran_order": False, "shape": shape}
            )
            file.write(bytes(after))

    return damage


def face(**arrays: np.ndarray) -> Callable[[Path], None]:
    return lambda folder: np.savez(folder / "face.npz", **arrays)


def lists(width: int) -> Callable[[pa.ChunkedArray], pa.Array]:
    def values(column: pa.ChunkedArray) -> pa.Array:
        return pa.FixedSizeListArray.from_arrays(pa.array(np.zeros(len(column) * width, np.float32)), width)

    return values


def first(value: float) -> Callable[[pa.ChunkedArray], pa.Array]:
    def values(column: pa.ChunkedArray) -> pa.Array:
        flat = column.combine_chunks().flatten().to_numpy().copy()
        flat[0] = value
        return pa.FixedSizeListArray.from_arrays(pa.array(flat), column.type.list_size)

    return values


ARRAYS = {
    **{f"rows of {rows!r}": about("rows", to=rows) for rows in (0, -1, 10**9, "x", None, [3])},
    **{f"a width of {size!r}": about("cameras", 0, "width", to=size) for size in (0, 10**9, "x", None)},
    **{
        f"arrays.json of {text[:9]}": lambda folder, text=text: (folder / "arrays.json").write_text(text)
        for text in ("[]", "null", "5", "{}", "[" * 100_000, '{"version": ' + "1" * 5000 + "}")
    },
    "a camera outside the folder": about("cameras", 0, "name", to="../copy/left_eye"),
    "a camera twice": about("cameras", to=lambda cameras: [cameras[0], *cameras]),
    "no cameras": about("cameras", to=[]),
    "cameras of numbers": about("cameras", to=[1, 2]),
    "a headset of a number": about("headset", to=5),
    "a seed of words": about("seed", to="none"),
    "half of a character": about("licence", to="\ud800"),
    "a header of a billion rows": lying_header((10**9, 24, 24), after=100),
    "a header of more than there is": lying_header((300, 24, 24), after=300 * 24 * 24 - 1),
    "a header of less than nothing": lying_header((-1, 24, 24)),
    "a cut header": lambda folder: (folder / "mouth.npy").write_bytes(b"\x93NUMPY\x01\x00\x76"),
    "objects for pictures": lambda folder: np.save(
        folder / "mouth.npy", np.array([None, 1], object), allow_pickle=True
    ),
    "a row less": labels(lambda table: table.slice(1)),
    "no row": labels(lambda table: table.slice(0, 0)),
    "a column less": labels(lambda table: table.drop_columns(["gaze"])),
    "people of words": column("person", lambda values: pa.array(["x"] * len(values))),
    "people who are missing": column("person", lambda values: pa.array([None] * len(values), pa.int64())),
    "neutral of numbers": column("neutral", lambda values: pa.array([1.5] * len(values))),
    "splits of numbers": column("split", lambda values: pa.array([1] * len(values))),
    "splits that are missing": column("split", lambda values: pa.array([None] * len(values), pa.string())),
    "a split of a megabyte": column("split", lambda values: pa.array(["x" * 10**6] * len(values))),
    "times that are none": column("time_s", lambda values: pa.array([np.nan] * len(values))),
    "weights of 51": column("weights", lists(51)),
    "weights of single numbers": column("weights", lambda values: pa.array([1.0] * len(values))),
    "weights that are none": column("weights", first(np.nan)),
    "weights beyond all": column("weights", first(np.inf)),
    "gaze of 1e30": column("gaze", first(1e30)),
    "no points": column("points_mouth", lists(2)),
    "a face without rest": face(displacement=np.zeros((52, 4, 3))),
    "a face of 51 shapes": face(displacement=np.zeros((51, 4, 3)), rest=np.zeros((4, 3))),
    "a face of other vertices": face(displacement=np.zeros((52, 4, 3)), rest=np.zeros((5, 3))),
    "a face without vertices": face(displacement=np.zeros((52, 0, 3)), rest=np.zeros((0, 3))),
    "a face that is not finite": face(displacement=np.full((52, 4, 3), np.nan), rest=np.zeros((4, 3))),
    "a face of words": face(displacement=np.full((52, 4, 3), "x"), rest=np.zeros((4, 3))),
    "a face of one number": face(displacement=np.float64(1), rest=np.float64(1)),
}


@pytest.mark.parametrize("damage", ARRAYS)
def test_damaged_arrays_are_refused_in_one_sentence(arrays_folder: Path, tmp_path: Path, damage: str):
    folder = Path(shutil.copytree(arrays_folder, tmp_path / "copy"))
    ARRAYS[damage](folder)
    with pytest.raises(InputError, match="copy") as caught:
        read_arrays(folder)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 800


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_labels_with_changed_bytes_are_refused_or_read(
    arrays_folder: Path, tmp_path: Path, data: st.DataObject
):
    folder = tmp_path / "copy"
    if not folder.exists():
        shutil.copytree(arrays_folder, folder)
    content = bytearray((arrays_folder / "labels.parquet").read_bytes())
    end = data.draw(st.booleans())  # the footer has the claims
    for _ in range(data.draw(st.integers(1, 4))):
        place = data.draw(st.integers(max(0, len(content) - 6000) if end else 0, len(content) - 1))
        content[place] = data.draw(st.integers(0, 255))
    (folder / "labels.parquet").write_bytes(content)
    try:
        arrays = read_arrays(folder)
    except InputError as error:
        said = str(error)
    else:
        said = ""
        assert len(arrays.weights) == len(arrays.split) == len(arrays.person)
    assert "\n" not in said
