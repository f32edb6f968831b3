"""Says how far a dataset on a farm is: what is on disk, and what the engines do about the rest."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from facegen.errors import ExitCode, Unanswered
from facegen.farm.chunks import Chunk
from facegen.farm.engine import Activity
from facegen.farm.job import Job, asked_jobs
from facegen.farm.submission import activities
from facegen.spec import sample_numbers
from facegen.store import Dataset
from facegen.work import Attempt, Task, done_tasks, quarantined_tasks, read_journals, wanted_tasks


@dataclass(frozen=True, kw_only=True)
class StepState:
    """One later step of the newest job that has it: ``done``, an engine's state, or ``to do``."""

    job: str
    step: str
    state: str


@dataclass(frozen=True, kw_only=True)
class FarmState:
    """A dataset on a farm.

    Attributes
    ----------
    wanted, done, missing
        Shards and rendered samples that jobs were asked for; ``missing`` without the quarantined.
    quarantined
        Names of what failed three times.
    running, waiting
        The engines' tasks at work, and not yet; None where no engine can be asked.
    reasons
        Why tasks wait.
    retries
        Attempts that failed, and were or will be made good.
    core_hours
        Processor time of all attempts.
    seconds_left
        At the mean time of what was made and the processors at work now; None without either.
    steps
        Later steps.
    busy
        Missing things that an engine has a task for.
    at_work
        Later steps that an engine has: each one's job and name.
    unknown
        Jobs that are not all done, and of which their engine was asked and did not say whether it is at them.
    unasked
        Jobs of which something is missing, and whose engine can never be asked.
    """

    wanted: int
    done: int
    missing: int
    quarantined: tuple[str, ...]
    running: int | None
    waiting: int | None
    reasons: dict[str, int]
    retries: int
    core_hours: float
    seconds_left: float | None
    steps: tuple[StepState, ...]
    busy: frozenset[Task]
    at_work: tuple[tuple[Job, str], ...]
    unknown: tuple[str, ...]
    unasked: tuple[str, ...]

    @property
    def exit_code(self) -> ExitCode:
        """Of `farm status`: all there, work remains, or some failed for good."""
        if self.missing:
            return ExitCode.DRAINED
        return ExitCode.INVALID if self.quarantined else ExitCode.OK

    @property
    def doubts(self) -> list[str]:
        """A sentence for each reason why a new job may make what tasks of another one are at."""
        silent = (
            "no answer says what these tasks are at, so all that is missing is listed; --dry-run alone passes"
        )
        unasked = (
            "no engine can be asked what these tasks are at, so things may be submitted twice; where they still run, "
            "let them end first"
        )
        reasons = {", ".join(self.unknown): silent, ", ".join(self.unasked): unasked}
        return [f"{names}: {reason}" for names, reason in reasons.items() if names]


