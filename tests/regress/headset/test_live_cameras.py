"""A headset's cameras frame by frame give what their recording gives: faults, calibration, stages, tables."""

import dataclasses
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.errors import InputError
from regress.runtime.headset.answers.predict import HeadsetStream
from regress.runtime.headset.network.model import Temporal
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.network.temporal import TAPS
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.writers.csv_table import confidence_csv
from regress.runtime.writers.tables import TABLES
from tests.regress.headset.takes import HEIGHT, WIDTH, pictures, write_take
from tests.regress.headset.tiny import NAMES, write_tiny_model

FRAMES, NEUTRAL, RESEATED = 60, 1, 30

STAGES: dict[str, tuple[tuple[str, ...], Output]] = {
    "nothing": ((), Output()),
    "filtered": (("--filter", "kalman-33"), Output(filter="kalman-33")),
    "moving average": (("--smooth", "3"), Output(smooth=3)),
    "one euro": (("--one-euro", "2"), Output(one_euro=OneEuro(cutoff_hz=2.0))),
    "own blinks": (("--own-blinks",), Output(own_blinks=True)),
    "lids amplified": (("--amplify-eyes", "1.5"), Output(amplify_eyes=1.5)),
    "sides blended": (("--left-right-blend", "0.7"), Output(left_right_blend=0.7)),
    "mirrored": (("--mirror",), Output(mirror=True)),
    "retargeted": (("--retarget", "vrm1"), Output(retargeting=read_retargeting("vrm1"))),
    "all": (
        (
            "--filter",
            "mean7",
            "--smooth",
            "3",
            "--one-euro",
            "2",
            "--own-blinks",
            "--amplify-eyes",
            "1.5",
            "--left-right-blend",
            "0.7",
            "--mirror",
        ),
        Output(
            filter="mean7",
            smooth=3,
            one_euro=OneEuro(cutoff_hz=2.0),
            own_blinks=True,
            amplify_eyes=1.5,
            left_right_blend=0.7,
            mirror=True,
        ),
    ),
}


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    rng = np.random.default_rng(2)
    before = rng.uniform(0, 0.1, size=(56, TAPS - 1))
    taps = np.concatenate([1 - before.sum(axis=1, keepdims=True), before], axis=1)
    temporal = Temporal(fps=30.0, taps=tuple(map(tuple, taps.tolist())), people=2, dataset_hash="0" * 64)
    return write_tiny_model(tmp_path_factory.mktemp("models") / "tiny", temporal=temporal)


@pytest.fixture(scope="module")
def predictor(model: Path) -> HeadsetPredictor:
    return load_headset_predictor(model)


@pytest.fixture
def frames() -> list[dict[str, np.ndarray]]:
    """Pictures by camera: a change of seat, a black picture, a missing one, one of another size, a frozen camera."""
    means = np.array([70.0] * RESEATED + [170.0] * (FRAMES - RESEATED)) + 8 * np.sin(np.arange(FRAMES) / 3)
    stacks = {name: pictures(means, seed=seed) for seed, name in enumerate(NAMES)}
    stacks["left_eye"][5] = 2
    stacks["mouth"][40:58] = stacks["mouth"][39]
    taken = [{name: stacks[name][row] for name in NAMES} for row in range(FRAMES)]
    del taken[12]["right_eye"]
    taken[20]["right_eye"] = cv2.resize(taken[20]["right_eye"], (2 * WIDTH, 2 * HEIGHT))
    taken[21]["right_eye"] = np.full((50, 20), 99, dtype=np.uint8)
    taken[25] = {}
    return taken


@pytest.fixture
def options(frames: list[dict[str, np.ndarray]], tmp_path: Path) -> list[str]:
    """The frames as folders of pictures."""
    words = write_take(tmp_path, {name: np.array([frames[0][name]]) for name in NAMES})
    for row, taken in enumerate(frames):
        for name, picture in taken.items():
            assert cv2.imwrite(str(tmp_path / name / f"frame_{row:04d}.png"), picture)
    return [*words, "--fps", "30"]


def _stepped(
    predictor: HeadsetPredictor, frames: list[dict[str, np.ndarray]], output: Output, **settings: bool
) -> tuple[Prediction, HeadsetStream]:
    stream = HeadsetStream(predictor, output, fps=30, **settings)
    stream.use_neutral(frames[NEUTRAL])
    samples = [
        ready
        for row, taken in enumerate(frames)
        for ready in stream.feed(Sample(label=str(row), time_s=row / 30, pictures=taken))
    ]
    samples += stream.finish()
    return Prediction(samples=samples, names=output.names), stream


