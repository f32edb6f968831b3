"""A batch of networks as least-squares problems: residuals, Jacobian products and a Kronecker preconditioner.

A network is ``y = W2 [h, 1]``, ``h = s(W1 [x, 1])`` with the logistic function s. A row of its Jacobian, for
sample n and output o, is ``dW1[j] = W2[o, j] h'[n, j] [x_n, 1]``, ``dW2[o] = [h_n, 1]``. All networks see the
same x, so a product with J or J' of the whole batch is two large matrix products.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Layout:
    """How W1 and W2 of one network lie in its parameter row.

    Parameters
    ----------
    inputs, hidden, outputs
        E, H and K; K is the largest number of outputs of any network in the batch.
    """

    inputs: int
    hidden: int
    outputs: int

    @property
    def parameters(self) -> int:
        """Length of a network's parameter row, P."""
        return self.hidden * (self.inputs + 1) + self.outputs * (self.hidden + 1)

    def split(self, rows: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Views of (m, P) rows as W1 (m, H, E+1) and W2 (m, K, H+1); the last column is the bias."""
        cut = self.hidden * (self.inputs + 1)
        w1 = rows[:, :cut].reshape(-1, self.hidden, self.inputs + 1)
        return w1, rows[:, cut:].reshape(-1, self.outputs, self.hidden + 1)

    def join(self, w1: np.ndarray, w2: np.ndarray) -> np.ndarray:
        """Parameter rows (m, P) of W1 (m, H, E+1) and W2 (m, K, H+1)."""
        return np.concatenate([w1.reshape(len(w1), -1), w2.reshape(len(w2), -1)], axis=1)


@dataclass(frozen=True, kw_only=True)
class Rows:
    """Inputs and targets of one split.

    Parameters
    ----------
    inputs : (E+1, n)
        Standardised features, one column a sample; the last row is ones.
    targets : (M, K, n)
        Standardised targets, 0 where a network has fewer than K outputs.
    """

    inputs: np.ndarray
    targets: np.ndarray


@dataclass(frozen=True, kw_only=True)
class NetworkState:
    """Networks linearised at their parameters (see ``levenberg_marquardt.problem.State``)."""

    problem: "NetworkProblem"
    members: np.ndarray
    parameters: np.ndarray
    hidden: np.ndarray  # (m, H, n)
    residual: np.ndarray  # (m, K n)

    @cached_property
    def _slope(self) -> np.ndarray:
        return self.hidden * (1 - self.hidden)

    @cached_property
    def _output_weights(self) -> np.ndarray:
        _, w2 = self.problem.layout.split(self.parameters)
        return w2[:, :, :-1] * self.problem.used[self.members, :, None]

    def product(self, direction: np.ndarray) -> np.ndarray:
        """``J v``."""
        v1, v2 = self.problem.layout.split(direction)
        moved = _apply(v1, self.problem.train.inputs)
        moved *= self._slope
        change = self._output_weights @ moved
        change += v2[:, :, :-1] @ self.hidden
        change += v2[:, :, -1:]
        change *= self.problem.used[self.members, :, None]
        return change.reshape(len(change), -1)

    def transposed_product(self, residual: np.ndarray) -> np.ndarray:
        """``J' r``."""
        residual = residual.reshape(len(residual), self.problem.layout.outputs, -1)
        residual = residual * self.problem.used[self.members, :, None]
        back = self._output_weights.transpose(0, 2, 1) @ residual
        back *= self._slope
        count, hidden, _ = back.shape
        w1 = back.reshape(count * hidden, -1) @ self.problem.train.inputs.T
        w2 = np.concatenate(
            [residual @ self.hidden.transpose(0, 2, 1), residual.sum(2, keepdims=True)], axis=2
        )
        return self.problem.layout.join(w1.reshape(count, hidden, -1), w2)

    def gram(self) -> np.ndarray:
        """``J'J`` from explicit rows of J."""
        jacobian = self.jacobian()
        return jacobian.transpose(0, 2, 1) @ jacobian

    def kernel(self) -> np.ndarray:
        """``J J'`` without J: slopes and output weights times X'X, which all networks and steps share."""
        count, _, rows = self.hidden.shape
        outputs = self.problem.layout.outputs
        back = self._output_weights[:, :, :, None] * self._slope[:, None]  # (m, K, H, n): dy / d(W1 x)
        back = back.transpose(0, 2, 1, 3).reshape(count, -1, outputs * rows)
        kernel = (back.transpose(0, 2, 1) @ back).reshape(count, outputs, rows, outputs, rows)
        kernel *= self.problem.input_kernel[:, None]
        own = self.hidden.transpose(0, 2, 1) @ self.hidden + 1
        for output in range(outputs):
            kernel[:, output, :, output] += own * self.problem.used[self.members, output, None, None]
        return kernel.reshape(count, outputs * rows, outputs * rows)

    def jacobian(self) -> np.ndarray:
        """J (m, K n, P)."""
        count, hidden, rows = self.hidden.shape
        outputs = self.problem.layout.outputs
        used = self.problem.used[self.members]
        back = self._output_weights[:, :, None] * self._slope.transpose(0, 2, 1)[:, None]  # (m, K, n, H)
        first = back[..., None] * self.problem.train.inputs.T[:, None]  # (m, K, n, H, E+1)
        second = np.zeros((count, outputs, rows, outputs, hidden + 1), dtype=self.parameters.dtype)
        for output in range(outputs):
            wide = used[:, output, None, None]
            second[:, output, :, output, :-1] = self.hidden.transpose(0, 2, 1) * wide
            second[:, output, :, output, -1:] = wide
        flat = (count, outputs * rows, -1)
        return np.concatenate([first.reshape(flat), second.reshape(flat)], axis=2)

    def effective_parameters(self, alpha: np.ndarray) -> np.ndarray:
        """Parameters that the data determine, by the preconditioner's eigenvalues: 10 to 20 % off the exact."""
        first, second, _, _ = self._spectra
        alpha = alpha[:, None]
        outputs = self.problem.used[self.members].sum(axis=1)
        of_w1 = (first / (first + alpha[..., None])).sum(axis=(1, 2))
        return of_w1 + outputs * (second / (second + alpha)).sum(axis=1)

    @cached_property
    def _spectra(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Eigenvalues (m, H, E+1) and (m, H+1) of the preconditioner's two blocks, and their eigenvectors.

        For W1, ``J'J`` is about ``Q (x) X'X`` with ``Q = (W2'W2) * (D'D) / n``, D the slopes h(1 - h); in the
        inputs' principal axes X'X is diagonal.
        """
        slope, output_weights = self._slope, self._output_weights
        gram = (output_weights.transpose(0, 2, 1) @ output_weights) * (slope @ slope.transpose(0, 2, 1))
        gram /= slope.shape[2]
        values, vectors = _eigh(gram)
        sums = self.hidden.sum(axis=2, keepdims=True)
        corner = np.full((len(sums), 1, 1), slope.shape[2], dtype=sums.dtype)
        square = np.block(
            [[self.hidden @ self.hidden.transpose(0, 2, 1), sums], [sums.transpose(0, 2, 1), corner]]
        )
        square_values, square_vectors = _eigh(square)
        return values[:, :, None] * self.problem.input_squares, square_values, vectors, square_vectors

    def preconditioner(self, shift: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
        """Inverse of J'J + shift, taken as one Kronecker product for W1 and one for W2.

        The blocks between W1 and W2 are left out. 3 to 15 products reach a tolerance of 0.1.
        """
        kind = self.parameters.dtype
        first, second, vectors, square_vectors = self._spectra
        first = (1 / (first + shift[:, None, None])).astype(kind)
        second = (1 / (second + shift[:, None])).astype(kind)[:, None, :]

        def apply(rows: np.ndarray) -> np.ndarray:
            r1, r2 = self.problem.layout.split(rows)
            z1 = vectors @ ((vectors.transpose(0, 2, 1) @ r1) * first)
            z2 = ((r2 @ square_vectors) * second) @ square_vectors.transpose(0, 2, 1)
            return self.problem.layout.join(z1, z2)

        return apply

    def take(self, rows: np.ndarray) -> "NetworkState":
        """Some of the networks."""
        return replace(
            self,
            members=self.members[rows],
            parameters=self.parameters[rows],
            hidden=self.hidden[rows],
            residual=self.residual[rows],
        )

    def where(self, chosen: np.ndarray, other: "NetworkState") -> "NetworkState":
        """This state's networks where chosen, the other's elsewhere."""
        if chosen.all():
            return self
        wide = chosen[:, None]
        return replace(
            self,
            parameters=np.where(wide, self.parameters, other.parameters),
            hidden=np.where(wide[..., None], self.hidden, other.hidden),
            residual=np.where(wide, self.residual, other.residual),
        )


class NetworkProblem:
    """M networks to be fitted to the same inputs.

    Parameters
    ----------
    layout
        Sizes; K is the largest number of outputs.
    used : (M, K)
        1 where a network has that output, 0 where it is padding. Its dtype must be the dtype of all arrays.
    train
        Rows to fit; their inputs must be in principal axes for the preconditioner to be a good one.
    held_out
        Splits to watch; the first one decides.
    """

    def __init__(self, *, layout: Layout, used: np.ndarray, train: Rows, held_out: tuple[Rows, ...]) -> None:
        self.layout = layout
        self.used = used
        self.train = train
        self.held_out = held_out
        self.input_squares = np.einsum("en,en->e", train.inputs, train.inputs)

    @cached_property
    def input_kernel(self) -> np.ndarray:
        """``X X'`` (n, n) of the training rows, the bias among the inputs."""
        return self.train.inputs.T @ self.train.inputs

    def at(self, parameters: np.ndarray, members: np.ndarray) -> NetworkState:
        """Run the networks forward on the training rows."""
        hidden, outputs = self.forward(parameters, members, self.train.inputs)
        outputs -= self.train.targets[members]
        return NetworkState(
            problem=self,
            members=members,
            parameters=parameters,
            hidden=hidden,
            residual=outputs.reshape(len(outputs), -1),
        )

    def observations(self, members: np.ndarray) -> np.ndarray:
        """Outputs that a network has, times rows."""
        return self.used[members].sum(axis=1, dtype=np.float64) * self.train.inputs.shape[1]

    def monitor(self, parameters: np.ndarray, members: np.ndarray) -> np.ndarray:
        """Mean squared errors (m, splits) in z-scored targets, over the outputs that a network has."""
        errors = np.empty((len(members), len(self.held_out)))
        for column, rows in enumerate(self.held_out):
            _, outputs = self.forward(parameters, members, rows.inputs)
            outputs -= rows.targets[members]
            outputs = outputs.reshape(len(members), -1)
            squares = np.einsum("mi,mi->m", outputs, outputs, dtype=np.float64)
            errors[:, column] = squares / (self.used[members].sum(axis=1) * rows.inputs.shape[1])
        return errors

    def forward(
        self, parameters: np.ndarray, members: np.ndarray, inputs: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Hidden units (m, H, n) and outputs (m, K, n) for inputs (E+1, n)."""
        w1, w2 = self.layout.split(parameters)
        hidden = _apply(w1, inputs)
        hidden *= 0.5
        np.tanh(hidden, out=hidden)  # s(a) = (1 + tanh(a/2)) / 2 cannot overflow and is faster than exp
        hidden += 1
        hidden *= 0.5
        outputs = w2[:, :, :-1] @ hidden
        outputs += w2[:, :, -1:]
        outputs *= self.used[members, :, None]
        return hidden, outputs


def _apply(weights: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    count, hidden, width = weights.shape
    return (weights.reshape(count * hidden, width) @ inputs).reshape(count, hidden, -1)


def _eigh(matrices: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    # float64 inside: in float32 tiny eigenvalues come out negative by more than the shift.
    values, vectors = np.linalg.eigh(matrices.astype(np.float64))
    return np.maximum(values, 0), vectors.astype(matrices.dtype)
