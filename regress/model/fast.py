"""The same predictions in a fraction of the time: buffers made once, networks in float32."""

import cmath
import itertools
import math
import os
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from threadpoolctl import threadpool_limits

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, FACE_WIDTH_LANDMARKS, LANDMARK_COUNT
from regress.errors import InputError
from regress.features import ANCHORS, turn_weights
from regress.model.model import Model
from regress.networks import FoldedNetworks

_BLOCK = 512
"""Frames of a batch computed at once: 620 hidden units of each are 1.3 MB, which stays in a core's cache."""

_PARTS = 4
"""Products that a batch's output weights are cut into: zero outside each network's block, they take 40 % less so."""

_FEWEST_BLOCKS = 8
"""Blocks from which on threads pay."""


class FastPredictor:
    """Predicts in float32, one frame as it comes or a whole batch.

    `regress bench` times it beside `Model.predict`, from which its results differ by less than 1e-5. An instance
    reuses its buffers, so it serves one thread.

    Parameters
    ----------
    model
        Any model; a calibrated one stays calibrated.

    Notes
    -----
    Points are complex numbers z = x + iy here, so that a face takes few calls of NumPy. Features are ratios of
    lengths: of the affine map ``(P'P)^-1 P'Q`` the determinant and the translation drop out, and its linear part
    is ``a z + b conj(z)``. One frame's time is that of its calls, half a microsecond each, and of the first layer's
    weights on their way from the cache: sums are products with ones, constants are arrays.
    """

    def __init__(self, model: Model) -> None:
        features, networks = model.features, model.networks
        self._aligned = features.alignment == "affine"
        self._anchors = np.array(ANCHORS)
        target = features.mean_shape[self._anchors].copy().view(np.complex128)[:, 0]
        self._target = target - target.mean()
        mean_of_anchors = np.full(len(target), 1 / len(target))
        self._anchor_products = np.stack([mean_of_anchors, self._target, self._target.conj()])
        self._ones = np.ones(LANDMARK_COUNT, np.complex128)
        self._target_axes = np.stack([self._target.real, self._target.imag]).astype(np.float32)
        self._depth = self._turn = None
        if features.depth is not None:
            turn = turn_weights(features.mean_shape, features.depth)
            # complex as the points are: no conversion in each frame
            self._depth, self._turn = features.depth.astype(np.complex128), turn.astype(np.complex128)
        first, last = np.concatenate([features.edges, [FACE_WIDTH_LANDMARKS]]).T
        self._first, self._last = np.ascontiguousarray(first), np.ascontiguousarray(last)
        self._ends = np.stack([last, first])
        self._mean = mean = model.normalisation.feature_mean
        self._w1 = np.ascontiguousarray(networks.w1, dtype=np.float32)
        self._w1_columns = np.ascontiguousarray(self._w1.T)  # a fifth faster on one face
        self._denoising = denoising = networks.denoising
        if denoising is None:
            # small about the mean: float32 would lose two digits on raw features
            self._b1 = (networks.b1 + networks.w1 @ mean).astype(np.float32)
        else:
            self._mean, self._b1 = denoising.origin, networks.b1.astype(np.float32)
            self._axes = np.concatenate([denoising.axes, denoising.noise_axes]).astype(np.float32)
            self._axes_columns = np.ascontiguousarray(self._axes.T)
            self._shown = len(denoising.axes)
            self._offset, self._signal = (
                denoising.offset.astype(np.float32),
                denoising.signal.astype(np.float32),
            )
            self._least = float(denoising.least)
            self._noise_share = 1 / len(denoising.noise_axes)
        rows = [BLENDSHAPE_INDEX[name] for name in model.outputs]
        self._w2 = np.zeros((len(BLENDSHAPES), len(networks.b1)), np.float32)
        self._w2[rows] = networks.block_w2
        self._b2 = np.zeros(len(BLENDSHAPES), np.float32)
        self._b2[rows] = networks.b2
        self._mean32 = self._mean.astype(np.float32)
        self._centred, self._features = np.empty(len(mean)), np.empty(len(mean), np.float32)
        self._hidden = np.empty(len(networks.b1), np.float32)
        self._zero, self._one = np.zeros((), np.float32), np.ones((), np.float32)
        # tanh(a) = 1 - 2 / (1 + exp(2a)): five times as fast as NumPy's tanh on blocks (AVX2), no faster on one face
        self._twice_w1, self._twice_b1 = 2 * self._w1, 2 * self._b1[:, None]
        self._rows = rows
        self._parts = _parts(networks)
        self._sum_b2 = (networks.b2 + networks.block_w2.sum(axis=1)).astype(np.float32)[:, None]

    def predict_frame(self, points: np.ndarray) -> np.ndarray:
        """Blendshape weights of one face.

        Parameters
        ----------
        points : (68, 2) float
            In pixels or any other unit, y down, iBUG order.

        Returns
        -------
        (52,) float32
            In the order of ``facegen.conventions.BLENDSHAPES``, clipped to [0, 1]; NaN throughout where a point
            is missing or the points that are aligned lie on one line.
        """
        points = np.ascontiguousarray(points, dtype=np.float64)
        if points.shape != (LANDMARK_COUNT, 2):
            raise InputError(f"points have shape {points.shape}; (68, 2) is needed")
        plane = points.view(np.complex128)[:, 0]
        if not cmath.isfinite(plane.dot(self._ones)):
            return np.full(len(BLENDSHAPES), np.nan, np.float32)
        if self._depth is not None:
            plane = plane - self._depth * self._turn.dot(plane)
        if self._aligned:
            straight, mirrored = self._map(plane)
            plane = straight * plane + mirrored * plane.conj()
        last, first = plane.take(self._ends)
        lengths = np.abs(last - first)
        width = lengths[-1]
        lengths /= width if width > 0 else math.nan
        self._features[:] = np.subtract(lengths[:-1], self._mean, out=self._centred)
        inputs = self._features if self._denoising is None else self._shrunk(self._features)
        hidden = np.dot(inputs, self._w1_columns, out=self._hidden)
        hidden += self._b1
        np.tanh(hidden, out=hidden)
        weights = np.dot(self._w2, hidden)
        weights += self._b2
        np.maximum(weights, self._zero, out=weights)
        return np.minimum(weights, self._one, out=weights)

    def predict(self, points: np.ndarray, *, threads: int | None = None) -> np.ndarray:
        """Blendshape weights of faces.

        Parameters
        ----------
        points : (n, 68, 2) float
        threads
            That share the blocks, whose results do not depend on it; None: as many as there are cores.

        Returns
        -------
        (n, 52) float32
            Rows as `predict_frame` gives them.
        """
        points = np.asarray(points, dtype=np.float64)
        if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2):
            raise InputError(f"points have shape {points.shape}; (n, 68, 2) is needed")
        weights = np.zeros((len(points), len(BLENDSHAPES)), np.float32)
        starts = range(0, len(points), _BLOCK)

        def fill(start: int) -> None:
            # faces with missing points become NaN; a sigmoid's tail overflows to its limit
            with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
                block = self._predict_block(points[start : start + _BLOCK])
            weights[start : start + _BLOCK, self._rows] = block
            weights[start : start + _BLOCK][np.isnan(block).any(axis=1)] = np.nan

        if len(starts) < _FEWEST_BLOCKS:
            for start in starts:
                fill(start)
            return weights
        # one BLAS thread each: products cut among several would end in other last bits
        with (
            threadpool_limits(limits=1, user_api="blas"),
            ThreadPoolExecutor(max_workers=threads or os.cpu_count()) as pool,
        ):
            list(pool.map(fill, starts))
        return weights

    def _predict_block(self, points: np.ndarray) -> np.ndarray:
        x, y = self._mapped(points.transpose(2, 1, 0))
        # a row an edge and a column a face: whole rows are fetched
        along, down = (axis.take(self._last, 0) - axis.take(self._first, 0) for axis in (x, y))
        along *= along
        down *= down
        along += down
        np.sqrt(along, out=along)
        features, width = along[:-1], along[-1]
        features /= np.where(width > 0, width, np.nan)
        features -= self._mean32[:, None]
        if self._denoising is not None:
            places = self._axes @ features
            features, noise = places[: self._shown], places[self._shown :]
            noise = np.einsum("tf,tf->f", noise, noise) * np.float32(self._noise_share) + np.float32(
                self._least
            )
            signal = self._signal[:, None]
            features += self._offset[:, None]
            features *= signal / (signal + noise)
        hidden = self._twice_w1 @ features
        hidden += self._twice_b1
        np.exp(hidden, out=hidden)
        hidden += 1
        np.reciprocal(hidden, out=hidden)
        weights = np.empty((len(self._rows), hidden.shape[1]), np.float32)
        for outputs, units, w2 in self._parts:
            np.matmul(w2, hidden[units], out=weights[outputs])
        weights += self._sum_b2
        return np.clip(weights, 0, 1, out=weights).T

    def _mapped(self, planes: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Both coordinates (68, b), float32, of faces (2, 68, b) after `_map`, their widths near one."""
        centre = planes.take(self._anchors, 1).mean(axis=1, keepdims=True)
        # centred before the precision drops: pixels count from a picture's corner
        size = planes[0].max(axis=0) - planes[0].min(axis=0)
        x, y = ((planes - centre) / np.where(size > 0, size, np.nan)).astype(np.float32)
        if not np.isfinite(x).all() or not np.isfinite(y).all():
            finite = np.isfinite(x).all(axis=0) & np.isfinite(y).all(axis=0)
            x, y = np.where(finite, x, np.nan), np.where(finite, y, np.nan)
        if self._depth is not None:
            depth, turn = self._depth.real.astype(np.float32)[:, None], self._turn.real.astype(np.float32)
            x, y = x - depth * (turn @ x), y - depth * (turn @ y)
        if not self._aligned:
            return x, y
        ax, ay = x.take(self._anchors, 0), y.take(self._anchors, 0)
        xx, xy, yy = (np.einsum("af,af->f", p, q) for p, q in ((ax, ax), (ax, ay), (ay, ay)))
        (xu, xv), (yu, yv) = self._target_axes @ ax, self._target_axes @ ay
        spread = xx + yy
        # Model.predict refuses at 1e-12 in float64; below 1e-6 float32 has no digit left
        spread[~(xx * yy - xy * xy > 1e-6 * spread * spread)] = np.nan
        m00, m01 = (yy * xu - xy * yu) / spread, (yy * xv - xy * yv) / spread
        m10, m11 = (xx * yu - xy * xu) / spread, (xx * yv - xy * xv) / spread
        return x * m00 + y * m10, x * m01 + y * m11

    def _shrunk(self, features: np.ndarray) -> np.ndarray:
        """What denoising leaves of one face's features, centred."""
        places = np.dot(features, self._axes_columns)
        shown, noise = places[: self._shown], places[self._shown :]
        gain = self._signal + (float(noise.dot(noise)) * self._noise_share + self._least)
        np.divide(self._signal, gain, out=gain)
        shown += self._offset
        shown *= gain
        return shown

    def _map(self, plane: np.ndarray) -> tuple[complex, complex]:
        """Factors of z and of its conjugate in the map onto the mean shape, but for a common one."""
        anchors = plane.take(self._anchors)
        mean, product, turned = self._anchor_products.dot(
            anchors
        ).tolist()  # the target is about its own mean
        anchors -= mean
        square = complex(anchors.dot(anchors))
        spread = np.vdot(anchors, anchors).real.item()
        xx, yy, xy = (spread + square.real) / 2, (spread - square.real) / 2, square.imag / 2
        if not xx * yy - xy * xy > 1e-12 * spread * spread:
            return complex(math.nan), complex(math.nan)
        xu, yv = (turned.real + product.real) / 2, (turned.real - product.real) / 2
        xv, yu = (product.imag - turned.imag) / 2, (product.imag + turned.imag) / 2
        # the spread keeps the numbers near one, whatever the unit
        m00, m01 = (yy * xu - xy * yu) / spread, (yy * xv - xy * yv) / spread
        m10, m11 = (xx * yu - xy * xu) / spread, (xx * yv - xy * xv) / spread
        return complex(m00 + m11, m01 - m10) / 2, complex(m00 - m11, m01 + m10) / 2


def _parts(networks: FoldedNetworks) -> list[tuple[slice, slice, np.ndarray]]:
    """Outputs of some networks that follow one another, their hidden units, and -2 times the weights between."""
    owners, hidden = networks.network_of_output, networks.hidden
    count = len(networks.b1) // hidden
    ends = np.linspace(0, count, min(_PARTS, count) + 1).astype(int)
    parts = []
    for first, last in itertools.pairwise(ends.tolist()):
        outputs = slice(*np.searchsorted(owners, [first, last]).tolist())
        units = slice(first * hidden, last * hidden)
        parts.append((outputs, units, -2 * networks.block_w2[outputs, units].astype(np.float32)))
    return parts
