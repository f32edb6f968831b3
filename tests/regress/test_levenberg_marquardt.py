"""The solver: exact steps, falling costs, derivatives that are derivatives, named ends."""

from dataclasses import dataclass, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.learning.levenberg_marquardt import (
    Outcome,
    Settings,
    exact_step,
    minimise,
    minimise_with_evidence,
    pcg_step,
)
from regress.learning.networks import Layout, NetworkProblem, Rows


@dataclass
class LinearState:
    problem: "Linear"
    members: np.ndarray
    parameters: np.ndarray
    residual: np.ndarray

    def product(self, direction):
        return np.einsum("mrp,mp->mr", self.problem.matrix[self.members], direction)

    def transposed_product(self, residual):
        return np.einsum("mrp,mr->mp", self.problem.matrix[self.members], residual)

    def gram(self):
        matrix = self.problem.matrix[self.members]
        return matrix.transpose(0, 2, 1) @ matrix

    def kernel(self):
        matrix = self.problem.matrix[self.members]
        return matrix @ matrix.transpose(0, 2, 1)

    def effective_parameters(self, alpha):
        values = np.linalg.eigvalsh(self.gram())
        return (values / (values + alpha[:, None])).sum(axis=1)

    def preconditioner(self, shift):
        return lambda rows: rows

    def take(self, rows):
        return LinearState(self.problem, self.members[rows], self.parameters[rows], self.residual[rows])

    def where(self, chosen, other):
        parameters = np.where(chosen[:, None], self.parameters, other.parameters)
        return LinearState(
            self.problem, self.members, parameters, np.where(chosen[:, None], self.residual, other.residual)
        )


@dataclass
class Linear:
    """Residuals ``A theta - b``."""

    matrix: np.ndarray
    target: np.ndarray

    def at(self, parameters, members):
        residual = np.einsum("mrp,mp->mr", self.matrix[members], parameters) - self.target[members]
        return LinearState(self, members, parameters, residual)

    def observations(self, members):
        return np.full(len(members), float(self.matrix.shape[1]))

    def monitor(self, parameters, members):
        return np.mean(self.at(parameters, members).residual ** 2, axis=1, keepdims=True)


def network_problem(
    seed: int, *, networks: int = 3, rows: int = 40, inputs: int = 5, outputs: int = 2
) -> NetworkProblem:
    rng = np.random.default_rng(seed)
    used = np.ones((networks, outputs))
    used[0, 1:] = 0  # the first network has one output, the rest of its rows is padding
    splits = []
    for _ in range(2):
        columns = np.concatenate([rng.normal(size=(inputs, rows)), np.ones((1, rows))])
        targets = np.sin(rng.normal(size=(networks, outputs, inputs + 1)) @ columns) * used[:, :, None]
        splits.append(Rows(inputs=columns, targets=targets))
    layout = Layout(inputs=inputs, hidden=4, outputs=outputs)
    return NetworkProblem(layout=layout, used=used, train=splits[0], held_out=(splits[1],))


def start(problem: NetworkProblem, seed: int) -> np.ndarray:
    size = (len(problem.used), problem.layout.parameters)
    return np.random.default_rng(seed).normal(size=size) * 0.5


def jacobian(state, member: int) -> np.ndarray:
    """Dense Jacobian (R, P) of one member, column by column."""
    count, parameters = state.parameters.shape
    columns = []
    for column in range(parameters):
        direction = np.zeros((count, parameters))
        direction[member, column] = 1
        columns.append(state.product(direction)[member])
    return np.stack(columns, axis=1)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_products_with_the_jacobian_are_differences_of_residuals(seed: int):
    problem = network_problem(seed)
    members, parameters = np.arange(3), start(problem, seed + 1)
    direction = np.random.default_rng(seed + 2).normal(size=parameters.shape)
    tiny = 1e-6
    ahead, behind = (problem.at(parameters + sign * tiny * direction, members).residual for sign in (1, -1))
    product = problem.at(parameters, members).product(direction)
    assert np.allclose(product, (ahead - behind) / (2 * tiny), atol=1e-7)


@settings(max_examples=15, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_the_transposed_product_is_the_adjoint(seed: int):
    problem = network_problem(seed)
    state = problem.at(start(problem, seed), np.arange(3))
    rng = np.random.default_rng(seed + 1)
    direction, residual = rng.normal(size=state.parameters.shape), rng.normal(size=state.residual.shape)
    left = np.sum(state.product(direction) * residual, axis=1)
    assert np.allclose(left, np.sum(direction * state.transposed_product(residual), axis=1))


def test_the_preconditioner_is_symmetric_and_positive():
    problem = network_problem(0)
    state = problem.at(start(problem, 1), np.arange(3))
    apply = state.preconditioner(np.full(3, 0.3))
    rng = np.random.default_rng(2)
    a, b = rng.normal(size=(2, *state.parameters.shape))
    assert np.allclose(np.sum(a * apply(b), axis=1), np.sum(b * apply(a), axis=1))
    assert (np.sum(a * apply(a), axis=1) > 0).all()


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 10**6))
def test_gram_and_kernel_are_products_of_the_jacobian(seed: int):
    problem = network_problem(seed, rows=15)
    state = problem.at(start(problem, seed), np.arange(3))
    gram, kernel = state.gram(), state.kernel()
    for member in range(3):
        dense = jacobian(state, member)
        assert np.allclose(gram[member], dense.T @ dense)
        assert np.allclose(kernel[member], dense @ dense.T)


