"""A farm job's record in ``OUT/farm/job-001/``: what was asked for, and the numbers that the engine gave."""

import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from facegen.errors import InputError
from facegen.farm.chunks import Chunk
from facegen.files import output_errors
from facegen.refusals import refusal
from facegen.store import DatasetFolder

STEPS = ("generate", "validate", "pack", "train", "export")
"""What a job can do, each after the one before it."""


@dataclass(frozen=True, kw_only=True)
class Resources:
    """What each task gets, and how it is started.

    Attributes
    ----------
    cpus
        Processors a task.
    mem
        Memory a task, as Slurm writes it: ``"4G"``, ``"900M"``.
    time
        Longest time of a task, as Slurm writes it: minutes, ``"HH:MM:SS"`` or ``"D-HH:MM:SS"``.
    max_parallel
        Tasks at a time.
    grace_s
        Time that running samples get to end after a request to stop.
    env_setup
        Shell command before the task's own, for example ``"module load python/3.11"``.
    python
        The Python with facegen in it, on the farm.
    sbatch_args
        Further arguments for sbatch.
    path_map
        Pairs (from, to): folders that have another name on the farm.
    """

    cpus: int = 1
    mem: str | None = None
    time: str | None = None
    max_parallel: int | None = None
    grace_s: float = 30.0
    env_setup: str | None = None
    python: str = "python3.11"
    sbatch_args: tuple[str, ...] = ()
    path_map: tuple[tuple[str, str], ...] = ()

    @property
    def time_s(self) -> int | None:
        """`time` in seconds."""
        return None if self.time is None else _seconds(self.time)

    @property
    def mem_mib(self) -> int | None:
        """`mem` in MiB."""
        return None if self.mem is None else _mebibytes(self.mem)

    def on_farm(self, path: str | Path) -> str:
        """A path as the farm's machines see it."""
        text = str(path)
        for source, target in self.path_map:
            source = source.rstrip("/")
            if text == source or text.startswith(f"{source}/"):
                return target.rstrip("/") + text[len(source) :]
        return text


@dataclass(frozen=True, kw_only=True)
class Job:
    """A submission's record.

    Attributes
    ----------
    name
        ``job-001`` and so on.
    engine
        Key of `facegen.farm.ENGINES`.
    out, packed, model
        Folders of the dataset, of what `pack` writes and of the model, absolute.
    steps
        Some of `STEPS`.
    samples, shards
        What was asked for, as `facegen.work.wanted_tasks` takes them.
    chunks
        What was missing when the job was made.
    """

    name: str
    engine: str
    out: str
    packed: str
    model: str
    steps: tuple[str, ...]
    samples: str
    shards: str | None
    chunks: tuple[Chunk, ...]
    resources: Resources

    @property
    def folder(self) -> Path:
        """The record's folder, as the submitting machine sees it."""
        return Path(self.out) / "farm" / self.name


@dataclass(frozen=True, kw_only=True)
class Submission:
    """The engine's numbers of a job's steps; empty where the engine gives none."""

    ids: dict[str, str] = field(default_factory=dict)


def new_job_name(folder: DatasetFolder) -> str:
    """Make the folder of a new job, whose name nobody else can get."""
    farm = folder.path / "farm"
    with output_errors(farm):
        farm.mkdir(parents=True, exist_ok=True)
        taken = [int(match[1]) for path in farm.iterdir() if (match := re.fullmatch(r"job-(\d+)", path.name))]
        number = max(taken, default=0)
        while True:
            number += 1
            try:
                (farm / f"job-{number:03d}" / "logs").parent.mkdir()
            except FileExistsError:
                continue
            return f"job-{number:03d}"


def write_record(path: Path, record: Job | Submission) -> None:
    """Write a record so that it appears whole."""
    content = TypeAdapter(type(record)).dump_json(record, indent=1)
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    with output_errors(path):
        part.write_bytes(content + b"\n")
        os.replace(part, path)


def list_jobs(folder: DatasetFolder) -> list[tuple[Job, Submission | None]]:
    """All jobs of a dataset, oldest first; without a submission where there was none, as in a dry run.

    Raises
    ------
    InputError
        If a record cannot be read.
    """
    jobs = []
    for path in sorted((folder.path / "farm").glob("job-*/job.json")):
        submitted = path.with_name("submission.json")
        jobs.append((_read(path, Job), _read(submitted, Submission) if submitted.is_file() else None))
    return jobs


def asked_jobs(folder: DatasetFolder) -> list[Job]:
    """Jobs that were submitted, oldest first; where none was, those of dry runs, which may be started by hand."""
    jobs = list_jobs(folder)
    return [job for job, submission in jobs if submission is not None] or [job for job, _ in jobs]


def _read(path: Path, kind: type):
    try:
        return TypeAdapter(kind).validate_json(path.read_bytes())
    except OSError as error:
        raise InputError(f"{path}: cannot be read as the record of a farm job ({error})") from None
    except ValidationError as error:
        raise InputError(f"{path}: is not the record of a farm job ({refusal(error, kind)})") from None


def _seconds(text: str) -> int:
    match = re.fullmatch(r"(?:(\d+)-)?(\d+)(?::(\d+))?(?::(\d+))?", text)
    if match is None:
        raise InputError(f"--time {text!r}: write minutes, HH:MM:SS or D-HH:MM:SS, as Slurm does")
    days, *parts = match.groups()
    numbers = [int(part) for part in parts if part is not None]
    if days is not None:  # D-HH, D-HH:MM, D-HH:MM:SS
        hours, minutes, seconds = (*numbers, 0, 0)[:3]
        return ((int(days) * 24 + hours) * 60 + minutes) * 60 + seconds
    if len(numbers) == 3:
        return (numbers[0] * 60 + numbers[1]) * 60 + numbers[2]
    return numbers[0] * 60 + (numbers[1] if len(numbers) == 2 else 0)


def _mebibytes(text: str) -> int:
    match = re.fullmatch(r"(\d+)([KMGT]?)B?", text, re.IGNORECASE)
    if match is None:
        raise InputError(f"--mem {text!r}: write a whole number with K, M, G or T, for example 4G")
    return max(
        1, int(int(match[1]) * {"K": 1 / 1024, "": 1, "M": 1, "G": 1024, "T": 1 << 20}[match[2].upper()])
    )
