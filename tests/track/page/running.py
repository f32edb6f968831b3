"""`track run` as a person starts it, and cameras for it from files."""

import os
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

SAMPLES = Path(__file__).resolve().parents[3] / "docs/samples/headset"
CAMERAS = ("left_eye", "right_eye", "mouth")


@contextmanager
def running(folder: Path, options: Sequence[str]) -> Iterator[tuple[str, int]]:
    """`track run` with these options, its page's address and its process's number; it must still run at the end."""
    told = folder / "told.txt"
    command = [sys.executable, "-m", "track", "run", *options, "--port", "0", "--no-browser"]
    with told.open("wb") as errors:
        process = subprocess.Popen([*command, "--profile", str(folder / "me.toml")], stderr=errors)
    try:
        end = time.monotonic() + 180
        while not (found := re.search(r"http://127\.0\.0\.1:\d+/", told.read_text())):
            assert process.poll() is None, told.read_text()
            assert time.monotonic() < end, told.read_text()
            time.sleep(0.1)
        yield found[0], process.pid
        assert process.poll() is None, told.read_text()
    finally:
        process.terminate()
        process.wait(120)


def headset(folder: Path, *, seconds: int) -> list[str]:
    """Options of the three cameras of the sample, whose hundred pictures come over and over."""
    options = []
    for camera in CAMERAS:
        own = [
            shutil.copy(path, folder / f"{camera}-{path.name}") for path in (SAMPLES / camera).glob("*.png")
        ]
        (folder / camera).mkdir()
        for number in range(30 * seconds):
            os.link(sorted(own)[number % len(own)], folder / camera / f"{number:05d}.png")
        options += ["--camera", f"{camera}={folder / camera}"]
    return options
