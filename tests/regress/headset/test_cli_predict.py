"""`regress headset predict`, as a person runs it."""

import csv
import io
import json
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from facegen.formats import read_live_link
from tests.regress.headset.takes import pictures, write_pictures, write_take
from tests.regress.headset.tiny import NAMES, OWNER, write_tiny_model

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def model(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return write_tiny_model(tmp_path_factory.mktemp("models") / "tiny")


@pytest.fixture
def take(tmp_path: Path) -> list[str]:
    """Options of a sound take of 12 frames, its own brightness a camera: 0.2, 0.4 and 0.6."""
    means = dict(zip(NAMES, (51, 102, 153), strict=True))
    return write_take(tmp_path / "take", {name: pictures([mean] * 12) for name, mean in means.items()})


def _rows(text: str) -> list[dict[str, str]]:
    return list(csv.DictReader(io.StringIO(text)))


def test_a_take_becomes_a_table_with_gaze_and_confidence(run, model: Path, take: list[str], tmp_path: Path):
    code, out, said = run(
        "headset", "predict", model, *take, "--fps", 30, "--confidence", tmp_path / "trust.csv"
    )
    assert (code, said) == (0, "")
    rows = _rows(out)
    assert list(rows[0])[:2] == ["frame", "time_s"]
    assert list(rows[0])[2:54] == list(BLENDSHAPES)
    assert list(rows[0])[54:] == [
        "left_eye_yaw_deg",
        "left_eye_pitch_deg",
        "right_eye_yaw_deg",
        "right_eye_pitch_deg",
    ]
    assert [row["frame"] for row in rows] == [str(number) for number in range(12)]
    expected = {"left_eye": 0.2, "right_eye": 0.4, "mouth": 0.6}
    for shape in BLENDSHAPES:
        assert float(rows[5][shape]) == pytest.approx(expected[OWNER[shape]], abs=0.005)
    assert float(rows[5]["left_eye_yaw_deg"]) == pytest.approx(np.degrees(0.02), abs=0.02)
    trust = _rows((tmp_path / "trust.csv").read_text())
    assert len(trust) == 12
    assert all(float(trust[0][shape]) > 0.5 for shape in BLENDSHAPES)


def test_a_model_without_points_cannot_give_any(run, model: Path, take: list[str], tmp_path: Path):
    code, out, said = run("headset", "predict", model, *take, "--points", tmp_path / "points.csv")
    assert (code, out) == (2, "")
    assert "the model gives no points: train one with points_loss above 0" in said
    assert not (tmp_path / "points.csv").exists()


def test_each_predict_says_which_command_takes_the_others_model(
    run, model: Path, take: list[str], quick_model_folder: Path
):
    code, out, said = run("predict", model, "-")
    assert (code, out) == (2, "")
    assert said == f"regress: {model} is a model of headset pictures; `regress headset` commands take it\n"
    code, out, said = run("headset", "predict", quick_model_folder, *take)
    assert (code, out) == (2, "")
    assert "is a model of 68 points; `regress` commands without `headset` take it" in said


def test_the_three_short_options_are_cameras_too(run, model: Path, take: list[str], tmp_path: Path):
    folder = tmp_path / "take"
    short = [
        "--left-eye",
        folder / "left_eye",
        "--right-eye",
        folder / "right_eye",
        "--mouth",
        folder / "mouth",
    ]
    assert run("headset", "predict", model, *short)[1] == run("headset", "predict", model, *take)[1]


def test_every_fault_is_one_sentence_and_the_other_cameras_go_on(run, model: Path, tmp_path: Path):
    stacks = {name: pictures([100] * 40, seed=seed) for seed, name in enumerate(NAMES)}
    stacks["mouth"][10:30] = stacks["mouth"][9]  # frozen
    stacks["left_eye"][5] = 3  # black
    options = write_take(tmp_path, stacks)
    (tmp_path / "right_eye" / "frame_0007.png").unlink()
    (tmp_path / "right_eye" / "frame_0008.png").write_bytes(b"\x89PNG")
    cv2.imwrite(str(tmp_path / "right_eye" / "frame_0020.png"), np.full((50, 20), 99, np.uint8))
    code, out, said = run("headset", "predict", model, *options, "--confidence", tmp_path / "trust.csv")
    assert code == 0
    assert said.splitlines() == [
        "left_eye: 1 of 40 frames have a black picture: 5",
        "right_eye: 1 of 40 frames have no picture: 7",
        "right_eye: 1 of 40 frames have a file that is no picture: 8",
        "right_eye: 1 of 40 frames have a picture of another shape: 20",
        "mouth: 12 of 40 frames have the picture of before again, while other cameras go on: 18-29",
    ]
    rows, trust = _rows(out), _rows((tmp_path / "trust.csv").read_text())
    at_fault = {"left_eye": {5}, "right_eye": {7, 8, 20}, "mouth": set(range(18, 30))}
    for row in range(40):
        for shape in BLENDSHAPES:
            gone = row in at_fault[OWNER[shape]]
            assert float(rows[row][shape]) == pytest.approx(0 if gone else 100 / 255, abs=0.005)
            assert (float(trust[row][shape]) <= 0.1) == gone
    code, out, said = run("headset", "predict", model, *options, "--strict", "--out", tmp_path / "w.csv")
    assert code == 2
    assert "without --strict the other cameras' pictures count" in said
    assert not (tmp_path / "w.csv").exists()


def test_a_camera_that_is_black_throughout_is_said_and_stops_a_strict_run(run, model: Path, tmp_path: Path):
    stacks = {name: pictures([100] * 5, seed=seed) for seed, name in enumerate(NAMES)}
    stacks["mouth"][:] = 2
    options = write_take(tmp_path, stacks)
    code, out, said = run("headset", "predict", model, *options)
    assert (code, said) == (0, "mouth: all of its 5 frames have a black picture\n")
    assert float(_rows(out)[0]["jawOpen"]) == 0
    assert run("headset", "predict", model, *options, "--strict")[0] == 2
    assert run("headset", "predict", model, *options[:4], "--strict")[0] == 0


def test_exchanged_cameras_are_told_and_weights_come_all_the_same(run, tmp_path: Path):
    down, across = np.mgrid[:12, :16]
    ramp = (40 + 8 * across + 5 * down).astype(np.uint8)
    looks = {"left_eye": ramp, "right_eye": ramp[:, ::-1], "mouth": ramp // 2}
    typical = {name: tuple(map(tuple, cv2.resize(look, (24, 24)).tolist())) for name, look in looks.items()}
    model = write_tiny_model(tmp_path / "model", typical=typical)
    taken = {
        name: np.clip(pictures([0] * 9).astype(int) + look, 0, 255).astype(np.uint8)
        for name, look in looks.items()
    }
    options = write_take(tmp_path / "take", taken)
    assert run("headset", "predict", model, *options)[::2] == (0, "")
    folder = tmp_path / "take"
    swapped = [
        "--left-eye",
        folder / "right_eye",
        "--right-eye",
        folder / "left_eye",
        "--mouth",
        folder / "mouth",
    ]
    code, out, said = run("headset", "predict", model, *swapped, "--strict")
    assert (code, len(_rows(out))) == (0, 9)
    assert [line.split(":")[0] for line in said.splitlines()] == ["left_eye", "right_eye"]
    assert "look more like those of right_eye or its own in a mirror" in said


@pytest.mark.parametrize(
    "typical",
    [
        *({"mouth": rows} for rows in ([[1] * 20] * 20, [[1] * 24] * 23 + [[1]], [1, 2], 7)),
        *({"mouth": [[value] * 24] * 24} for value in ("a", 300, -1, 1.5)),
        {"chin": [[1] * 24] * 24},
        7,
    ],
)
def test_a_damaged_typical_picture_is_one_sentence(run, take: list[str], tmp_path: Path, typical: object):
    model = write_tiny_model(tmp_path / "model")
    path = model / "model.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | {"typical": typical}))
    code, out, said = run("headset", "predict", model, *take)
    assert (code, out, len(said.splitlines())) == (2, "", 1)
    assert str(path) in said


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"calibration": "always"}, "calibration = \"always\": must be 'optional' or 'none'"),
        ({"cameras": [{"name": "left_eye", "width": 16}]}, "key 'cameras[0].height' is missing"),
        ({"scores": {"split": "test", "components": {"dense": {}}}}, "key 'scores.rows' is missing"),
        ({"scores": 7}, "model.json is not a headset model's description"),
        ({"age": 3}, "unknown key 'age'"),
    ],
)
def test_a_damaged_description_is_one_sentence(
    run, take: list[str], tmp_path: Path, changes: dict[str, object], message: str
):
    path = write_tiny_model(tmp_path / "model") / "model.json"
    path.write_text(json.dumps(json.loads(path.read_text()) | changes))
    code, out, said = run("headset", "predict", path.parent, *take)
    assert (code, out, len(said.splitlines())) == (2, "", 1)
    assert message in said


