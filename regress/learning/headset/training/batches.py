"""Draws training batches: frames paired with neutral pictures, displaced at random, now and then without a camera."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import cv2
import numpy as np

from facegen.conventions import BLINK_INDICES, CAMERA_TERMS, CAMERA_TERMS_MIRRORED
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.recipe import PLAIN_DISPLACEMENT, HeadsetRecipe
from regress.learning.headset.training.resampling import reduced, warp_matrix
from regress.learning.headset.training.targets import outputs_of
from regress.learning.headset.training.traced import mirrored_points, positions_of, traced_points
from regress.runtime.headset.network.outputs import MIRROR, MIRROR_SIGN
from regress.runtime.headset.network.parts import encoder_owners, is_symmetric, mirror_partner

_SHUT = 0.5
"""Weight of eyeBlink from which an eye counts as shut: 5 % of the frames of datasets/headset.toml."""

_SEAT = 1.7
"""A neutral picture displaced as if from another seat is displaced this many times as far as a frame: donning
scatters by 1.5 to 2 mm, five pixels of 96 in an eye camera."""


@dataclass(frozen=True, kw_only=True)
class Batch:
    """What the networks see of n frames, and what they should say.

    Parameters
    ----------
    pictures, neutral : (n, cameras, size, size) uint8
        Mirrored where the camera uses another's encoder.
    present : (n, cameras) float32
    calibrated, same_seat : (n,) float32
        0 or 1; ``same_seat`` counts where ``calibrated``.
    positions : tuple of (n, P, 2) float32
        By camera, where its traced points lie: 0 to 1 across and down what the encoder sees, NaN beyond.
    outputs : (n, 56) float32
        Weights and gaze.
    plain : (n,) bool
        Frames whose light is left as it is.
    terms : (n, cameras, 15) float32
        ``CAMERA_TERMS`` of the cameras as the encoders see them, and 1; zeros where nothing is told. (n, cameras, 0)
        where nothing ever is.
    """

    pictures: np.ndarray
    neutral: np.ndarray
    present: np.ndarray
    calibrated: np.ndarray
    same_seat: np.ndarray
    positions: tuple[np.ndarray, ...]
    outputs: np.ndarray
    plain: np.ndarray
    terms: np.ndarray


class TrainingFrames:
    """Pictures and labels of arrays as batches are made of them, reduced to what the encoders need.

    ``traced`` are the points that a network traces already, by the camera that owns its encoder; without, those that
    pictures show.
    """

    def __init__(
        self,
        arrays: HeadsetArrays,
        recipe: HeadsetRecipe,
        rows: np.ndarray,
        traced: Mapping[str, np.ndarray] | None = None,
    ) -> None:
        names = tuple(camera.name for camera in arrays.cameras)
        self.rows = rows
        self.outputs = outputs_of(arrays)
        shut = arrays.weights[rows][:, BLINK_INDICES].max(axis=1) > _SHUT
        self._shown = np.concatenate([rows, np.repeat(rows[shut], recipe.shut_eyes)])
        self._recipe = recipe
        self._pictures = [reduced(arrays.pictures[name], recipe.square_size) for name in names]
        owners = encoder_owners(names)
        self._flipped = np.array([owner is not None for owner in owners.values()])
        self._mirror = recipe.mirror and is_symmetric(names)
        self._partner = np.array([names.index(mirror_partner(name)) if self._mirror else 0 for name in names])
        self.traced = dict(traced or traced_points(arrays, rows))
        if not recipe.points_loss:
            self.traced = {name: traced[:0] for name, traced in self.traced.items()}
        self._traced = [self.traced[owners[name] or name] for name in names]
        self._points = [arrays.points[name] for name in names]
        self._reduction = np.array(
            [
                (seen.shape[2] / camera.width, seen.shape[1] / camera.height)
                for seen, camera in zip(self._pictures, arrays.cameras, strict=True)
            ]
        )
        self._terms = [arrays.camera_terms[name] for name in names] if recipe.camera_terms else None
        self._own_seat = arrays.neutral_rows()
        self._other_seat = arrays.neutral_rows(other_seat=True)

    @property
    def batches(self) -> int:
        """Batches of an epoch."""
        return len(self._shown) // self._batch

    @property
    def _batch(self) -> int:
        return min(self._recipe.batch, len(self._shown))

    def draw_epoch(self, random: np.random.Generator) -> Iterator[Batch]:
        """All training rows, those with shut eyes again; the last few are left out where they fill no batch."""
        order, size = random.permutation(self._shown), self._batch
        for start in range(0, len(order) - size + 1, size):
            yield self._draw_batch(random, order[start : start + size])

    def plain_batch(self, rows: np.ndarray) -> Batch:
        """Rows as they are: nothing displaced, every camera present, no neutral pictures."""
        count, cameras = len(rows), len(self._pictures)
        still = _Affine(np.zeros((count, cameras, 2)), np.ones((count, cameras)), np.zeros((count, cameras)))
        straight, none = np.zeros(count, bool), np.zeros(count, np.float32)
        warps = self._warps(still, straight)
        return Batch(
            pictures=self._warped(rows, warps, straight),
            neutral=self._warped(np.full(count, -1), warps, straight),
            present=np.ones((count, cameras), np.float32),
            calibrated=none,
            same_seat=none,
            positions=self._positions(rows, warps, straight),
            outputs=self.outputs[rows],
            plain=~straight,
            terms=self._told(rows, straight),
        )

    def _draw_batch(self, random: np.random.Generator, rows: np.ndarray) -> Batch:
        recipe, count, cameras = self._recipe, len(rows), len(self._pictures)
        mirrored = (random.random(count) < 0.5) & self._mirror
        kind, calibrated = random.random(count), random.random(count) >= recipe.calibration_dropout
        other = (kind < recipe.other_seat) & (self._other_seat[rows] >= 0)
        # drawn only where it is asked for, so that trainings without it are those of before
        plain = random.random(count) < recipe.plain if recipe.plain else np.zeros(count, bool)
        displaced_by = np.where(plain, PLAIN_DISPLACEMENT, 1.0)
        frame = _draw_affine(random, recipe, displaced_by, cameras)
        seat = _draw_affine(random, recipe, displaced_by * np.where(other, 1.0, _SEAT), cameras)
        displaced = other | (kind >= 1 - recipe.jitter_neutral)
        neutral_rows = np.where(other, self._other_seat[rows], self._own_seat[rows])
        calibrated &= (neutral_rows >= 0) & recipe.calibration
        present = random.random((count, cameras)) >= recipe.camera_dropout
        present[~present.any(axis=1)] = True
        outputs = self.outputs[rows]
        terms = self._told(rows, mirrored)
        if self._terms is not None:  # drawn only where it is asked for, as above
            terms[..., :-1] += recipe.terms_noise * random.standard_normal(terms[..., :-1].shape)
            terms *= random.random((count, 1, 1)) >= recipe.terms_dropout
        warps, neutral_warps = (
            self._warps(affine, mirrored) for affine in (frame, _where(displaced, seat, frame))
        )
        return Batch(
            pictures=self._warped(rows, warps, mirrored),
            neutral=self._warped(np.where(calibrated, neutral_rows, -1), neutral_warps, mirrored),
            present=present.astype(np.float32),
            calibrated=calibrated.astype(np.float32),
            same_seat=(~displaced).astype(np.float32),
            positions=self._positions(rows, warps, mirrored),
            outputs=np.where(mirrored[:, None], outputs[:, MIRROR] * MIRROR_SIGN, outputs),
            plain=plain,
            terms=terms,
        )

    def _told(self, rows: np.ndarray, mirrored: np.ndarray) -> np.ndarray:
        """Terms (n, cameras, 15) float32 of the cameras of rows, as the encoders see them; none without them."""
        sources = self._sources(mirrored)
        if self._terms is None:
            return np.zeros((*sources.shape, 0), np.float32)
        terms = np.ones((*sources.shape, len(CAMERA_TERMS) + 1), np.float32)
        for camera, source in enumerate(sources.T):
            told = np.stack([self._terms[one][row] for one, row in zip(source, rows, strict=True)])
            turned = (mirrored != self._flipped[camera])[:, None]
            terms[:, camera, :-1] = np.where(turned, told * CAMERA_TERMS_MIRRORED, told)
        return terms

    def _sources(self, mirrored: np.ndarray) -> np.ndarray:
        """(n, cameras) of whose pictures each camera sees: a mirrored frame's are its partner's."""
        own = np.arange(len(self._pictures))
        return np.where(mirrored[:, None], self._partner, own)

    def _warps(self, affine: "_Affine", mirrored: np.ndarray) -> np.ndarray:
        """(n, cameras, 2, 3) from the encoders' pixels to the reduced pictures'."""
        sources = self._sources(mirrored)
        warps = np.zeros((*sources.shape, 2, 3))
        for place, camera in np.ndindex(*sources.shape):
            height, width = self._pictures[sources[place, camera]].shape[1:]
            warps[place, camera] = warp_matrix(
                width,
                height,
                self._recipe.square_size,
                shift=affine.shift[place, camera],
                scale=affine.scale[place, camera],
                angle_rad=affine.angle_rad[place, camera],
                flipped=bool(self._flipped[camera] != mirrored[place]),
            )
        return warps

    def _warped(self, rows: np.ndarray, warps: np.ndarray, mirrored: np.ndarray) -> np.ndarray:
        """Pictures (n, cameras, size, size) uint8 of rows; -1 gives black ones."""
        sources, size = self._sources(mirrored), self._recipe.square_size
        warped = np.zeros((*sources.shape, size, size), np.uint8)
        for place, camera in np.ndindex(*sources.shape):
            if rows[place] >= 0:
                warped[place, camera] = cv2.warpAffine(
                    self._pictures[sources[place, camera]][rows[place]],
                    warps[place, camera],
                    (size, size),
                    flags=cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP,
                    borderMode=cv2.BORDER_REPLICATE,
                )
        return warped

    def _positions(self, rows: np.ndarray, warps: np.ndarray, mirrored: np.ndarray) -> tuple[np.ndarray, ...]:
        """Positions (n, P, 2) of each camera's traced points in its warped pictures."""
        by_camera = []
        for camera, sources in enumerate(self._sources(mirrored).T):
            points = np.stack([self._points[source][row] for source, row in zip(sources, rows, strict=True)])
            turned, traced = mirrored != self._flipped[camera], self._traced[camera]
            by_camera.append(
                positions_of(
                    points,
                    np.where(turned[:, None], mirrored_points(traced), traced),
                    warps[:, camera],
                    scale=self._reduction[sources],
                    size=self._recipe.square_size,
                )
            )
        return tuple(by_camera)


@dataclass(frozen=True)
class _Affine:
    shift: np.ndarray
    scale: np.ndarray
    angle_rad: np.ndarray


def _draw_affine(
    random: np.random.Generator, recipe: HeadsetRecipe, factor: np.ndarray, cameras: int
) -> _Affine:
    """Displacements of each row's cameras, ``factor`` (n,) times the recipe's."""
    count, factor = len(factor), factor[:, None]
    return _Affine(
        factor[..., None] * recipe.shift * random.standard_normal((count, cameras, 2)),
        np.exp(factor * recipe.scale * random.standard_normal((count, cameras))),
        factor * np.deg2rad(recipe.rotation_deg) * random.standard_normal((count, cameras)),
    )


def _where(condition: np.ndarray, first: _Affine, second: _Affine) -> _Affine:
    chosen = condition[:, None]
    return _Affine(
        np.where(chosen[..., None], first.shift, second.shift),
        np.where(chosen, first.scale, second.scale),
        np.where(chosen, first.angle_rad, second.angle_rad),
    )
