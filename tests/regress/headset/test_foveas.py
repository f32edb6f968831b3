"""The second look at an iris: which points it is of, and where it samples the picture."""

import cv2
import numpy as np
import pytest

torch = pytest.importorskip("torch")

from facegen.conventions import IRIS_POINTS, VIEW_POINTS  # noqa: E402
from regress.learning.headset.training.foveas import Fovea, center, iris_columns  # noqa: E402

EYES = {
    side: [
        VIEW_POINTS.index(f"{side}_{name}") for name in ("pupil", *(f"iris_{k}" for k in range(IRIS_POINTS)))
    ]
    for side in ("left", "right")
}


def an_iris(middle: tuple[float, float], radius: float = 0.15) -> torch.Tensor:
    angles = 2 * np.pi * np.arange(IRIS_POINTS) / IRIS_POINTS
    outline = radius * np.stack([np.cos(angles), np.sin(angles)], axis=-1)
    return torch.tensor(np.concatenate([[[0.02, 0.0]], outline]) + middle, dtype=torch.float32)


def test_only_whole_irises_are_looked_at_again():
    assert iris_columns(()) == ()
    assert iris_columns([3, *EYES["left"][:-1]]) == ()
    assert iris_columns([3, *EYES["left"]]) == (tuple(range(1, 10)),)
    assert iris_columns([*EYES["right"][::-1], *EYES["left"]]) == (
        tuple(range(9, 18)),
        tuple(range(8, -1, -1)),
    )


def test_it_knows_the_usual_iris_before_it_has_learned():
    fovea = Fovea().eval()
    for layer in (fovea.head.weight, fovea.head.bias):
        torch.nn.init.zeros_(layer)
    known = torch.stack([an_iris((0.4, 0.5)), an_iris((0.6, 0.3)), torch.full((9, 2), float("nan"))])
    fovea.set_usual(known)
    assert fovea.span == pytest.approx(1.5 * 0.3, rel=1e-5)
    rough = known[:2] + torch.tensor([0.01, -0.02])
    torch.testing.assert_close(fovea(torch.rand(2, 30, 30), rough), rough, atol=1e-5, rtol=0)
    unseen = Fovea()
    unseen.set_usual(known[2:])
    assert torch.isfinite(unseen.usual).all()


def test_it_sees_the_pictures_own_pixels_about_the_iris():
    fovea, picture = Fovea(), np.random.default_rng(0).random((60, 60)).astype(np.float32)
    fovea.set_usual(an_iris((0.5, 0.5))[None])
    seen = []
    fovea.convolutions.register_forward_pre_hook(lambda _, given: seen.append(given[0]))
    middle = np.array([0.42, 0.9], np.float32)  # so low that samples lie beyond the picture's edge
    fovea.eval()(torch.from_numpy(picture)[None], an_iris(tuple(middle))[None])
    side = seen[0].shape[-1]
    offsets = ((np.arange(side) + 0.5) / side - 0.5) * float(fovea.span)
    across, down = np.meshgrid((middle[0] + offsets) * 60 - 0.5, (middle[1] + offsets) * 60 - 0.5)
    wanted = cv2.remap(
        picture,
        across.astype(np.float32),
        down.astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    )
    assert np.abs(seen[0][0, 0].numpy() - wanted).max() < 0.05  # OpenCV samples at 32nds of a pixel


def test_what_it_finds_moves_with_the_picture():
    torch.manual_seed(0)
    fovea = Fovea().eval()
    fovea.set_usual(an_iris((0.5, 0.5))[None])
    picture = torch.rand(1, 80, 80) * 255
    moved = torch.roll(picture, (3, -5), dims=(1, 2))
    by = torch.tensor([-5.0, 3.0]) / 80
    found = fovea(picture, an_iris((0.5, 0.5))[None])
    torch.testing.assert_close(fovea(moved, an_iris((0.5, 0.5))[None] + by), found + by, atol=1e-4, rtol=0)
    assert (found - an_iris((0.5, 0.5))).abs().max() > 1e-3


def test_the_middle_is_the_outlines():
    torch.testing.assert_close(center(an_iris((0.3, 0.6))[None]), torch.tensor([[0.3, 0.6]]))
