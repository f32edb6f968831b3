"""Linear identity: principal components of many heads, eyeballs fitted to them, traits regressed on them."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class IdentityBasis:
    """``mean`` (D,), ``components`` (K, D) times their sigma, ``scores`` (n, K) of the people."""

    mean: np.ndarray
    components: np.ndarray
    scores: np.ndarray


def fit_sphere(points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Least-squares spheres of point sets (..., n, 3): centres (..., 3) and radii (...).

    Solves ``|p|^2 = 2 c.p + (r^2 - |c|^2)``, which is linear in the centre.
    """
    middle = points.mean(axis=-2, keepdims=True)
    p = points - middle
    a = np.concatenate([2.0 * p, np.ones((*p.shape[:-1], 1))], axis=-1)
    b = np.square(p).sum(axis=-1)
    at = np.swapaxes(a, -1, -2)
    solution = np.linalg.solve(at @ a, (at @ b[..., None]))[..., 0]
    centre = solution[..., :3]
    return centre + middle[..., 0, :], np.sqrt(solution[..., 3] + np.square(centre).sum(axis=-1))


def principal_components(samples: np.ndarray, count: int) -> IdentityBasis:
    """First ``count`` principal components of ``samples`` (n, D), the largest entry of each positive.

    Without that choice of sign another build of LAPACK may mirror a component.
    """
    mean = samples.mean(axis=0)
    centred = samples - mean
    variance, vectors = np.linalg.eigh(centred @ centred.T / (len(samples) - 1))
    order = np.argsort(variance)[::-1][:count]
    sigma = np.sqrt(variance[order])
    components = (vectors[:, order].T @ centred) / (np.sqrt(len(samples) - 1) * sigma[:, None])
    largest = np.abs(components).argmax(axis=1)
    components *= np.sign(components[np.arange(count), largest])[:, None]
    scores = centred @ components.T / sigma
    return IdentityBasis(mean=mean, components=components * sigma[:, None], scores=scores)


def regress_traits(scores: np.ndarray, traits: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Scores from traits: (K, T) and (K, K) so that scores are ``mean @ traits + residual @ N(0, 1)``.

    ``residual`` is the lower Cholesky factor of the covariance that traits leave unexplained.
    """
    mean = np.linalg.lstsq(traits, scores, rcond=None)[0].T
    left = scores - traits @ mean.T
    return mean, np.linalg.cholesky(left.T @ left / len(scores))
