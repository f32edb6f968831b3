"""Networks and their graph: mirrored faces, missing cameras, neutral pictures, resampling, equality with PyTorch."""

from copy import deepcopy
from dataclasses import replace

import cv2
import numpy as np
import pytest

torch = pytest.importorskip("torch")

from hypothesis import given  # noqa: E402
from hypothesis import strategies as st  # noqa: E402

from facegen.conventions import MIRRORED_BLENDSHAPES, VIEW_POINTS  # noqa: E402
from regress.errors import ModelError  # noqa: E402
from regress.learning.headset.architectures import ARCHITECTURES  # noqa: E402
from regress.learning.headset.recipe import HeadsetRecipe  # noqa: E402
from regress.learning.headset.training import export  # noqa: E402
from regress.learning.headset.training.export import export_graph  # noqa: E402
from regress.learning.headset.training.networks import network_of  # noqa: E402
from regress.learning.headset.training.resampling import reduced, resampling_matrix, warp_matrix  # noqa: E402
from regress.learning.headset.training.targets import target_scale  # noqa: E402
from regress.runtime.headset import CameraInput, HeadsetGraph  # noqa: E402
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN, OUTPUTS  # noqa: E402

CAMERAS = (
    CameraInput(name="left_eye", width=40, height=40),
    CameraInput(name="right_eye", width=40, height=40, mirrored_of="left_eye"),
    CameraInput(name="mouth", width=52, height=30),
)
SIZE, SQUARE = 16, 24
POINTS = {
    "left_eye": tuple(range(VIEW_POINTS.index("left_pupil") - 2, len(VIEW_POINTS))),
    "mouth": (48, 51, 54),
}


def network(architecture: str, seed: int = 0, **settings):
    """An untrained network whose normalisations have seen something."""
    recipe = HeadsetRecipe(architecture=architecture, input_size=SIZE, code=12, hidden=20, **settings)
    torch.manual_seed(seed)
    points = POINTS if recipe.points_loss else dict.fromkeys(POINTS, ())
    made = network_of(architecture)(tuple(camera.name for camera in CAMERAS), recipe, points)
    for encoder in made.encoders.values():
        encoder.set_scale(100.0, 60.0)
    seen = torch.rand(2, 3, 32, SQUARE, SQUARE) * 255
    made.train()(seen[0], seen[1], torch.ones(32, 3), torch.arange(32).float() % 2)
    return made.eval()


def targets():
    return target_scale(np.random.default_rng(0).random((30, len(OUTPUTS))).astype(np.float32))


@pytest.fixture(
    scope="module",
    params=[
        *ARCHITECTURES,
        "modular with skips",
        "modular without points",
        "modular without second look",
    ],
)
def graph(request: pytest.FixtureRequest) -> HeadsetGraph:
    architecture, _, how = request.param.partition(" ")
    settings = {
        "skip": 5 if how == "with skips" else 0,
        "points_loss": 0.0 if how == "without points" else 5.0,
        "second_look": how != "without second look",
    }
    graph, difference = exported(network(architecture, **settings))
    assert difference < 1e-4
    return HeadsetGraph(graph, CAMERAS)


def exported(made, **settings) -> tuple[bytes, float]:
    scale = np.ones(len(OUTPUTS), np.float32)
    return export_graph(made, CAMERAS, targets(), square_size=SQUARE, deviation_scale=scale, **settings)


def frames(count: int, seed: int = 1) -> dict[str, np.ndarray]:
    random = np.random.default_rng(seed)
    return {c.name: random.integers(0, 256, (count, c.height, c.width), dtype=np.uint8) for c in CAMERAS}


def test_outputs_have_the_shapes_and_ranges_of_the_contract(graph: HeadsetGraph):
    said = graph.run(frames(70), neutral=frames(70, seed=2))
    assert said.weights.shape == said.deviation.shape == (70, 52)
    assert (said.gaze.shape, said.shares.shape, said.same_seat.shape) == ((70, 2, 2), (70, 3, 52), (70,))
    assert said.weights.min() >= 0
    assert said.weights.max() <= 1
    assert (said.deviation > 0).all()
    np.testing.assert_allclose(said.shares.sum(axis=1), 1, atol=1e-4)
    assert ((said.same_seat >= 0) & (said.same_seat <= 1)).all()


