"""Networks: folding, the ridge baseline, starts, and the table of 31."""

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.learning.networks import (
    Layout,
    NetworkProblem,
    Rows,
    draw_nguyen_widrow,
    draw_ridge_knots,
    fit_ridge,
    fold,
    ridge_coefficients,
    ridge_directions,
)
from regress.runtime.networks import evaluate
from regress.targets import NETWORKS, NOT_OBSERVABLE, OUTPUTS, REGIONS, VISIBLE_SHAPES, observability


def test_31_networks_give_every_shape_but_the_tongue_once():
    assert len(NETWORKS) == 31
    assert len({network.key for network in NETWORKS}) == 31
    assert len(OUTPUTS) == len(set(OUTPUTS)) == 51
    assert set(OUTPUTS) | set(NOT_OBSERVABLE) == set(BLENDSHAPES)
    sizes = {region: sum(network.region == region for network in NETWORKS) for region in REGIONS}
    assert sizes == {"eyes": 7, "jaw": 3, "mouth": 7, "lips": 8, "brows": 3, "cheeks": 2, "nose": 1}


def test_thirty_shapes_are_visible():
    assert len(VISIBLE_SHAPES) == 30
    assert observability("jawOpen") == "visible"
    assert observability("cheekPuff") == "weak"
    assert observability("tongueOut") == "not_observable"


def test_folded_networks_give_what_the_unfolded_ones_gave():
    rng = np.random.default_rng(0)
    layout = Layout(inputs=7, hidden=4, outputs=2)
    outputs = (1, 2, 2)
    parameters = rng.normal(size=(3, layout.parameters))
    rotation, _ = np.linalg.qr(rng.normal(size=(7, 7)))
    input_mean, input_std = rng.normal(size=7), rng.uniform(0.5, 2, 7)
    target_mean, target_std = rng.normal(size=5), rng.uniform(0.5, 2, 5)
    raw = rng.normal(size=(11, 7))
    folded = fold(
        layout,
        parameters,
        outputs=outputs,
        rotation=rotation,
        input_mean=input_mean,
        input_std=input_std,
        target_mean=target_mean,
        target_std=target_std,
    )
    w1, w2 = layout.split(parameters)
    expected = []
    for network, count in enumerate(outputs):
        x = ((raw - input_mean) / input_std) @ rotation
        hidden = 1 / (1 + np.exp(-(x @ w1[network, :, :-1].T + w1[network, :, -1])))
        expected.append((hidden @ w2[network, :, :-1].T + w2[network, :, -1])[:, :count])
    expected = np.concatenate(expected, axis=1) * target_std + target_mean
    assert np.allclose(evaluate(folded, raw), expected)


def test_the_fused_product_is_a_loop_over_networks():
    rng = np.random.default_rng(1)
    layout = Layout(inputs=5, hidden=3, outputs=2)
    same = {
        "input_mean": np.zeros(5),
        "input_std": np.ones(5),
        "target_mean": np.zeros(4),
        "target_std": np.ones(4),
    }
    folded = fold(layout, rng.normal(size=(2, layout.parameters)), outputs=(2, 2), rotation=np.eye(5), **same)
    features = rng.normal(size=(6, 5))
    looped = np.empty((6, 4))
    for output, network in enumerate(folded.network_of_output):
        units = slice(network * 3, network * 3 + 3)
        hidden = np.tanh(features @ folded.w1[units].T + folded.b1[units])
        looped[:, output] = hidden @ folded.w2[output] + folded.b2[output]
    assert np.allclose(evaluate(folded, features), looped)
    assert np.count_nonzero(folded.block_w2) == folded.w2.size


def test_ridge_picks_each_targets_strength_on_held_out_rows():
    rng = np.random.default_rng(2)
    inputs, held = rng.normal(size=(60, 20)), rng.normal(size=(400, 20))
    truth = np.zeros((20, 2))
    truth[0, 0] = 1.0  # the second target is noise alone
    targets = inputs @ truth + rng.normal(size=(60, 2)) * [0.01, 1]
    ridge = fit_ridge(inputs, targets, held, held @ truth + rng.normal(size=(400, 2)) * [0.01, 1])
    assert ridge.strengths[0] < 1 < ridge.strengths[1]
    chosen = ridge_coefficients(inputs, targets, float(ridge.strengths[1]))[:, 1]
    assert np.allclose(ridge.coefficients[:, 1], chosen)


