"""`adapt` changes last layers where held-out frames get better by it, and refuses to where they do not."""

import csv
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.headsets import told_cameras
from regress.learning.headset.adaptation import (
    Heads,
    HeldOut,
    KnownFrames,
    adapted_graph,
    changes,
    judge,
    read_heads,
)
from regress.learning.headset.known_frames import known_frames
from regress.runtime.headset.guided.minute import GuidedTake
from regress.runtime.headset.network.outputs import MIRROR
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.ready_made import model_folder

SAMPLES = Path(__file__).parents[3] / "docs" / "samples"
TAKE = SAMPLES / "headset"
CAMERAS = [
    word
    for name in ("left_eye", "right_eye", "mouth")
    for word in (f"--{name.replace('_', '-')}", TAKE / name)
]
FRAMES, CODE = 64, 6


def drawn_heads(random: np.random.Generator) -> Heads:
    """Heads of a left eye, a right one that sees the mirrored face by the same head, and a mouth."""
    features = tuple(
        np.column_stack([8 * random.standard_normal((FRAMES, CODE)), np.ones(FRAMES)]) for _ in range(3)
    )
    return Heads(
        names=("eye", "eye", "mouth"),
        biases=("eye.bias", "eye.bias", "mouth.bias"),
        features=features,
        shares=random.dirichlet(np.ones(3), (FRAMES, 52)).transpose(0, 2, 1) * 0.1,
        mirrored=(False, True, False),
        weights=random.uniform(0.3, 0.7, (FRAMES, 52)),
    )


