"""Orthogonalised steps: their directions, and which optimizer moves what."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

torch = pytest.importorskip("torch")

from facegen.conventions import VIEW_POINTS  # noqa: E402
from regress.learning.headset.architectures import ARCHITECTURES  # noqa: E402
from regress.learning.headset.recipe import HeadsetRecipe  # noqa: E402
from regress.learning.headset.training.networks import network_of  # noqa: E402
from regress.learning.headset.training.optimizer import Muon, optimizers_of, orthogonalised  # noqa: E402

EYE = tuple(range(VIEW_POINTS.index("left_pupil"), VIEW_POINTS.index("right_upper_lid_0")))
CAMERAS = ("left_eye", "right_eye", "mouth")
BEYOND_ENCODERS = {
    "modular": {"tells.left_eye.weight", "tells.mouth.weight", "tells.mouth mirrored.weight"},
    "holistic": {"hidden.0.weight"},
}
"""Layers behind the encoders that take orthogonalised steps."""


@given(
    rows=st.integers(1, 40),
    columns=st.integers(1, 40),
    scale=st.floats(1e-3, 1e3),
    seed=st.integers(0, 2**32 - 1),
)
def test_orthogonalised_keeps_directions_and_levels_their_sizes(rows, columns, scale, seed):
    random, least = np.random.default_rng(seed), min(rows, columns)
    left = np.linalg.qr(random.standard_normal((rows, least)))[0]
    right = np.linalg.qr(random.standard_normal((columns, least)))[0]
    sizes = scale * random.uniform(0.05, 1, least)
    matrix = torch.from_numpy((left * sizes) @ right.T).float()
    found = orthogonalised(matrix).numpy()
    along = left.T @ found @ right
    np.testing.assert_allclose(found, left @ np.diag(np.diag(along)) @ right.T, atol=1e-3)
    assert (np.diag(along) > 0.65).all()
    assert (np.diag(along) < 1.25).all()


def test_a_step_of_a_convolution_is_that_of_its_matrix():
    torch.manual_seed(0)
    weight, gradient = torch.randn(8, 3, 5, 5), torch.randn(8, 3, 5, 5)
    found = []
    for shape in ((8, 3, 5, 5), (8, 75)):
        parameter = torch.nn.Parameter(weight.reshape(shape).clone())
        optimizer = Muon([parameter], lr=0.1, weight_decay=0.5)
        parameter.grad = gradient.reshape(shape).clone()
        optimizer.step()
        found.append(parameter.detach().reshape(8, 75))
    assert torch.equal(*found)
    step = (0.95 * weight.reshape(8, 75) - found[0]) / 0.1
    torch.testing.assert_close(step, orthogonalised(gradient.reshape(8, 75)), atol=1e-4, rtol=0)


@pytest.mark.parametrize("architecture", ARCHITECTURES)
def test_every_parameter_has_one_optimizer(architecture: str):
    recipe = HeadsetRecipe(architecture=architecture, input_size=16, skip=4)
    network = network_of(architecture)(CAMERAS, recipe, {"left_eye": EYE, "mouth": (48, 54)})
    moved = [
        [id(parameter) for group in optimizer.param_groups for parameter in group["params"]]
        for optimizer in optimizers_of(network, recipe)
    ]
    assert sorted([*moved[0], *moved[1]]) == sorted(id(parameter) for parameter in network.parameters())
    names = {id(parameter): name for name, parameter in network.named_parameters()}
    adam, muon = ({names[key] for key in keys} for keys in moved)
    beyond = {name for name in muon if not name.startswith("encoders")}
    assert beyond == BEYOND_ENCODERS.get(architecture, beyond)
    assert all(name.endswith("weight") for name in muon)
    assert not any("convolutions" in name and ".0.weight" in name for name in adam)
    (only,) = optimizers_of(network, HeadsetRecipe(architecture=architecture, matrix_learning_rate=0))
    assert isinstance(only, torch.optim.AdamW)
