"""What a file gives is what its frames give as they come: over all readers, stages and writers."""

import io
import sys
from pathlib import Path

import numpy as np
import pytest

from regress.runtime.heads.camera import CameraSettings
from regress.runtime.inputs import READERS, read_frames
from regress.runtime.model import Model
from regress.runtime.predict import landmark_chain
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.adjustment import ShapeAdjustment
from regress.runtime.stages.filters import DEFAULT_FILTER, FILM_FILTER, FILTERS
from regress.runtime.stages.head import HeadSettings
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.output import Output
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.stages.soundness import Soundness
from regress.runtime.stages.stage import Chain
from regress.runtime.writers.avatar import animated_avatar
from regress.runtime.writers.csv_table import confidence_csv
from regress.runtime.writers.tables import TABLES
from tests.facegen.formats.test_gltf_animation import avatar
from tests.regress.drawn import drawn_faces
from tests.regress.test_inputs import example_file

ADJUSTMENTS = (
    '{"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": 2.0}, "*": {"dead_zone": 0.1}}}'
)

STAGES: dict[str, tuple[tuple[str, ...], Output]] = {
    "nothing": (("--filter", "none"), Output()),
    "filtered unasked": ((), Output(filter=FILM_FILTER)),
    **{f"filtered by {name}": (("--filter", name), Output(filter=name)) for name in FILTERS},
    "landmarks smoothed": (("--smooth-landmarks", "1.5"), Output(smooth_landmarks_hz=1.5)),
    "moving average": (("--smooth", "3"), Output(smooth=3)),
    "one euro": (("--one-euro", "2"), Output(one_euro=OneEuro(cutoff_hz=2.0))),
    "adjusted": (
        ("--filter", "none", "--adjust", "mine.json"),
        Output(adjustments={"jawOpen": ShapeAdjustment(gain=2.0), "*": ShapeAdjustment(dead_zone=0.1)}),
    ),
    "own blinks": (("--own-blinks",), Output(filter=FILM_FILTER, own_blinks=True)),
    "sides blended": (("--filter", "none", "--left-right-blend", "0.7"), Output(left_right_blend=0.7)),
    "mirrored": (("--filter", "none", "--mirror"), Output(mirror=True)),
    "retargeted": (("--filter", "none", "--retarget", "vrm1"), Output(retargeting=read_retargeting("vrm1"))),
    "all": (
        (
            *("--smooth-landmarks", "1.5", "--filter", "kalman-50", "--smooth", "3", "--one-euro", "2"),
            *("--adjust", "mine.json"),
            *("--left-right-blend", "0.7", "--mirror", "--retarget", "mixamo50"),
        ),
        Output(
            smooth_landmarks_hz=1.5,
            filter="kalman-50",
            smooth=3,
            one_euro=OneEuro(cutoff_hz=2.0),
            adjustments={"jawOpen": ShapeAdjustment(gain=2.0), "*": ShapeAdjustment(dead_zone=0.1)},
            left_right_blend=0.7,
            mirror=True,
            retargeting=read_retargeting("mixamo50"),
        ),
    ),
}


def _stepped(
    model: Model, path: Path, output: Output, *, confident: bool = False, head: HeadSettings | None = None
) -> Prediction:
    """The frames of a file, one at a time; 25 a second."""
    frames = read_frames(path)
    chain = Chain(
        [Soundness(needs_times=True), landmark_chain(model, output, confident=confident, head=head)]
    )
    taken = (
        Sample(label=label, time_s=row / 25, points=points)
        for row, (label, points) in enumerate(zip(frames.labels, frames.points, strict=True))
    )
    samples = list(chain.stream(taken))
    return Prediction(samples=samples, names=output.names, source=str(path))


@pytest.fixture
def take(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Twelve faces, of which one is not there and one the wrong way round; beside it an adjustment file."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mine.json").write_text(ADJUSTMENTS)
    faces = drawn_faces(np.random.default_rng(4), 12)
    faces[5] = np.nan
    faces[9] *= [1, -1]
    np.save(tmp_path / "take.npy", faces)
    return tmp_path / "take.npy"


@pytest.mark.parametrize("reader", READERS)
def test_every_reader(reader: str, run, quick_model: Model, quick_model_folder: Path, tmp_path: Path):
    path = example_file(reader, tmp_path)
    code, out, err = run("predict", quick_model_folder, path, "--fps", 25)
    assert code == 0, err
    frames, samples = read_frames(path).at_rate(25), {}
    for rows in frames.takes().values():  # each face of a picture is a take of its own
        output = Output(filter=FILM_FILTER if len(rows) > 1 else None)  # one frame is a still
        chain = Chain([Soundness(needs_times=True), landmark_chain(quick_model, output)])
        samples |= dict(zip(rows.tolist(), chain.stream(frames.take(rows).samples()), strict=True))
    in_order = [samples[row] for row in range(len(frames.labels))]
    assert out == TABLES["csv"].text(Prediction(samples=in_order, names=Output().names, source=str(path)))