def test_ridge_knots_start_no_worse_than_ridge():
    rng = np.random.default_rng(3)
    inputs = rng.normal(size=(500, 12))
    targets = np.maximum(inputs @ rng.normal(size=(12, 2)) - 1, 0)
    targets = (targets - targets.mean(axis=0)) / targets.std(axis=0)
    coefficients = ridge_coefficients(inputs, targets, 3.0)
    layout = Layout(inputs=12, hidden=14, outputs=2)
    w1, w2 = draw_ridge_knots(
        layout=layout,
        inputs=inputs,
        targets=targets,
        directions=ridge_directions(inputs, targets, 3.0),
        alpha=1.0,
        rng=rng,
    )
    columns = np.concatenate([inputs.T, np.ones((1, 500))])
    rows = Rows(inputs=columns, targets=targets.T[None])
    problem = NetworkProblem(layout=layout, used=np.ones((1, 2)), train=rows, held_out=(rows,))
    error = problem.monitor(layout.join(w1[None], w2[None]), np.array([0]))[0, 0]
    assert error < np.mean((inputs @ coefficients - targets) ** 2)


def test_ridge_directions_have_outputs_of_unit_spread():
    rng = np.random.default_rng(3)
    inputs = rng.normal(size=(200, 12)) * np.logspace(0, -3, 12)
    targets = inputs @ rng.normal(size=(12, 2))
    directions = ridge_directions(inputs, targets, 0.1)
    assert (inputs @ directions).std(axis=0) == pytest.approx(1)
    coefficients = ridge_coefficients(inputs, targets, 0.1)
    assert np.allclose(directions / directions[0], coefficients / coefficients[0])


def test_directions_of_exact_rows_keep_what_displaced_rows_flood():
    # The target lies along an axis of little variance, which displacement floods in half of the rows.
    rng = np.random.default_rng(4)
    inputs = rng.normal(size=(2000, 6)) * [1, 1, 1, 1, 1, 0.05]
    targets = inputs[:, 5:] / 0.05
    exact = np.arange(2000) < 1000
    inputs[~exact, 5] += rng.normal(size=1000)
    layout = Layout(inputs=6, hidden=12, outputs=1)
    of_all = ridge_directions(inputs, targets, 1.0)
    of_exact = ridge_directions(inputs[exact], targets[exact], 1.0)
    errors = []
    for directions in (of_all, np.concatenate([of_all, of_exact], axis=1)):
        w1, w2 = draw_ridge_knots(
            layout=layout,
            inputs=inputs,
            targets=targets,
            directions=directions,
            alpha=1.0,
            rng=np.random.default_rng(0),
        )
        hidden = 1 / (1 + np.exp(-(inputs[exact] @ w1[:, :-1].T + w1[:, -1])))
        outputs = hidden @ w2[:, :-1].T + w2[:, -1]
        errors.append(np.mean((outputs - targets[exact]) ** 2))
    assert errors[1] < errors[0] / 3


def test_ridge_knots_bear_a_shape_that_inputs_do_not_show():
    layout = Layout(inputs=3, hidden=4, outputs=1)
    w1, w2 = draw_ridge_knots(
        layout=layout,
        inputs=np.ones((5, 3)),
        targets=np.zeros((5, 1)),
        directions=ridge_directions(np.ones((5, 3)), np.zeros((5, 1)), 1.0),
        alpha=0.0,
        rng=np.random.default_rng(0),
    )
    assert np.isfinite(w1).all()
    assert np.isfinite(w2).all()


def test_nguyen_widrow_rows_have_their_length_in_any_axes():
    layout = Layout(inputs=9, hidden=20, outputs=2)
    rotation, _ = np.linalg.qr(np.random.default_rng(0).normal(size=(9, 9)))
    w1, _ = draw_nguyen_widrow(layout=layout, rotation=rotation, rng=np.random.default_rng(1))
    assert np.linalg.norm(w1[:, :-1], axis=1) == pytest.approx(0.7 * 20 ** (1 / 9))
    assert np.abs(w1[:, -1]).max() <= 0.7 * 20 ** (1 / 9) + 1e-12