def test_scores_of_older_models_say_less(run, take: list[str], tmp_path: Path):
    path = write_tiny_model(tmp_path / "model") / "model.json"
    document = json.loads(path.read_text())
    for name in ("combined", "people_in_training", "unseen"):
        del document["scores"][name]
    path.write_text(json.dumps(document | {"training": {"people": 20}}))
    assert run("headset", "predict", path.parent, *take, "--confidence", tmp_path / "trust.csv")[0] == 0


@pytest.mark.parametrize("suffix", ["png", "tiff", "pgm"])
def test_pictures_of_more_bits_say_how_many(run, model: Path, tmp_path: Path, suffix: str):
    levels = {
        name: pictures([mean] * 4).astype(np.uint16) for name, mean in zip(NAMES, (51, 102, 153), strict=True)
    }
    for name, stack in levels.items():
        for place, depth in (("eight", np.uint8), ("twelve", np.uint16)):
            folder = tmp_path / place / name
            folder.mkdir(parents=True)
            for number, picture in enumerate(stack):
                deep = picture if depth is np.uint8 else 16 * picture + 7
                assert cv2.imwrite(str(folder / f"{number}.{suffix}"), deep.astype(depth))
                assert cv2.imwrite(str(folder.parent / f"{name}.{suffix}"), deep.astype(depth))
    eight, twelve = (
        [word for name in NAMES for word in ("--camera", f"{name}={tmp_path / place / name}")]
        for place in ("eight", "twelve")
    )
    code, out, said = run("headset", "predict", model, *eight, "--neutral", tmp_path / "eight")
    assert (code, said) == (0, "")
    neutral = ("--neutral", tmp_path / "twelve")
    assert run("headset", "predict", model, *twelve, *neutral, "--bits", 12) == (0, out, "")
    code, nothing, said = run("headset", "predict", model, *twelve)
    assert (code, nothing, len(said.splitlines())) == (2, "", 1)
    assert "has 16 bits a pixel" in said
    assert "--bits says how many of them the camera uses" in said
    code, nothing, said = run("headset", "predict", model, *twelve, "--bits", 10)
    assert (code, nothing) == (2, "")
    assert "--bits 10 holds levels to 1023" in said
    code, nothing, said = run("headset", "predict", model, *twelve, "--bits", 16)
    assert (code, nothing) == (2, "")
    assert "give --bits 12" in said, "all of them look black"
    for file in tmp_path.glob(
        "twelve/*.png"
    ):  # a glint that saturates what 16 bits hold is no reason to refuse
        picture = cv2.imread(str(file), cv2.IMREAD_UNCHANGED)
        picture[0, 0] = 65535
        cv2.imwrite(str(file), picture)
    code, _, said = run("headset", "predict", model, *twelve, *neutral, "--bits", 12)
    assert (code, said) == (0, "")
    if suffix == "tiff":
        assert cv2.imwrite(str(tmp_path / "twelve" / "mouth" / "0.tiff"), np.zeros((12, 16), np.float32))
        code, nothing, said = run("headset", "predict", model, *twelve, "--bits", 12)
        assert (code, nothing) == (2, "")
        assert "has pixels of type float32; pictures of 8 or 16 bits can be read" in said


