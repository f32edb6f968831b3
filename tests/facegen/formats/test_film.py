"""Films by OpenCV; what they hold is tested where faces are drawn."""

import subprocess
import sys
from pathlib import Path

import cv2
import numpy as np
import pytest

from facegen.errors import FormatError
from facegen.formats.film import encode_film

ROOT = Path(__file__).resolve().parents[3]


def test_a_film_that_cannot_be_written_says_so(tmp_path: Path):
    frames = np.zeros((2, 32, 32, 3), dtype=np.uint8)
    with pytest.raises(OSError, match=r"films that end in \.nothing"):
        encode_film(tmp_path / "face.nothing", frames, fps=25)


def test_a_frame_that_fails_ends_the_film(tmp_path: Path):
    def frames():
        yield np.zeros((32, 32, 3), dtype=np.uint8)
        raise ValueError("no more faces")

    with pytest.raises(ValueError, match="no more faces"):
        encode_film(tmp_path / "face.mp4", frames(), fps=25)


def test_a_name_that_is_no_text_is_refused(tmp_path: Path):
    frames = np.zeros((2, 32, 32, 3), dtype=np.uint8)
    with pytest.raises(FormatError, match="no name in UTF-8"):  # of which OpenCV 4.11 dies
        encode_film(tmp_path / "face\udcff.mp4", frames, fps=25)


def test_browsers_play_webm_and_no_library_complains(tmp_path: Path, capfd: pytest.CaptureFixture):
    frames = np.zeros((3, 32, 32, 3), dtype=np.uint8)
    encode_film(tmp_path / "face.WEBM", frames, fps=25)
    film = cv2.VideoCapture(str(tmp_path / "face.WEBM"))
    assert int(film.get(cv2.CAP_PROP_FOURCC)).to_bytes(4, "little") == b"VP90"
    print("still there", file=sys.stderr)
    assert capfd.readouterr().err == "still there\n"


@pytest.mark.parametrize("suffix", [".webm", ".mp4", ".avi"])
def test_a_film_that_finds_no_room_says_so(tmp_path: Path, suffix: str):
    # beyond this size every write fails, as on a full disk; a process of its own, because the limit stays
    program = f"""
import resource, signal
import numpy as np
from pathlib import Path
from facegen.errors import FormatError
from facegen.formats.film import encode_film
signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
resource.setrlimit(resource.RLIMIT_FSIZE, (100_000, 100_000))
frames = np.random.default_rng(0).integers(0, 255, (20, 160, 160, 3), dtype=np.uint8)
encode_film(Path({str(tmp_path / f"face{suffix}")!r}), frames, fps=25)
"""
    done = subprocess.run([sys.executable, "-c", program], cwd=ROOT, capture_output=True, text=True)
    assert "of 20 frames can be read back: no space is left" in done.stderr.splitlines()[-1]
