"""Defines how trainings report their progress."""

from collections.abc import Callable

Progress = Callable[[str, int, int], None]
"""Called with the stage's name, steps done and steps at most; from any thread."""