def test_a_camera_may_be_left_out(run, model: Path, take: list[str]):
    code, out, said = run("headset", "predict", model, *take[:4])
    assert code == 0
    assert said == "mouth: not given; its shapes come from the other cameras as far as these know them\n"
    assert float(_rows(out)[0]["jawOpen"]) == 0


def test_eyes_of_one_take_and_the_mouth_of_another(run, model: Path, take: list[str], tmp_path: Path):
    other = write_take(tmp_path / "other", {"mouth": pictures([200] * 9)}, first=700)
    code, _, said = run("headset", "predict", model, *take[:4], *other)
    assert code == 2
    assert "--from-start matches takes of different recordings" in said
    code, out, said = run("headset", "predict", model, *take[:4], *other, "--from-start")
    assert code == 0
    assert said.startswith("the cameras have different numbers of frames (")
    assert len(said.splitlines()) == 1
    rows = _rows(out)
    assert len(rows) == 9
    assert float(rows[8]["jawOpen"]) == pytest.approx(200 / 255, abs=0.005)
    assert float(rows[8]["eyeBlinkLeft"]) == pytest.approx(0.2, abs=0.005)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--camera", "nose=take"], "the model has no camera 'nose'; it has left_eye, right_eye, mouth"),
        (["--camera", "mouth"], "--camera 'mouth' is not NAME=PATH, as --camera mouth=take/mouth"),
        (["--camera", "mouth=a", "--mouth", "b"], "camera mouth is given twice: b and a"),
        (
            [],
            "give either a dataset or the cameras' paths (left_eye, right_eye, mouth), as --camera NAME=PATH",
        ),
        (["nowhere"], "nowhere is no dataset with pictures: it has no folder renders"),
        (["TAKE", "--neutral", "99"], "is neither a frame of"),
        (["TAKE", "--one-euro", "1"], "does not say when its frames were taken; give --fps"),
        (["TAKE", "--format", "livelink"], "does not say when its frames were taken; give --fps"),
        (["TAKE", "--retarget", "vrm1", "--video", "a.mp4"], "leave out --retarget"),
        (
            ["TAKE", "--video", "a.gif"],
            "a.gif is no name of a film that can be written; these end in .mp4, .avi",
        ),
    ],
)
def test_what_cannot_be_done_is_one_sentence(
    run, model: Path, take: list[str], words: list[str], message: str
):
    words = take + words[1:] if words[:1] == ["TAKE"] else words
    code, out, said = run("headset", "predict", model, *words)
    assert code == 2
    assert message in said
    assert len(said.splitlines()) == 1
    assert out == ""


