"""Model folders from strangers: whatever their hash says, they are refused in one sentence, or they work throughout."""

import hashlib
import io
import json
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from regress.errors import InputError, ModelError
from regress.exporters import export_model
from regress.report import write_report
from regress.runtime.model import FastPredictor, load_model
from tests.regress.drawn import drawn_faces

pytestmark = pytest.mark.slow

Arrays = dict[str, np.ndarray]


def resealed(
    source: Path, folder: Path, *, arrays: Callable[[Arrays], Any] = len, edit: Callable[[dict], Any] = len
) -> Path:
    """A copy of a model whose arrays and description were changed, and whose hash fits again."""
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copytree(source, folder)
    with np.load(folder / "weights.npz") as archive:
        content = dict(archive)
    arrays(content)
    buffer = io.BytesIO()
    np.savez(buffer, **content)
    (folder / "weights.npz").write_bytes(buffer.getvalue())
    document = json.loads((folder / "model.json").read_text())
    document["weights_sha256"] = hashlib.sha256(buffer.getvalue()).hexdigest()
    edit(document)
    (folder / "model.json").write_text(json.dumps(document))
    return folder


def put(name: str, value: Any) -> Callable[[Arrays], None]:
    return lambda arrays: arrays.update({name: np.asarray(value(arrays[name]) if callable(value) else value)})


def one(number: float) -> Callable[[np.ndarray], np.ndarray]:
    def change(array: np.ndarray) -> np.ndarray:
        changed = array.copy()
        changed.flat[-1] = number
        return changed

    return change


ARRAYS = {
    "an array is missing": lambda arrays: arrays.pop("b1"),
    "another array beside them": put("extra", 1.0),
    "half of the calibrated arrays": lambda arrays: arrays.pop("calibrated_w2"),
    "half of the filter": lambda arrays: arrays.pop("denoising_axes"),
    "a row less": put("w1", lambda array: array[:-1]),
    "a column less": put("w1", lambda array: array[:, :-1]),
    "an axis less": put("w2", np.ravel),
    "an axis more": put("b2", lambda array: array[None]),
    "nothing at all": put("w2", np.zeros((0, 0))),
    "no unit": put("w2", lambda array: array[:, :0]),
    "one number": put("w1", 1.0),
    "no axes": put("denoising_axes", lambda array: array[:0]),
    "no axes of noise": put("denoising_noise_axes", lambda array: array[:0]),
    "a list for a number": put("denoising_usual", [1.0]),
    "NaN in the weights": put("w1", one(np.nan)),
    "infinity in the biases": put("b1", one(np.inf)),
    "beyond float32": put("w2", one(1e300)),
    "a spread of nothing": put("feature_std", one(0.0)),
    "NaN in the normalisation": put("feature_mean", one(np.nan)),
    "a signal of nothing": put("denoising_signal", one(0.0)),
    "noise below nothing": put("denoising_least", -1.0),
    "a mean shape of 67 points": put("mean_shape", lambda array: array[:-1]),
    "a mean shape that is not finite": put("mean_shape", one(np.inf)),
    "depths of 67 points": put("depth", lambda array: array[:-1]),
    "networks that there are not": put("network_of_output", one(10**9)),
    "networks before the first": put("network_of_output", one(-1)),
    "networks in disorder": put("network_of_output", lambda array: array[::-1]),
    "networks as fractions": put("network_of_output", lambda array: array.astype(float)),
    "words": put("b2", lambda array: array.astype(str)),
    "complex numbers": put("b2", lambda array: array.astype(complex)),
    "truths": put("b2", lambda array: array > 0),
}


@pytest.fixture(scope="session")
def denoising_folder(pytestconfig: pytest.Config) -> Path:
    """The ready-made model: it has every array that a model may have."""
    return Path(pytestconfig.rootpath) / "regress" / "models" / "landmarks-default"


@pytest.mark.parametrize("damage", ARRAYS)
def test_resealed_arrays_are_refused_in_one_sentence(denoising_folder: Path, tmp_path: Path, damage: str):
    folder = resealed(denoising_folder, tmp_path / "model", arrays=ARRAYS[damage])
    with pytest.raises(ModelError, match=r"weights\.npz") as refused:
        load_model(folder)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 500


