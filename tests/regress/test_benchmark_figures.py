"""Benchmarks: all of them start, and their figures are of what they say."""

import subprocess
import sys
from collections.abc import Iterator
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.rigs import Rig
from regress.learning.training.dataset import KeypointDataset
from regress.learning.training.gain import SEEN
from regress.learning.training.preparation import OUTPUT_COLUMNS, draw_detected, faces_of
from regress.learning.training.recipes import RECIPES
from regress.runtime.model import Model
from regress.targets import OUTPUTS

ROOT = Path(__file__).parents[2]
FOLDER = ROOT / "benchmarks"
FILES = sorted([*FOLDER.glob("*.py"), *FOLDER.glob("experiments/*.py")])

STARTS = """
import importlib, sys
for name in sys.argv[1:]:
    try:
        module = importlib.import_module(name)
    except ModuleNotFoundError as missing:
        if missing.name.split(".")[0] in ("torch", "aiortc", "psutil", "playwright"):
            continue  # of an extra that need not be here
        raise
    if hasattr(module, "main") and "ArgumentParser" in open(module.__file__, encoding="utf-8").read():
        sys.argv = [name, "--help"]
        try:
            module.main()
        except SystemExit as left:
            assert not left.code, (name, left.code)
        else:
            raise AssertionError(f"{name} --help does not end")
"""


@pytest.mark.parametrize("as_module", [False, True], ids=["as a script", "with -m"])
def test_all_start_as_their_first_lines_say(as_module: bool):
    names = [path for path in FILES if _started_as_module(path) == as_module]
    assert len(names) > 5
    folders = {path.parent for path in names}
    for folder in sorted(folders):
        here = [path.stem for path in names if path.parent == folder]
        if as_module:
            here = [".".join((*folder.relative_to(ROOT).parts, stem)) for stem in here]
        paths = [ROOT] if as_module else [folder, ROOT]  # the latter is where the packages are installed from
        code = f"import sys; sys.path[:1] = {[str(path) for path in paths]!r}\n{STARTS}"
        done = subprocess.run(
            [sys.executable, "-c", code, *here], cwd=folder.parent, capture_output=True, text=True
        )
        assert done.returncode == 0, done.stderr[-2000:]


def _started_as_module(path: Path) -> bool:
    return (
        f"python -m benchmarks.{'experiments.' if path.parent != FOLDER else ''}{path.stem}"
        in path.read_text(encoding="utf-8")
    )


@pytest.fixture(scope="module")
def benchmark() -> Iterator:
    """A benchmark by its name; what it brings into the list of modules goes with it."""
    before, path = set(sys.modules), list(sys.path)
    sys.path.insert(0, str(FOLDER))

    def load(name: str) -> ModuleType:
        return import_module(name)

    yield load
    sys.path[:] = path
    for name in set(sys.modules) - before:
        if str(getattr(sys.modules[name], "__file__", "")).startswith(str(FOLDER)):
            del sys.modules[name]


def test_zero_stands_beside_errors_on_a_film(benchmark):
    detector = benchmark("track_detector")
    true = np.concatenate([np.zeros(90), np.full(10, 0.8)])
    ours, theirs = np.where(true > 0, 0.6, 0.1), np.zeros(100)
    found = detector.agreement(ours, theirs, true)
    assert found.r == pytest.approx((1.0, 0.0))
    assert found.mae == pytest.approx((0.11, 0.08, 0.08))  # who sees nothing seems to err less
    assert found.active == pytest.approx((0.2, 0.8, 0.8))
    lines = list(detector.truth_table({"jawOpen": found, "jawLeft": replace(found, active=(np.nan,) * 3)}))
    assert "MAE: ours, MediaPipe, zero" in lines[0]
    assert lines[-2] == "| mean of 2 | 1.00 / 0.00 | 0.110 / 0.080 / 0.080 | 0.200 / 0.800 / 0.800 |"
    assert lines[-1].startswith("| median of 2 |")