def test_a_film_whose_half_is_read_is_not_written_over(run, model: Path, tmp_path: Path):
    film = tmp_path / "both.mp4"
    film.write_bytes(b"a recording")
    code, _, said = run("headset", "predict", model, "--mouth", f"{film}#left", "--video", film)
    assert code == 2
    assert "is also what is read" in said
    assert film.read_bytes() == b"a recording"


def test_a_model_of_keypoints_is_told_apart(run, quick_model_folder: Path, take: list[str]):
    code, _, said = run("headset", "predict", quick_model_folder, *take)
    assert code == 2
    assert "headset" in said


def test_neutral_frames_by_number_by_folder_and_found(run, model: Path, tmp_path: Path):
    rng = np.random.default_rng(1)
    means = np.where(rng.random(80) < 0.5, 60, 60 + rng.uniform(10, 90, 80))
    means[3] = 60
    options = write_take(
        tmp_path / "take", {name: pictures(means, seed=seed) for seed, name in enumerate(NAMES)}
    )
    by_number = run("headset", "predict", model, *options, "--neutral", 3)
    for seed, name in enumerate(NAMES):
        write_pictures(tmp_path / "neutral", pictures(means, seed=seed)[3][None], name=f"{name}.png")
    assert run("headset", "predict", model, *options, "--neutral", tmp_path / "neutral") == by_number
    found = run("headset", "predict", model, *options, "--neutral", "auto")
    assert found[0] == by_number[0] == 0
    assert "is taken for neutral: 20 calm frames of 80 agree to 0.00" in found[2]
    for row, other in zip(_rows(found[1]), _rows(by_number[1]), strict=True):
        assert float(row["jawOpen"]) == pytest.approx(float(other["jawOpen"]), abs=0.005)
    assert float(_rows(by_number[1])[3]["jawOpen"]) == 0


def test_a_new_seat_is_said_once_with_its_frame(run, model: Path, tmp_path: Path):
    means = [60.0] * 40 + [170.0] * 40
    options = write_take(tmp_path, {name: pictures(means, seed=seed) for seed, name in enumerate(NAMES)})
    code, out, said = run("headset", "predict", model, *options, "--neutral", 0, "--fps", 30)
    assert code == 0
    assert len(said.splitlines()) == 1
    frame = int(said.removeprefix("frame ").partition(":")[0])
    assert 40 <= frame <= 55
    kept = run("headset", "predict", model, *options, "--neutral", 0, "--keep-neutral", "--fps", 30)
    assert kept[2].startswith(f"frame {frame}:")
    assert "less well calibrated" in kept[2]
    assert float(_rows(kept[1])[79]["jawOpen"]) == pytest.approx(110 / 255, abs=0.01)
    again = run("headset", "predict", model, *options, "--neutral", 0, "--neutral", 70, "--fps", 30)
    assert again[2] == said
    assert float(_rows(again[1])[79]["jawOpen"]) == pytest.approx(0, abs=0.01)
    for wrong, message in ((["60", "0"], "are not in the order of time"), (["0", "auto"], "is no frame of")):
        words = [word for name in wrong for word in ("--neutral", name)]
        refused = run("headset", "predict", model, *options, *words)
        assert (refused[0], message in refused[2]) == (2, True)
    assert float(_rows(out)[79]["jawOpen"]) == pytest.approx(170 / 255, abs=0.01)