def set_at(*path: str | int, to: Any) -> Callable[[dict], None]:
    def change(document: dict) -> None:
        place: Any = document
        for key in path[:-1]:
            place = place[key]
        place[path[-1]] = to(place[path[-1]]) if callable(to) else to

    return change


DESCRIPTIONS = {
    "a landmark of 99": set_at("features", "edges", 0, to=[0, 99]),
    "a landmark of -1": set_at("features", "edges", 0, to=[-1, 3]),
    "an edge of one landmark": set_at("features", "edges", 0, to=[3, 3]),
    "an edge twice": set_at("features", "edges", to=lambda edges: [edges[1], *edges[1:]]),
    "an edge turned": set_at("features", "edges", 0, to=lambda edge: edge[::-1]),
    "an edge less": set_at("features", "edges", to=lambda edges: edges[:-1]),
    "no edges": set_at("features", "edges", to=[]),
    "a million edges": set_at("features", "edges", to=[[0, 1]] * 1_000_000),
    "edges of fractions": set_at("features", "edges", 0, to=[0.5, 1]),
    "no networks": set_at("networks", to=[]),
    "a network less": set_at("networks", to=lambda networks: networks[:-1]),
    "a network twice": set_at("networks", 1, to=lambda network: {**network, "name": "blink"}),
    "a shape twice": set_at("networks", 0, "outputs", to=["jawOpen", "jawOpen"]),
    "a shape of another network": set_at("networks", 0, "outputs", to=["jawOpen", "eyeBlinkRight"]),
    "a shape that nobody knows": set_at("networks", 0, "outputs", to=["eyeBlinkLeft", 'x"; system("']),
    "a network without shapes": set_at("networks", 0, "outputs", to=[]),
    "a name that ends a string": set_at("networks", 0, "name", to='blink"'),
    "a name of two lines": set_at("networks", 0, "name", to="blink\nint main"),
    "a region that ends a comment": set_at("networks", 0, "region", to="eyes*/"),
    "a name of a megabyte": set_at("networks", 0, "name", to="b" * 1_000_000),
    "an alignment that there is not": set_at("features", "alignment", to="perspective"),
    "half of a character": set_at("record", "dataset", "licence", to="\ud800"),
    "half of a character as a key": set_at("record", "recipe", "\udc00", to=1),
    "a number that is none": set_at("record", "scores", "jawOpen", "network", "r2", to=float("nan")),
    "an infinite number": set_at("record", "networks", "eyes.blink", "alpha", to=float("inf")),
    "a number of 400 digits": set_at("record", "seed", to=10**400),
    "fewer samples than none": set_at("record", "dataset", "samples", "test", to=-1),
    "counts of another shape": set_at("record", "regression", "test", "counts", 0, to=[1, 2]),
    "no counts": set_at("record", "regression", "test", "counts", to=[]),
    "an error below nothing": set_at("record", "networks", "eyes.blink", "curves", "train", 0, to=-1.0),
    "a schema of a list": set_at("schema", to=[4]),
    "a hash of a number": set_at("weights_sha256", to=5),
}


@pytest.mark.parametrize("damage", DESCRIPTIONS)
def test_edited_descriptions_are_refused_in_one_sentence(denoising_folder: Path, tmp_path: Path, damage: str):
    folder = resealed(denoising_folder, tmp_path / "model", edit=DESCRIPTIONS[damage])
    with pytest.raises(ModelError) as refused:
        load_model(folder)
    assert "\n" not in str(refused.value)
    assert len(str(refused.value)) < 700


@pytest.mark.parametrize("text", ["[]", "null", "5", '"model"', "{}", "[" * 100_000, "1" * 5000, "\xff"])
def test_what_is_no_description_is_refused(denoising_folder: Path, tmp_path: Path, text: str):
    folder = resealed(denoising_folder, tmp_path / "model")
    (folder / "model.json").write_bytes(text.encode("latin-1"))
    with pytest.raises(InputError):
        load_model(folder)