@pytest.mark.parametrize("stage", STAGES)
def test_frames_one_by_one_give_the_files_table_with_every_stage(
    stage: str, run, quick_model: Model, quick_model_folder: Path, take: Path
):
    options, output = STAGES[stage]
    code, out, err = run("predict", quick_model_folder, take, "--fps", 25, *options)
    assert code == 0, err
    assert out == TABLES["csv"].text(_stepped(quick_model, take, output))
    assert len(out.splitlines()) == 13


def test_the_table_of_stages_is_whole():
    """Each thing that an `Output` can ask for is tried, alone and with the others."""
    changed = {name for _, output in STAGES.values() for name in vars(output) if _differs(output, name)}
    # lids of headsets alone (tests/regress/headset/test_live_cameras.py), and what is said
    assert changed == set(vars(Output())) - {"amplify_eyes", "few_told"}


def _differs(output: Output, name: str) -> bool:
    return getattr(output, name) != getattr(Output(), name)


@pytest.mark.parametrize("writer", TABLES)
def test_frames_one_by_one_give_every_format_of_table(
    writer: str, run, quick_model: Model, quick_model_folder: Path, take: Path
):
    code, out, err = run("predict", quick_model_folder, take, "--fps", 25, "--format", writer, "--smooth", 2)
    assert code == 0, err
    head = HeadSettings() if TABLES[writer].has_head else None
    assert out == TABLES[writer].text(_stepped(quick_model, take, Output(smooth=2), head=head))


@pytest.mark.parametrize("writer", TABLES)
def test_every_table_has_the_head(writer: str, run, quick_model: Model, quick_model_folder: Path, take: Path):
    """From the landmarks as they came, however they are smoothed after it, and mirrored with the rest."""
    camera = CameraSettings(picture_px=(1920, 1080), fov_deg=70.0)
    options = (
        "--picture",
        "1920x1080",
        "--fov-deg",
        70,
        "--smooth-landmarks",
        1.5,
        "--one-euro",
        2,
        "--mirror",
    )
    code, out, err = run("predict", quick_model_folder, take, "--fps", 25, "--format", writer, *options)
    assert code == 0, err
    output = Output(smooth_landmarks_hz=1.5, one_euro=OneEuro(cutoff_hz=2.0), mirror=True)
    stepped = _stepped(quick_model, take, output, head=HeadSettings(camera=camera))
    assert out == TABLES[writer].text(stepped)
    assert np.isnan(stepped.head).any(axis=1).tolist() == [row in (5, 9) for row in range(12)]


@pytest.mark.parametrize("mirrored", [False, True])
def test_an_avatar_and_the_confidence(
    mirrored: bool, run, quick_model: Model, quick_model_folder: Path, take: Path
):
    avatar(take.with_name("a.glb"))
    options = ("--gltf", "a.glb", "--out", "b.glb", "--confidence", "trust.csv", "--fps", 25, "--head")
    code, _, err = run("predict", quick_model_folder, take, *options, *(["--mirror"] if mirrored else []))
    assert code == 0, err
    assert "a.glb has no bone called head that can be turned" in err
    output = Output(filter=FILM_FILTER, mirror=mirrored)
    stepped = _stepped(quick_model, take, output, confident=True, head=HeadSettings())
    assert take.with_name("b.glb").read_bytes() == animated_avatar(stepped, Path("a.glb")).content
    assert take.with_name("trust.csv").read_text() == confidence_csv(stepped)


@pytest.mark.parametrize("stage", [name for name in STAGES if name != "own blinks"])
def test_a_pipe_gives_the_files_table_with_every_stage(
    stage: str, run, quick_model_folder: Path, take: Path, monkeypatch: pytest.MonkeyPatch
):
    options, _ = STAGES[stage]
    in_file = options or ("--filter", DEFAULT_FILTER)  # a recording has no delay to save
    _, out, _ = run("predict", quick_model_folder, take, "--fps", 25, *in_file)
    lines = [" ".join(map(repr, face.ravel().tolist())) for face in np.load(take)]
    monkeypatch.setattr(sys, "stdin", io.StringIO("\n".join(lines) + "\n"))
    code, piped, err = run("predict", quick_model_folder, "-", "--out", "-", "--fps", 25, *options)
    assert code == 0, err
    # an array's rows are called 0, 1, ... and lines 1, 2, ...
    assert [line.partition(",")[2] for line in piped.splitlines()] == [
        line.partition(",")[2] for line in out.splitlines()
    ]
