"""Clips and tables of weights as strips and films."""

import io
from collections.abc import Sequence
from pathlib import Path

import cv2
import numpy as np
import pyarrow as pa
import pytest
from PIL import Image
from typer.testing import CliRunner

from facegen.cli import app
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.errors import FacegenError, InputError
from facegen.formats import live_link_csv
from facegen.formats.ppm import ppm_bytes, read_ppm_stream
from facegen.preview import (
    clip_of_dataset,
    clip_strip,
    contact_sheet,
    pictures,
    play_weights,
    write_film,
)
from facegen.store import Dataset

JAW = BLENDSHAPE_INDEX["jawOpen"]


@pytest.fixture(scope="module")
def opening(anny):
    """A jaw that opens in four frames; the detector lost the face in the third one."""
    weights = np.zeros((4, 52))
    weights[:, JAW] = [0.0, 0.5, np.nan, 1.0]
    return play_weights(anny, weights, np.arange(4) / 25, title="opening")


def test_a_face_stays_as_it_was_where_a_row_has_no_weights(opening):
    np.testing.assert_array_equal(opening.weights[:, JAW], [0, 0.5, 0.5, 1])
    assert opening.fps == pytest.approx(25)
    with pytest.raises(InputError, match="no row has all weights"):
        play_weights(opening.rig, np.full((2, 52), np.nan), np.arange(2.0), title="x.csv")


def test_pictures_show_the_jaw_opening_and_the_landmarks_on_it(opening):
    shut, _, _, wide = pictures(opening, height_px=120, landmarks=False)
    assert shut.dtype == np.uint8
    assert shut.shape == (120, 114, 3)
    change = np.abs(shut.astype(int) - wide).sum(axis=2) > 60
    rows = np.flatnonzero(change.any(axis=1))
    assert rows.min() > 60  # the lower half of the face alone
    dotted = next(pictures(opening, height_px=120))
    blue = (dotted[..., 2].astype(int) - dotted[..., 0] > 120).sum()
    assert blue > 40


@pytest.mark.parametrize("name", ["face.webm", "face.mp4"])
def test_films_hold_every_frame_at_its_rate(opening, tmp_path, name):
    frames = list(pictures(opening, height_px=96))
    write_film(tmp_path / name, frames, fps=opening.fps)
    film = cv2.VideoCapture(str(tmp_path / name))
    assert film.get(cv2.CAP_PROP_FPS) == pytest.approx(25)
    read = []
    while True:
        there, frame = film.read()
        if not there:
            break
        read.append(cv2.cvtColor(frame, cv2.COLOR_BGR2RGB))
    assert len(read) == 4
    for found, made in zip(read, frames, strict=True):
        assert np.abs(found.astype(int) - made).mean() < 12  # of 255: the codec loses detail, not the picture


def test_animated_pictures_hold_every_frame_at_its_rate(opening, tmp_path):
    frames = list(pictures(opening, height_px=96))
    for suffix in (".gif", ".webp"):
        write_film(tmp_path / f"face{suffix}", frames, fps=opening.fps)
        with Image.open(tmp_path / f"face{suffix}") as image:
            assert image.n_frames == 3  # two equal frames become one, shown twice as long
            assert image.size == frames[0].shape[1::-1]
    with pytest.raises(InputError, match=r"\.webm, \.mp4, \.gif, \.webp"):
        write_film(tmp_path / "face.avi", frames, fps=25)


def test_a_strip_of_a_clip_shows_faces_over_curves(recorded, tmp_path):
    clip = clip_of_dataset(recorded, 3)
    assert clip.title == "clip 3: sentence, person 0, session 0"
    np.testing.assert_allclose(np.linalg.det(clip.rotation), 1)
    assert (clip.rotation[:, 2, 2] > 0.8).all()  # towards the viewer
    figure = clip_strip(clip, count=2, height_px=96)
    assert [axes.get_title() for axes in figure.axes] == ["0.00 s", "1.97 s", ""]
    labels = {line.get_label() for line in figure.axes[2].lines}
    assert len(labels & set(BLENDSHAPES)) == 8
    figure.savefig(tmp_path / "strip.png")
    with pytest.raises(InputError, match="has no clip 99; there are clips 0-7"):
        clip_of_dataset(recorded, 99)


def test_the_command_plays_a_recording_and_refuses_what_it_cannot(anny, tmp_path):
    weights = np.zeros((6, 52))
    weights[:, JAW] = np.linspace(0, 1, 6)
    (tmp_path / "take.csv").write_text(live_link_csv(weights, np.arange(6) / 30))
    out = tmp_path / "face.gif"
    call = ["preview", "--weights", str(tmp_path / "take.csv"), "--size", "64", "--out"]
    assert CliRunner().invoke(app, [*call, str(out), "--frames", "0-5:2"]).exit_code == 0
    with Image.open(out) as image:
        assert image.n_frames == 3
        assert [image.seek(n) or image.info["duration"] for n in range(3)] == [70, 60, 70]  # 200 ms in all
    assert {path.name for path in tmp_path.iterdir()} == {"take.csv", "face.gif"}  # nothing half-made
    piped = CliRunner().invoke(app, [*call, "-", "--frames", "0-1", "--no-landmarks"])
    assert piped.exit_code == 0
    rig_pictures = pictures(
        play_weights(anny, weights, np.arange(6) / 30, title=""), height_px=64, landmarks=False
    )
    for found, drawn in zip(read_ppm_stream(io.BytesIO(piped.stdout_bytes)), rig_pictures, strict=False):
        np.testing.assert_array_equal(found, drawn)
    assert len(piped.stdout_bytes) == 2 * len(ppm_bytes(drawn))
    for arguments, words in (
        ([*call, str(tmp_path / "face.avi")], "ends in none of .png, .webm, .mp4"),
        ([*call, str(out), "--frames", "6"], "frame 6 does not exist"),
        (["preview", "--out", str(out)], "give one of them"),
    ):
        error = CliRunner().invoke(app, arguments).exception
        assert isinstance(error, FacegenError)
        assert words in str(error)


@pytest.mark.parametrize(("fps", "kept", "lasting_ms"), [(25, 12, 40), (60, 6, 33.3), (240, 3, 20.8)])
def test_no_frame_of_a_gif_is_shorter_than_programs_play(tmp_path, fps: float, kept: int, lasting_ms: float):
    frames = [np.full((8, 8, 3), 20 * number, dtype=np.uint8) for number in range(12)]
    write_film(tmp_path / "a.gif", iter(frames), fps=fps)
    with Image.open(tmp_path / "a.gif") as image:
        lasting = [image.seek(n) or image.info["duration"] for n in range(image.n_frames)]
    assert len(lasting) == kept
    assert min(lasting) >= 20
    assert np.mean(lasting) == pytest.approx(lasting_ms, abs=3.4)


def test_what_is_not_shown_is_not_read(recorded, monkeypatch):
    """A dataset of a million samples has 9 GB of columns; a film of two seconds needs few of some."""
    read = Dataset.read_shard

    def bounded(self: Dataset, path: Path, columns: Sequence[str] | None = None) -> pa.Table:
        assert columns is not None
        return read(self, path, columns)

    monkeypatch.setattr(Dataset, "read_shard", bounded)
    assert len(clip_of_dataset(recorded, 3).time_s) == 60
    assert contact_sheet(recorded, [70, 3]).axes
