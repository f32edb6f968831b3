"""Says what a new job has to make: what is missing of a request, and what no other job's tasks are at."""

from dataclasses import dataclass

from facegen.errors import InputError
from facegen.farm.job import Job
from facegen.farm.state import answered_state
from facegen.farm.submission import Remaining, remaining
from facegen.store import Dataset
from facegen.work import wanted_tasks


@dataclass(frozen=True, kw_only=True)
class Request:
    """What a job would make, the later steps of other jobs that engines have, and sentences on what cannot be known.

    ``at_work`` has each step's job and name.
    """

    remaining: Remaining
    at_work: tuple[tuple[Job, str], ...]
    doubts: list[str]


def plan_request(
    dataset: Dataset, samples: str | None, *, steps: tuple[str, ...], dry_run: bool = False
) -> Request:
    """Look for what is missing and no engine is at; writes nothing.

    Parameters
    ----------
    dataset
        What to make, from `facegen.store.resolve`.
    samples
        Those that are asked for; None for the spec's own.
    steps
        Of the job.
    dry_run
        Whether nothing will be submitted.

    Raises
    ------
    InputError
        If later steps need what the tasks of another job are at.
    Unanswered
        If an engine does not say whether it is at tasks that it has, and this is no dry run.
    """
    state = answered_state(dataset, dry_run=dry_run)
    later = [step for step in steps if step != "generate"]
    awaited = sum(task in state.busy for task in wanted_tasks(dataset, samples).tasks()) if state.busy else 0
    if later and awaited:
        raise InputError(
            f"--steps {','.join(steps)}: tasks of another job are at {awaited} things that {later[0]} needs, and it "
            f"would not wait for them; give --steps generate now, and {','.join(later)} when they have ended"
        )
    return Request(
        remaining=remaining(dataset, samples, busy=state.busy), at_work=state.at_work, doubts=state.doubts
    )
