"""Ellipses fitted to points.

References
----------
.. [1] R. Halir and J. Flusser, "Numerically stable direct least squares fitting of ellipses", WSCG 1998.
"""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class Ellipse:
    """An ellipse in a picture.

    Attributes
    ----------
    center
        (2,) pixels.
    semi_axes
        (2,) pixels, the longer first.
    angle
        Radians from the picture's x to the longer axis, towards y (which points down): above -pi/2, at most pi/2.
    """

    center: np.ndarray
    semi_axes: np.ndarray
    angle: float


def fit_ellipse(points: np.ndarray) -> Ellipse:
    """The ellipse of least squared algebraic distance [1]_ to points (n, 2), at least 6; NaN where one is NaN."""
    if not np.isfinite(points).all():
        return Ellipse(center=np.full(2, np.nan), semi_axes=np.full(2, np.nan), angle=np.nan)
    middle, size = points.mean(axis=0), points.std()
    x, y = (points - middle).T / size
    quadratic, linear = np.stack([x * x, x * y, y * y], axis=-1), np.stack([x, y, np.ones_like(x)], axis=-1)
    # the linear terms that go best with each quadratic one
    best = -np.linalg.lstsq(linear, quadratic, rcond=None)[0]
    scatter = quadratic.T @ (quadratic + linear @ best)
    # times the inverse of the matrix of 4 a c - b^2, which is 1 for an ellipse
    vectors = np.linalg.eig(scatter[::-1] * np.array([[0.5], [-1.0], [0.5]]))[1].real
    a, b, c = vectors[:, (4.0 * vectors[0] * vectors[2] - vectors[1] ** 2).argmax()]
    d, e, f = best @ (a, b, c)
    matrix = np.array([[a, 0.5 * b], [0.5 * b, c]])
    center = np.linalg.solve(matrix, [-0.5 * d, -0.5 * e])
    # about its centre it is x^T M x = 1, and the smaller eigenvalue belongs to the longer axis
    values, axes = np.linalg.eigh(matrix / (matrix @ center @ center - f))
    angle = np.arctan2(axes[1, 0], axes[0, 0])
    return Ellipse(
        center=middle + size * center,
        semi_axes=size / np.sqrt(values),
        angle=float(np.pi / 2 - (np.pi / 2 - angle) % np.pi),
    )
