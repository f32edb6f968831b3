"""A camera that another program streams from is said to be busy in one sentence, by OpenCV's own Linux backend."""

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
from track.sources import sources, webcams

sources.WebcamSource = partial(webcams.WebcamSource, folder=Path(sys.argv.pop(1)))
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


@pytest.mark.parametrize("camera", ["42", "mouth tracker"])
def test_a_camera_that_another_program_uses(shim: Path, tmp_path: Path, camera: str):
    (tmp_path / "system" / "video42").mkdir(parents=True)
    (tmp_path / "system" / "video42" / "name").write_text("Mouth Tracker\n")
    words = ["--camera", camera, "--detector", "points", "--no-page", "--record", str(tmp_path / "take.csv")]
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, tmp_path / "system", *words],
        env={**os.environ, "LD_PRELOAD": str(shim), "XDG_CONFIG_HOME": str(tmp_path / "home")},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 2, done.stderr
    assert done.stderr.splitlines()[-1] == (
        f"track: camera {camera} gives no picture: another program may be using it; cameras here: 42 (Mouth Tracker)"
    )
    assert "the camera says EBUSY" in done.stderr
    assert "Traceback" not in done.stderr
    assert "VIDEOIO" not in done.stderr
    assert not (tmp_path / "take.csv").exists()
