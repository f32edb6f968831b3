"""Many small networks side by side: how they start, train and fold."""

from regress.learning.networks.denoising import fit_denoising
from regress.learning.networks.folding import fold
from regress.learning.networks.initial import draw_nguyen_widrow, draw_ridge_knots, ridge_directions
from regress.learning.networks.least_squares import Layout, NetworkProblem, Rows
from regress.learning.networks.ridge import Ridge, fit_ridge, ridge_coefficients

__all__ = [
    "Layout",
    "NetworkProblem",
    "Ridge",
    "Rows",
    "draw_nguyen_widrow",
    "draw_ridge_knots",
    "fit_denoising",
    "fit_ridge",
    "fold",
    "ridge_coefficients",
    "ridge_directions",
]
