"""Says how far a dataset on a farm is: what is on disk, and what the engines do about the rest."""

from collections import Counter
from dataclasses import dataclass

from facegen.errors import ExitCode, Unanswered
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
        Jobs of which their engine was asked, and did not say whether it is at them.
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

    @property
    def exit_code(self) -> ExitCode:
        """Of `farm status`: all there, work remains, or some failed for good."""
        if self.missing:
            return ExitCode.DRAINED
        return ExitCode.INVALID if self.quarantined else ExitCode.OK


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
        step: StepState(job=job.name, step=step, state=_step_state(job, step, by_name.get(job.name)))
        for job in jobs
        for step in job.steps
        if step != "generate"
    }
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
            if index < len(job.chunks)
            for task in _tasks(dataset, job, index)
        ),
        at_work=tuple((job, step) for job, activity in known for step in activity.steps),
        # an engine that gave numbers can be asked for them
        unknown=tuple(job.name for job, given, activity in asked if given.ids and activity is None),
    )


def answered_state(dataset: Dataset) -> FarmState:
    """`farm_state`, where every engine that was asked has answered.

    Raises
    ------
    Unanswered
        If an engine does not say whether it is at tasks that it has.
    """
    state = farm_state(dataset)
    if state.unknown:
        engines = {job.name: job.engine for job in asked_jobs(dataset.folder)}
        raise Unanswered(
            f"{dataset.folder.path}: {engines[state.unknown[-1]]} does not say what it does with "
            f"{', '.join(state.unknown)}, so tasks might be submitted twice; repeat the command when it answers"
        )
    return state


def _step_state(job: Job, step: str, activity: Activity | None) -> str:
    if (job.folder / f"{step}.done").is_file():
        return "done"
    if activity is not None and step in activity.steps:
        return activity.steps[step]
    return "to do"


def _tasks(dataset: Dataset, job: Job, index: int) -> list[Task]:
    chunk = job.chunks[index]
    shards = sample_numbers(chunk.shards, total=dataset.shards, where="chunk")
    samples = sample_numbers(chunk.samples, total=dataset.plan.samples, where="chunk")
    return [Task("shard", number) for number in shards] + [Task("sample", number) for number in samples]


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
