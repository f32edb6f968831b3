"""Resumes a dataset: the missing things that no engine is at become a new job, as the newest was submitted."""

from dataclasses import dataclass, replace

from facegen.errors import InputError
from facegen.farm.job import STEPS, Job, asked_jobs
from facegen.farm.sbatch_arguments import is_need
from facegen.farm.state import FarmState, answered_state
from facegen.farm.submission import Remaining, prepare, remaining
from facegen.spec import format_ranges
from facegen.store import Dataset
from facegen.work import wanted_tasks


@dataclass(frozen=True, kw_only=True)
class Resumption:
    """Plan of a job that goes on with a dataset.

    Attributes
    ----------
    newest
        The job whose engine and resources the new one takes over.
    samples, shards
        What all jobs together were asked for, which the new one is asked for.
    state
        How far the dataset is.
    remaining
        What the tasks would make.
    steps
        The job that left each step undone, by step, in the order of `STEPS`; empty where nothing is to submit.
    postponed
        Steps that were left undone and must wait for tasks that an engine is at.
    """

    newest: Job
    samples: str
    shards: str | None
    state: FarmState
    remaining: Remaining
    steps: dict[str, Job]
    postponed: tuple[str, ...]


def plan_resumption(
    dataset: Dataset, *, retry_quarantined: bool = False, dry_run: bool = False
) -> Resumption:
    """Look for what is missing, and for steps that any job left undone; writes nothing.

    Raises
    ------
    InputError
        If the dataset was never submitted.
    Unanswered
        If an engine does not say whether it is at tasks that it has, and this is no dry run.
    """
    jobs = {job.name: job for job in asked_jobs(dataset.folder)}
    if not jobs:
        raise InputError(
            f"{dataset.folder.path}: was never submitted to a farm; begin with: facegen farm submit"
        )
    newest = list(jobs.values())[-1]
    state = answered_state(dataset, dry_run=dry_run)
    # an older job may have been asked for more than the newest
    requests = list(dict.fromkeys((job.samples, job.shards) for job in jobs.values()))
    left = [
        remaining(dataset, samples, shards=shards, busy=state.busy, retry_quarantined=retry_quarantined)
        for samples, shards in requests
    ]
    samples, shards = _together(dataset, requests)
    left = Remaining(
        shards=sorted({number for some in left for number in some.shards}),
        samples=sorted({number for some in left for number in some.samples}),
    )
    undone = {step.step: jobs[step.job] for step in state.steps if step.state == "to do"}
    postponed = tuple(undone) if state.busy else ()
    if postponed:
        undone = {}
    if (left.shards or left.samples) and any("generate" in job.steps for job in jobs.values()):
        undone["generate"] = newest
    return Resumption(
        newest=newest,
        samples=samples,
        shards=shards,
        state=state,
        remaining=left,
        steps={step: undone[step] for step in STEPS if step in undone},
        postponed=postponed,
    )


def _together(dataset: Dataset, requests: list[tuple[str, str | None]]) -> tuple[str, str | None]:
    if len(requests) == 1:
        return requests[0]
    wanted = [wanted_tasks(dataset, samples, shards) for samples, shards in requests]
    return (
        format_ranges(sorted({number for some in wanted for number in some.samples})),
        format_ranges(sorted({number for some in wanted for number in some.shards})),
    )


def prepare_resumption(dataset: Dataset, resumption: Resumption, *, chunk: int | None = None) -> Job:
    """Write the new job as `facegen.farm.prepare` does; ``chunk`` is the number of samples a task.

    It gets the newest job's resources and arguments for sbatch, without what that job was to wait for.
    """
    newest, steps = resumption.newest, resumption.steps
    # what the newest job waited for, Slurm may know no more, and would cancel the new one for it
    arguments = tuple(each for each in newest.resources.sbatch_args if not is_need(each))
    try:
        return prepare(
            dataset,
            resumption.remaining,
            engine=newest.engine,
            steps=tuple(steps),
            samples=resumption.samples,
            shards=resumption.shards,
            resources=replace(newest.resources, sbatch_args=arguments),
            chunk=chunk,
            packed=steps.get("pack", newest).packed,
            model=steps.get("train", steps.get("export", newest)).model,
        )
    except InputError as error:
        if chunk is not None:
            raise
        # it speaks of options, and was given none
        raise InputError(f"{dataset.folder.path / 'farm' / newest.name / 'job.json'}: {error}") from error
