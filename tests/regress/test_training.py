"""Training on a small drawn dataset: it repeats, it learns, it records, it refuses."""

import dataclasses
import json
from contextlib import nullcontext
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from threadpoolctl import threadpool_info, threadpool_limits

from facegen.conventions import BLENDSHAPE_INDEX
from regress.errors import InputError, Interrupted
from regress.learning.training import (
    RECIPES,
    KeypointDataset,
    evaluate_model,
    read_dataset,
    run,
    score,
    train,
)
from regress.learning.training.preparation import mirrored, prepare
from regress.runtime.model import Model
from regress.runtime.model.record import record_to_json
from regress.targets import NETWORKS, OUTPUTS
from tests.regress.conftest import QUICK, QUICK_STABLE, write_dataset


def test_a_dataset_reads_as_it_was_written(dataset: KeypointDataset, dataset_folder: Path):
    read = read_dataset(dataset_folder)
    assert np.allclose(read.points, dataset.points, rtol=1e-6)
    assert np.allclose(read.weights, dataset.weights, atol=1e-7)
    assert np.array_equal(read.split, dataset.split)
    assert np.array_equal(read.person, dataset.person)
    assert read.description["spec_hash"] == "abc"
    assert read.sha256 == read_dataset(dataset_folder).sha256


def test_frames_in_which_a_detector_found_no_face_are_left_out(dataset: KeypointDataset, tmp_path: Path):
    dropped = dataset.points.copy()
    dropped[[3, 40]] = np.nan
    write_dataset(dataclasses.replace(dataset, points=dropped), tmp_path / "dropped")
    read = read_dataset(tmp_path / "dropped")
    kept = np.delete(np.arange(len(dataset.split)), [3, 40])
    assert np.allclose(read.points, dataset.points[kept], rtol=1e-6)
    assert np.allclose(read.weights, dataset.weights[kept], atol=1e-7)
    assert np.array_equal(read.person, dataset.person[kept])


def test_what_is_no_dataset_is_refused(dataset: KeypointDataset, tmp_path: Path):
    with pytest.raises(InputError, match=r"dataset\.json does not exist"):
        read_dataset(tmp_path)
    write_dataset(dataset, tmp_path / "no_points", without=("detected_2d",))
    with pytest.raises(InputError, match="lacks the column 'detected_2d'"):
        read_dataset(tmp_path / "no_points")
    one_split = dataclasses.replace(dataset, split=np.full(len(dataset.split), "train"))
    write_dataset(one_split, tmp_path / "one_split")
    with pytest.raises(InputError, match="no sample in the validation split"):
        read_dataset(tmp_path / "one_split")
    with pytest.raises(InputError, match="no sample in the test split; people are needed in test"):
        read_dataset(tmp_path / "one_split", splits=("test",))
    damaged = dataset.points.copy()
    damaged[3, 5, 1] = np.nan
    write_dataset(dataclasses.replace(dataset, points=damaged), tmp_path / "damaged")
    with pytest.raises(InputError, match="not finite"):
        read_dataset(tmp_path / "damaged")
    faceless = dataclasses.replace(dataset, points=np.full_like(dataset.points, np.nan))
    write_dataset(faceless, tmp_path / "faceless")
    with pytest.raises(InputError, match="no row has a face"):
        read_dataset(tmp_path / "faceless")
    write_dataset(dataset, tmp_path / "broken")
    (tmp_path / "broken" / "keypoints" / "shard-00001.parquet").write_bytes(b"PAR1")
    with pytest.raises(InputError, match="run facegen validate --repair"):
        read_dataset(tmp_path / "broken")
    (tmp_path / "broken" / "dataset.json").write_text("[]")
    with pytest.raises(InputError, match="a JSON object is needed"):
        read_dataset(tmp_path / "broken")


def test_numbers_that_changed_on_the_disk_are_refused(dataset: KeypointDataset, tmp_path: Path):
    write_dataset(dataset, tmp_path / "set")
    shard = tmp_path / "set" / "keypoints" / "shard-00000.parquet"
    pq.write_table(
        pq.read_table(shard), shard, compression="none", use_dictionary=False, write_page_checksum=True
    )
    content = bytearray(shard.read_bytes())
    place = content.find(dataset.weights[0].astype(np.float32).tobytes()[:16])
    assert place > 0
    content[place] ^= 1
    shard.write_bytes(content)
    with pytest.raises(
        InputError, match=r"shard-00000\.parquet cannot be read as Parquet .*validate --repair"
    ):
        read_dataset(tmp_path / "set")


def test_training_repeats_to_the_bit_and_follows_its_seed(quick_model: Model, dataset: KeypointDataset):
    again, other = train(dataset, QUICK, seed=3), train(dataset, QUICK, seed=4)
    for name in ("w1", "b1", "w2", "b2"):
        assert np.array_equal(getattr(again.networks, name), getattr(quick_model.networks, name))
    assert again.record == quick_model.record
    assert not np.array_equal(other.networks.w1, quick_model.networks.w1)


