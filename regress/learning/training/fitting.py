"""Fits all networks: groups of them in threads, the L2 strength of each chosen on the validation split."""

import os
import threading
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, replace

import numpy as np
from threadpoolctl import threadpool_limits

from regress.errors import Interrupted
from regress.learning.levenberg_marquardt import (
    EVIDENCE_ROUNDS,
    EVIDENCE_STEPS,
    Result,
    Settings,
    minimise,
    minimise_with_evidence,
)
from regress.learning.networks import (
    Layout,
    NetworkProblem,
    Rows,
    draw_nguyen_widrow,
    draw_ridge_knots,
    ridge_directions,
)
from regress.learning.progress import Progress
from regress.learning.training.preparation import WIDEST, Prepared, Split, network_columns, used_outputs
from regress.learning.training.recipes import Recipe
from regress.targets import NETWORKS

_GROUPS: tuple[np.ndarray, ...] = tuple(np.arange(first, len(NETWORKS), 6) for first in range(6))
"""Networks fitted together. Fixed, whatever the cores: matrix products of other shapes give other last bits.
Five to a group reach three quarters of the speed of all 31 in one; six groups fill 2, 3 and 6 cores."""

_START_ROWS = 3000
"""Rows on which a start's output weights are fitted: 21 unknowns need no more."""

_FIRST_STRENGTH = 3.0
"""Where the evidence begins; it moves by powers of ten within a round."""

_RIDGE_FACTOR = 3.0
"""A start's ridge strength in units of alpha."""


@dataclass(frozen=True, kw_only=True)
class Fit:
    """All networks, fitted.

    Parameters
    ----------
    layout
        Sizes.
    parameters : (31, P) float32
    alphas : (31,) float64
        The chosen L2 strengths.
    tried : tuple of A floats
        Those tried on the search's rows; none where the evidence chose.
    search_errors : (A, 31) float64
        Their validation errors.
    groups
        Networks of each group.
    results
        What came of each group on all rows; validation is monitored first, test second.
    """

    layout: Layout
    parameters: np.ndarray
    alphas: np.ndarray
    tried: tuple[float, ...]
    search_errors: np.ndarray
    groups: tuple[np.ndarray, ...]
    results: tuple[Result, ...]


def fit_networks(prepared: Prepared, recipe: Recipe, *, seed: int, progress: Progress | None = None) -> Fit:
    """Choose an alpha for each network on some rows, then go on with it on all.

    Networks want alphas up to 40 times apart: one for all would overfit some and blur others. Every alpha
    starts afresh: warm starts from one alpha to the next end 10 to 20 % worse. From some rows to all rows at the same
    alpha, the search's networks are the start: half the steps, the same errors.
    """
    train, validation, test = (prepared.splits[name] for name in ("train", "validation", "test"))
    layout = Layout(inputs=train.inputs.shape[1], hidden=recipe.hidden, outputs=WIDEST)
    order = np.random.default_rng(seed).permutation(len(train.inputs))
    searched = train.take(np.sort(order[: recipe.search_rows]))
    few, held, watched = searched.network_rows(), validation.network_rows(), test.network_rows()
    settings = Settings(steps=recipe.steps, patience=recipe.patience, improvement=recipe.improvement)
    brief = replace(settings, steps=min(recipe.search_steps, recipe.steps))

    def search(alpha: float) -> tuple[Result, ...]:
        """What comes of one alpha on some rows."""
        alphas = np.full(len(NETWORKS), alpha)
        start = _start(searched, prepared.rotation, layout, recipe, alpha, seed)
        counter = _StepCounter(progress, f"alpha {alpha:g}", brief.steps)
        return _fit_groups(layout, few, (held,), start, alphas, brief, counter)

    with threadpool_limits(limits=1, user_api="blas"):
        if recipe.strengths == "evidence":
            tried = ()
            start = _start(searched, prepared.rotation, layout, recipe, _FIRST_STRENGTH, seed)
            counter = _StepCounter(progress, "evidence", EVIDENCE_ROUNDS * EVIDENCE_STEPS + brief.steps)
            alphas = np.full(len(NETWORKS), _FIRST_STRENGTH)
            fits = _fit_groups(layout, few, (held,), start, alphas, brief, counter, evidence=True)
            errors = np.empty((0, len(NETWORKS)))
            start = _gathered(result.parameters for result in fits)
            alphas = _gathered(result.alpha for result in fits)
        else:
            tried = recipe.alphas
            trials = [search(alpha) for alpha in tried]
            errors = np.stack([_gathered(result.error for result in trial) for trial in trials])
            best = errors.argmin(axis=0)
            start = np.stack([_gathered(result.parameters for result in trial) for trial in trials])
            start = start[best, np.arange(len(NETWORKS))]
            alphas = np.array(tried)[best]
        counter = _StepCounter(progress, "all rows", settings.steps)
        results = _fit_groups(layout, train.network_rows(), (held, watched), start, alphas, settings, counter)
    return Fit(
        layout=layout,
        parameters=_gathered(result.parameters for result in results),
        alphas=alphas,
        tried=tried,
        search_errors=errors,
        groups=_GROUPS,
        results=results,
    )


