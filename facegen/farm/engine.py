"""Defines what a scheduler can do; a new one is a module with these methods and a line in `facegen.farm.engines`."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from facegen.farm.job import Job, Submission


@dataclass(frozen=True, kw_only=True)
class Activity:
    """What an engine says it does with a job; the disk knows what came of it.

    Attributes
    ----------
    running, waiting
        Indices of the chunks that it is at, and of those that it has not begun.
    steps
        State of each later step that it has, a word for people: ``"pending"``.
    reasons
        Why things wait, and how many do.
    """

    running: frozenset[int] = frozenset()
    waiting: frozenset[int] = frozenset()
    steps: dict[str, str] = field(default_factory=dict)
    reasons: Counter[str] = field(default_factory=Counter)

    @property
    def anything(self) -> bool:
        """Whether the engine has any of the job."""
        return bool(self.running or self.waiting or self.steps)


class Engine(Protocol):
    """A scheduler."""

    def files(self, job: Job) -> dict[str, str]:
        """Scripts or bundle of a job: texts by path below the job's folder. Pure."""

    def check(self, folder: Path) -> None:
        """Refuse a job whose files, written below ``folder``, the scheduler or a shell would not take."""

    def notes(self, job: Job) -> list[str]:
        """Say what of a job's wishes the scheduler will not grant; nothing of what cannot be asked."""

    def instructions(self, job: Job) -> list[str]:
        """Commands that start the job by hand, for ``--dry-run``."""

    def submit(self, job: Job) -> Submission:
        """Hand the job over; its files are written."""

    def wait(self, job: Job, submission: Submission) -> None:
        """Return when the engine has nothing of the job any more."""

    def activity(self, job: Job, submission: Submission) -> Activity | None:
        """What the engine does with the job; None where it cannot be asked."""

    def cancel(self, job: Job, submission: Submission) -> None:
        """Stop a job for good."""
