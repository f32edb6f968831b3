"""Trains six networks of the paper's size by this project's solver and by three others: errors and seconds.

    python benchmarks/bench_peers.py DATASET [--faces 2000] [--limit 60] [--json]

DATASET is a folder that `facegen generate` made. The script needs torch (the CPU build does) and
torch-levenberg-marquardt, which the project itself does without:

    pip install torch torch-levenberg-marquardt

All peers see the same rows, float32 or float64 as they do by themselves, one thread, the same L2 strength
(chosen for each network on validation rows by this project's solver), and start from their own start and from
ours (ridge knots). Where a peer stands after every iteration is judged on the validation rows, outside its
time; its best place counts. Details of each peer stand at its function. docs/measurements/landmark-networks.md has a
run's table.
"""

import argparse
import json
import os
import platform
import time
import warnings
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from importlib.metadata import version

os.environ.setdefault("OMP_NUM_THREADS", "1")  # before NumPy and torch read it

import numpy as np

from regress.learning.levenberg_marquardt import Settings, minimise
from regress.learning.networks import Layout, NetworkProblem, Rows, draw_ridge_knots, ridge_directions
from regress.learning.training import read_dataset
from regress.learning.training.preparation import Split, network_columns, prepare
from regress.runtime.features import Features, load_reference_shape, mean_shape
from regress.targets import NETWORKS

NAMES = ("jaw.open", "mouth.close", "eyes.blink", "brows.down", "lips.press", "nose.sneer")
HIDDEN = 20
ALPHAS = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
PATIENCE = 6


@dataclass(frozen=True, kw_only=True)
class Task:
    """One network to be trained: rows (n, E) and (n, k) of the three splits, its strength, our start."""

    name: str
    train: Split
    validation: Split
    test: Split
    alpha: float
    start: np.ndarray  # (P,) float64, as Layout joins them

    @property
    def layout(self) -> Layout:
        return Layout(inputs=self.train.inputs.shape[1], hidden=HIDDEN, outputs=self.train.targets.shape[1])


@dataclass(frozen=True, kw_only=True)
class Place:
    """Where a peer stands after so many processor seconds: mean squared errors of z-scored targets."""

    seconds: float
    validation: float
    test: float


class Watch:
    """Processor seconds of a peer, and its places; judging is not on its time."""

    def __init__(self, task: Task) -> None:
        self.task, self.places = task, []
        self._spent, self._since = 0.0, time.process_time()

    @property
    def seconds(self) -> float:
        return self._spent + time.process_time() - self._since

    def judge(self, outputs: Callable[[np.ndarray], np.ndarray], seconds: float | None = None) -> None:
        """Judge a network, given as a function of inputs."""
        self._spent = self.seconds if seconds is None else seconds
        errors = [
            float(np.mean((outputs(split.inputs) - split.targets) ** 2))
            for split in (self.task.validation, self.task.test)
        ]
        self.places.append(Place(seconds=self._spent, validation=errors[0], test=errors[1]))
        self._since = time.process_time()

    def is_over(self, limit: float) -> bool:
        """Whether time is up, or the last places are all worse than an earlier one."""
        errors = [place.validation for place in self.places]
        waited = len(errors) - 1 - int(np.argmin(errors)) if errors else 0
        return self.seconds > limit or waited >= PATIENCE


def run_network(layout: Layout, parameters: np.ndarray, inputs: np.ndarray) -> np.ndarray:
    """Outputs (n, k) of one parameter row (P,)."""
    w1, w2 = (part[0] for part in layout.split(parameters[None]))
    hidden = 0.5 + 0.5 * np.tanh(0.5 * (inputs @ w1[:, :-1].T + w1[:, -1]))
    return hidden @ w2[:, :-1].T + w2[:, -1]


