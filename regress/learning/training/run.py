"""Trains a model: features, networks with and without a neutral frame, and the record."""

import dataclasses
from dataclasses import dataclass

import numpy as np
from threadpoolctl import threadpool_limits

from regress.errors import Interrupted
from regress.learning.levenberg_marquardt import EVIDENCE_ROUNDS, EVIDENCE_STEPS
from regress.learning.networks import fold
from regress.learning.progress import Progress, joined
from regress.learning.training.baseline import fit_baseline
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.fitting import Fit, fit_networks
from regress.learning.training.gain import stretched
from regress.learning.training.linear_share import with_linear_share
from regress.learning.training.preparation import Prepared, prepare
from regress.learning.training.recipes import Recipe
from regress.learning.training.record import training_record
from regress.runtime.features import (
    Features,
    closed_under_mirror,
    depths_of,
    load_reference_shape,
    mean_shape,
)
from regress.runtime.model import Calibrated, Model, symmetrised
from regress.runtime.networks import FoldedNetworks
from regress.targets import NETWORKS


def train(
    dataset: KeypointDataset, recipe: Recipe, *, seed: int = 0, progress: Progress | None = None
) -> Model:
    """Train all networks on a dataset; the same inputs give the same model on one machine.

    Parameters
    ----------
    dataset
        Points, weights and splits.
    recipe
        One of ``RECIPES``, or another.
    seed
        Of the starts and of the rows on which alphas are compared.
    progress
        Called as work goes on, from any thread.

    Raises
    ------
    Interrupted
        On Ctrl-C.
    """
    try:
        return _trained(dataset, recipe, seed, progress)
    except KeyboardInterrupt:
        raise Interrupted("training was stopped; no model was written") from None


def _trained(dataset: KeypointDataset, recipe: Recipe, seed: int, progress: Progress | None) -> Model:
    reference = load_reference_shape()
    features = Features(
        alignment=recipe.alignment,
        mean_shape=mean_shape(dataset.points[dataset.rows("train")]),
        edges=closed_under_mirror(reference.edges) if recipe.denoise else reference.edges,
        reference_name=reference.name,
        reference_sha256=reference.sha256,
        depth=depths_of(reference) if recipe.undo_turn else None,
    )
    both = recipe.calibrated and dataset.has_neutral_frames
    progress = joined(progress, _work(len(dataset.rows("train")), recipe, both=both))
    alone = fit_set(dataset, features, recipe, calibrated=False, seed=seed, progress=progress)
    compared = None
    beside = beside_neutral(features, recipe)
    if both:
        with _one_thread():
            compared = fit_set(dataset, beside, recipe, calibrated=True, seed=seed, progress=progress)
    model = Model(
        recipe=recipe.name,
        table=NETWORKS,
        features=features,
        normalisation=alone.prepared.normalisation,
        networks=alone.networks,
        calibrated=None
        if compared is None
        else Calibrated(
            features=beside, normalisation=compared.prepared.normalisation, networks=compared.networks
        ),
    )
    if recipe.symmetric:
        model = symmetrised(model)
    if recipe.calibrated_gain and model.calibrated is not None:
        with _one_thread():
            model = stretched(model, dataset)
    fits = {"alone": alone.fit} if compared is None else {"alone": alone.fit, "calibrated": compared.fit}
    rows = len(alone.prepared.splits["train"].inputs)
    record = training_record(model, dataset, recipe, seed=seed, fits=fits, training_rows=rows)
    return dataclasses.replace(model, record=record)


def _work(rows: int, recipe: Recipe, *, both: bool) -> dict[str, float]:
    """Steps times rows of every stage, by its name."""
    rows *= (2 if recipe.mirror else 1) * (1 if recipe.noise is None else recipe.noise.copies)
    searched, steps = min(recipe.search_rows, rows), min(recipe.search_steps, recipe.steps)
    if recipe.strengths == "evidence":
        stages = {"evidence": (EVIDENCE_ROUNDS * EVIDENCE_STEPS + steps) * searched}
    else:
        stages = {f"alpha {alpha:g}": steps * searched for alpha in recipe.alphas}
    stages["all rows"] = recipe.steps * rows
    return stages | ({f"calibrated, {name}": work for name, work in stages.items()} if both else {})


def _one_thread() -> threadpool_limits:
    """Products of large matrices in one thread: with two they have other last bits, and the networks other weights.

    Not for the networks of a frame alone: their weights stay those of earlier versions, with as many threads as then.
    """
    return threadpool_limits(limits=1, user_api="blas")


def beside_neutral(features: Features, recipe: Recipe) -> Features:
    """What the networks see that compare with a neutral frame."""
    if recipe.calibrated_alignment != "stable":
        return dataclasses.replace(features, alignment=recipe.calibrated_alignment)
    # the neutral frame is turned as the face is, more or less: what the turn moves cancels better than it is undone
    return dataclasses.replace(
        features, alignment="stable", edges=np.empty((0, 2), dtype=np.int64), depth=None
    )


@dataclass(frozen=True, kw_only=True)
class FittedSet:
    """One set of networks, and what it was fitted to.

    Parameters
    ----------
    prepared
        Training data, standardised.
    fit
        How the fit went.
    networks
        Folded, on raw features or their differences.
    """

    prepared: Prepared
    fit: Fit
    networks: FoldedNetworks


def fit_set(
    dataset: KeypointDataset,
    features: Features,
    recipe: Recipe,
    *,
    calibrated: bool,
    seed: int,
    progress: Progress | None,
) -> FittedSet:
    """One set of 31 networks: for a frame alone, or beside a neutral one."""
    prepared = prepare(
        dataset,
        features,
        mirror=recipe.mirror,
        noise=recipe.calibrated_noise if calibrated else recipe.noise,
        calibrated=calibrated,
        denoise=recipe.calibrated_denoise if calibrated else recipe.denoise,
        whitening=recipe.calibrated_whitening if calibrated else 0.0,
        seed=seed,
    )
    stages = progress
    if progress is not None and calibrated:

        def stages(stage: str, done: int, total: int) -> None:
            progress(f"calibrated, {stage}", done, total)

    fit = fit_networks(prepared, recipe, seed=seed, progress=stages)
    normalisation = prepared.normalisation
    networks = fold(
        fit.layout,
        fit.parameters,
        outputs=tuple(len(network.outputs) for network in NETWORKS),
        rotation=prepared.rotation,
        input_mean=prepared.input_mean,
        input_std=prepared.input_std,
        target_mean=normalisation.target_mean,
        target_std=normalisation.target_std,
    )
    if prepared.denoising is not None:  # on places along the axes instead of the features made of them
        networks = dataclasses.replace(
            networks, w1=networks.w1 @ prepared.denoising.back.T, denoising=prepared.denoising
        )
    elif calibrated and recipe.calibrated_linear:
        ridge = fit_baseline(
            dataset, features, mirror=recipe.mirror, noise=recipe.calibrated_noise, calibrated=True, seed=seed
        )
        networks = with_linear_share(networks, ridge, recipe.calibrated_linear)
    return FittedSet(prepared=prepared, fit=fit, networks=networks)
