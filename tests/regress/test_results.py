"""What leaves the program: other avatars' shapes, Live Link Face's columns, animated avatars, smooth landmarks."""

import csv
import dataclasses
import io

import numpy as np
import pytest
from pygltflib import GLTF2

from facegen.conventions import BLENDSHAPES
from facegen.formats import read_live_link
from regress.errors import InputError
from regress.runtime.features import align_similarity, extract
from regress.runtime.inputs import Frames
from regress.runtime.model import save_model
from regress.runtime.stages.retargeting.shipped import shipped_targets
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.stages.smoothing import LandmarkSmoothing
from tests.facegen.formats.test_gltf_animation import avatar
from tests.facegen.formats.test_gltf_expressions import vrm
from tests.regress.drawn import drawn_face, drawn_faces, in_pictures

FACES = drawn_faces(np.random.default_rng(4), 12)


def _smoothed(faces: np.ndarray, time_s: np.ndarray, cutoff_hz: float, mean: np.ndarray) -> np.ndarray:
    frames = Frames(points=faces, labels=tuple(map(str, range(len(faces)))), time_s=time_s, source="here")
    return np.array([sample.points for sample in LandmarkSmoothing(cutoff_hz, mean).run(frames.samples())])


@pytest.fixture
def take(tmp_path):
    faces = FACES.copy()
    faces[7] = np.nan
    np.save(tmp_path / "take.npy", faces)
    return tmp_path / "take.npy"


@pytest.mark.parametrize("target", shipped_targets())
def test_columns_are_the_targets(target: str, run, quick_model, quick_model_folder, take):
    code, out, err = run("predict", quick_model_folder, take, "--retarget", target, "--keep-guessed-gaze")
    assert code == 0, err
    rows = list(csv.DictReader(io.StringIO(out)))
    retargeting = read_retargeting(target)
    assert tuple(rows[0]) == ("frame", *retargeting.names)
    assert set(rows[7].values()) == {"7", ""}
    written = np.array([[float(row[name]) for name in retargeting.names] for row in rows[:7]])
    expected = np.clip(quick_model.predict(FACES[:7]) @ retargeting.factors, 0, 1)
    np.testing.assert_allclose(written, expected, atol=1e-6)


def test_live_link_reads_back(run, quick_model, quick_model_folder, take):
    target = take.with_name("out.csv")
    options = (
        "--format",
        "livelink",
        "--fps",
        25,
        "--filter",
        "none",
        "--keep-guessed-gaze",
        "--out",
        target,
    )
    code, _, err = run("predict", quick_model_folder, take, *options)
    assert code == 0, err
    read = read_live_link(target)
    expected = quick_model.predict(np.load(take))
    np.testing.assert_allclose(read.weights, expected, atol=1e-9)
    np.testing.assert_allclose(read.time_s, np.arange(12) / 25, atol=2e-5)


@pytest.mark.filterwarnings("ignore:Ignoring chunk 2")
def test_an_avatar_moves(run, quick_model, quick_model_folder, take, tmp_path):
    options = (
        "--gltf",
        avatar(tmp_path / "a.glb"),
        "--fps",
        25,
        "--filter",
        "none",
        "--out",
        tmp_path / "b.glb",
    )
    code, out, err = run("predict", quick_model_folder, take, *options)
    assert (code, out) == (0, "")
    assert "no morph target for 48 of 52 shapes" in err
    gltf = GLTF2().load(str(tmp_path / "b.glb"))
    assert gltf.animations[-1].name == "take"
    view = gltf.bufferViews[gltf.accessors[gltf.animations[-1].samplers[1].output].bufferView]
    jaw = np.frombuffer(gltf.binary_blob(), "<f4", 11, view.byteOffset)
    expected = np.delete(quick_model.predict(np.load(take))[:, BLENDSHAPES.index("jawOpen")], 7)
    np.testing.assert_allclose(jaw, expected, atol=1e-6)


@pytest.mark.filterwarnings("ignore:Ignoring chunk 2")
@pytest.mark.parametrize("began_s", [0.0, 3600.0, 1.7e9])
def test_an_animation_begins_at_zero_whatever_a_recordings_clock_says(
    began_s, run, quick_model_folder, tmp_path
):
    names = [f"{axis}_{index}" for axis in "xy" for index in range(68)]
    lines = [",".join(["frame", "timestamp", "success", *names])]
    for number, face in enumerate(FACES):
        lines.append(",".join(map(str, [number, began_s + number / 25, 1, *face.T.ravel()])))
    (tmp_path / "take.csv").write_text("\n".join(lines))
    moved = ("--gltf", avatar(tmp_path / "a.glb"), "--out", tmp_path / "b.glb")
    code, _, err = run("predict", quick_model_folder, tmp_path / "take.csv", *moved)
    assert code == 0, err
    gltf = GLTF2().load(str(tmp_path / "b.glb"))
    accessor = gltf.accessors[gltf.animations[-1].samplers[0].input]
    assert accessor.min == [0.0]
    assert accessor.max == pytest.approx([11 / 25], abs=1e-5)