def network_problem(task: Task, kind: type) -> NetworkProblem:
    """The task as the project's solver takes it."""

    def rows(split: Split) -> Rows:
        inputs = np.concatenate([split.inputs.T, np.ones((1, len(split.inputs)))]).astype(kind)
        return Rows(inputs=inputs, targets=split.targets.T[None].astype(kind))

    used = np.ones((1, task.layout.outputs), dtype=kind)
    return NetworkProblem(
        layout=task.layout,
        used=used,
        train=rows(task.train),
        held_out=(rows(task.validation), rows(task.test)),
    )


def our_start(split: Split, alpha: float) -> np.ndarray:
    layout = Layout(inputs=split.inputs.shape[1], hidden=HIDDEN, outputs=split.targets.shape[1])
    w1, w2 = draw_ridge_knots(
        layout=layout,
        inputs=split.inputs,
        targets=split.targets,
        directions=ridge_directions(split.inputs, split.targets, 3 * alpha),
        alpha=alpha,
        rng=np.random.default_rng(0),
    )
    return layout.join(w1[None], w2[None])[0]


def ours(task: Task, limit: float) -> list[Place]:
    """This project: float32, conjugate gradients. Its time holds the start and the principal axes too.

    Errors after every step are part of its way to stop, so that they are on its time.
    """
    watch = Watch(task)
    np.linalg.eigh(task.train.inputs.T @ task.train.inputs)  # the others get the axes for nothing
    start = our_start(task.train, task.alpha).astype(np.float32)
    seconds = [watch.seconds]
    result = minimise(
        network_problem(task, np.float32),
        start[None],
        np.array([task.alpha]),
        Settings(steps=60, patience=PATIENCE),
        on_step=lambda number, going: seconds.append(watch.seconds),
    )
    return [
        Place(seconds=spent, validation=float(errors[0]), test=float(errors[1]))
        for spent, errors in zip(seconds, result.monitored[:, 0], strict=True)
    ]


def glorot(layout: Layout) -> np.ndarray:
    """The start that scikit-learn gives its networks, for SciPy, which has none of its own."""
    rng = np.random.default_rng(0)
    w1, w2 = np.zeros((1, HIDDEN, layout.inputs + 1)), np.zeros((1, layout.outputs, HIDDEN + 1))
    for weights in (w1, w2):
        bound = np.sqrt(2 / (weights.shape[1] + weights.shape[2] - 1))
        weights[:] = rng.uniform(-bound, bound, weights.shape)
    return layout.join(w1, w2)[0]


def by_scipy(task: Task, limit: float, start: np.ndarray | None, *, operator: bool = False) -> list[Place]:
    """``scipy.optimize.least_squares``: trf, lsmr, float64, L2 as extra residuals, analytic Jacobian.

    The Jacobian is dense, as its users give it, or the products of ours as a LinearOperator. ``lm`` (MINPACK) and
    ``trf`` with an exact solve take half a minute or more per step here.
    """
    from scipy.optimize import least_squares
    from scipy.sparse.linalg import LinearOperator

    problem, layout, root = network_problem(task, np.float64), task.layout, np.sqrt(task.alpha)
    member = np.array([0])
    watch = Watch(task)

    class Over(Exception):
        pass

    def residuals(theta: np.ndarray) -> np.ndarray:
        return np.concatenate([problem.at(theta[None], member).residual[0], root * theta])

    def jacobian(theta: np.ndarray) -> np.ndarray | LinearOperator:
        # SciPy asks for it at every accepted point
        watch.judge(lambda inputs: run_network(layout, theta, inputs))
        if watch.is_over(limit):
            raise Over
        state = problem.at(theta[None], member)
        count = state.residual.shape[1]
        if not operator:
            return np.concatenate([state.jacobian()[0], root * np.eye(layout.parameters)])
        return LinearOperator(
            (count + layout.parameters, layout.parameters),
            matvec=lambda v: np.concatenate([state.product(v.reshape(1, -1))[0], root * v.ravel()]),
            rmatvec=lambda r: state.transposed_product(r.ravel()[None, :count])[0] + root * r.ravel()[count:],
        )

    theta = glorot(layout) if start is None else start
    try:
        found = least_squares(residuals, theta, jacobian, method="trf", tr_solver="lsmr", max_nfev=100)
        watch.judge(lambda inputs: run_network(layout, found.x, inputs))
    except Over:
        pass
    return watch.places


