"""Writes the command line of each step: tasks run it, and anyone can paste it to run the step by hand."""

import shlex
from collections.abc import Callable

from facegen.farm.chunks import Chunk
from facegen.farm.job import Job


def generate_command(job: Job, *, spec: str, out: str, what: tuple[str, ...]) -> list[str]:
    """``facegen generate`` for ``what``: a chunk's arguments, or the engine's placeholders for them."""
    resources = job.resources
    return [
        *(resources.on_farm(resources.python), "-m", "facegen", "generate", spec, "--out", out, *what),
        *("--workers", str(resources.cpus), "--grace", f"{resources.grace_s:g}"),
    ]


def later_command(job: Job, step: str, *, out: str, packed: str, model: str) -> list[str]:
    """Write the command of a step after ``generate``; a job may have been asked for a slice, which is no fault."""
    python = job.resources.on_farm(job.resources.python)
    chosen = [] if job.whole else ["--samples", job.samples]
    commands: dict[str, Callable[[], list[str]]] = {
        "validate": lambda: ["facegen", "validate", out, "--partial"],
        "pack": lambda: ["facegen", "pack", out, "--out", packed, *chosen],
        "train": lambda: ["regress", "train", out, "--out", model],
        "export": lambda: ["regress", "export", model, "--out", f"{model}/exports"],
    }
    return [python, "-m", *commands[step]()]


def rigs_line(job: Job) -> str:
    """Shell line by which tasks find the rigs of the machine that submitted; those of another farm have their own."""
    if not job.rigs:
        return ""
    folder = shlex.quote(job.resources.on_farm(job.rigs))
    return f"[ ! -d {folder} ] || export FACEGEN_RIGS={folder}\n"


def chunk_lines(chunks: tuple[Chunk, ...]) -> str:
    """A file with one line of arguments per task, counted from 0."""
    return "".join(" ".join(chunk.arguments) + "\n" for chunk in chunks)