def known(heads: Heads, weights: np.ndarray) -> KnownFrames:
    return KnownFrames(weights=weights, known=np.ones(weights.shape, bool), fold=np.arange(FRAMES) // 8)


def test_what_another_head_would_say_is_learnt_from_other_frames():
    random = np.random.default_rng(0)
    heads = drawn_heads(random)
    rows = [(name, row) for name in ("eye", "mouth") for row in range(52)]
    true = {key: 0.15 * random.standard_normal(CODE + 1) for key in rows}
    told = heads.weights.copy()
    for shape in range(52):
        design, keys = heads.design([shape], np.arange(FRAMES))
        told[:, shape] += design @ np.concatenate([true[key] for key in keys])
    held = judge(heads, known(heads, told))
    assert held.better
    assert held.after < 0.7 * held.before
    # the mirrored camera reads the partner's row: without it the two sides cannot both be met
    shape = BLENDSHAPE_INDEX["eyeBlinkLeft"]
    _, keys = heads.design([shape], np.arange(3))
    assert set(keys) == {("eye", shape), ("eye", int(MIRROR[shape])), ("mouth", shape)}


def test_a_hundredth_is_the_least_that_is_worth_a_network():
    better = [HeldOut(before=0.1, after=after, pull=1.0).better for after in (0.0989, 0.0991, 0.1)]
    assert better == [True, False, False]


def test_noise_is_refused_and_a_larger_pull_changes_less():
    random = np.random.default_rng(1)
    heads = drawn_heads(random)
    frames = known(heads, np.clip(heads.weights + 0.1 * random.standard_normal(heads.weights.shape), 0, 1))
    held = judge(heads, frames)
    assert not held.better
    sizes = [
        sum(float((change**2).sum()) for change in changes(heads, frames, np.arange(40), pull=pull).values())
        for pull in (1.0, 10.0, 100.0)
    ]
    assert sizes == sorted(sizes, reverse=True)


@pytest.mark.slow
def test_the_graph_with_other_heads_says_what_the_heads_say():
    """Rows and their biases, of a camera that sees a mirrored face too."""
    predictor, random = load_headset_predictor("headset-tracking3"), np.random.default_rng(3)
    graph = (model_folder("headset-tracking3") / "network.onnx").read_bytes()
    pictures = {
        name: random.integers(0, 256, (6, height, width), dtype=np.uint8)
        for name, (width, height) in predictor.sizes.items()
    }
    before = read_heads(graph, predictor.model, pictures, None)
    shapes = [
        BLENDSHAPE_INDEX[name] for name in ("browInnerUp", "eyeBlinkLeft", "jawOpen", "mouthSmileRight")
    ]
    design, keys = before.design(shapes, np.arange(6))
    change = {key: 0.2 * random.standard_normal(before._width(key[0])) for key in keys}
    for added in change.values():
        added[:-1] /= np.sqrt(len(added))
    moved = (design @ np.concatenate([change[key] for key in keys])).reshape(len(shapes), 6).T
    after = read_heads(adapted_graph(graph, before, change), predictor.model, pictures, None)
    wanted = before.weights[:, shapes] + moved
    inside = (np.minimum(before.weights[:, shapes], wanted) > 0.01) & (
        np.maximum(before.weights[:, shapes], wanted) < 0.99
    )
    assert inside.mean() > 0.2
    np.testing.assert_allclose(after.weights[:, shapes][inside], wanted[inside], atol=2e-3)
    assert np.abs(moved[inside]).max() > 0.02


def test_the_way_into_a_face_is_no_full_face():
    """People take a third of a take to get there; the face at rest is there at once."""
    predictor = load_headset_predictor("headset-tracking3")
    width, height = predictor.sizes["mouth"]
    frames = np.arange(90, dtype=np.uint8)[:, None, None] * np.ones((1, height, width), np.uint8)
    takes = {
        face: GuidedTake(pictures={"mouth": frames}, targets_deg={}) for face in ("rest", "smile", "pucker")
    }
    pictures, _, known = known_frames(predictor, takes)
    shown = pictures["mouth"][:, 0, 0]
    smiles = known.weights[:, BLENDSHAPE_INDEX["mouthSmileLeft"]] == 1
    assert shown[~known.weights.any(axis=1)].min() == 0
    assert shown[smiles].min() == 30
    assert smiles.sum() > 4


def table_of(path: Path, change) -> Path:
    lines = (SAMPLES / "headset.weights.csv").read_text().splitlines()
    names = lines[0].split(",")
    columns = [names.index(name) for name in BLENDSHAPES]
    values = np.array([[float(line.split(",")[column]) for column in columns] for line in lines[1:]])
    rows = [
        ",".join([str(number), *(f"{value:.4f}" for value in row)])
        for number, row in enumerate(change(values))
    ]
    path.write_text("\n".join([",".join(["frame", *BLENDSHAPES]), *rows]) + "\n")
    return path


def error_of(run, model: str | Path, truth: Path, folder: Path) -> float:
    """Mean error of all weights of a model that runs by its own graph, beside the rest."""
    code, _, said = run("headset", "predict", model, *CAMERAS, "--neutral", 0, "--out", folder / "found.csv")
    assert code == 0, said
    found, known = (
        list(csv.DictReader(path.read_text().splitlines())) for path in (folder / "found.csv", truth)
    )
    rows = {row["frame"]: row for row in known}
    return float(
        np.mean(
            [abs(float(row[name]) - float(rows[row["frame"]][name])) for row in found for name in BLENDSHAPES]
        )
    )


@pytest.mark.slow
def test_a_persons_model_is_written_and_says_what_was_promised(run, tmp_path: Path):
    # a person whose mouth moves three fifths as far as the network thinks
    table = table_of(tmp_path / "w.csv", lambda weights: 0.6 * weights)
    words = ["headset", "adapt", *CAMERAS, "--rest", "0-9", "--weights", table, "--out", tmp_path / "anna"]
    code, _, said = run(*words)
    assert code == 0, said
    base, own = load_headset_predictor("headset-tracking3"), load_headset_predictor(tmp_path / "anna")
    assert own.model.training.began_as == base.model.network_sha256 != own.model.network_sha256
    assert own.model.training.adapted_from == (base.model.network_sha256,)
    before, after = (
        float(word.rstrip(",")) for word in said.split("err by ")[1].replace("and by ", "").split()[:2]
    )
    assert after < 0.9 * before
    errors = [error_of(run, model, table, tmp_path) for model in ("headset-tracking3", tmp_path / "anna")]
    assert errors[1] < 0.9 * errors[0], "the graph that was written has the heads that were judged"
    code, _, told = run("headset", "adapt", *CAMERAS, "--rest", "0-9", "--out", tmp_path / "other")
    assert (code, "one or two faces cannot be adapted to" in told) == (2, True)


def test_frames_that_say_nothing_new_write_nothing(run, tmp_path: Path):
    random = np.random.default_rng(2)

    def noisy(weights: np.ndarray) -> np.ndarray:
        return (weights + random.choice([-1, 1], weights.shape) * np.minimum(weights, 1 - weights))[:40]

    table = table_of(tmp_path / "w.csv", noisy)
    words = ["headset", "adapt", *CAMERAS, "--rest", "0-3", "--weights", table, "--out", tmp_path / "anna"]
    code, _, said = run(*words)
    assert code == 2, said
    assert "known weights of held-out frames err by" in said
    assert "nothing is written" in said
    assert not (tmp_path / "anna").exists()


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (["--weights", "w.csv"], "--rest is needed"),
        (["--rest", "0-3", "--weights", "far.csv"], "no frame of"),
        (["--rest", "0-3", "--weights", "other.csv"], "a column frame and columns of ARKit's names"),
    ],
)
def test_tables_that_say_nothing_are_refused(run, tmp_path: Path, monkeypatch, options: list[str], said: str):
    monkeypatch.chdir(tmp_path)
    table_of(Path("w.csv"), lambda weights: weights)
    Path("far.csv").write_text("frame,jawOpen\n900,0.1\n")
    Path("other.csv").write_text("frame,jaw\n1,0.1\n")
    code, _, told = run("headset", "adapt", *CAMERAS, *options, "--out", "anna")
    assert (code, said in told) == (2, True), told


def test_heads_are_read_as_the_network_that_is_told_of_its_cameras_reads_them(run, tmp_path: Path):
    predictor = load_headset_predictor("headset-any")
    terms = told_cameras("tracking3", predictor.sizes)
    pictures = {
        name: np.stack([cv2.imread(str(file), 0) for file in sorted((TAKE / name).glob("*.png"))[:4]])
        for name in predictor.sizes
    }
    graph = (model_folder("headset-any") / "network.onnx").read_bytes()
    plain = read_heads(graph, predictor.model, pictures, None).weights
    heads = read_heads(graph, predictor.model, pictures, None, terms=terms)
    np.testing.assert_allclose(heads.weights, predictor.told(terms).predict(pictures).weights, atol=1e-5)
    assert np.abs(heads.weights - plain).max() > 0.01
    words = ("headset", "adapt", "headset-tracking3", "--out", tmp_path / "model", "--headset", "tracking3")
    code, _, said = run(*words, *CAMERAS, "--rest", "0-9", "--shut", "90-93")
    assert code == 2
    assert "trained for one headset" in said
