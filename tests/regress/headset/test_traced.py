"""Traced points: which, where they lie in what encoders see, and that networks learn to find them."""

from dataclasses import replace

import numpy as np
import pytest

torch = pytest.importorskip("torch")

from facegen.conventions import BLENDSHAPES, IRIS_POINTS, VIEW_POINTS  # noqa: E402
from regress.learning.headset.arrays import HeadsetArrays  # noqa: E402
from regress.learning.headset.recipe import HeadsetRecipe  # noqa: E402
from regress.learning.headset.training.batches import TrainingFrames  # noqa: E402
from regress.learning.headset.training.blend import Blended  # noqa: E402
from regress.learning.headset.training.encoders import Encoder  # noqa: E402
from regress.learning.headset.training.loop import start_training  # noqa: E402
from regress.learning.headset.training.losses import positions_loss, total_loss  # noqa: E402
from regress.learning.headset.training.modular import ModularNetwork  # noqa: E402
from regress.learning.headset.training.networks import Answer  # noqa: E402
from regress.learning.headset.training.traced import traced_points  # noqa: E402
from regress.learning.headset.training.tracers import Tracer  # noqa: E402
from regress.runtime.headset.network.outputs import OUTPUTS  # noqa: E402
from tests.regress.headset.drawn import DOTS, dot_of  # noqa: E402

IRIS = [f"left_iris_{place}" for place in range(IRIS_POINTS)]


