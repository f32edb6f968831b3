"""Graphs in two parts: what neutral pictures alone decide is computed once, and the answers stay the same."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from regress.runtime.headset.network.model import CameraInput
from regress.runtime.headset.network.neutral_codes import cut_network
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.onnx_cut import cut
from regress.runtime.onnx_session import open_session
from regress.runtime.protobuf import bytes_field, fields, number_field
from regress.runtime.ready_made import model_folder

READY = ("headset-tracking3", "headset-any")
SIDE = 4
EYE = CameraInput(name="eye", width=SIDE, height=SIDE)


@pytest.fixture(scope="module", params=READY)
def both(request: pytest.FixtureRequest) -> tuple[HeadsetPredictor, object]:
    """A ready-made model, and onnxruntime on the whole of its graph."""
    return load_headset_predictor(request.param), open_session(
        (model_folder(request.param) / "network.onnx").read_bytes()
    )


def drawn(predictor: HeadsetPredictor, rows: int, seed: int) -> dict[str, np.ndarray]:
    random = np.random.default_rng(seed)
    return {
        name: random.integers(0, 256, (rows, high, wide), np.uint8)
        for name, (wide, high) in predictor.sizes.items()
    }


def whole_answers(
    session, pictures: dict, neutral: dict | None, present: np.ndarray, calibrated: np.ndarray
) -> dict[str, np.ndarray]:
    feed = {"present": present.astype(np.float32), "calibrated": calibrated.astype(np.float32)}
    for name, seen in pictures.items():
        feed[f"pictures_{name}"] = seen
        feed[f"neutral_{name}"] = np.zeros_like(seen) if neutral is None else np.array(neutral[name])
    names = [value.name for value in session.get_outputs()]
    return dict(zip(names, session.run(names, feed), strict=True))


@pytest.mark.parametrize("rows", [1, 3, 70])
@pytest.mark.parametrize("how", ["none", "one for all", "one each"])
def test_a_cut_network_says_what_the_whole_says(both, rows: int, how: str):
    predictor, session = both
    pictures = drawn(predictor, rows, 1)
    neutral = {
        "none": None,
        "one for all": {
            name: np.broadcast_to(one, pictures[name].shape) for name, one in drawn(predictor, 1, 2).items()
        },
        "one each": drawn(predictor, rows, 3),
    }[how]
    random = np.random.default_rng(4)
    present = random.random((rows, len(pictures))) < 0.8
    calibrated = (random.random(rows) < 0.7) & (neutral is not None)
    said, points = predictor.graph.see(pictures, neutral=neutral, present=present, calibrated=calibrated)
    expected = whole_answers(session, pictures, neutral, present, calibrated)
    for name in ("weights", "deviation", "gaze", "shares", "same_seat"):
        np.testing.assert_allclose(getattr(said, name), expected[name], atol=1e-6, err_msg=name)
    for name, traced in points.items():
        np.testing.assert_allclose(traced, expected[f"points_{name}"], atol=1e-3)


class Counted:
    """A session that counts how often it is run."""

    def __init__(self, session: object) -> None:
        self.session, self.runs = session, 0

    def run(self, *given: object) -> object:
        self.runs += 1
        return self.session.run(*given)


@pytest.mark.parametrize("name", READY)
def test_a_ready_made_network_encodes_a_neutral_face_once(name: str):
    predictor = load_headset_predictor(name)
    codes = predictor.graph._codes
    codes._half = Counted(codes._half)
    calm = {camera: one[0] for camera, one in drawn(predictor, 1, 5).items()}
    for seed in range(4):
        predictor.predict(drawn(predictor, 1, seed), neutral=calm)
    predictor.predict(drawn(predictor, 70, 9), neutral=calm)
    predictor.predict(drawn(predictor, 3, 10))
    assert codes._half.runs == 1


def test_another_neutral_face_counts_from_its_frame_on_also_in_the_same_memory(both):
    predictor, session = both
    seen, calm = drawn(predictor, 1, 1), drawn(predictor, 1, 2)
    first = predictor.graph.run(seen, neutral=calm).weights
    for one in calm.values():
        one[:] = 255 - one
    second = predictor.graph.run(seen, neutral=calm).weights
    everywhere, always = np.ones((1, len(seen))), np.ones(1)
    np.testing.assert_allclose(
        second, whole_answers(session, seen, calm, everywhere, always)["weights"], atol=1e-6
    )
    assert np.abs(first - second).max() > 0.01


def small_graph(*, turned: bool = False, told: bool = False) -> bytes:
    """The difference of a camera's pictures from the neutral ones.

    ``turned`` compares columns, so that frames are the last axis; ``told`` gives what neutral pictures decide as well.
    """
    onnx = pytest.importorskip("onnx")
    make, floats, grey = onnx.helper, onnx.TensorProto.FLOAT, onnx.TensorProto.UINT8
    axes = [2, 1, 0] if turned else [0, 1, 2]
    nodes = [
        make.make_node("Cast", ["pictures_eye"], ["seen"], to=floats),
        make.make_node("Transpose", ["seen"], ["seen_as"], perm=axes),
        make.make_node("Cast", ["neutral_eye"], ["rest"], to=floats),
        make.make_node("Transpose", ["rest"], ["rest_as"], perm=axes),
        make.make_node("Sub", ["seen_as", "rest_as"], ["moved_as"]),
        make.make_node("Transpose", ["moved_as"], ["moved"], perm=axes),
        make.make_node("Unsqueeze", ["calibrated", "axes"], ["counts"]),
        make.make_node("Mul", ["moved", "counts"], ["weights"]),
    ]
    outputs = [make.make_tensor_value_info("weights", floats, None)]
    if told:
        nodes.append(make.make_node("Identity", ["rest"], ["rest_told"]))
        outputs.append(make.make_tensor_value_info("rest_told", floats, None))
    inputs = [
        *(
            make.make_tensor_value_info(name, grey, ["n", SIDE, SIDE])
            for name in ("pictures_eye", "neutral_eye")
        ),
        make.make_tensor_value_info("present", floats, ["n", 1]),
        make.make_tensor_value_info("calibrated", floats, ["n"]),
    ]
    axes_of_counts = onnx.numpy_helper.from_array(np.array([1, 2]), "axes")
    graph = make.make_graph(nodes, "small", inputs, outputs, [axes_of_counts])
    return make.make_model(graph, opset_imports=[make.make_opsetid("", 13)], ir_version=8).SerializeToString()


def test_a_graph_whose_values_do_not_follow_frames_is_run_whole():
    """A code whose first axis is not that of frames cannot be repeated for each of them."""
    for turned in (False, True):
        content = small_graph(turned=turned)
        halves = cut_network(content, open_session(content), (EYE,))
        assert (halves is None) == turned


def test_a_graph_that_tells_what_neutral_pictures_decide_is_not_cut():
    parts = (lambda name: name.startswith("neutral_"), lambda name: name.startswith("pictures_"))
    assert cut(small_graph(), *parts).values == ("rest_as",)
    assert cut(small_graph(told=True), *parts) is None
    assert cut(small_graph(), lambda name: name == "nothing", parts[1]) is None


@given(
    st.lists(
        st.tuples(st.integers(1, 2**29 - 1), st.integers(0, 2**64 - 1) | st.binary(max_size=300)), max_size=6
    )
)
def test_fields_that_are_written_are_read_again(entries: list[tuple[int, int | bytes]]):
    message = b"".join(
        number_field(number, value) if isinstance(value, int) else bytes_field(number, value)
        for number, value in entries
    )
    read = list(fields(memoryview(message)))
    assert [
        (one.number, one.value if isinstance(one.value, int) else bytes(one.value)) for one in read
    ] == entries
    assert b"".join(one.raw for one in read) == message


def test_a_network_told_of_cameras_keeps_codes_of_its_own():
    predictor = load_headset_predictor("headset-any")
    told = predictor.told({})
    assert told.graph._codes is not None
    assert told.graph._codes is not predictor.graph._codes