@pytest.mark.parametrize("rows", [8, 40])  # 16 and 80 residuals for 34 parameters: both forms
@pytest.mark.parametrize("seed", range(3))
def test_every_step_solves_the_damped_normal_equations(seed: int, rows: int):
    problem = network_problem(seed, rows=rows)
    state = problem.at(start(problem, seed), np.arange(3))
    alpha, damping = np.array([0.1, 0.5, 2.0]), np.array([1.0, 0.2, 0.0])
    exact = exact_step(state, alpha, damping)
    conjugate = pcg_step(state, alpha, damping, tolerance=1e-10, most=2000)
    for member in range(3):
        dense = jacobian(state, member)
        gradient = dense.T @ state.residual[member] + alpha[member] * state.parameters[member]
        matrix = dense.T @ dense + (alpha[member] + damping[member]) * np.eye(dense.shape[1])
        expected = -np.linalg.solve(matrix, gradient)
        assert np.allclose(exact.direction[member], expected, rtol=1e-9, atol=1e-9 * np.abs(expected).max())
        assert np.abs(conjugate.direction[member] - expected).max() < 1e-6 * np.abs(expected).max()
    assert np.allclose(exact.predicted, conjugate.predicted)
    assert np.allclose(exact.gradient_norm, conjugate.gradient_norm)


def test_an_exact_step_bears_float32_and_next_to_no_strength():
    problem = network_problem(0, rows=8)
    kind = np.float32
    problem = NetworkProblem(
        layout=problem.layout,
        used=problem.used.astype(kind),
        train=Rows(inputs=problem.train.inputs.astype(kind), targets=problem.train.targets.astype(kind)),
        held_out=(),
    )
    state = problem.at(start(problem, 0).astype(kind), np.arange(3))
    step = exact_step(state, np.full(3, 1e-9), np.zeros(3))
    assert step.direction.dtype == kind
    assert np.isfinite(step.direction).all()


def test_the_networks_reach_the_same_place_whichever_way_steps_are_solved():
    problem = network_problem(5, rows=30)
    errors = [
        minimise(problem, start(problem, 5), np.full(3, 0.3), Settings(exact_size=size, tolerance=1e-6)).error
        for size in (0, 250)
    ]
    assert np.allclose(*errors, rtol=1e-3)


def test_evidence_finds_the_strength_of_a_linear_problem():
    # Bayesian linear regression with prior variance 4 and noise variance 1: alpha is 1 / 4.
    rng = np.random.default_rng(4)
    matrix = rng.normal(size=(1, 3000, 60))
    truth = 2 * rng.normal(size=60)
    target = matrix[0] @ truth + rng.normal(size=3000)
    result = minimise_with_evidence(
        Linear(matrix, target[None]), np.zeros((1, 60)), np.array([100.0]), Settings(steps=20)
    )
    expected = np.mean((matrix[0] @ truth - target) ** 2) / np.mean(truth**2)
    assert result.alpha[0] == pytest.approx(expected, rel=0.05)
    exact = np.linalg.solve(matrix[0].T @ matrix[0] + result.alpha[0] * np.eye(60), matrix[0].T @ target)
    assert np.allclose(result.parameters[0], exact, atol=1e-4)


def test_evidence_counts_what_the_parameters_have_used_up():
    """Of 100 rows 60 parameters leave 40 that tell the noise: by all rows it would be two fifths of it."""
    rng = np.random.default_rng(6)
    matrix = rng.normal(size=(20, 100, 60))
    truth = 2 * rng.normal(size=(20, 60))
    target = np.einsum("mrp,mp->mr", matrix, truth) + 3 * rng.normal(size=(20, 100))
    problem = Linear(matrix, target)
    alpha = minimise_with_evidence(problem, np.zeros((20, 60)), np.full(20, 1.0), Settings(steps=20)).alpha
    assert np.median(alpha) == pytest.approx(9 / 4, rel=0.25)


def test_refused_steps_use_up_no_patience():
    problem = network_problem(3)
    # held out is what is trained on, so each accepted step lowers the held-out error
    problem = NetworkProblem(
        layout=problem.layout, used=problem.used, train=problem.train, held_out=(problem.train,)
    )
    first, alpha = 4 * start(problem, 3), np.full(3, 1e-6)
    undamped = Settings(steps=1, damping=0.0)
    refused = (minimise(problem, first, alpha, undamped).parameters == first).all(axis=1)
    assert refused.any()
    patient = minimise(problem, first, alpha, replace(undamped, steps=30, patience=1))
    before = problem.monitor(first, np.arange(3))[:, 0]
    assert (patient.error[refused] < 0.9 * before[refused]).all()


