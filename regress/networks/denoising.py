"""Features shrunk as far as the noise of the very face says: what noise floods is left out, the rest is kept."""

from dataclasses import dataclass, replace

import numpy as np

NOISE_AXES = 32
"""Axes that measure the noise: their mean square is right to a quarter."""

_LEVELS = (0.003, 0.012)
"""Sizes of noise at which the two places that tell networks of it have fallen to a half."""

_LEAST = 0.001
"""Noise, in the unit of the axes, below which levels are not told apart: less than datasets and detectors have."""

_TYPICAL = 0.005
"""Noise at which the weights of the surplus measure it best: that of a good detector."""

_FAINTEST = 1e-5
"""Variance under noise, of the largest, of the faintest axis kept: float32 has no digits for fainter ones."""


@dataclass(frozen=True, kw_only=True)
class Denoising:
    """A Wiener filter for each face: along every axis ``signal / (signal + noise)`` of its features is left.

    Points are displaced along axes in which no face differs from another, too, and there the mean square is the
    noise. One set of networks then serves exact points and bad detectors alike: without it what they learn of one
    they lose of the other.

    A face that differs from those trained on by more than they do from each other, as heads of another make do, tells
    as little along the faint axes as a noisy one. The surplus of its squares over the usual ones is a second measure
    of the noise, and the larger of the two counts.

    Parameters
    ----------
    origin : (E,) float64
        Mean features of undisturbed faces.
    axes : (A, E) float64
        What expressions show in, most first; noise of unit size has unit variance along each. The last two are 0.
    offset : (A,) float64
        Added to places along the axes: 1 for the last two, 0 for the others. So shrunk, 1 says how much noise there is.
    signal : (A,) float64
        Variance of undisturbed faces along them, and of noise that halves the last two.
    noise_axes : (32, E) float64
        What only noise shows in.
    surplus : (A,) float64
        Weights of the squares along the axes, 0 for the last two: their sum, less ``usual``, measures noise.
    usual : float64
        That sum for undisturbed faces, in the mean.
    least : float64
        Added to the noise's variance.
    """

    origin: np.ndarray
    axes: np.ndarray
    offset: np.ndarray
    signal: np.ndarray
    noise_axes: np.ndarray
    surplus: np.ndarray
    usual: np.ndarray
    least: np.ndarray

    def shrunk(self, features: np.ndarray) -> np.ndarray:
        """Places along the axes (n, A) of raw features (n, E), shrunk; rows of NaN give rows of NaN."""
        centred = features - self.origin
        places = centred @ self.axes.T
        measured = np.mean((centred @ self.noise_axes.T) ** 2, axis=1, keepdims=True)
        surplus = (places**2 @ self.surplus)[:, None] - self.usual
        noise = np.maximum(measured, surplus) + self.least
        return (places + self.offset) * (self.signal / (self.signal + noise))

    @property
    def believing(self) -> "Denoising":
        """The same without the second measure: for faces that are usual because they are trained on."""
        return replace(self, surplus=np.zeros_like(self.surplus), usual=np.zeros(()))

    def shifted(self, origin: np.ndarray) -> "Denoising":
        """The filter that acts on features (E,) as this acts on features less an origin."""
        return replace(self, origin=self.origin + origin)

    @property
    def back(self) -> np.ndarray:
        """(A, E + 2): makes features, about the origin, of places along the axes, and leaves the last two places."""
        levels = len(_LEVELS)
        shown = len(self.axes) - levels
        back = np.linalg.pinv(np.concatenate([self.axes[:shown], self.noise_axes]).T)[:shown]
        return np.block(
            [[back, np.zeros((shown, levels))], [np.zeros((levels, back.shape[1])), np.eye(levels)]]
        )


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
    floor = variances[-NOISE_AXES:].mean()  # the noise that undisturbed faces have
    levels = np.square(_LEVELS)
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
