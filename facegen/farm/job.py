"""Reads and writes the records of farm jobs in ``OUT/farm/job-001/``: what was asked for, and the engine's numbers."""

import re
from dataclasses import dataclass, field
from pathlib import Path
from typing import Annotated, Literal, get_args

from pydantic import Field, TypeAdapter, ValidationError

from facegen.documents import MOST_JSON_BYTES, read_bytes
from facegen.errors import InputError
from facegen.farm.chunks import Chunk
from facegen.farm.resources import Resources, refuse_control
from facegen.files import output_errors, write_whole
from facegen.refusals import refusal
from facegen.store import DatasetFolder
from facegen.work import memory_note

Step = Literal["generate", "validate", "pack", "train", "export"]

STEPS: tuple[Step, ...] = get_args(Step)
"""What a job can do, each after the one before it."""

JOB_NAME = r"^job-[0-9]{3,9}$"


@dataclass(frozen=True, kw_only=True)
class Job:
    """Record of a job: what was asked for, and what was missing then.

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
    whole
        Whether all that the spec asks for was asked for, and no slice of it.
    rigs
        Folder of built rigs where the job was submitted, absolute; tasks use it where they find it.
    """

    name: Annotated[str, Field(pattern=JOB_NAME)]
    engine: str
    out: str
    packed: str
    model: str
    steps: tuple[Step, ...]
    samples: str
    shards: str | None
    chunks: tuple[Chunk, ...]
    resources: Resources
    whole: bool = True
    rigs: str = ""

    def __post_init__(self) -> None:
        folders = {
            "--out": self.out,
            "--packed": self.packed,
            "--model": self.model,
            "FACEGEN_RIGS": self.rigs,
        }
        for what, folder in folders.items():
            refuse_control(folder, what=what)

    @property
    def folder(self) -> Path:
        """Folder of the record, as the submitting machine sees it."""
        return Path(self.out) / "farm" / self.name

    @property
    def memory_note(self) -> str:
        """A sentence where a task that renders has too little memory for its workers."""
        memory, cpus = self.resources.mem_mib, self.resources.cpus
        if memory is None or not any(chunk.samples for chunk in self.chunks):
            return ""
        note = memory_note(memory << 20, cpus)
        return note and f"--mem {self.resources.mem}: {note}"


@dataclass(frozen=True, kw_only=True)
class Submission:
    """Record of a submission: the engine's numbers of the job's steps, none where the engine gives none."""

    ids: dict[str, Annotated[str, Field(pattern=r"^[0-9]{1,20}$")]] = field(default_factory=dict)


def parse_steps(text: str) -> tuple[str, ...]:
    """Steps of ``--steps``, ``"generate,pack"``, in their order.

    Raises
    ------
    InputError
        If one is none of `STEPS`, or there is none.
    """
    names = [step.strip() for step in text.split(",") if step.strip()]
    unknown = [step for step in names if step not in STEPS]
    if unknown or not names:
        raise InputError(
            f"--steps {text!r}: {unknown[0] if unknown else 'nothing'} is none of {', '.join(STEPS)}"
        )
    return tuple(step for step in STEPS if step in names)


def new_job_name(folder: DatasetFolder) -> str:
    """Make the folder of a new job, whose name nobody else can get."""
    farm = folder.path / "farm"
    with output_errors(farm):
        farm.mkdir(parents=True, exist_ok=True)
        taken = [int(path.name[4:]) for path in farm.iterdir() if re.match(JOB_NAME, path.name)]
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
    write_whole(path, TypeAdapter(type(record)).dump_json(record, indent=1) + b"\n")


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
    content = read_bytes(path, most_bytes=MOST_JSON_BYTES)
    try:
        return TypeAdapter(kind).validate_json(content)
    except ValidationError as error:
        raise InputError(f"{path}: is not the record of a farm job ({refusal(error, kind)})") from None
    except InputError as error:  # of its resources, which speak of options
        raise InputError(f"{path}: {error}") from None