def test_an_eyes_answer_depends_on_the_mouth_only_with_skips():
    for skip in (0, 5):
        made, seen = network("modular", skip=skip), torch.rand(3, 2, SQUARE, SQUARE) * 255
        other = seen.clone()
        other[2] = torch.rand(2, SQUARE, SQUARE) * 255
        eyes, same_eyes = (
            made(one, torch.zeros_like(one), torch.ones(2, 3), torch.zeros(2)).means[:, :2]
            for one in (seen, other)
        )
        assert torch.equal(eyes, same_eyes) is (skip == 0)


def test_a_mirrored_frame_gives_the_mirrored_answer_also_where_cameras_hear_each_other():
    cameras = ("left_brow", "left_eye", "mouth", "right_brow", "right_eye")
    recipe = HeadsetRecipe(input_size=SIZE, code=12, skip=5)
    torch.manual_seed(0)
    made = network_of("modular")(cameras, recipe, {"left_brow": (), **POINTS}).eval()
    seen, present = torch.rand(5, 2, SQUARE, SQUARE) * 255, torch.tensor([[1.0, 1, 0, 1, 1]]).expand(2, 5)
    # pictures of the right side are kept mirrored, so that sides change places
    said, mirrored = (
        made(one, torch.zeros_like(one), present, torch.zeros(2)).blended.mean
        for one in (seen, seen[[3, 4, 2, 0, 1]])
    )
    torch.testing.assert_close(mirrored, said[:, MIRROR.copy()] * torch.from_numpy(MIRROR_SIGN.copy()))


def test_the_mouth_tells_an_eye_that_is_seen_mirrored_of_a_mirrored_mouth():
    made, seen = network("modular", skip=5), torch.rand(3, 2, SQUARE, SQUARE) * 255
    other = seen.clone()
    other[2] = torch.rand(2, SQUARE, SQUARE) * 255
    for told, deaf in (("mouth", 0), ("mouth mirrored", 1)):
        quiet = deepcopy(made)
        for parameter in quiet.tells[told].parameters():
            parameter.data.zero_()
        means, others = (
            quiet(one, torch.zeros_like(one), torch.ones(2, 3), torch.zeros(2)).means for one in (seen, other)
        )
        assert [torch.equal(means[:, eye], others[:, eye]) for eye in (0, 1)] == [
            eye == deaf for eye in (0, 1)
        ]


def test_a_holistic_network_traces_what_an_absent_camera_would_see_and_has_a_code_for_its_absence():
    made, seen = network("holistic"), torch.rand(3, 2, SQUARE, SQUARE) * 255
    there = torch.ones(2, 3)
    absent = there * torch.tensor([1.0, 1, 0])
    whole, without = (made(seen, torch.zeros_like(seen), here, torch.zeros(2)) for here in (there, absent))
    for one, other in zip(whole.positions, without.positions, strict=True):
        assert torch.equal(one, other)
    made.absent[2].data += 1
    again = made(seen, torch.zeros_like(seen), absent, torch.zeros(2)).blended.mean
    assert (again - without.blended.mean).abs().max() > 1e-3


def test_a_missing_cameras_pictures_do_not_matter(graph: HeadsetGraph):
    pictures = frames(3)
    whole = graph.run(pictures)
    without = graph.run({name: seen for name, seen in pictures.items() if name != "mouth"})
    black = graph.run({**pictures, "mouth": 0 * pictures["mouth"]}, present=np.tile([1, 1, 0], (3, 1)))
    np.testing.assert_array_equal(without.weights, black.weights)
    assert np.abs(without.weights - whole.weights).max() > 1e-4


def test_neutral_pictures_matter_only_to_calibrated_frames(graph: HeadsetGraph):
    pictures, neutral = frames(4), frames(4, seed=3)
    alone, both = graph.run(pictures), graph.run(pictures, neutral=neutral, calibrated=np.array([0, 1, 0, 1]))
    np.testing.assert_allclose(both.weights[::2], alone.weights[::2], atol=1e-6)
    assert (np.abs(both.weights[1::2] - alone.weights[1::2]).max(axis=1) > 1e-3).all()


@pytest.mark.parametrize("architecture", ARCHITECTURES)
def test_a_network_trained_without_neutral_pictures_does_not_look_at_them(architecture: str):
    graph = HeadsetGraph(exported(network(architecture), calibration=False)[0], CAMERAS)
    alone, both = graph.run(frames(4)), graph.run(frames(4), neutral=frames(4, seed=3))
    for name, said in vars(alone).items():
        np.testing.assert_array_equal(getattr(both, name), said)


