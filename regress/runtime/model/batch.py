"""Predicts for many faces: blocks that stay in a core's cache, in buffers made once."""

import os
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from facegen.conventions import (
    BLENDSHAPE_INDEX,
    BLENDSHAPES,
    FACE_WIDTH_LANDMARKS,
    LANDMARK_COUNT,
    LANDMARK_GROUPS,
)
from regress.runtime.features import ANCHORS, STABLE, turn_weights
from regress.runtime.model.model import Model

_BLOCK = 512
"""Faces computed at once: 620 hidden units of each are 1.3 MB. 256 cost more calls, 1024 more trips to memory."""

_FEWEST_BLOCKS = 8
"""Blocks from which on threads pay."""

_ANCHORS = slice(min(ANCHORS), max(ANCHORS) + 1)
"""The anchors' rows: iBUG has them first, and a slice is no copy."""

_CENTRE = LANDMARK_GROUPS["nose_bridge"][0]
"""Landmark that faces are laid about before they are aligned."""

_ONE = np.ones((), np.float32)
_SUM = np.ones(LANDMARK_COUNT, np.float32)
_MEAN = np.full(len(ANCHORS), 1 / len(ANCHORS), np.float32)


class BatchPredictor:
    """Predicts in float32 with a row a number and a column a face, so that every call runs along whole rows.

    Parameters
    ----------
    model
        Any model; a calibrated one stays calibrated.

    Notes
    -----
    Features are ratios of lengths: translations drop out, and what a map multiplies all points by. The width is
    measured first and divides the map, not the lengths.

    ``tanh(a) = 1 - 2 / (1 + exp(2a))`` is four times as fast as NumPy's tanh on blocks (AVX2): 2, -2 and 1 are in
    the weights. The first layer's bias is one more column of them. Outputs are gathered by their place in their
    network (each network's first output, then the second ones): sums along rows, a quarter of what a product of
    matrices takes that are zero outside each network's block.
    """

    def __init__(self, model: Model) -> None:
        features, networks = model.features, model.networks
        self._target_axes = self._turn = self._denoising = None
        if features.alignment == "affine":
            target = features.mean_shape[_ANCHORS]
            self._target_axes = (target - target.mean(axis=0)).T.astype(np.float32)
        if features.depth is not None:
            self._turn = turn_weights(features.mean_shape, features.depth).astype(np.float32)
            self._depth = _column(features.depth)
        self._first, self._last = np.ascontiguousarray(features.edges.T)
        self._laid = features.of_points
        if self._laid:
            target = features.mean_shape[list(STABLE)]
            self._centre = target.mean(axis=0).astype(np.float32)
            self._target = (target - target.mean(axis=0)).T.astype(np.float32)
        mean, bias = about_mean(model)
        # points lie as two planes here, one below the other
        order = (
            np.arange(features.count).reshape(-1, 2).T.ravel() if self._laid else np.arange(features.count)
        )
        self._mean = _column(mean[order])
        if networks.denoising is not None:
            self._denoising = networks.denoising
            axes = np.concatenate([networks.denoising.axes, networks.denoising.noise_axes])
            self._axes = axes[:, order].astype(np.float32)
            self._offset, self._signal = _column(self._denoising.offset), _column(self._denoising.signal)
            self._surplus = self._denoising.surplus.astype(np.float32)
        # networks with most outputs first: those that have a k-th one are the first rows
        owners, size = networks.network_of_output, networks.hidden
        largest = np.argsort(-np.bincount(owners), kind="stable")
        units = (largest[:, None] * size + np.arange(size)).ravel()
        w1 = networks.w1 if networks.denoising is not None else networks.w1[:, order]
        self._w1 = 2 * np.column_stack([w1, bias])[units].astype(np.float32)
        place = np.arange(len(owners)) - np.searchsorted(owners, owners)
        outputs = np.lexsort((np.argsort(largest)[owners], place))
        w2 = -2 * networks.w2[outputs].astype(np.float32)
        self._w2 = np.split(w2, np.cumsum(np.bincount(place))[:-1])
        self._b2 = _column((networks.b2 + networks.w2.sum(axis=1))[outputs])
        self._rows = np.array([BLENDSHAPE_INDEX[name] for name in model.outputs])[outputs]
        units, inputs = self._w1.shape
        self._sizes = _Sizes(
            units=units,
            inputs=inputs,
            edges=len(self._first),
            lengths=None if self._denoising is None else len(self._mean),
            outputs=len(self._rows),
        )

    def predict(self, points: np.ndarray, *, threads: int | None = None) -> np.ndarray:
        """Blendshape weights (n, 52) float32 of faces (n, 68, 2), as `FastPredictor.predict` says."""
        weights = np.zeros((len(points), len(BLENDSHAPES)), np.float32)
        starts = range(0, len(points), _BLOCK)

        def work(starts: range) -> None:
            buffers = None
            # faces with missing points become NaN; a sigmoid's tail overflows to its limit
            with np.errstate(invalid="ignore", divide="ignore", over="ignore"):
                for start in starts:
                    block = np.ascontiguousarray(points[start : start + _BLOCK], dtype=np.float64)
                    if buffers is None or buffers.count != len(block):
                        buffers = _Buffers(self._sizes, len(block))
                    self._fill(weights[start : start + _BLOCK], block, buffers)

        if len(starts) < _FEWEST_BLOCKS:
            work(starts)
            return weights
        workers = threads or os.cpu_count() or 1
        # one BLAS thread each: products cut among several would end in other last bits
        with (
            threadpool_limits(limits=1, user_api="blas"),
            ThreadPoolExecutor(max_workers=workers) as pool,
        ):
            list(pool.map(work, [starts[first::workers] for first in range(workers)]))
        return weights

    def _fill(self, weights: np.ndarray, points: np.ndarray, buffers: "_Buffers") -> None:
        """Write the weights (b, 52) of points (b, 68, 2)."""
        x, y = buffers.planes_of(points)
        # one missing point leaves no sum
        sound = np.isfinite(_SUM @ x + _SUM @ y)
        if self._turn is not None:
            for plane in (x, y):
                plane -= np.multiply(self._depth, self._turn @ plane, out=buffers.product)
        if self._laid:
            self._lay(x, y, sound, buffers)
        else:
            x, y = self._scaled(x, y, sound, buffers)
            self._measure(x, y, buffers)
        if self._denoising is not None:
            self._shrink(buffers)
        hidden = np.matmul(self._w1, buffers.inputs, out=buffers.hidden)
        np.exp(hidden, out=hidden)
        hidden += _ONE
        np.reciprocal(hidden, out=hidden)
        units = hidden.reshape(len(self._w2[0]), -1, len(points))
        outputs, filled = buffers.outputs, 0
        for w2 in self._w2:
            rows = outputs[filled : filled + len(w2)]
            np.einsum("nh,nhf->nf", w2, units[: len(w2)], out=rows)
            filled += len(w2)
        outputs += self._b2
        np.clip(outputs, 0, 1, out=outputs)
        weights[:, self._rows] = outputs.T
        weights[np.isnan(outputs[0])] = np.nan

    def _lay(self, x: np.ndarray, y: np.ndarray, sound: np.ndarray, buffers: "_Buffers") -> None:
        """Fill in both coordinates under the similarity, about their mean; NaN for faces that have none."""
        rows = list(STABLE)
        u, v = x[rows], y[rows]
        centre_x, centre_y = u.mean(axis=0), v.mean(axis=0)
        u -= centre_x
        v -= centre_y
        spread = np.einsum("af,af->f", u, u) + np.einsum("af,af->f", v, v)
        spread[~(sound & (spread > 0))] = np.nan
        target_x, target_y = self._target
        # the factor conj(face) . target over |face|^2, as in align_similarity
        real, imaginary = (target_x @ u + target_y @ v) / spread, (target_y @ u - target_x @ v) / spread
        x -= centre_x
        y -= centre_y
        laid_x, laid_y = buffers.lengths.reshape(2, LANDMARK_COUNT, -1)
        for plane, of_x, of_y, centre in (
            (laid_x, real, -imaginary, self._centre[0]),
            (laid_y, imaginary, real, self._centre[1]),
        ):
            np.multiply(x, of_x, out=plane)
            plane += np.multiply(y, of_y, out=buffers.product)
            plane += centre
        buffers.lengths -= self._mean

    def _scaled(
        self, x: np.ndarray, y: np.ndarray, sound: np.ndarray, buffers: "_Buffers"
    ) -> tuple[np.ndarray, np.ndarray]:
        """Both coordinates (68, b) aligned, in face widths; NaN for faces that are not sound, or have no map."""
        right, left = FACE_WIDTH_LANDMARKS
        across, down = x[left] - x[right], y[left] - y[right]
        if self._target_axes is not None:
            m00, m01, m10, m11 = self._map(x[_ANCHORS], y[_ANCHORS])
            across, down = across * m00 + down * m10, across * m01 + down * m11
        width = np.sqrt(across * across + down * down)
        width[~(sound & (width > 0))] = np.nan
        if self._target_axes is None:
            return np.divide(x, width, out=x), np.divide(y, width, out=y)
        u, v = buffers.mapped
        for plane, of_x, of_y in ((u, m00, m10), (v, m01, m11)):
            np.multiply(x, of_x / width, out=plane)
            plane += np.multiply(y, of_y / width, out=buffers.product)
        return u, v

    def _map(self, x: np.ndarray, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """The four numbers (b,) of the affine map of anchors (31, b) onto the target, but for a common factor."""
        x, y = x - _MEAN @ x, y - _MEAN @ y
        xx, xy, yy = (np.einsum("af,af->f", p, q) for p, q in ((x, x), (x, y), (y, y)))
        (xu, xv), (yu, yv) = self._target_axes @ x, self._target_axes @ y
        spread = xx + yy
        for moment in (xx, xy, yy):
            moment /= spread
        # Model.predict refuses at 1e-12 in float64; below 1e-6 float32 has no digit left
        xx[~(xx * yy - xy * xy > 1e-6)] = np.nan
        return yy * xu - xy * yu, yy * xv - xy * yv, xx * yu - xy * xu, xx * yv - xy * xv

    def _measure(self, x: np.ndarray, y: np.ndarray, buffers: "_Buffers") -> None:
        """Fill in the edges' lengths about their mean."""
        lengths, (rises, starts) = buffers.lengths, buffers.ends
        # mode="clip": the default copies what it takes once more
        x.take(self._last, 0, out=lengths, mode="clip")
        lengths -= x.take(self._first, 0, out=starts, mode="clip")
        y.take(self._last, 0, out=rises, mode="clip")
        rises -= y.take(self._first, 0, out=starts, mode="clip")
        lengths *= lengths
        rises *= rises
        lengths += rises
        np.sqrt(lengths, out=lengths)
        lengths -= self._mean

    def _shrink(self, buffers: "_Buffers") -> None:
        """Fill in what denoising leaves of the lengths."""
        shown, share = len(self._signal), np.float32(1 / len(self._denoising.noise_axes))
        coordinates = np.matmul(self._axes, buffers.lengths)
        noise = np.einsum("tf,tf->f", coordinates[shown:], coordinates[shown:]) * share
        surplus = self._surplus @ np.square(coordinates[:shown]) - np.float32(self._denoising.usual)
        np.maximum(noise, surplus, out=noise)
        noise += np.float32(self._denoising.least)
        coordinates = np.add(coordinates[:shown], self._offset, out=buffers.inputs[:-1])
        gain = self._signal + noise
        coordinates *= np.divide(self._signal, gain, out=gain)


@dataclass(frozen=True, kw_only=True)
class _Sizes:
    """Rows of what a `BatchPredictor` fills for each face; ``lengths`` is None where these are the networks' inputs."""

    units: int
    inputs: int
    edges: int
    lengths: int | None
    outputs: int


class _Buffers:
    """Arrays for ``count`` faces of one `BatchPredictor`, which one thread fills again and again.

    What comes before the hidden units lies where they will: less memory is more of it in the cache (4 %).
    """

    def __init__(self, sizes: _Sizes, count: int) -> None:
        def rows(number: int) -> np.ndarray:
            return np.empty((number, count), np.float32)

        units, edges, points = sizes.units, sizes.edges, LANDMARK_COUNT
        self.count = count
        memory = rows(max(units, 2 * edges + 3 * points, 6 * points))
        self.hidden = memory[:units]
        ends, mapped, product = np.split(
            memory[: 2 * edges + 3 * points], [2 * edges, 2 * edges + 2 * points]
        )
        self.ends, self.mapped = ends.reshape(2, edges, count), mapped.reshape(2, points, count)
        self.product = product
        centred, single = np.split(memory[: 6 * points].ravel(), [4 * points * count])
        self.centred = centred.view(np.complex128).reshape(count, points)
        self.single = single.view(np.complex64).reshape(count, points)
        self.planes = rows(2 * points).reshape(2, points, count)
        self.inputs = rows(sizes.inputs)
        self.inputs[-1] = 1  # the bias's
        self.lengths = self.inputs[:-1] if sizes.lengths is None else rows(sizes.lengths)
        self.outputs = rows(sizes.outputs)

    def planes_of(self, points: np.ndarray) -> np.ndarray:
        """Both coordinates (2, 68, count) of points (count, 68, 2), about one of them.

        Centred before the precision drops, for pixels count from a picture's corner.
        """
        faces = points.view(np.complex128)[..., 0]
        np.subtract(faces, faces[:, _CENTRE : _CENTRE + 1], out=self.centred)
        self.single[:] = self.centred
        self.planes[:] = self.single.view(np.float32).reshape(points.shape).transpose(2, 1, 0)
        return self.planes


def about_mean(model: Model) -> tuple[np.ndarray, np.ndarray]:
    """Features (E,) that count as zero, and the bias (M*H,) that goes with them.

    Small numbers keep their digits in float32: raw features would lose two of seven.
    """
    networks = model.networks
    if networks.denoising is not None:
        return networks.denoising.origin, networks.b1
    mean = model.normalisation.feature_mean
    return mean, networks.b1 + networks.w1 @ mean


def _column(values: np.ndarray) -> np.ndarray:
    return values.astype(np.float32)[:, None]
