"""``track record``: what cameras show comes back from the folders as it was, moment by moment."""

import errno
import shlex
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from regress.runtime.headset.recordings.footage import line_up
from regress.runtime.headset.recordings.recording import read_recording
from regress.runtime.sample import Sample
from tests.track.virtual import noise
from track.cli import main
from track.errors import InputError, OutputError
from track.footage import FootageWriter

HEADSET = Path(__file__).parents[2] / "docs" / "samples" / "headset"
SIZES = {"left_eye": (64, 48), "mouth": (64, 48)}


def ended(monkeypatch: pytest.MonkeyPatch, *words: str) -> int:
    monkeypatch.setattr(sys, "argv", ["track", *words])
    with pytest.raises(SystemExit) as end:
        main()
    return end.value.code


def grey(number: int) -> np.ndarray:
    return noise(number)[..., 0].copy()


@settings(max_examples=20, deadline=None)
@given(st.integers(1, 6), st.lists(st.integers(0, 29), max_size=5, unique=True))
def test_what_was_seen_together_is_read_together(tmp_path_factory, times: int, lost: list[int]):
    """Of an eye that loses pictures, and a mouth that has one for several of them."""
    folder = tmp_path_factory.mktemp("takes") / "take"
    seen: list[tuple[np.ndarray | None, np.ndarray, bool]] = []
    with FootageWriter(folder, ["left_eye", "mouth"]) as writer:
        for moment in range(30):
            if moment % times == 0:
                mouth = grey(1000 + moment)
            pictures = {"mouth": mouth} | ({} if moment in lost else {"left_eye": grey(moment)})
            new = moment % times == 0 or moment not in lost
            if new:
                seen.append((pictures.get("left_eye"), mouth, moment % times == 0))
            writer.write(Sample(label="", time_s=moment / 60, pictures=pictures))
    assert writer.written == {"left_eye": 30 - len(lost), "mouth": len(range(0, 30, times))}
    takes = {name: read_recording(folder / name, name, width=64, height=48) for name in writer.written}
    footage = line_up(takes, SIZES)
    assert footage.numbers.tolist() == list(range(len(seen)))
    for row, (left, mouth, is_new) in enumerate(seen):
        faults = {name: footage.faults[name][row] for name in SIZES}
        assert (faults["left_eye"] is None) == (left is not None)
        if left is not None:
            assert np.array_equal(footage.pictures["left_eye"][row], left)
        # a picture counts at its own moment, and may stand for later ones
        assert faults["mouth"] is None or not is_new
        if faults["mouth"] is None:
            assert np.array_equal(footage.pictures["mouth"][row], mouth)
    lines = (folder / "times.csv").read_text().splitlines()
    assert lines[0] == "frame,time_s"
    assert len(lines) - 1 == len(seen)


def test_colours_stay_and_grey_ones_become_grey(tmp_path: Path):
    with FootageWriter(tmp_path / "take", ["a", "b"]) as writer:
        writer.write(
            Sample(label="", time_s=0.0, pictures={"a": noise(1), "b": np.stack([grey(2)] * 3, axis=-1)})
        )
    for name, wanted in (("a", noise(1)), ("b", grey(2))):
        found = cv2.imread(str(tmp_path / "take" / name / "000000.png"), cv2.IMREAD_UNCHANGED)
        assert np.array_equal(found, wanted)


def test_a_full_disk_ends_the_take_in_one_sentence(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    def full(self: Path, content: bytes) -> None:
        with open(self, "wb") as half:
            half.write(content[:100])
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr(Path, "write_bytes", full)

    def record() -> None:
        with FootageWriter(tmp_path / "take", ["a"]) as writer:
            for number in range(200):
                writer.write(Sample(label="", time_s=number / 30, pictures={"a": grey(number)}))

    with pytest.raises(OutputError, match=r"take: cannot be written \(No space left on device\)"):
        record()
    assert [path.name for path in (tmp_path / "take" / "a").iterdir()] == []  # nor half of any picture


def test_a_take_without_pictures_leaves_nothing(tmp_path: Path):
    with FootageWriter(tmp_path / "take", ["a"]) as writer:
        writer.write(Sample(label="", time_s=0.0, pictures={}))
    assert not list(tmp_path.iterdir())


def test_a_take_that_is_there_is_kept(tmp_path: Path):
    with pytest.raises(InputError, match="is there already"):
        FootageWriter(tmp_path, ["a"])
    with pytest.raises(OutputError, match="there is no folder"):
        FootageWriter(tmp_path / "none" / "take", ["a"])


def test_the_command_keeps_each_camera_s_pictures(tmp_path: Path, monkeypatch, capsys):
    cameras = [f"--camera={name}={HEADSET / name}" for name in ("left_eye", "mouth")]
    take = tmp_path / "my take"
    assert ended(monkeypatch, "record", str(take), "--fast", "--seconds", "1", *cameras) == 0
    said = capsys.readouterr().err
    assert f"{take / 'mouth'}: 30 pictures" in said
    written = next(line for line in said.splitlines() if "regress headset check" in line)
    options = shlex.split(written.partition("check ")[2])
    assert options == ["--camera", f"left_eye={take / 'left_eye'}", "--camera", f"mouth={take / 'mouth'}"]
    for name in ("left_eye", "mouth"):
        sources = sorted((HEADSET / name).glob("*.png"))[:30]
        kept = sorted((take / name).glob("*.png"))
        assert [file.name for file in kept] == [f"{number:06d}.png" for number in range(30)]
        for source, file in zip(sources, kept, strict=True):
            assert np.array_equal(cv2.imread(str(source), 0), cv2.imread(str(file), cv2.IMREAD_UNCHANGED))
    assert ended(monkeypatch, "record", str(take), *cameras) == 2
    assert "is there already" in capsys.readouterr().err
    assert ended(monkeypatch, "record", str(tmp_path / "b"), "--camera", "-") == 2
    assert "have no pictures to record" in capsys.readouterr().err
    assert ended(monkeypatch, "record", str(tmp_path / "b"), "--camera", "left_eye=0", "--camera", "1") == 2
    assert "--camera 1: a headset's camera needs its name before it" in capsys.readouterr().err
    assert not (tmp_path / "b").exists()