def test_ridge_is_finished_as_networks_are(benchmark, dataset: KeypointDataset, stable_model: Model):
    recordings, features = benchmark("real_recordings"), stable_model.calibrated.features
    ridge = recordings.ridges_beside(stable_model, dataset)["ridge_same_rows"]
    plain = recordings.fit_baseline(
        dataset, features, mirror=True, calibrated=True, noise=RECIPES["default"].calibrated_noise
    )
    assert ridge.predict(np.zeros((1, features.count))) == pytest.approx(0)
    people = draw_detected(faces_of(dataset, "validation", calibrated=True), SEEN, np.random.default_rng(27))
    true = people.weights[:, OUTPUT_COLUMNS]
    free = [OUTPUTS.index(name) for name in OUTPUTS if not name.startswith("eyeLook")]
    gaps = [
        np.abs(one.predict(people.features(features)).std(axis=0) - true.std(axis=0))[free].mean()
        for one in (plain, ridge)
    ]
    assert gaps[1] < gaps[0]


def test_other_seeds_play_other_people(benchmark, anny: Rig, monkeypatch: pytest.MonkeyPatch):
    replay = benchmark("replay")
    weights = np.random.default_rng(0).uniform(0, 0.4, (6, len(BLENDSHAPES)))
    monkeypatch.setattr(replay, "read_live_link", lambda path: SimpleNamespace(weights=weights))
    first, again, other = (replay.play(Path(), anny, 2, 1, seed)[0] for seed in (7, 7, 8))
    assert np.array_equal(first.exact[0], again.exact[0])
    assert not np.allclose(first.exact[0], other.exact[0])
    seen = [next(iter(take.seen(1.0, biased=True)))[1] - take.exact[0][10:] for take in (first, other)]
    assert not np.allclose(*seen)


def test_a_share_of_people_is_told(benchmark, capsys: pytest.CaptureFixture[str]):
    row = {"take": "speech", "noise_px": 1.0, "bias": True, "by person": [(0.07, 0.8), (0.09, 0.9)]}
    benchmark("real_recordings").tell_people([row, row | {"bias": False}])
    told = capsys.readouterr().out
    assert "| speech | 2 | 0.080 (0.070 to 0.090) | 0.850 (0.800 to 0.900) |" in told
    assert told.count("speech") == 1


def test_targets_are_not_judged(benchmark):
    traced = benchmark("traced_gaze")
    rows = np.arange(60)
    targets, judged = traced.targets_of(rows, np.random.default_rng(2).permutation(60))
    assert [len(seen) for seen in targets.values()] == [0, 1, 5, 9]
    assert not np.isin(judged, np.concatenate(list(targets.values()))).any()
    assert len(judged) >= 60 - 15


def test_gaze_errors_are_angles(benchmark):
    # a yaw of 20 degrees is less than that where eyes look up
    off = benchmark("traced_gaze").off_deg(np.array([[20.0, 60.0]]), np.array([[0.0, 60.0]]))
    assert off == pytest.approx(np.degrees(2 * np.arcsin(np.sin(np.radians(10)) * 0.5)))


def test_errors_of_changed_films_are_of_one_width(benchmark, monkeypatch: pytest.MonkeyPatch):
    sys.path.insert(0, str(ROOT))
    changed = benchmark("benchmarks.changed_eyes")
    rng = np.random.default_rng(4)
    pupils = rng.uniform((50, 40), (80, 60), (40, 2))
    film = changed.Film(
        name="film_a",
        frames=tuple(map(str, range(40))),
        pictures=np.zeros((40, 100, 130), np.uint8),
        pupils=pupils,
    )
    wrong = rng.normal(0, 1, pupils.shape)
    placed = SimpleNamespace(placement=SimpleNamespace(mirror=False, roll_deg=0.0), lost=False)
    monkeypatch.setattr(changed, "find_placement", lambda *given: placed)
    monkeypatch.setattr(changed.EyePoints, "of", lambda *given: SimpleNamespace(pupil=0))
    errors = {}
    for what in (
        "none",
        "0.5 times as near",
        "1.7 times as near",
        "on its side",
        "0.7, moved by .15 and -.1",
    ):
        near, change = changed.changes()[what]
        seen = change(film)
        # whoever traces errs by as much of the eye, however near it is
        off = near * (wrong @ [[0, -1], [1, 0]] if what == "on its side" else wrong)
        traced = SimpleNamespace(points=(seen.pupils + off)[:, None])
        monkeypatch.setattr(changed, "answer_to", lambda *given, traced=traced: traced)
        errors[what] = changed.told(None, seen, near * film.pictures.shape[2]).split(", ")[2]
    assert len(set(errors.values())) == 1, errors


