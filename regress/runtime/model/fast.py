"""Predicts the same weights in a fraction of the time: buffers made once, networks in float32."""

import cmath
import math

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, FACE_WIDTH_LANDMARKS, LANDMARK_COUNT
from regress.errors import InputError
from regress.runtime.features import ANCHORS, STABLE, turn_weights
from regress.runtime.features.alignment import ROUNDING
from regress.runtime.model.batch import BatchPredictor, about_mean
from regress.runtime.model.model import Model


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
    is ``a z + b conj(z)``; or they are points, ``a z + c``. One frame's time is that of its calls, half a microsecond
    each, and of the first layer's weights on their way from the cache: sums are products with ones, constants are
    arrays.
    """

    def __init__(self, model: Model) -> None:
        features, networks = model.features, model.networks
        self._aligned, self._of_points = features.alignment == "affine", features.of_points
        self._anchors = np.array(STABLE if features.of_points else ANCHORS)
        target = features.mean_shape[self._anchors].copy().view(np.complex128)[:, 0]
        self._centre = target.mean()
        self._target = target - self._centre
        mean_of_anchors = np.full(len(target), 1 / len(target))
        self._mean_of_anchors = mean_of_anchors.astype(np.complex128)
        self._anchor_products = np.stack([mean_of_anchors, self._target, self._target.conj()])
        self._ones = np.ones(LANDMARK_COUNT, np.complex128)
        self._depth = self._turn = None
        if features.depth is not None:
            turn = turn_weights(features.mean_shape, features.depth)
            # complex as the points are: no conversion in each frame
            self._depth, self._turn = features.depth.astype(np.complex128), turn.astype(np.complex128)
        first, last = np.concatenate([features.edges, [FACE_WIDTH_LANDMARKS]]).T  # no edges: the width alone
        self._ends = np.stack([last, first])
        self._mean, bias = about_mean(model)
        self._b1 = bias.astype(np.float32)
        self._w1_columns = np.ascontiguousarray(networks.w1.T, dtype=np.float32)  # a fifth faster than rows
        self._denoising = denoising = networks.denoising
        if denoising is not None:
            axes = np.concatenate([denoising.axes, denoising.noise_axes])
            self._axes_columns = np.ascontiguousarray(axes.T, dtype=np.float32)
            self._shown = len(denoising.axes)
            self._offset, self._signal = (
                denoising.offset.astype(np.float32),
                denoising.signal.astype(np.float32),
            )
            self._surplus = denoising.surplus.astype(np.float32)
            self._usual, self._least = float(denoising.usual), float(denoising.least)
            self._noise_share = 1 / len(denoising.noise_axes)
        rows = [BLENDSHAPE_INDEX[name] for name in model.outputs]
        self._w2 = np.zeros((len(BLENDSHAPES), len(networks.b1)), np.float32)
        self._w2[rows] = networks.block_w2
        self._b2 = np.zeros(len(BLENDSHAPES), np.float32)
        self._b2[rows] = networks.b2
        self._centred, self._features = np.empty(len(self._mean)), np.empty(len(self._mean), np.float32)
        self._hidden = np.empty(len(networks.b1), np.float32)
        self._zero, self._one = np.zeros((), np.float32), np.ones((), np.float32)
        self._batch = BatchPredictor(model)

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
        values = self._laid(plane) if self._of_points else self._lengths(plane)
        self._features[:] = np.subtract(values, self._mean, out=self._centred)
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
        points = np.asarray(points)
        if points.ndim != 3 or points.shape[1:] != (LANDMARK_COUNT, 2):
            raise InputError(f"points have shape {points.shape}; (n, 68, 2) is needed")
        return self._batch.predict(points, threads=threads)

    def _lengths(self, plane: np.ndarray) -> np.ndarray:
        """Lengths (E,) of the edges, in face widths."""
        if self._aligned:
            straight, mirrored = self._map(plane)
            plane = straight * plane + mirrored * plane.conj()
        last, first = plane.take(self._ends)
        lengths = np.abs(last - first)
        width = lengths[-1]
        lengths /= width if width > 0 else math.nan
        return lengths[:-1]

    def _laid(self, plane: np.ndarray) -> np.ndarray:
        """Points (136,), x and y of each, turned, scaled and shifted onto the mean shape."""
        anchors = plane.take(self._anchors)
        mean = complex(anchors.dot(self._mean_of_anchors))
        anchors -= mean
        spread = np.vdot(anchors, anchors).real.item()
        factor = complex(np.vdot(anchors, self._target)) / (
            spread if spread > ROUNDING * abs(mean) ** 2 else math.nan
        )
        return (factor * plane + (self._centre - factor * mean)).view(np.float64)

    def _shrunk(self, features: np.ndarray) -> np.ndarray:
        """What denoising leaves of one face's features, centred."""
        coordinates = np.dot(features, self._axes_columns)
        shown, noise = coordinates[: self._shown], coordinates[self._shown :]
        measured = float(noise.dot(noise)) * self._noise_share
        surplus = float(np.square(shown).dot(self._surplus)) - self._usual
        gain = self._signal + (max(measured, surplus) + self._least)
        np.divide(self._signal, gain, out=gain)
        shown += self._offset
        shown *= gain
        return shown

    def _map(self, plane: np.ndarray) -> tuple[complex, complex]:
        """Factors of z and of its conjugate in the map onto the mean shape, but for a common one."""
        anchors = plane.take(self._anchors)
        # the target is about its own mean
        mean, product, turned = self._anchor_products.dot(anchors).tolist()
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
