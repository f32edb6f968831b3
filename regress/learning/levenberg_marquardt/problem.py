"""Defines what the solver needs of a batch of problems: residuals, products with the Jacobian, a preconditioner."""

from collections.abc import Callable
from typing import Protocol

import numpy as np

Preconditioner = Callable[[np.ndarray], np.ndarray]


class State(Protocol):
    """Linearisation of m problems of a batch at their parameters.

    Attributes
    ----------
    parameters : (m, P)
        Where.
    residual : (m, R)
        Model minus target.
    """

    parameters: np.ndarray
    residual: np.ndarray

    def product(self, direction: np.ndarray) -> np.ndarray:
        """``J v``: (m, P) to (m, R)."""
        ...

    def transposed_product(self, residual: np.ndarray) -> np.ndarray:
        """``J' r``: (m, R) to (m, P)."""
        ...

    def gram(self) -> np.ndarray:
        """``J'J``: (m, P, P). Asked for only where P is small."""
        ...

    def kernel(self) -> np.ndarray:
        """``J J'``: (m, R, R). Asked for only where R is small."""
        ...

    def effective_parameters(self, alpha: np.ndarray) -> np.ndarray:
        """About how many parameters (m,) the data determine: ``trace((J'J + alpha I)^-1 J'J)``, at no cost."""
        ...

    def preconditioner(self, shift: np.ndarray) -> Preconditioner:
        """Symmetric positive approximation of ``(J'J + shift I)^-1``, shift (m,), as a function on (m, P)."""
        ...

    def take(self, rows: np.ndarray) -> "State":
        """The problems of these rows, or of this boolean mask."""
        ...

    def where(self, chosen: np.ndarray, other: "State") -> "State":
        """Rows of this state where ``chosen`` (m,) is true, of the other elsewhere."""
        ...


class LeastSquares(Protocol):
    """A batch of M independent problems with P parameters each."""

    def at(self, parameters: np.ndarray, members: np.ndarray) -> State:
        """Linearise problems ``members`` (m,) at ``parameters`` (m, P)."""
        ...

    def observations(self, members: np.ndarray) -> np.ndarray:
        """How many residuals (m,) are data; padding is not."""
        ...

    def monitor(self, parameters: np.ndarray, members: np.ndarray) -> np.ndarray:
        """Errors (m, C) on held-out data; column 0 decides which parameters are kept."""
        ...
