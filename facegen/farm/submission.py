"""Submits a job: cuts what is missing into tasks, writes them as scripts or a bundle, hands them to the engine."""

import contextlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

from facegen.errors import FacegenError, InputError, Unanswered
from facegen.farm.chunks import cut_chunks
from facegen.farm.engine import Activity, Engine
from facegen.farm.engines import ENGINES
from facegen.farm.job import Job, Resources, Submission, list_jobs, new_job_name, write_record
from facegen.farm.places import check_packed, refuse_rivals
from facegen.files import output_errors
from facegen.rigs import rigs_folder
from facegen.spec import format_ranges
from facegen.store import Dataset, DatasetFolder, begin, staging
from facegen.work import Task, plan_work, wanted_tasks


@dataclass(frozen=True, kw_only=True)
class Remaining:
    """Numbers of what a job would make: missing shards and samples that no engine is at."""

    shards: list[int]
    samples: list[int]


def remaining(
    dataset: Dataset,
    samples: str | None,
    *,
    shards: str | None = None,
    busy: frozenset[Task] = frozenset(),
    retry_quarantined: bool = False,
) -> Remaining:
    """List what is missing of `facegen.work.wanted_tasks`, and is neither quarantined nor among ``busy``."""
    missing = plan_work(dataset, samples, shards=shards, retry_quarantined=retry_quarantined).missing
    free = [task for task in missing if task not in busy]
    return Remaining(
        shards=[task.number for task in free if task.kind == "shard"],
        samples=[task.number for task in free if task.kind == "sample"],
    )


def prepare(
    dataset: Dataset,
    what: Remaining,
    *,
    engine: str,
    steps: tuple[str, ...],
    samples: str | None,
    resources: Resources,
    shards: str | None = None,
    chunk: int | None = None,
    packed: str | None = None,
    model: str | None = None,
    at_work: tuple[tuple[Job, str], ...] = (),
) -> Job:
    """Write a job's record and its scripts or bundle below ``OUT/farm``; nothing is handed over.

    Parameters
    ----------
    dataset
        Its folder is begun if it was not.
    what
        What the tasks make, from `remaining`.
    engine
        Key of `ENGINES`.
    steps
        Some of `facegen.farm.STEPS`.
    samples, shards
        What was asked for, for the record.
    resources
        What each task gets.
    chunk
        Samples a task.
    packed, model
        Folders for ``pack`` and ``train``; without, beside the dataset.
    at_work
        Later steps of other jobs that engines have.

    Raises
    ------
    InputError
        If ``chunk`` makes too many tasks, a step of another job writes into the same folder, the pack's holds another
        pack, the folder holds another dataset, or the engine or a shell would not take what would be written.
    OutputError
        If the folder cannot be written.
    """
    # tasks begin in another folder; a link stays one, as a virtual environment's Python is
    if "/" in resources.python:
        resources = replace(resources, python=os.path.abspath(resources.python))
    chunks = cut_chunks(what.shards, what.samples, chunk=chunk) if "generate" in steps else ()
    out = dataset.folder.path.resolve()
    draft = Job(
        name="job-000",
        engine=engine,
        out=str(out),
        packed=str(Path(packed).resolve() if packed else out.with_name(f"{out.name}-packed")),
        model=str(Path(model).resolve() if model else out.with_name(f"{out.name}-model")),
        steps=steps,
        # the spec's own samples are written out: a later version of the spec may name others
        samples=dataset.spec.render.samples if samples is None else samples,
        shards=format_ranges(range(dataset.shards)) if samples is None else shards,
        chunks=chunks,
        resources=resources,
        whole=_is_whole(dataset, samples, shards),
        rigs=str(rigs_folder().resolve()),
    )
    refuse_rivals(draft, at_work)
    with tempfile.TemporaryDirectory() as folder:  # what is refused leaves nothing in the dataset
        _write_files(draft, Path(folder))
        _engine(draft).check(Path(folder))
    begin(dataset)
    if "pack" in steps:
        check_packed(dataset, draft)
    job = replace(draft, name=new_job_name(dataset.folder))
    with output_errors(job.folder):
        (job.folder / "logs").mkdir(exist_ok=True)
        _write_files(job, job.folder)
    write_record(job.folder / "job.json", job)
    return job