def by_sklearn(task: Task, limit: float, start: np.ndarray | None) -> list[Place]:
    """scikit-learn's MLPRegressor with lbfgs, float64; the same cost (its alpha is per output and row).

    It shows no iterations, so it runs afresh with 10, 20, 40 ... of them, each run on a time of its own:
    its best place is found for it.
    """
    from sklearn.neural_network import MLPRegressor

    layout = task.layout
    targets = task.train.targets if layout.outputs > 1 else task.train.targets[:, 0]
    watch, iterations = Watch(task), 10
    while not watch.is_over(limit) and iterations <= 1280:
        network = MLPRegressor(
            hidden_layer_sizes=(HIDDEN,),
            activation="logistic",
            solver="lbfgs",
            alpha=task.alpha / layout.outputs,
            max_iter=iterations,
            max_fun=10**6,
            random_state=0,
            warm_start=start is not None,
        )
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of not having converged
            if start is not None:
                network.set_params(max_iter=1).fit(task.train.inputs, targets)
                w1, w2 = (part[0] for part in layout.split(start[None]))
                network.coefs_ = [w1[:, :-1].T.copy(), w2[:, :-1].T.copy()]
                network.intercepts_ = [w1[:, -1].copy(), w2[:, -1].copy()]
                network.set_params(max_iter=iterations)
            began = time.process_time()
            network.fit(task.train.inputs, targets)
        spent = time.process_time() - began
        watch.judge(lambda x, network=network: network.predict(x).reshape(len(x), -1), spent)
        iterations *= 2
    return watch.places


def by_torch(task: Task, limit: float, start: np.ndarray | None) -> list[Place]:
    """torch-levenberg-marquardt: float32, Cholesky, all rows a step, its own damping.

    It has no L2: its residuals are the model's outputs alone. Early stopping is all that holds it.
    """
    import torch
    from torch_levenberg_marquardt.training import LevenbergMarquardtModule

    torch.set_num_threads(1)
    torch.manual_seed(0)
    layout = task.layout
    network = torch.nn.Sequential(
        torch.nn.Linear(layout.inputs, HIDDEN), torch.nn.Sigmoid(), torch.nn.Linear(HIDDEN, layout.outputs)
    )
    if start is not None:
        with torch.no_grad():
            for layer, part in zip((network[0], network[2]), layout.split(start[None]), strict=True):
                layer.weight.copy_(torch.from_numpy(part[0, :, :-1].copy()))
                layer.bias.copy_(torch.from_numpy(part[0, :, -1].copy()))
    inputs, targets = (
        torch.from_numpy(a.astype(np.float32)) for a in (task.train.inputs, task.train.targets)
    )

    def outputs(x: np.ndarray) -> np.ndarray:
        with torch.no_grad():
            return network(torch.from_numpy(x.astype(np.float32))).numpy()

    watch = Watch(task)
    trainer = LevenbergMarquardtModule(network, solve_method="cholesky")
    watch.judge(outputs)
    while not watch.is_over(limit):
        _, _, stopped, _ = trainer.training_step(inputs, targets)
        watch.judge(outputs)
        if stopped:
            break
    return watch.places


PEERS: dict[str, Callable[..., list[Place]]] = {
    "torch-levenberg-marquardt": by_torch,
    "SciPy least_squares": by_scipy,
    "SciPy with our products": lambda *arguments: by_scipy(*arguments, operator=True),
    "scikit-learn lbfgs": by_sklearn,
}