def test_frames_do_not_see_each_other(graph: HeadsetGraph):
    pictures = frames(5)
    one = graph.run({name: seen[3:4] for name, seen in pictures.items()})
    np.testing.assert_allclose(graph.run(pictures).weights[3], one.weights[0], atol=1e-5)


def test_the_eyes_of_a_mirrored_face_give_mirrored_answers():
    """Without the mouth, whose own picture is not built to be mirrored."""
    graph = HeadsetGraph(exported(network("modular"))[0], CAMERAS)
    pictures = {name: seen for name, seen in frames(6).items() if name != "mouth"}
    flipped = {"left_eye": pictures["right_eye"][..., ::-1], "right_eye": pictures["left_eye"][..., ::-1]}
    said, mirrored = graph.run(pictures), graph.run(flipped)
    np.testing.assert_allclose(mirrored.weights, said.weights[:, MIRRORED_BLENDSHAPES], atol=1e-5)
    np.testing.assert_allclose(mirrored.deviation, said.deviation[:, MIRRORED_BLENDSHAPES], atol=1e-5)
    np.testing.assert_allclose(mirrored.gaze, said.gaze[:, ::-1] * (-1, 1), atol=1e-5)


def test_modulation_keeps_a_camera_out_of_other_parts():
    shares = {}
    for modulation in (1.0, 0.0):
        made = HeadsetGraph(exported(network("modular", modulation=modulation))[0], CAMERAS)
        shares[modulation] = made.run(frames(4)).shares
    mouth_by_eye = shares[0.0][:, :2, 17]  # jawOpen
    assert mouth_by_eye.max() < 0.01 < shares[1.0][:, :2, 17].max()


def test_a_graph_that_differs_from_the_network_is_not_let_through(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(export, "TOLERANCE", -1.0)
    with pytest.raises(ModelError, match="differs from PyTorch"):
        exported(network("modular"))


@given(side=st.integers(8, 200), size=st.integers(4, 64))
def test_resampling_keeps_grey_and_order(side: int, size: int):
    matrix = resampling_matrix(side, size)
    np.testing.assert_allclose(matrix.sum(axis=1), 1, atol=1e-5)
    assert matrix.min() >= 0
    ramp = matrix @ np.arange(side)
    assert (np.diff(ramp) >= -1e-5).all()
    # the picture's middle stays in the middle
    assert ramp.mean() == pytest.approx((side - 1) / 2, abs=0.5)


@pytest.mark.parametrize("side", [40, 96, 250])
@pytest.mark.parametrize("flipped", [False, True])
def test_training_samples_pictures_where_the_graph_does(side: int, flipped: bool):
    random = np.random.default_rng(side)
    picture = cv2.GaussianBlur(random.integers(0, 256, (side, side), dtype=np.uint8), (0, 0), side / 30)
    small = reduced(picture[None], 64)[0]
    matrix = warp_matrix(
        small.shape[1], small.shape[0], 64, shift=np.zeros(2), scale=1.0, angle_rad=0.0, flipped=flipped
    )
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    warped = cv2.warpAffine(small, matrix, (64, 64), flags=flags, borderMode=cv2.BORDER_REPLICATE)
    sampling = resampling_matrix(side, 64)
    expected = sampling @ picture.astype(np.float32) @ sampling.T
    expected = expected[:, ::-1] if flipped else expected
    assert np.abs(warped - expected).max() <= 1.5  # two roundings to whole grey levels
    assert np.abs(warped - expected[:, ::-1]).max() > 5


def test_a_displacement_moves_the_picture_the_way_it_says():
    picture = np.zeros((60, 60), np.uint8)
    picture[28:32, 28:32] = 255
    moved = warp_matrix(60, 60, 60, shift=np.array([0.1, 0.0]), scale=1.0, angle_rad=0.0, flipped=False)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    found = cv2.warpAffine(picture, moved, (60, 60), flags=flags)
    assert np.argwhere(found > 128)[:, 1].mean() == pytest.approx(29.5 - 6)


def test_cameras_in_the_other_order_share_the_encoder_the_other_way_round():
    cameras = (
        replace(CAMERAS[1], mirrored_of=None),
        replace(CAMERAS[0], mirrored_of="right_eye"),
        CAMERAS[2],
    )
    points = {"right_eye": (5,), "mouth": (48,)}
    made = network_of("modular")(
        tuple(camera.name for camera in cameras), HeadsetRecipe(input_size=SIZE), points
    )
    assert list(made.encoders) == ["right_eye", "mouth"]