def test_an_archive_that_unpacks_to_gigabytes_is_refused_unread(denoising_folder: Path, tmp_path: Path):
    folder = resealed(denoising_folder, tmp_path / "model")
    np.savez_compressed(folder / "weights.npz", w1=np.zeros((40_000_000,)))
    content = (folder / "weights.npz").read_bytes()
    assert len(content) < 1_000_000 < 256 * 1024**2 < 40_000_000 * 8
    document = json.loads((folder / "model.json").read_text())
    document["weights_sha256"] = hashlib.sha256(content).hexdigest()
    (folder / "model.json").write_text(json.dumps(document))
    with pytest.raises(InputError, match=r"weights\.npz: unpacks to 320,000,128 bytes"):
        load_model(folder)


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_a_changed_number_is_refused_or_does_no_harm(
    denoising_folder: Path, quick_model_folder: Path, tmp_path: Path, data: st.DataObject
):
    source = data.draw(st.sampled_from([denoising_folder, quick_model_folder]))
    with np.load(source / "weights.npz") as archive:
        names = archive.files
    name = data.draw(st.sampled_from(names))
    number = data.draw(
        st.sampled_from([0.0, -1.0, 1e9, -1e9, 1e10, 1e30, 1e-300, np.nan, -np.inf, 2**31, -(2**62)])
        | st.floats(-1e6, 1e6)
    )
    everywhere = data.draw(st.booleans())

    def change(arrays: Arrays) -> None:
        array = arrays[name].copy()
        number_there = (
            number if array.dtype.kind == "f" else int(np.clip(np.nan_to_num(number), -(2**62), 2**62))
        )
        if everywhere:
            array[...] = number_there
        else:
            array.flat[data.draw(st.integers(0, array.size - 1))] = number_there
        arrays[name] = array

    folder = resealed(source, tmp_path / "model", arrays=change)
    try:
        model = load_model(folder)
    except ModelError:
        return
    faces = drawn_faces(np.random.default_rng(1), 3)
    for predicted in (model.predict(faces), FastPredictor(model).predict(faces)):
        assert ((predicted >= 0) & (predicted <= 1) | np.isnan(predicted)).all()
    export_model(model, tmp_path / "out", name="face")


def paths_of(value: Any, path: tuple = ()) -> list[tuple]:
    """Places of a document's values, of long lists only the first and last."""
    if isinstance(value, dict):
        return [path, *(place for key in list(value)[:6] for place in paths_of(value[key], (*path, key)))]
    if isinstance(value, list) and value:
        return [path, *(place for row in {0, len(value) - 1} for place in paths_of(value[row], (*path, row)))]
    return [path]


OTHER = [
    None,
    True,
    0,
    -1,
    5,
    1e90,
    "x",
    "",
    [],
    {},
    [[]],
    [1, 2],
    {"a": 1},
    10**18,
    "9" * 3000,
    "*/ \n</script>",
]


@settings(max_examples=20, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_an_edited_record_is_refused_or_reported(
    denoising_folder: Path, quick_model_folder: Path, tmp_path: Path, data: st.DataObject
):
    source = data.draw(st.sampled_from([denoising_folder, quick_model_folder]))
    document = json.loads((source / "model.json").read_text())
    places = [path for path in paths_of({"record": document["record"], "recipe": document["recipe"]}) if path]
    path = data.draw(st.sampled_from(places))
    drop = data.draw(st.booleans())
    other = data.draw(st.sampled_from(OTHER))

    def edit(changed: dict) -> None:
        place: Any = changed
        for key in path[:-1]:
            place = place[key]
        if drop:
            del place[path[-1]]
        else:
            place[path[-1]] = other

    folder = resealed(source, tmp_path / "model", edit=edit)
    try:
        model = load_model(folder)
        page = write_report(model, tmp_path / "report.html").read_text(encoding="utf-8")
        export_model(model, tmp_path / "out", name="face", formats=("c", "javascript", "json"))
    except InputError:
        return
    assert "<script>" not in page.replace("</script>", "")