def test_networks_beat_the_mean_and_their_scores_are_recorded(quick_model: Model, dataset: KeypointDataset):
    record = quick_model.record
    assert set(record.scores) == set(OUTPUTS)
    assert record.summary["network"].mean_r2 > 0.3
    assert record.summary["mean"].mean_r2 < 0.01
    floors = {name for name in record.summary if "ridge" in name}
    assert {name for name in record.as_detected if "ridge" in name} == floors, (
        "a floor for either kind of points"
    )
    assert all(record.as_detected[name] != record.summary[name] for name in floors)
    scores = evaluate_model(quick_model, dataset)
    for name, figures in scores.items():
        assert record.scores[name]["network"] == figures
    # browInnerUp never moves in the drawn dataset: no R2, and nothing breaks
    assert scores["browInnerUp"].r2 is None
    assert scores["browInnerUp"].mae == pytest.approx(0, abs=1e-6)
    json.dumps(record_to_json(record), allow_nan=False)


def test_each_network_records_its_curves_alpha_and_outcome(quick_model: Model):
    networks = quick_model.record.networks
    assert set(networks) == {network.key for network in NETWORKS}
    for figures in networks.values():
        curves = figures.curves
        assert len(curves.train) == len(curves.validation) == len(curves.test) == figures.steps + 1
        assert figures.alpha in QUICK.alphas
        assert figures.best_step == int(np.argmin(curves.validation))
        assert figures.reason.endswith(".")


def test_scores_are_the_textbooks():
    rng = np.random.default_rng(0)
    true = rng.uniform(size=(200, 2))
    predicted = true + rng.normal(size=true.shape) * 0.1
    from sklearn.metrics import mean_absolute_error, r2_score

    for column, figures in enumerate(score(predicted, true)):
        assert figures.r2 == pytest.approx(r2_score(true[:, column], predicted[:, column]))
        assert figures.mae == pytest.approx(mean_absolute_error(true[:, column], predicted[:, column]))
        assert figures.pearson == pytest.approx(np.corrcoef(true[:, column], predicted[:, column])[0, 1])


def test_mirrored_training_rows_double_the_train_split_only(dataset: KeypointDataset, quick_model: Model):
    plain, doubled = (prepare(dataset, quick_model.features, mirror=mirror) for mirror in (False, True))
    assert len(doubled.splits["train"].inputs) == 2 * len(plain.splits["train"].inputs)
    assert len(doubled.splits["test"].inputs) == len(plain.splits["test"].inputs)
    points, weights = mirrored(dataset.points[:5], dataset.weights[:5])
    left, right = BLENDSHAPE_INDEX["mouthSmileLeft"], BLENDSHAPE_INDEX["mouthSmileRight"]
    assert np.array_equal(weights[:, left], dataset.weights[:5, right])
    assert np.array_equal(mirrored(points, weights)[0], dataset.points[:5])


def test_principal_axes_are_uncorrelated(dataset: KeypointDataset, quick_model: Model):
    inputs = prepare(dataset, quick_model.features, mirror=True).splits["train"].inputs
    gram = inputs.T @ inputs
    assert np.abs(gram - np.diag(np.diag(gram))).max() < 1e-8 * gram.max()


def test_a_progress_callback_that_raises_stops_training(dataset: KeypointDataset):
    calls = []

    def stop(stage: str, done: int, total: int) -> None:
        calls.append((stage, done, total))
        raise KeyboardInterrupt

    with pytest.raises(Interrupted, match="training was stopped; no model was written"):
        train(dataset, QUICK, progress=stop)
    assert calls


@pytest.mark.parametrize("strengths", ["validation", "evidence"])
def test_a_training_has_one_progress_that_never_goes_back(dataset: KeypointDataset, strengths: str):
    calls = []
    recipe = dataclasses.replace(QUICK, steps=3, search_rows=100, strengths=strengths, calibrated=True)
    train(dataset, recipe, progress=lambda *call: calls.append(call))
    names, done, totals = zip(*calls, strict=True)
    assert set(names) == {"training"}
    assert set(totals) == {100}
    assert list(done) == sorted(set(done))
    assert done[-1] == 100


def test_the_record_says_whom_training_knows(dataset: KeypointDataset, quick_model: Model):
    assert quick_model.record.dataset.people_in_training == {"validation": 0, "test": 0}
    split = dataset.split.copy()
    rows = np.flatnonzero(np.isin(dataset.person, [0, 1, 2]) & ~dataset.neutral)  # of training people
    split[rows[::2]] = "test"
    model = train(
        dataclasses.replace(dataset, split=split), dataclasses.replace(QUICK, steps=2, alphas=(1.0,))
    )
    assert model.record.dataset.people_in_training == {"validation": 0, "test": 3}


