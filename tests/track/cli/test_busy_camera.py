"""Why a camera gives no picture is said in one sentence, by OpenCV's own Linux backend: busy, forbidden, no room."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

PROGRAM = """
import sys
from functools import partial
from pathlib import Path
from track.cli import main
from track.sources import devices, sources, webcams

devices.FOLDER = Path(sys.argv.pop(1))
sources.WebcamSource = partial(webcams.WebcamSource, folder=devices.FOLDER)
main()
"""


@pytest.fixture
def shim(tmp_path: Path) -> Path:
    """`busy_camera.c`, built."""
    compiler = shutil.which("cc")
    if not sys.platform.startswith("linux") or compiler is None:
        pytest.skip("needs Linux and a C compiler")
    built = tmp_path / "busy_camera.so"
    source = Path(__file__).parent / "busy_camera.c"
    subprocess.run(
        [compiler, "-shared", "-fPIC", "-Wall", "-Werror", source, "-o", built, "-ldl"], check=True
    )
    return built


BUSY = "another program uses it; end that one (`fuser -v /dev/video42` says which)"


@pytest.mark.parametrize(
    ("camera", "number", "says", "sentence"),
    [
        ("42", 42, "EBUSY", BUSY),
        ("mouth tracker", 42, "EBUSY", f"{BUSY}; cameras here: 42 (Mouth Tracker)"),
        (
            "42",
            42,
            "EACCES",
            "you are not in the group video, which may open /dev/video42; say `sudo usermod -aG video $USER` and sign "
            "in again",
        ),
        (
            "42",
            42,
            "ENOSPC",
            "the USB port has no room for it beside others; use another port, format=MJPG, or a smaller size "
            "(0,size=320x240)",
        ),
        (
            "42",
            42,
            "METADATA",
            "/dev/video42 is no camera but a node of other data; the camera's own has another number",
        ),
        ("142", 142, "EBUSY", BUSY.replace("42", "142")),
    ],
)
def test_a_camera_that_gives_no_picture_says_why(
    shim: Path, tmp_path: Path, camera: str, number: int, says: str, sentence: str
):
    words = ["--camera", camera, "--detector", "points", "--no-page", "--record", str(tmp_path / "take.csv")]
    done = _run(shim, tmp_path, words, number=number, says=says)
    assert done.returncode == 2, done.stderr
    assert done.stderr.splitlines()[-1] == f"track: camera {camera} gives no picture: {sentence}"
    assert f"the camera says {says}" in done.stderr or says == "METADATA"
    assert "Traceback" not in done.stderr
    assert "VIDEOIO" not in done.stderr
    assert not (tmp_path / "take.csv").exists()


def test_a_node_without_pictures_is_not_listed(shim: Path, tmp_path: Path):
    listed = {
        says: json.loads(_run(shim, tmp_path, ["devices", "--json"], says=says).stdout)
        for says in ("METADATA", "EBUSY")
    }
    assert listed["METADATA"] == []
    assert [each["fault"] for each in listed["EBUSY"]] == [f"gives no picture: {BUSY}"]


def _run(
    shim: Path, tmp_path: Path, words: list[str], *, number: int = 42, says: str
) -> subprocess.CompletedProcess[str]:
    system = tmp_path / "system"
    (system / f"video{number}").mkdir(parents=True, exist_ok=True)
    (system / f"video{number}" / "name").write_text("Mouth Tracker\n")
    camera = {"CAMERA_DEVICE": f"/dev/video{number}", "CAMERA_SAYS": says, "LD_PRELOAD": str(shim)}
    return subprocess.run(
        [sys.executable, "-c", PROGRAM, system, *words],
        env={**os.environ, **camera, "XDG_CONFIG_HOME": str(tmp_path / "home")},
        capture_output=True,
        text=True,
        timeout=300,
    )
