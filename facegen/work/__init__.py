"""Making datasets: tasks, workers, and the supervisor that owns them."""

from facegen.work.generate import DEFAULT_GRACE_S, Summary, Work, available_cpus, generate, plan_work

__all__ = ["DEFAULT_GRACE_S", "Summary", "Work", "available_cpus", "generate", "plan_work"]
