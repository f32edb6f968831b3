"""Finds the axes and the gains of the noise filter from faces and from what noise adds to them."""

import numpy as np

from regress.errors import InputError
from regress.runtime.networks.denoising import LEVELS, Denoising

NOISE_AXES = 32
"""Axes that measure the noise: their mean square is right to a quarter."""

_LEAST = 0.001
"""Noise, in the unit of the axes, below which levels are not told apart: less than datasets and detectors have."""

_TYPICAL = 0.005
"""Noise at which the weights of the surplus measure it best: that of a good detector."""

_FAINTEST = 1e-5
"""Variance under noise, of the largest, of the faintest axis kept: float32 has no digits for fainter ones."""


def fit_denoising(clean: np.ndarray, moved: np.ndarray, partner: np.ndarray) -> Denoising:
    """Find the axes from features of faces and what noise of unit size adds to them.

    Generalised eigenvectors of the two covariances (K. Fukunaga 1990, section 10.2). Those of features that a mirror
    leaves, and of those that it turns over, are found apart, so that a mirrored face has the same places but for
    signs, and the same noise.

    Parameters
    ----------
    clean, moved : (n, E) float64
        Features of undisturbed faces, and what noise, divided by its size, adds to them.
    partner : (E,) int64
        The feature that each becomes in the mirror.

    Returns
    -------
    Denoising

    Raises
    ------
    InputError
        Where the faces are too few to tell noise by.
    """
    origin = clean.mean(axis=0)
    own = np.eye(len(partner))
    mirror = own[partner]
    signal, noise = np.cov(clean.T), np.cov(moved.T)
    signal, noise = ((each + mirror @ each @ mirror) / 2 for each in (signal, noise))
    strongest = np.linalg.eigvalsh(noise)[-1]
    axes, variances = [], []
    for sign in (1, -1):
        values, basis = np.linalg.eigh(own + sign * mirror)
        basis = basis[:, values > 1]  # of features that keep, or change, their sign
        values, vectors = np.linalg.eigh(basis.T @ noise @ basis)
        kept = values > _FAINTEST * strongest
        white = basis @ (vectors[:, kept] / np.sqrt(values[kept]))
        values, vectors = np.linalg.eigh(white.T @ signal @ white)
        axes.append((white @ vectors).T)
        variances.append(values)
    order = np.argsort(-np.concatenate(variances), kind="stable")
    axes, variances = np.concatenate(axes)[order], np.concatenate(variances)[order]
    if len(axes) <= NOISE_AXES:
        raise InputError(
            f"{len(clean)} faces are too few to tell a detector's noise from what faces do; make a dataset of more "
            "people, or train by --recipe exact"
        )
    floor = variances[-NOISE_AXES:].mean()  # the noise that undisturbed faces have
    levels = np.square(LEVELS)
    shown = len(axes) - NOISE_AXES
    signal = np.maximum(variances[:shown] - floor, 0)
    # the square along an axis has the mean signal + noise, and a variance that goes with the square of it
    weights = 1 / (signal + _TYPICAL**2) ** 2
    weights /= weights.sum()
    return Denoising(
        origin=(origin + origin[partner]) / 2,
        axes=np.concatenate([axes[:shown], np.zeros((len(levels), len(partner)))]),
        offset=np.concatenate([np.zeros(shown), np.ones(len(levels))]),
        signal=np.concatenate([signal, levels]),
        noise_axes=axes[-NOISE_AXES:],
        surplus=np.concatenate([weights, np.zeros(len(levels))]),
        usual=np.array(weights @ signal),
        least=np.array(_LEAST**2),
    )