@pytest.mark.parametrize("name", RECIPES)
def test_every_recipe_trains(dataset: KeypointDataset, name: str):
    quick = dataclasses.replace(RECIPES[name], alphas=(1.0,), steps=3, search_rows=100)
    model = train(dataset, quick)
    assert model.recipe == name
    assert np.isfinite(model.predict(dataset.points[:3])).all()


def test_strengths_by_evidence_need_no_list(dataset: KeypointDataset):
    model = train(dataset, dataclasses.replace(QUICK, strengths="evidence", alphas=()))
    figures = model.record.networks.values()
    assert len({network.alpha for network in figures}) > 20
    assert all(network.search == {} for network in figures)
    assert model.record.summary["network"].mean_r2 > 0.3


def test_the_exact_points_can_be_read(dataset: KeypointDataset, dataset_folder: Path, tmp_path: Path):
    with pytest.raises(InputError, match="lacks the column 'points_2d'"):
        read_dataset(dataset_folder, points="points_2d")
    write_dataset(dataset, tmp_path, more={"points_2d": dataset.points + 3})
    exact = read_dataset(tmp_path, points="points_2d")
    np.testing.assert_allclose(exact.points, dataset.points + 3, rtol=1e-6)


def test_half_a_dataset_is_told(dataset: KeypointDataset, tmp_path: Path):
    write_dataset(dataset, tmp_path)
    description = json.loads((tmp_path / "dataset.json").read_text())
    for samples, whole in ((20_000, True), (20_001, False)):
        (tmp_path / "dataset.json").write_text(json.dumps(description | {"samples": samples}))
        with (
            nullcontext() if whole else pytest.raises(InputError, match="2 of 3 shards; run facegen generate")
        ):
            read_dataset(tmp_path)


PAPER = {
    **{"name": "paper", "alignment": "affine", "denoise": False, "undo_turn": False, "hidden": 20},
    **{"start": "nguyen_widrow", "mirror": False, "symmetric": False, "steps": 1000, "patience": 6},
    **{"improvement": 0.003, "strengths": "validation", "alphas": (1.0, 3.0, 10.0, 30.0)},
    **{"search_rows": 3000, "search_steps": 15, "smooth_frames": 10, "noise": None, "calibrated_noise": None},
    **{"calibrated": False, "calibrated_alignment": "affine", "calibrated_denoise": False},
    **{"calibrated_whitening": 0.0, "calibrated_linear": 0.0, "calibrated_gain": False},
}
"""The recipe, whole: a setting that is new has the value that it had before it was one, and stands here as well."""

PAPER_WEIGHTS = [
    [0.0026, 0.0024, 0.0059, 0.0050, 0.0025],
    [0.0245, 0.0781, 0.0528, 0.1997, 0.0328],
    [0.0000, 0.6462, 0.1565, 0.0577, 0.0000],
    [0.0333, 0.1351, 0.0000, 0.2541, 0.0635],
]
"""Every tenth weight or so of four faces, after three steps on the drawn dataset."""


def test_the_paper_recipe_is_the_papers():
    assert dataclasses.asdict(RECIPES["paper"]) == PAPER


def test_the_paper_recipe_trains_the_networks_that_it_always_did(dataset: KeypointDataset):
    """The same to the byte on one processor; others differ in what is rounded away here."""
    model = train(dataset, dataclasses.replace(RECIPES["paper"], steps=3), seed=3)
    weights = model.predict(dataset.points[dataset.rows("test")][:4])
    np.testing.assert_allclose(weights[:, [0, 1, 17, 25, 40]], PAPER_WEIGHTS, rtol=0, atol=1e-4)
    assert weights.mean() == pytest.approx(0.139192, abs=1e-6)


def test_networks_that_compare_do_not_hang_on_how_many_threads_there_are(
    dataset: KeypointDataset, monkeypatch: pytest.MonkeyPatch
):
    """Large products have other last bits in two threads; frames alone keep the machine's, as they always did."""
    threads: dict[bool, set[int]] = {False: set(), True: set()}
    prepared = run.prepare

    def watched(*words, calibrated: bool, **options):
        libraries = [library for library in threadpool_info() if library["user_api"] == "blas"]
        threads[calibrated].add(max(library["num_threads"] for library in libraries))
        return prepared(*words, calibrated=calibrated, **options)

    monkeypatch.setattr(run, "prepare", watched)
    with threadpool_limits(limits=2, user_api="blas"):
        run.train(dataset, dataclasses.replace(QUICK_STABLE, steps=2, alphas=(1.0,)))
    assert threads == {False: {2}, True: {1}}