def test_live_link_columns_hold_the_gaze(run, model: Path, take: list[str], tmp_path: Path):
    table = tmp_path / "take.csv"
    code, _, _ = run("headset", "predict", model, *take, "--fps", 30, "--format", "livelink", "--out", table)
    assert code == 0
    read = read_live_link(table)
    assert read.weights[:, BLENDSHAPES.index("jawOpen")] == pytest.approx(0.6, abs=0.005)
    row = _rows(table.read_text())[0]
    assert float(row["LeftEyeYaw"]) == pytest.approx(-0.02, abs=0.001)
    assert float(row["RightEyePitch"]) == pytest.approx(-0.08, abs=0.002)
    assert float(row["HeadYaw"]) == 0


def test_adjustments_are_those_of_regress_predict(run, model: Path, take: list[str], tmp_path: Path):
    path = tmp_path / "adjust.json"
    path.write_text(json.dumps({"format": "regress-adjustment", "shapes": {"jawOpen": {"gain": 0.5}}}))
    for option in ("--adjust", "--calibration"):
        out = run("headset", "predict", model, *take, option, path)[1]
        assert float(_rows(out)[0]["jawOpen"]) == pytest.approx(0.3, abs=0.005)


def test_a_dataset_is_predicted_by_sample(run, model: Path, tmp_path: Path):
    for name in NAMES:
        for sample, picture in enumerate(pictures([100] * 5)):
            folder = tmp_path / "set" / "renders" / "000" / f"{sample:06d}"
            write_pictures(folder, picture[None], name=f"{name}.png")
    code, out, said = run("headset", "predict", model, tmp_path / "set")
    assert (code, said, len(_rows(out))) == (0, "", 5)
    code, _, said = run("headset", "predict", model, tmp_path / "set", "--neutral", "auto")
    assert code == 2
    assert "a dataset has many people" in said


@pytest.mark.parametrize("suffix", [".webm", ".mp4"])
def test_a_film_shows_the_cameras_beside_the_avatar(
    run, model: Path, take: list[str], suffix: str, tmp_path: Path
):
    film = tmp_path / f"take{suffix}"
    code, _, said = run("headset", "predict", model, *take[:4], "--fps", 10, "--video", film)
    assert code == 0, said
    reader = cv2.VideoCapture(str(film))
    assert reader.get(cv2.CAP_PROP_FPS) == 10
    frames = [frame for there, frame in iter(reader.read, (False, None)) if there]
    reader.release()
    assert len(frames) == 12
    height, width = frames[0].shape[:2]
    assert height == 480
    assert width > 800
    # the right eye (0.4 of white) lies at the left, the left eye (0.2) beside it, and no mouth below
    side = height // 2
    assert frames[0][60:160, 20 : side - 20].mean() == pytest.approx(102, abs=8)
    assert frames[0][60:160, side + 20 : 2 * side - 20].mean() == pytest.approx(51, abs=8)
    assert frames[0][side + 60 :, 20 : 2 * side - 20].max() < 90
    assert sorted(path.name for path in tmp_path.iterdir()) == ["take", film.name]


def test_one_path_for_both_eyes_is_told(run, model: Path, take: list[str], tmp_path: Path):
    """A camera of 16 : 9 that shows both eyes passed for a view of each."""
    folder = tmp_path / "take" / "left_eye"
    for left, right, told in ((folder, folder, True), (f"{folder}#left", f"{folder}#right", False)):
        _, _, said = run("headset", "predict", model, "--left-eye", left, "--right-eye", right, "--fps", 30)
        assert ("left_eye and right_eye have the same path" in said) is told, said
