"""Many small networks side by side: how they train, start and run."""

from regress.networks.denoising import Denoising, fit_denoising
from regress.networks.folded import FoldedNetworks, evaluate, shifted
from regress.networks.folding import fold
from regress.networks.initial import nguyen_widrow, ridge_directions, ridge_knots
from regress.networks.least_squares import Layout, NetworkProblem, Rows
from regress.networks.ridge import Ridge, fit_ridge, ridge_coefficients

__all__ = [
    "Denoising",
    "FoldedNetworks",
    "Layout",
    "NetworkProblem",
    "Ridge",
    "Rows",
    "evaluate",
    "fit_denoising",
    "fit_ridge",
    "fold",
    "nguyen_widrow",
    "ridge_coefficients",
    "ridge_directions",
    "ridge_knots",
    "shifted",
]
