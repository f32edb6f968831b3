"""Reads what each task of a farm gets: processors, memory and time as Slurm writes them, names of folders there."""

import re
from dataclasses import dataclass
from pathlib import Path

from facegen.errors import InputError


@dataclass(frozen=True, kw_only=True)
class Resources:
    """Resources of a task, and how it is started.

    Attributes
    ----------
    cpus
        Processors a task.
    mem
        Memory a task, as Slurm writes it: ``"4G"``, ``"900M"``.
    time
        Longest time of a task, as Slurm writes it: minutes, ``"HH:MM:SS"`` or ``"D-HH:MM:SS"``.
    max_parallel
        Tasks at a time.
    grace_s
        Time that running samples get to end after a request to stop.
    env_setup
        Shell command before the task's own, for example ``"module load python/3.11"``.
    python
        The Python with facegen in it, on the farm.
    sbatch_args
        Further arguments for sbatch.
    path_map
        Pairs (from, to): folders that have another name on the farm.
    """

    cpus: int = 1
    mem: str | None = None
    time: str | None = None
    max_parallel: int | None = None
    grace_s: float = 30.0
    env_setup: str | None = None
    python: str = "python3.11"
    sbatch_args: tuple[str, ...] = ()
    path_map: tuple[tuple[str, str], ...] = ()

    def __post_init__(self) -> None:
        if self.time_s is not None and self.time_s < 60:
            raise InputError(f"--time {self.time}: is less than a minute")
        _ = self.mem_mib  # refused here rather than while scripts are written

    @property
    def time_s(self) -> int | None:
        """`time` in seconds."""
        return None if self.time is None else _seconds(self.time)

    @property
    def mem_mib(self) -> int | None:
        """`mem` in MiB."""
        return None if self.mem is None else _mebibytes(self.mem)

    def on_farm(self, path: str | Path) -> str:
        """A path as the farm's machines see it."""
        text = str(path)
        for source, target in self.path_map:
            source = source.rstrip("/")
            if text == source or text.startswith(f"{source}/"):
                return target.rstrip("/") + text[len(source) :]
        return text


def parse_path_pair(text: str) -> tuple[str, str]:
    """Both names of a folder, from ``--map FROM=TO``."""
    source, equals, target = text.partition("=")
    if not (source.startswith("/") and equals and target.startswith("/")):
        raise InputError(f"--map {text!r}: write FROM=TO, both beginning with a slash")
    return source, target


def _seconds(text: str) -> int:
    match = re.fullmatch(r"(?:(\d+)-)?(\d+)(?::(\d+))?(?::(\d+))?", text)
    if match is None:
        raise InputError(f"--time {text!r}: write minutes, HH:MM:SS or D-HH:MM:SS, as Slurm does")
    days, *parts = match.groups()
    numbers = [int(part) for part in parts if part is not None]
    if days is not None:  # D-HH, D-HH:MM, D-HH:MM:SS
        hours, minutes, seconds = (*numbers, 0, 0)[:3]
        return ((int(days) * 24 + hours) * 60 + minutes) * 60 + seconds
    if len(numbers) == 3:
        return (numbers[0] * 60 + numbers[1]) * 60 + numbers[2]
    return numbers[0] * 60 + (numbers[1] if len(numbers) == 2 else 0)


def _mebibytes(text: str) -> int:
    match = re.fullmatch(r"(\d+)([KMGT]?)B?", text, re.IGNORECASE)
    if match is None:
        raise InputError(f"--mem {text!r}: write a whole number with K, M, G or T, for example 4G")
    return max(
        1, int(int(match[1]) * {"K": 1 / 1024, "": 1, "M": 1, "G": 1024, "T": 1 << 20}[match[2].upper()])
    )