def test_effective_parameters_are_about_the_exact_trace():
    problem = network_problem(2, rows=200)
    state = problem.at(start(problem, 2), np.arange(3))
    previous = np.full(3, np.inf)
    for strength in (0.1, 1.0, 10.0, 100.0):
        alpha = np.full(3, strength)
        approximate = state.effective_parameters(alpha)
        values = np.maximum(np.linalg.eigvalsh(state.gram()), 0)
        exact = (values / (values + strength)).sum(axis=1)
        # With 178 inputs 20 % off, here up to 45 %: the blocks left out weigh more in a small network.
        assert np.allclose(approximate, exact, rtol=0.5)
        assert (approximate < previous).all()
        previous = approximate


def test_the_predicted_fall_is_the_quadratic_models():
    problem = network_problem(3)
    state = problem.at(start(problem, 3), np.arange(3))
    alpha, damping = np.full(3, 0.2), np.full(3, 0.7)
    for tolerance in (0.3, 1e-8):  # also where the solve stopped early
        step = pcg_step(state, alpha, damping, tolerance=tolerance, most=500)
        after = state.residual + state.product(step.direction)
        moved = state.parameters + step.direction
        model = (after**2).sum(axis=1) / 2 + alpha * (moved**2).sum(axis=1) / 2
        before = (state.residual**2).sum(axis=1) / 2 + alpha * (state.parameters**2).sum(axis=1) / 2
        assert np.allclose(step.predicted, before - model)


def test_a_linear_problem_ends_in_one_undamped_step():
    rng = np.random.default_rng(0)
    problem = Linear(rng.normal(size=(4, 12, 5)), rng.normal(size=(4, 12)))
    alpha = np.array([0.0, 0.1, 1.0, 10.0])
    settings_ = Settings(damping=0, tolerance=1e-12, products=100, steps=10)
    result = minimise(problem, np.zeros((4, 5)), alpha, settings_)
    for member in range(4):
        a = problem.matrix[member]
        exact = np.linalg.solve(a.T @ a + alpha[member] * np.eye(5), a.T @ problem.target[member])
        first = problem.at(result.parameters, np.arange(4))
        assert np.allclose(first.parameters[member], exact)
    assert set(result.outcomes) == {Outcome.CONVERGED}
    # the second step finds nothing to gain
    assert result.steps.max() <= 2
    assert np.allclose(result.cost[1], np.nanmin(result.cost, axis=0))


@settings(max_examples=10, deadline=None)
@given(seed=st.integers(0, 10**6), damping=st.floats(1e-6, 1e3))
def test_the_cost_never_rises_and_the_best_held_out_error_is_kept(seed: int, damping: float):
    problem = network_problem(seed)
    result = minimise(problem, start(problem, seed), np.full(3, 0.05), Settings(damping=damping, steps=25))
    for member in range(3):
        cost = result.cost[: result.steps[member] + 1, member]
        assert (np.diff(cost) <= 0).all()
        assert np.isnan(result.cost[result.steps[member] + 1 :, member]).all()
    kept = problem.monitor(result.parameters, np.arange(3))[:, 0]
    assert np.allclose(kept, result.error)
    assert np.allclose(kept, np.nanmin(result.monitored[:, :, 0], axis=0))


def test_every_end_has_a_name_and_a_sentence():
    problem = network_problem(1, rows=12)
    outcome = minimise(problem, start(problem, 1), np.full(3, 1e-3), Settings(steps=200, patience=2)).outcomes
    assert Outcome.VALIDATION_ROSE in outcome
    short = minimise(problem, start(problem, 1), np.full(3, 1e-3), Settings(steps=1)).outcomes
    assert set(short) == {Outcome.OUT_OF_STEPS}
    broken = start(problem, 1)
    broken[1] = np.nan
    mixed = minimise(problem, broken, np.full(3, 0.1), Settings(steps=3))
    assert mixed.outcomes[1] is Outcome.NOT_FINITE
    assert mixed.steps[1] == 0
    assert np.isfinite(mixed.parameters[[0, 2]]).all()
    for end in Outcome:
        assert end.value.endswith(".")


def test_problems_do_not_disturb_each_other():
    problem = network_problem(7)
    begin = start(problem, 7)
    together = minimise(problem, begin, np.full(3, 0.1), Settings(steps=10, tolerance=1e-8, products=400))
    for member in range(3):
        rows = [member]
        alone = NetworkProblem(
            layout=problem.layout,
            used=problem.used[rows],
            train=Rows(inputs=problem.train.inputs, targets=problem.train.targets[rows]),
            held_out=tuple(Rows(inputs=r.inputs, targets=r.targets[rows]) for r in problem.held_out),
        )
        result = minimise(
            alone, begin[rows], np.full(1, 0.1), Settings(steps=10, tolerance=1e-8, products=400)
        )
        assert np.allclose(result.error, together.error[member], rtol=1e-4)