def test_a_model_without_calibrated_networks_asks_for_no_neutral_face(
    run, quick_model, quick_model_folder, take
):
    alone = take.with_name("alone")
    save_model(dataclasses.replace(quick_model, calibrated=None), alone)
    said = [run("predict", model, take)[2] for model in (quick_model_folder, alone)]
    assert ["--neutral" in words for words in said] == [True, False]


@pytest.mark.parametrize(("kind", "target"), [("VRM 1.0", "vrm1"), ("VRM 0.x", "vrm0")])
def test_a_vrm_s_expressions_move_what_they_bind(
    kind, target, run, quick_model, quick_model_folder, take, tmp_path
):
    avatar_and_target = ("--gltf", vrm(tmp_path / "a.vrm", kind), "--retarget", target)
    options = (*avatar_and_target, "--fps", 25, "--filter", "none", "--out", tmp_path / "b.glb")
    code, out, err = run("predict", quick_model_folder, take, *options, "--keep-guessed-gaze")
    assert (code, out) == (0, "")
    assert f"no morph target for {len(read_retargeting(target).names) - 3}" in err
    gltf = GLTF2().load(str(tmp_path / "b.glb"))
    view = gltf.bufferViews[gltf.accessors[gltf.animations[-1].samplers[0].output].bufferView]
    moved = np.frombuffer(gltf.binary_blob(), "<f4", 11 * 5, view.byteOffset).reshape(11, 5)
    shapes = np.delete(quick_model.predict(np.load(take)), 7, axis=0)
    smile = shapes[:, [BLENDSHAPES.index("mouthSmileLeft"), BLENDSHAPES.index("mouthSmileRight")]].mean(
        axis=1
    )
    np.testing.assert_allclose(moved[:, 4], 0.5 * np.clip(smile, 0, 1), atol=1e-6)
    jaw = np.clip(shapes[:, BLENDSHAPES.index("jawOpen")], 0, 1)
    np.testing.assert_allclose(moved[:, 0], 0.75 * jaw, atol=1e-6)


@pytest.mark.parametrize(
    ("options", "said"),
    [
        (("--format", "livelink"), "give --fps"),
        (("--gltf", "a.glb", "--out", "b.glb"), "give --fps"),
        (("--gltf", "a.glb"), "needs --out"),
        (("--gltf", "a.glb", "--out", "b.csv", "--fps", 25), "an animated avatar ends with .glb or .vrm"),
        (("--gltf", "none.glb", "--out", "b.glb", "--fps", 25), "does not exist"),
        (("--format", "livelink", "--retarget", "vrm1"), "leave out --retarget"),
        (("--retarget", "metahuman"), "no target 'metahuman'"),
        (("--smooth-landmarks", 1), "give --fps"),
    ],
)
def test_what_does_not_go_together_is_refused(options, said, run, quick_model_folder, take, monkeypatch):
    monkeypatch.chdir(take.parent)
    avatar(take.with_name("a.glb"))
    before = sorted(path.name for path in take.parent.iterdir())
    code, out, err = run("predict", quick_model_folder, take, *options)
    assert (code, out) == (2, "")
    assert said in err
    assert sorted(path.name for path in take.parent.iterdir()) == before


def test_laying_a_face_upon_the_mean_keeps_its_features(quick_model):
    laid = align_similarity(FACES, quick_model.features.mean_shape)
    np.testing.assert_allclose(
        extract(quick_model.features, laid), extract(quick_model.features, FACES), atol=1e-12
    )
    assert np.ptp(np.linalg.norm(laid[:, 16] - laid[:, 0], axis=1)) < 0.5


def test_smooth_landmarks_calm_a_still_face_of_a_moving_head(quick_model):
    rng = np.random.default_rng(1)
    still = np.repeat(drawn_face()[None], 90, axis=0)
    time_s, mean = np.arange(90) / 30, quick_model.features.mean_shape
    moving = in_pictures(rng, still)  # another roll, size and place in every frame
    calm = _smoothed(moving, time_s, 1.0, mean)
    np.testing.assert_allclose(calm, np.repeat(calm[:1], 90, axis=0), atol=1e-12)
    noisy = _smoothed(in_pictures(rng, still + rng.normal(size=still.shape) * 0.004), time_s, 1.0, mean)
    raw = align_similarity(in_pictures(rng, still + rng.normal(size=still.shape) * 0.004), mean)
    assert noisy[30:].std(axis=0).mean() < raw[30:].std(axis=0).mean() / 2


def test_landmarks_without_times_are_not_smoothed_in_silence():
    frames = Frames(points=FACES[:2], labels=("a", "b"), time_s=None, source="here")
    with pytest.raises(InputError, match="frame a has no time, which smoothing of landmarks needs"):
        LandmarkSmoothing(1.0, FACES[0]).run(frames.samples())