@pytest.mark.parametrize("keep", [False, True])
@pytest.mark.parametrize("temporal", [False, True])
def test_calibration_seats_and_taps(
    keep: bool, temporal: bool, run, model: Path, predictor: HeadsetPredictor, frames, options, tmp_path: Path
):
    words = [*(["--keep-neutral"] if keep else []), *(["--temporal"] if temporal else [])]
    trust = tmp_path / "trust.csv"
    code, out, said = run(
        "headset", "predict", model, *options, "--neutral", NEUTRAL, "--confidence", trust, *words
    )
    assert code == 0, said
    stepped, stream = _stepped(predictor, frames, Output(), keep_neutral=keep, temporal=temporal)
    assert out == TABLES["csv"].text(stepped)
    assert trust.read_text() == confidence_csv(stepped)
    (frame,) = stream.networks.reseated
    assert RESEATED <= int(frame) <= RESEATED + 15
    assert f"frame {frame}: the headset does not sit" in said
    weights = stepped.weights[:, BLENDSHAPES.index("jawOpen")]
    assert np.isnan(weights[25])
    # a new seat is 100 grey levels brighter than the neutral picture, which are subtracted while calibrated
    assert (weights[47] < 0.55) == keep


@pytest.mark.parametrize("stage", STAGES)
def test_frames_one_by_one_give_the_files_table_with_every_stage(
    stage: str, run, model: Path, predictor: HeadsetPredictor, frames, options
):
    words, output = STAGES[stage]
    code, out, said = run("headset", "predict", model, *options, "--neutral", NEUTRAL, *words)
    assert code == 0, said
    assert out == TABLES["csv"].text(_stepped(predictor, frames, output)[0])


@pytest.mark.parametrize("writer", TABLES)
def test_frames_one_by_one_give_every_format_of_table(
    writer: str, run, model: Path, predictor: HeadsetPredictor, frames, options
):
    code, out, said = run(
        "headset", "predict", model, *options, "--neutral", NEUTRAL, "--format", writer, "--mirror"
    )
    assert code == 0, said
    assert out == TABLES[writer].text(_stepped(predictor, frames, Output(mirror=True))[0])


def test_neutral_pictures_are_placed_as_the_cameras_pictures_are(predictor: HeadsetPredictor, frames):
    """The left half of twice as large pictures: what is beside it does not count in either."""
    placement = {name: CameraPlacement(x=0.25, y=0.5, size=0.5) for name in NAMES}
    rng = np.random.default_rng(5)

    def beside(picture: np.ndarray) -> np.ndarray:
        wide = rng.integers(0, 255, (2 * HEIGHT, 2 * WIDTH), dtype=np.uint8)
        wide[HEIGHT // 2 : HEIGHT // 2 + HEIGHT, :WIDTH] = picture
        return wide

    taken = {name: pictures([120], seed=seed)[0] for seed, name in enumerate(NAMES)}
    at_rest = {name: pictures([100], seed=seed)[0] for seed, name in enumerate(NAMES)}
    plain, placed = (HeadsetStream(predictor, fps=30, placement=each) for each in (None, placement))
    plain.use_neutral(at_rest)
    placed.use_neutral({name: beside(picture) for name, picture in at_rest.items()})
    expected = plain.step(Sample(label="0", time_s=0.0, pictures=taken))
    found = placed.step(
        Sample(label="0", time_s=0.0, pictures={name: beside(picture) for name, picture in taken.items()})
    )
    np.testing.assert_allclose(found.weights, expected.weights, atol=0.01)
    assert 0.03 < expected.weights.max() < 0.12


@pytest.mark.parametrize(
    ("picture", "said"),
    [
        (np.zeros((HEIGHT, WIDTH), np.uint8), "the neutral picture of mouth cannot be one: it is"),
        (np.full((50, 20), 99, np.uint8), "the neutral picture of mouth cannot be one: it is"),
    ],
)
def test_a_neutral_picture_that_shows_nothing_is_refused(
    predictor: HeadsetPredictor, frames, picture: np.ndarray, said: str
):
    with pytest.raises(InputError, match=said):
        HeadsetStream(predictor).use_neutral({**frames[NEUTRAL], "mouth": picture})
    with pytest.raises(InputError, match="a neutral picture is of chin; the model's cameras are left_eye"):
        HeadsetStream(predictor).use_neutral({"chin": frames[NEUTRAL]["mouth"]})


def test_faults_of_live_pictures_are_told(predictor: HeadsetPredictor, frames):
    stepped, _ = _stepped(predictor, frames, Output())
    faults = [{name: fault.name for name, fault in sample.faults.items()} for sample in stepped.samples]
    assert faults[5] == {"left_eye": "BLACK"}
    assert faults[12] == {"right_eye": "MISSING"}
    assert faults[20] == {}
    assert faults[21] == {"right_eye": "SHAPE"}
    assert faults[25] == dict.fromkeys(NAMES, "MISSING")
    frozen = [row for row, found in enumerate(faults) if found.get("mouth") == "FROZEN"]
    assert frozen == list(range(48, 58))
    assert dataclasses.is_dataclass(stepped.samples[0])