def test_a_camera_traces_what_its_pictures_show(arrays: HeadsetArrays):
    rows = arrays.rows("train")
    found = traced_points(arrays, rows)
    assert {name: [VIEW_POINTS[index] for index in indices] for name, indices in found.items()} == {
        "left_eye": ["left_pupil", *IRIS],
        "mouth": ["landmark_8"],
    }
    points = {name: seen.copy() for name, seen in arrays.points.items()}
    points["mouth"][rows[: len(rows) * 3 // 4]] = np.nan  # shown in a quarter of the frames
    points["left_eye"] += 100  # beyond the picture, but the right eye's are not: together they are half
    found = traced_points(replace(arrays, points=points), rows)
    assert [len(indices) for indices in found.values()] == [1 + IRIS_POINTS, 0]


@pytest.mark.parametrize("input_size", [24, 12])
def test_places_are_where_the_dots_are_however_frames_are_displaced(arrays: HeadsetArrays, input_size: int):
    """A dot that is all there is in a picture has its middle where the label says."""
    rows = arrays.rows("train")
    down, across = np.indices((24, 24))
    pictures = {}
    for name in DOTS:
        spots = [dot_of(name, *labels) for labels in zip(arrays.weights, arrays.gaze, strict=True)]
        pictures[name] = np.stack(
            [255 * np.exp(-((across - x) ** 2 + (down - y) ** 2) / 8) for x, y in spots]
        ).astype(np.uint8)
    moved = HeadsetRecipe(
        input_size=input_size, batch=len(rows), plain=0.0, shift=0.05, scale=0.1, rotation_deg=10.0
    )
    (batch,) = TrainingFrames(replace(arrays, pictures=pictures), moved, rows).draw_epoch(
        np.random.default_rng(3)
    )
    size = moved.square_size
    middle = (np.arange(size) + 0.5) / size
    for camera, places in enumerate(batch.positions):
        seen = batch.pictures[:, camera].astype(float) ** 2
        mass = seen.sum(axis=(1, 2))
        found = np.stack([(seen.sum(axis=1) @ middle) / mass, (seen.sum(axis=2) @ middle) / mass], axis=1)
        inner = ((places[:, 0] > 0.25) & (places[:, 0] < 0.75)).all(axis=1)  # none of the dot is cut off
        assert inner.sum() > 30
        off = (found - places[:, 0])[inner]
        assert np.abs(off).max() < 0.3 / size
        assert (
            np.abs(off.mean(axis=0)).max() < 0.04 / size
        )  # half a pixel of the whole picture is four times this


def test_a_heat_maps_peak_is_the_place():
    tracer = Tracer((1, 1), (8, 4), 1).eval()
    for layer in (tracer.lifts[0], tracer.head):
        torch.nn.init.zeros_(layer.weight)
        torch.nn.init.zeros_(layer.bias)
    finest = torch.zeros(2, 1, 8, 8)
    finest[:, 0, 2, 5] = 1.0  # down, across
    even = tracer([finest, torch.zeros(2, 1, 4, 4)])
    torch.testing.assert_close(even, torch.zeros(2, 1, 2))  # an even map's mean is the middle
    torch.nn.init.dirac_(tracer.mixes[0][0].weight)
    torch.nn.init.constant_(tracer.head.weight, 50.0)
    peak = tracer([finest, torch.zeros(2, 1, 4, 4)])
    wanted = tracer.standardised(torch.tensor([[[5.5 / 8, 2.5 / 8]]]).expand(2, -1, -1))
    torch.testing.assert_close(peak, wanted, atol=1e-3, rtol=0)


def test_places_are_standardised_by_what_training_saw():
    tracer = Tracer((4, 6), (8, 4), 3)
    tracer.set_usual(torch.full((5, 3, 2), float("nan")))
    torch.testing.assert_close(tracer.standardised(torch.full((1, 3, 2), 0.5)), torch.zeros(1, 3, 2))
    known = torch.rand(50, 3, 2)
    tracer.set_usual(known)
    torch.testing.assert_close(tracer.standardised(known).mean(dim=0), torch.zeros(3, 2), atol=1e-5, rtol=0)
    assert tracer.standardised(known).square().mean() == pytest.approx(1, abs=0.05)


UNTOLD = torch.zeros(5, 0)
"""Terms of the camera, for encoders that are told none."""


def test_what_moved_since_the_neutral_picture_counts():
    torch.manual_seed(0)
    encoder = Encoder(HeadsetRecipe(input_size=16, code=12), range(4)).eval()
    encoder.set_scale(100.0, 60.0)
    seen, *neutral = torch.rand(3, 5, 24, 24) * 255
    (one, places), (other, same) = (encoder(seen, rest, torch.ones(5), UNTOLD) for rest in neutral)
    torch.testing.assert_close(places, same, atol=1e-5, rtol=0)
    assert (one - other).abs().max() > 1e-3
    (one, _), (other, _) = (encoder(seen, rest, torch.zeros(5), UNTOLD) for rest in neutral)
    assert torch.equal(one, other)


def test_what_looks_otherwise_than_in_the_neutral_picture_counts_without_points_too():
    torch.manual_seed(0)
    encoder = Encoder(HeadsetRecipe(input_size=16, code=12), ()).eval()
    encoder.set_scale(100.0, 60.0)
    seen, *neutral = torch.rand(3, 5, 24, 24) * 255
    (one, _), (other, _) = (encoder(seen, rest, torch.ones(5), UNTOLD) for rest in neutral)
    assert (one - other).abs().max() > 1e-3
    # a frame that is its own neutral picture differs from one without by the switch alone
    layer = encoder.looks[0]
    layer.weight.data[:, -1] = 0
    torch.testing.assert_close(
        encoder(seen, seen, torch.ones(5), UNTOLD)[0], encoder(seen, seen, torch.zeros(5), UNTOLD)[0]
    )


def test_a_cameras_own_part_counts_in_millimetres_too():
    recipe = HeadsetRecipe(input_size=16, calibration=False, points_loss=0.0)
    network = ModularNetwork(("left_eye", "mouth"), recipe, {"left_eye": (), "mouth": ()})
    jaw, outputs = BLENDSHAPES.index("jawOpen"), len(OUTPUTS)
    gram = torch.zeros(52, 52)
    gram[jaw, jaw] = 3.0

    def loss(camera: int, geometry_loss: float) -> float:
        means = torch.zeros(1, 2, outputs)
        means[0, camera, jaw] = 2.0
        blended = Blended(torch.zeros(1, outputs), torch.ones(1, outputs), torch.zeros(1, 2, outputs))
        answer = Answer(blended, means, torch.zeros_like(means), torch.zeros(1), ())
        return float(
            total_loss(
                network,
                answer,
                torch.zeros(1, outputs),
                calibrated=torch.zeros(1),
                same_seat=torch.zeros(1),
                positions=(),
                gram=gram,
                recipe=replace(recipe, geometry_loss=geometry_loss),
            )
        )

    eye, mouth = (loss(camera, 0.5) - loss(camera, 0.0) for camera in (0, 1))
    assert eye == pytest.approx(0, abs=1e-6)  # the jaw is no part of the eye's camera
    assert mouth == pytest.approx(0.5 * 3 * 2**2, rel=1e-5)


def test_points_that_are_not_shown_cost_nothing():
    found = torch.randn(4, 3, 2, requires_grad=True)
    wanted = torch.randn(4, 3, 2)
    wanted[:, 1] = float("nan")
    loss = positions_loss([found, found[:, :0]], [wanted, wanted[:, :0]])
    loss.backward()
    assert torch.isfinite(loss)
    assert not found.grad[:, 1].any()
    assert found.grad[:, [0, 2]].all()
    assert positions_loss([wanted[:, ::2]], [wanted[:, ::2]]) == 0


@pytest.mark.slow
def test_networks_learn_where_things_are(arrays: HeadsetArrays):
    little = {"randomise": 0.0, "shift": 0.03, "scale": 0.04, "rotation_deg": 3.0, "plain": 0.0}
    recipe = HeadsetRecipe(input_size=24, code=24, epochs=12, batch=16, **little)
    training = start_training(arrays, recipe)
    network = training.run()
    frames = TrainingFrames(arrays, recipe, training.rows)
    batch = frames.plain_batch(arrays.rows("test"))
    pictures, neutral = (torch.from_numpy(seen).float() for seen in (batch.pictures, batch.neutral))
    with torch.no_grad():
        answer = network(
            pictures.unbind(1), neutral.unbind(1), torch.from_numpy(batch.present), torch.zeros(len(pictures))
        )
    for camera, found, places in zip(network.cameras, answer.positions, batch.positions, strict=True):
        wanted = network.encoder(camera).standardised(torch.from_numpy(places))
        assert found.shape == wanted.shape
        traced = places.shape[1]
        off = [(found - wanted)[:, part].square().mean() for part in (slice(traced), slice(traced, None))]
        assert off[0] < 0.3 * wanted.square().mean()
        assert camera == "mouth" or off[1] < 0.75 * off[0]  # the second look sees better
    untraced = start_training(arrays, replace(recipe, points_loss=0.0, epochs=1)).run()
    assert untraced.encoder("mouth").tracer is None
