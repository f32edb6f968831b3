"""Makes datasets: tasks, workers, and the supervisor that owns them."""

from facegen.work.allocation import available_cpus, available_memory, memory_note, side_by_side
from facegen.work.blend import save_blend
from facegen.work.developing import Settings, develop_dataset, develop_sample
from facegen.work.generate import (
    DEFAULT_GRACE_S,
    Summary,
    Work,
    check_versions,
    crew_note,
    generate,
    plan_work,
)
from facegen.work.journal import Attempt, attempt_logs, read_journals
from facegen.work.limits import Limits
from facegen.work.tasks import Task, done_tasks, quarantined_tasks, wanted_tasks

__all__ = [
    "DEFAULT_GRACE_S",
    "Attempt",
    "Limits",
    "Settings",
    "Summary",
    "Task",
    "Work",
    "attempt_logs",
    "available_cpus",
    "available_memory",
    "check_versions",
    "crew_note",
    "develop_dataset",
    "develop_sample",
    "done_tasks",
    "generate",
    "memory_note",
    "plan_work",
    "quarantined_tasks",
    "read_journals",
    "save_blend",
    "side_by_side",
    "wanted_tasks",
]