def test_a_fit_is_judged_on_frames_that_it_has_not_seen(benchmark):
    eyes = benchmark("real_eyes")
    rng = np.random.default_rng(1)
    true = rng.normal(0, 10, (12, 2))
    found = true @ [[1.0, 0.3], [0.1, 0.9]] + 5 + rng.normal(0, 2, true.shape)
    fitted_r, fitted = eyes.pupil_figures(found, true, 100)
    left_out = eyes.error_percent(eyes.fitted_without(found, true), true, 100)
    assert left_out > fitted
    assert (eyes.axis_r(found, true) < fitted_r + 1e-12).all()
    exact = true @ [[1.0, 0.3], [0.1, 0.9]] + 5
    assert eyes.fitted_without(exact, true) == pytest.approx(true)


def test_a_neutral_face_that_is_off_trembles_no_answer(benchmark, anny: Rig):
    small = benchmark("small_movements")
    rng = np.random.default_rng(0)
    moved = np.zeros((2, len(BLENDSHAPES)))
    moved[1, BLENDSHAPE_INDEX["jawOpen"]] = small.SLIGHT[-1]
    rest, opened = small.project(anny, np.zeros(anny.components), moved)
    movement = ((opened - rest) / small.SLIGHT[-1]).ravel()
    neutral = rest.ravel() + rng.standard_normal((10, 136)).mean(axis=0)
    frames = rest.ravel() + rng.standard_normal((20_000, 136))
    said = (frames - neutral) @ movement / (movement @ movement)
    assert small._least_tremble(anny, ["jawOpen"]) == pytest.approx(said.std(), rel=0.02)


def test_pieces_of_which_none_is_sure_have_no_share(benchmark):
    tell = benchmark("bench_neutral").tell_pieces
    assert tell([{"sure": False, "off": 0.3}] * 2) == "0.00 of 2 | - | 1.00, -"
    assert (
        tell([{"sure": True, "off": 0.3}, {"sure": False, "off": 0.1}])
        == "0.50 of 2 | 0.30, 0.30 | 0.50, 1.00"
    )


def test_every_way_says_the_turn_since_the_neutral_frame(benchmark):
    head = benchmark("head_pose")
    eye = np.tile(np.eye(4), (3, 1, 1))
    faces = SimpleNamespace(camera_from_head=eye)
    said = head.Said(alone=eye, moved=eye, start=eye)
    assert head.row("exact", "known", "mean face", said, faces, faces).split("|")[-2].strip() == "0.00"


def test_ridge_sees_what_the_networks_beside_it_see(
    benchmark, dataset: KeypointDataset, stable_model: Model, monkeypatch: pytest.MonkeyPatch
):
    recipes, asked = benchmark("bench_recipes"), []
    assert stable_model.calibrated.features != stable_model.features

    def fit(dataset, features, **options):
        asked.append((features, options["seed"]))
        return fitted(dataset, features, **options)

    fitted = recipes.fit_baseline
    monkeypatch.setattr(recipes, "fit_baseline", fit)
    recipes.figures(stable_model, dataset, dataset, RECIPES["default"], calibrated=True)
    assert asked[0][0] is stable_model.calibrated.features
    assert asked[0][1] == stable_model.record.seed