def farm_state(dataset: Dataset) -> FarmState:
    """Look at the disk, and ask the engines."""
    jobs = asked_jobs(dataset.folder)
    requests = {(job.samples, job.shards) for job in jobs} or {(None, None)}
    wanted = [wanted_tasks(dataset, *request) for request in requests]
    requested = {task for some in wanted for task in some.tasks()}
    done = {task for some in wanted for task in done_tasks(dataset, some)}
    quarantined = {task for some in wanted for task in quarantined_tasks(dataset, some)} - done
    missing = requested - done - quarantined
    asked = activities(dataset.folder)
    known = [(job, activity) for job, _, activity in asked if activity is not None]
    attempts = list(read_journals(dataset.folder))
    cores = sum(job.resources.cpus * len(activity.running) for job, activity in known)
    by_name = {job.name: activity for job, activity in known}
    steps = {
        step: StepState(job=job.name, step=step, state=_step_state(dataset, job, step, by_name.get(job.name)))
        for job in jobs
        for step in job.steps
        if step != "generate"
    }
    silent = [(job, bool(given.ids)) for job, given, activity in asked if activity is None]
    return FarmState(
        wanted=len(requested),
        done=len(done),
        missing=len(missing),
        quarantined=tuple(sorted(task.name for task in quarantined)),
        running=sum(len(activity.running) for _, activity in known) if known else None,
        waiting=sum(len(activity.waiting) for _, activity in known) if known else None,
        reasons=dict(sum((activity.reasons for _, activity in known), Counter())),
        retries=sum(attempt.outcome == "failed" for attempt in attempts),
        core_hours=sum(attempt.cpu_seconds for attempt in attempts) / 3600,
        seconds_left=_seconds_left(missing, attempts, cores),
        steps=tuple(steps.values()),
        busy=frozenset(
            task
            for job, activity in known
            for index in activity.running | activity.waiting
            for task in _tasks(dataset, job.chunks[index : index + 1])
        ),
        at_work=tuple((job, step) for job, activity in known for step in activity.steps),
        # an engine that gave numbers can be asked for them, which is in vain where nothing is left that it can be at
        unknown=tuple(
            job.name
            for job, can_be_asked in silent
            if can_be_asked and (_lacks(dataset, job, missing) or not _has_all_steps(dataset, job))
        ),
        unasked=tuple(
            job.name for job, can_be_asked in silent if not can_be_asked and _lacks(dataset, job, missing)
        ),
    )


def answered_state(dataset: Dataset, *, dry_run: bool = False) -> FarmState:
    """`farm_state`, where every engine that was asked has answered, or nothing will be submitted.

    Raises
    ------
    Unanswered
        If an engine does not say whether it is at tasks that it has, and this is no dry run.
    """
    state = farm_state(dataset)
    if state.unknown and not dry_run:
        records = [str(dataset.folder.path / "farm" / name / "submission.json") for name in state.unknown]
        engines = {job.name: job.engine for job in asked_jobs(dataset.folder)}
        raise Unanswered(
            f"{dataset.folder.path}: {engines[state.unknown[-1]]} does not say what it does with "
            f"{', '.join(state.unknown)}, so tasks might be submitted twice; repeat the command when it answers, "
            f"or remove {' and '.join(records)} if it is gone for good"
        )
    return state


def _step_state(dataset: Dataset, job: Job, step: str, activity: Activity | None) -> str:
    if _has_step(dataset, job, step):
        return "done"
    if activity is not None and step in activity.steps:
        return activity.steps[step]
    return "to do"


def _has_step(dataset: Dataset, job: Job, step: str) -> bool:
    """Whether a later step has ended well; a dataset may have moved since its job wrote down where it is."""
    return (dataset.folder.path / "farm" / job.name / f"{step}.done").is_file()


def _has_all_steps(dataset: Dataset, job: Job) -> bool:
    return all(_has_step(dataset, job, step) for step in job.steps if step != "generate")


def _lacks(dataset: Dataset, job: Job, missing: set[Task]) -> bool:
    """Whether something of what a job's tasks make is missing."""
    return bool(missing) and not missing.isdisjoint(_tasks(dataset, job.chunks))


def _tasks(dataset: Dataset, chunks: Sequence[Chunk]) -> Iterator[Task]:
    for chunk in chunks:
        for number in sample_numbers(chunk.shards, total=dataset.shards, where="chunk"):
            yield Task("shard", number)
        for number in sample_numbers(chunk.samples, total=dataset.plan.samples, where="chunk"):
            yield Task("sample", number)


def _seconds_left(missing: set[Task], attempts: list[Attempt], cores: int) -> float | None:
    seconds = 0.0
    for kind in ("shard", "sample"):
        count = sum(task.kind == kind for task in missing)
        costs = [a.cpu_seconds for a in attempts if a.outcome == "done" and a.task.startswith(kind)]
        if count and not costs:
            return None
        seconds += count * sum(costs) / max(len(costs), 1)
    if not seconds:
        return 0.0
    return seconds / cores if cores else None
