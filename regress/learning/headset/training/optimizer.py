"""Makes optimizers: orthogonalised steps for convolutions and codes, AdamW for all else."""

from collections.abc import Callable, Iterable

import torch
from torch import nn

from regress.learning.headset.recipe import HeadsetRecipe

_MOMENTUM = 0.95
_COEFFICIENTS = (3.4445, -4.7750, 2.0315)
"""Of the quintic iteration that brings all singular values between 0.7 and 1.2 (Jordan 2024), and its steps."""
_STEPS = 5


class Muon(torch.optim.Optimizer):
    """Momentum whose every step is the nearest orthogonal matrix: all directions of a layer learn alike.

    K. Jordan et al., "Muon: an optimizer for hidden layers in neural networks", 2024,
    https://kellerjordan.github.io/posts/muon/. PyTorch's own takes matrices only and iterates in bfloat16, which
    takes 15 times as long on a CPU without instructions for it.

    Parameters
    ----------
    parameters
        Weights (outputs, ...) of hidden layers; a convolution's count as a matrix with a row for each output.
    lr, weight_decay
        Step, and share of it that draws weights to zero.
    """

    def __init__(self, parameters: Iterable[nn.Parameter], *, lr: float, weight_decay: float) -> None:
        super().__init__(parameters, {"lr": lr, "weight_decay": weight_decay})

    @torch.no_grad()
    def step(self, closure: Callable[[], float] | None = None) -> float | None:
        """Make one step; parameters without a gradient stay."""
        loss = None if closure is None else torch.enable_grad()(closure)()
        for group in self.param_groups:
            for parameter in group["params"]:
                if parameter.grad is None:
                    continue
                state = self.state[parameter]
                if not state:
                    state["momentum"] = torch.zeros_like(parameter)
                momentum = state["momentum"].lerp_(parameter.grad, 1 - _MOMENTUM)
                matrix = parameter.grad.lerp(momentum, _MOMENTUM).flatten(1)
                # as large for tall layers as their outputs' spread asks
                size = max(1.0, matrix.shape[0] / matrix.shape[1]) ** 0.5
                parameter.mul_(1 - group["lr"] * group["weight_decay"])
                parameter.add_(orthogonalised(matrix).view_as(parameter), alpha=-group["lr"] * size)
        return loss


def orthogonalised(matrix: torch.Tensor) -> torch.Tensor:
    """``U @ V.T`` of a matrix (m, n) = ``U @ S @ V.T``, with singular values of 0.7 to 1.2 for those not near 0."""
    tall = matrix.shape[0] > matrix.shape[1]
    wide = matrix.T if tall else matrix
    wide = wide / (wide.norm() + 1e-7)
    a, b, c = _COEFFICIENTS
    for _ in range(_STEPS):
        gram = wide @ wide.T
        wide = a * wide + (b * gram + c * gram @ gram) @ wide
    return wide.T if tall else wide


def optimizers_of(network: nn.Module, recipe: HeadsetRecipe) -> tuple[torch.optim.Optimizer, ...]:
    """Optimizers that share a network's parameters; each group's ``peak`` is what its ``lr`` is scheduled from."""
    hidden = [
        layer.weight
        for name, layer in network.named_modules()
        if isinstance(layer, nn.Conv2d | nn.Linear) and not name.startswith("head")
    ]
    hidden = hidden if recipe.matrix_learning_rate else []
    taken = {id(parameter) for parameter in hidden}
    others = [parameter for parameter in network.parameters() if id(parameter) not in taken]
    decay = recipe.weight_decay
    optimizers: list[torch.optim.Optimizer] = [
        torch.optim.AdamW(others, lr=recipe.learning_rate, weight_decay=decay)
    ]
    if hidden:
        optimizers.append(Muon(hidden, lr=recipe.matrix_learning_rate, weight_decay=decay))
    for optimizer in optimizers:
        for group in optimizer.param_groups:
            group["peak"] = group["lr"]
    return tuple(optimizers)
