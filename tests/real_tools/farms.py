"""Small datasets for farms, and the commands that submit them."""

import json
import os
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import psutil

ROOT = Path(__file__).resolve().parents[2]

SPEC = """\
version = 1
kind = "still"
seed = 3
people = {people}
rig = "anny"

[still]
neutral = 1
faces = 4

[render]
headset = "tracking3"
samples = "0-{last}"
size_px = 24
samples_per_pixel = 1
denoise = false
"""


def write_spec(folder: Path, people: int = 12) -> Path:
    """The spec in a folder: 5 samples a person, each rendered in half a second or more."""
    path = folder / "small.toml"
    path.write_text(SPEC.format(people=people, last=5 * people - 1))
    return path


def facegen(*arguments: object, environ: Mapping[str, str] = os.environ, code: int | None = 0) -> str:
    """Run a facegen command to its end; returns its stdout."""
    done = subprocess.run(
        [sys.executable, "-m", "facegen", *map(str, arguments)],
        cwd=ROOT,
        env=environ,
        capture_output=True,
        text=True,
        timeout=1200,
    )
    assert code is None or done.returncode == code, (
        f"exit code {done.returncode}\n{done.stdout}\n{done.stderr}"
    )
    return done.stdout


def state(out: Path, environ: Mapping[str, str] = os.environ) -> dict:
    """``facegen farm status --json``."""
    return json.loads(facegen("farm", "status", out, "--json", environ=environ, code=None))


def rendered(out: Path) -> list[int]:
    """Numbers of the finished samples."""
    return sorted(int(path.name) for path in (out / "renders").glob("*/*"))


def attempts(out: Path) -> list[dict]:
    """What the logs say of all attempts of all runs."""
    lines = [
        line for path in sorted((out / "logs").glob("run-*.jsonl")) for line in path.read_text().splitlines()
    ]
    return [json.loads(line) for line in lines]


def outcomes(out: Path) -> list[str]:
    """How all attempts of all runs ended."""
    return [attempt["outcome"] for attempt in attempts(out)]


def files_of(out: Path) -> dict[str, bytes]:
    """What the dataset consists of: everything but logs and what the farm notes for itself."""
    kept = [
        p
        for p in sorted(out.rglob("*"))
        if p.is_file() and p.relative_to(out).parts[0] not in ("logs", "farm")
    ]
    return {str(path.relative_to(out)): path.read_bytes() for path in kept}


def no_leftovers(out: Path) -> bool:
    """Whether nothing half-made is left."""
    return not list((out / "tmp").iterdir()) and not list(out.rglob("*.part"))


def wait_for(condition: Callable[[], object], *, seconds: float = 600, what: str = "") -> None:
    """Wait until something holds, on the slowest machine and beside other work."""
    deadline = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < deadline, f"after {seconds} s still not: {what}"
        time.sleep(0.1)


def processes_with(*words: str) -> list[int]:
    """Processes whose command line has all these words."""
    return [
        process.pid
        for process in psutil.process_iter(["cmdline"])
        if process.pid != os.getpid()
        and all(word in "\0".join(process.info["cmdline"] or ()) for word in words)
    ]


def children_of(process: int) -> list[int]:
    """Worker processes of a supervisor: the spawned ones, not Python's tracker."""
    try:
        children = {child.pid for child in psutil.Process(process).children()}
    except psutil.NoSuchProcess:
        return []
    return [child for child in processes_with("spawn_main") if child in children]