def tasks(folder: str, faces: int) -> Iterator[Task]:
    """The six networks on the first faces of a dataset, features as the paper's."""
    dataset = read_dataset(folder)
    chosen = np.concatenate([dataset.rows(name)[: round(share * faces)] for name, share in SHARES.items()])
    dataset = dataset.take(np.sort(chosen))
    reference = load_reference_shape()
    features = Features(
        alignment="affine",
        mean_shape=mean_shape(dataset.points[dataset.rows("train")]),
        edges=reference.edges,
        reference_name=reference.name,
        reference_sha256=reference.sha256,
    )
    prepared = prepare(dataset, features, mirror=False)
    for network, columns in zip(NETWORKS, network_columns(), strict=True):
        if network.key in NAMES:
            splits = {
                name: replace(split, targets=split.targets[:, columns])
                for name, split in prepared.splits.items()
            }
            trials = [
                Task(name=network.key, **splits, alpha=alpha, start=our_start(splits["train"], alpha))
                for alpha in ALPHAS
            ]
            yield min(trials, key=lambda task: best(ours(task, np.inf)).validation)


SHARES = {"train": 0.7, "validation": 0.15, "test": 0.15}


def best(places: list[Place]) -> Place:
    """The place with the lowest validation error."""
    return min(places, key=lambda place: place.validation)


def seconds_to(places: list[Place], error: float) -> float | None:
    """Processor seconds until the validation error was that low, None where it never was."""
    return next((place.seconds for place in places if place.validation <= error), None)


def compared(our: list[list[Place]], theirs: list[list[Place]]) -> dict[str, float | int | None]:
    """Figures of one peer beside ours, over the six networks."""
    reached = [seconds_to(mine, best(peer).validation) for mine, peer in zip(our, theirs, strict=True)]
    spent = [best(peer).seconds for peer in theirs]
    known = [(mine, peer) for mine, peer in zip(reached, spent, strict=True) if mine is not None]
    return {
        "validation": float(np.mean([best(peer).validation for peer in theirs])),
        "test": float(np.mean([best(peer).test for peer in theirs])),
        "seconds": sum(spent),
        "our_seconds": sum(mine for mine, _ in known),
        "reached": len(known),
        "times_less": sum(peer for _, peer in known) / max(sum(mine for mine, _ in known), 1e-9)
        if known
        else None,
    }


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset")
    parser.add_argument("--faces", type=int, default=2000)
    parser.add_argument("--limit", type=float, default=60.0, help="processor seconds per network and peer")
    parser.add_argument("--peers", default=",".join(PEERS), help="which, joined by commas")
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    chosen = list(tasks(arguments.dataset, arguments.faces))
    our = [ours(task, arguments.limit) for task in chosen]
    rows: dict[str, dict[str, float | int | None]] = {}

    def add(name: str, theirs: list[list[Place]]) -> None:
        rows[name] = compared(our, theirs)
        if not arguments.json:
            print(_line(name, rows[name], len(chosen)), flush=True)

    if not arguments.json:
        packages = ("numpy", "scipy", "scikit-learn", "torch", "torch-levenberg-marquardt")
        print(f"{platform.machine()}, one thread; Python {platform.python_version()}, ", end="")
        print(", ".join(f"{name} {version(name)}" for name in packages))
        print("L2: " + ", ".join(f"{task.name} {task.alpha:g}" for task in chosen))
        print(f"{'peer, start':<44}{'validation':>11}{'test':>8}{'CPU s':>8}{'ours':>8}{'times':>8}  reached")
    add("ours", our)
    for name in arguments.peers.split(","):
        for label, starts in (("its own", [None] * len(chosen)), ("ours", [task.start for task in chosen])):
            found = [
                PEERS[name](task, arguments.limit, start) for task, start in zip(chosen, starts, strict=True)
            ]
            add(f"{name}, {label}", found)
    if arguments.json:
        print(json.dumps({"strengths": {task.name: task.alpha for task in chosen}, "rows": rows}, indent=1))


def _line(name: str, row: dict[str, float | int | None], count: int) -> str:
    times = "" if row["times_less"] is None else f"{row['times_less']:.0f}"
    return (
        f"{name:<44}{row['validation']:>11.4f}{row['test']:>8.4f}{row['seconds']:>8.2f}"
        f"{row['our_seconds']:>8.2f}{times:>8}  {row['reached']} of {count}"
    )


if __name__ == "__main__":
    main()