def _is_whole(dataset: Dataset, samples: str | None, shards: str | None) -> bool:
    """Whether a request leaves nothing out that the spec asks for."""
    if samples is None:
        return True
    asked, everything = wanted_tasks(dataset, samples, shards), wanted_tasks(dataset, None)
    return len(asked) >= len(everything) and set(everything.samples) <= set(asked.samples)


def _write_files(job: Job, folder: Path) -> None:
    for name, text in _engine(job).files(job).items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(text, encoding="utf-8")


def _engine(job: Job) -> Engine:
    if job.engine not in ENGINES:
        raise InputError(
            f"{job.folder}: {job.name} is of the engine {job.engine!r}, none of {', '.join(ENGINES)}"
        )
    return ENGINES[job.engine]


def submit(job: Job, *, retried: tuple[str, ...] = ()) -> Submission:
    """Hand a prepared job to its engine, and write down under which numbers.

    Parameters
    ----------
    job
        From `prepare`.
    retried
        Names of what failed three times and is to be tried again: the tasks would leave it out by its records, which
        go, unless the engine does not take the job.

    Raises
    ------
    FacegenError
        If the engine does not take it; then the job's folder is gone as well, and the next one has its name.
    Unanswered
        If the engine may have taken it; what runs then finds its folder.
    """
    try:
        with _put_aside(DatasetFolder(Path(job.out)), retried):
            submission = _engine(job).submit(job)
    except Unanswered as error:
        raise Unanswered(
            f"{error}; {job.name} may be queued all the same, so {job.folder} is kept: cancel what the queue has of "
            f"{job.name}, then submit again"
        ) from None
    except FacegenError:
        shutil.rmtree(job.folder, ignore_errors=True)
        raise
    write_record(job.folder / "submission.json", submission)
    return submission


@contextlib.contextmanager
def _put_aside(folder: DatasetFolder, names: tuple[str, ...]) -> Iterator[None]:
    """Remove records of the quarantine for good at the end, or put them back where a job certainly was not taken."""
    if not names:
        yield
        return
    with staging(folder, "retried") as stage:
        for name in names:
            with contextlib.suppress(FileNotFoundError):
                os.rename(folder.quarantine(name), stage / name)
        try:
            yield
        except Unanswered:
            raise
        except BaseException:
            for record in stage.iterdir():
                os.rename(record, folder.quarantine(record.name))
            raise


def cancel(folder: DatasetFolder) -> list[str]:
    """Cancel all of a dataset's jobs that an engine has; returns their names.

    Raises
    ------
    InputError
        If nothing was ever submitted from the folder, or an engine refuses; all other jobs are cancelled then.
    """
    if not (folder.path / "farm").is_dir():
        raise InputError(
            f"{folder.path}: was never submitted to a farm; name the folder of a dataset that was"
        )
    cancelled, refusals = [], []
    for job, submission in list_jobs(folder):
        if submission is None:
            continue
        activity = _engine(job).activity(job, submission)
        if activity is None or activity.anything:
            try:
                _engine(job).cancel(job, submission)
            except FacegenError as refusal:
                refusals.append(str(refusal))
            else:
                cancelled.append(job.name)
    if refusals:
        raise InputError(f"{'; '.join(refusals)}; cancelled: {', '.join(cancelled) or 'nothing'}")
    return cancelled


def engine_logs(folder: DatasetFolder) -> list[Path]:
    """List the files of what the engine's tasks printed, newest job last."""
    return sorted((folder.path / "farm").glob("job-*/logs/*.out"))


def activities(folder: DatasetFolder) -> list[tuple[Job, Submission, Activity | None]]:
    """All submitted jobs with what their engines do with them."""
    return [
        (job, submission, _engine(job).activity(job, submission))
        for job, submission in list_jobs(folder)
        if submission is not None
    ]