def _start(
    split: Split, rotation: np.ndarray, layout: Layout, recipe: Recipe, alpha: float, seed: int
) -> np.ndarray:
    """Parameters (31, P) with which the networks of one alpha begin."""
    few = split.take(slice(_START_ROWS))
    sources = [split]
    if split.exact.any() and not split.exact.all():
        sources.append(split.take(split.exact))
    directions = [ridge_directions(rows.inputs, rows.targets, _RIDGE_FACTOR * alpha) for rows in sources]
    rows = []
    for number, columns in enumerate(network_columns()):
        rng = np.random.default_rng([seed, number])
        if recipe.start == "nguyen_widrow":
            w1, w2 = draw_nguyen_widrow(layout=layout, rotation=rotation, rng=rng)
        else:
            w1, w2 = draw_ridge_knots(
                layout=layout,
                inputs=few.inputs,
                targets=few.targets[:, columns],
                directions=np.concatenate([source[:, columns] for source in directions], axis=1),
                alpha=alpha,
                rng=rng,
            )
        rows.append(layout.join(w1[None], w2[None])[0])
    return np.array(rows, dtype=np.float32)


def _fit_groups(
    layout: Layout,
    train: Rows,
    held_out: tuple[Rows, ...],
    start: np.ndarray,
    alphas: np.ndarray,
    settings: Settings,
    counter: "_StepCounter",
    *,
    evidence: bool = False,
) -> tuple[Result, ...]:
    used = used_outputs()

    def fit(group: np.ndarray) -> Result:
        problem = NetworkProblem(
            layout=layout,
            used=used[group],
            train=Rows(inputs=train.inputs, targets=train.targets[group]),
            held_out=tuple(Rows(inputs=rows.inputs, targets=rows.targets[group]) for rows in held_out),
        )
        taken = 0

        def count(number: int, going: int) -> None:
            nonlocal taken
            taken += 1  # of all rounds, where the evidence chooses
            counter.count_step()

        solve = minimise_with_evidence if evidence else minimise
        result = solve(problem, start[group], alphas[group], settings, on_step=count)
        counter.finish(taken)
        return result

    # Matrix products release Python's lock, so threads suffice; OpenBLAS itself keeps to one thread each.
    with ThreadPoolExecutor(max_workers=min(len(_GROUPS), os.cpu_count() or 1)) as threads:
        try:
            return tuple(threads.map(fit, _GROUPS))
        except BaseException:
            counter.stop()  # Ctrl-C arrives in this thread alone: the others stop at their next step
            raise


def _gathered(values: Iterable[np.ndarray]) -> np.ndarray:
    """Rows of all groups, back in the networks' order."""
    return np.concatenate(list(values))[np.argsort(np.concatenate(_GROUPS))]


class _StepCounter:
    """Counts the steps of all groups of one stage, and tells them to stop."""

    def __init__(self, progress: Progress | None, name: str, steps: int) -> None:
        self._stopped = False
        self._progress, self._name = progress, name
        self._steps, self._done = steps, 0
        self._lock = threading.Lock()

    def stop(self) -> None:
        """End the groups at their next step; nothing is said of progress any more."""
        with self._lock:
            self._stopped = True

    def count_step(self) -> None:
        """Count a group's step.

        Raises
        ------
        Interrupted
            Where the groups were stopped.
        """
        if self._stopped:
            raise Interrupted("training was stopped; no model was written")
        self._advance(1)

    def finish(self, steps: int) -> None:
        self._advance(self._steps - steps)

    def _advance(self, steps: int) -> None:
        with self._lock:
            self._done += steps
            if self._progress is not None and not self._stopped:
                self._progress(self._name, self._done, self._steps * len(_GROUPS))
