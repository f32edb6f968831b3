"""What every exported file computes, as plain arrays: the form between a model and the exporters.

A face's 68 points become 52 weights in five steps; an exporter only writes them down in its language:

0. ``points = points - depth (turn points)``, depth a column and turn a row of 68: the turn of the head is undone. Both
   are 0 where a model leaves it;
1. ``map``: with P the anchor points less their mean and R the reference, a 2 x 2 matrix that points (rows) are
   multiplied by. Where ``alignment`` is ``"affine"`` it is ``inverse(P'P) P'R``, where it is ``"none"`` the identity.
   Where it is ``"stable"`` it turns and scales: ``[[c, s], [-s, c]]`` with ``c`` the sum of ``p_x r_x + p_y r_y`` and
   ``s`` that of ``p_x r_y - p_y r_x``, both over the sum of ``p_x^2 + p_y^2``;
2. ``features``: lengths of the edges under the map, over the face's width under the map; or, where ``alignment`` is
   ``"stable"``, x and y of each point less the anchors' mean under the map. Less ``feature_mean``;
   and where a model denoises: ``(places + offset) signal / (signal + noise)`` with ``places = axes features`` and
   ``noise`` the mean square of ``noise_axes features``, or ``surplus places^2 - usual`` where that is larger, plus
   ``least``, are its features from here on;
3. ``hidden = tanh(hidden_weights features + hidden_bias)``, network by network;
4. ``weights = output_weights hidden + output_bias``, clipped to `WEIGHT_RANGE`; shapes without a network
   are 0.

A model that compares faces with a person's neutral face has a second set of all these numbers, for when that face is
known: from the features of step 2 those of the neutral face, measured alike, are subtracted as well. A neutral face
of zeros is none.

A face with a missing point gives NaN throughout, as in ``Model.predict``; a neutral face with one is refused where a
language can, and gives NaN elsewhere, and so does one that is no face (`outline`).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from regress import __version__
from regress.exporters.answering import Answering, FormulaNetwork
from regress.exporters.measures import measures_of, place_of
from regress.runtime.features import Features
from regress.runtime.model import Model, Normalisation
from regress.runtime.networks import FoldedNetworks
from regress.targets import Network

FORMAT_VERSION = 5
"""Of the JSON and NPZ files; raised by any change that breaks a reader."""

WEIGHT_RANGE = (0.0, 1.0)


@dataclass(frozen=True, kw_only=True)
class Formula:
    """Everything between points and weights, and the words that go with it.

    Parameters
    ----------
    alone
        Networks for a face by itself.
    calibrated
        Those for a face whose person's neutral face is known; None where a model has none.
    about
        Words for people and tools: ``recipe``, ``dataset``, ``dataset_sha256``, ``licence``, ``program``.
    """

    alone: Answering
    calibrated: Answering | None
    about: dict[str, str]

    @property
    def as_paper(self) -> bool:
        """Whether the files are the paper's, whose bytes stay as they were."""
        return self.calibrated is None and self.about["recipe"] == "paper"


def formula_of(model: Model) -> Formula:
    """Write a model down as a formula."""
    calibrated = model.calibrated
    return Formula(
        alone=_answering(
            model.table,
            model.features,
            model.normalisation,
            model.networks,
            # points are measured from their anchors' mean; in a difference that cancels
            place=place_of(model.features),
        ),
        calibrated=None
        if calibrated is None
        else _answering(
            model.table, calibrated.features, calibrated.normalisation, calibrated.networks, place=0.0
        ),
        about=_about(model),
    )


def _answering(
    table: Sequence[Network],
    features: Features,
    normalisation: Normalisation,
    networks: FoldedNetworks,
    *,
    place: np.ndarray | float,
) -> Answering:
    denoising = networks.denoising
    mean = normalisation.feature_mean if denoising is None else denoising.origin

    def network(index: int, described: Network) -> FormulaNetwork:
        hidden = slice(index * networks.hidden, (index + 1) * networks.hidden)
        outputs = networks.network_of_output == index
        weights = networks.w1[hidden]
        return FormulaNetwork(
            name=described.key,
            outputs=described.outputs,
            hidden_weights=weights,
            # behind a filter the weights act on what has no mean
            hidden_bias=networks.b1[hidden] + (0 if denoising else weights @ mean),
            output_weights=networks.w2[outputs],
            output_bias=networks.b2[outputs],
        )

    return Answering(
        measures=measures_of(features),
        feature_mean=mean - place,
        denoising=denoising,
        networks=tuple(network(index, described) for index, described in enumerate(table)),
    )


def _about(model: Model) -> dict[str, str]:
    record = model.record
    name, sha256, data_licence, licence = "unknown", "unknown", "licence of the data unknown", "unknown"
    if record is not None:
        name, sha256 = record.dataset.name, record.dataset.keypoints_sha256
        data_licence, licence = record.dataset.licence, record.licence
    return {
        "recipe": model.recipe,
        "dataset": name,
        "dataset_sha256": sha256,
        # what the numbers derive from comes first: a rig's terms may bind whoever ships them
        "licence": f"{data_licence}; weights: {licence}",
        "program": f"regress {__version__}",
    }
