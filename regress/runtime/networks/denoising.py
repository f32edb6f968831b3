"""Shrinks features as far as the noise of the very face says: what noise floods is left out, the rest is kept."""

from dataclasses import dataclass, replace

import numpy as np

LEVELS = (0.003, 0.012)
"""Sizes of noise at which the two places that tell networks of it have fallen to a half."""


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
        coordinates = centred @ self.axes.T
        measured = np.mean((centred @ self.noise_axes.T) ** 2, axis=1, keepdims=True)
        surplus = (coordinates**2 @ self.surplus)[:, None] - self.usual
        noise = np.maximum(measured, surplus) + self.least
        return (coordinates + self.offset) * (self.signal / (self.signal + noise))

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
        levels = len(LEVELS)
        shown = len(self.axes) - levels
        back = np.linalg.pinv(np.concatenate([self.axes[:shown], self.noise_axes]).T)[:shown]
        return np.block(
            [[back, np.zeros((shown, levels))], [np.zeros((levels, back.shape[1])), np.eye(levels)]]
        )
