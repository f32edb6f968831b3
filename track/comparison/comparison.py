"""Figures of one recording against another that is taken for the truth."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES
from track.comparison.alignment import MOVING, Alignment, align, at
from track.errors import InputError

GAP_S = 0.1
"""Of the truth: a frame farther from its neighbours has none to be compared with."""


@dataclass(frozen=True, kw_only=True)
class ShapeFigures:
    """Of one shape.

    Parameters
    ----------
    r
        Pearson's correlation; None where one of the two does not move.
    mae
        Mean absolute difference.
    moved
        Standard deviation of the truth.
    """

    r: float | None
    mae: float
    moved: float


@dataclass(frozen=True, kw_only=True, eq=False)
class Comparison:
    """Two recordings laid upon one another.

    Parameters
    ----------
    alignment
        By how much the truth is later.
    shapes
        Figures by ARKit's names.
    rows : (n,) int
        Of the tracked frames that have a truth.
    truth : (n, 52) float64
        Of those frames.
    """

    alignment: Alignment
    shapes: Mapping[str, ShapeFigures]
    rows: np.ndarray
    truth: np.ndarray

    @property
    def median_r(self) -> float | None:
        """Over shapes that the truth moves."""
        found = [each.r for each in self.shapes.values() if each.r is not None]
        return float(np.median(found)) if found else None


def compare_weights(
    tracked_s: np.ndarray, tracked: np.ndarray, truth_s: np.ndarray, truth: np.ndarray
) -> Comparison:
    """Align two recordings and compare them shape by shape.

    Parameters
    ----------
    tracked_s, truth_s : (n,), (m,) float64
        By one clock.
    tracked, truth : (n, 52), (m, 52) float64

    Raises
    ------
    InputError
        Where one is empty, or they do not fit together.
    """
    for what, times_s, do in (
        ("camera", tracked_s, "sit before it in good light"),
        (
            "phone",
            truth_s,
            "enter this machine's address and that port in Live Link Face, and start it there first",
        ),
    ):
        if len(times_s) < 2:
            raise InputError(
                f"the {what} gave {len(times_s)} frames with a face, and two or more are needed: {do}"
            )
    alignment = align(tracked_s, tracked, truth_s, truth)
    if not alignment.certain:
        raise InputError(
            f"camera and phone could not be aligned: over {alignment.shapes} moving shapes they agree by "
            f"{alignment.correlation:.2f} at best; record ten seconds or more, and blink, talk and smile"
        )
    wanted_s = tracked_s + alignment.delay_s
    after = np.clip(np.searchsorted(truth_s, wanted_s), 1, len(truth_s) - 1)
    near = (
        (truth_s[after] - truth_s[after - 1] <= GAP_S) & (wanted_s >= truth_s[0]) & (wanted_s <= truth_s[-1])
    )
    rows = np.flatnonzero(near)
    aligned = at(wanted_s[rows], truth_s, truth)
    figures = {
        name: _figures(tracked[rows, column], aligned[:, column]) for column, name in enumerate(BLENDSHAPES)
    }
    return Comparison(alignment=alignment, shapes=figures, rows=rows, truth=aligned)


def _figures(tracked: np.ndarray, truth: np.ndarray) -> ShapeFigures:
    moved = float(truth.std())
    both = moved > MOVING and tracked.std() > 1e-9
    return ShapeFigures(
        r=float(np.corrcoef(tracked, truth)[0, 1]) if both else (0.0 if moved > MOVING else None),
        mae=float(np.abs(tracked - truth).mean()),
        moved=moved,
    )
