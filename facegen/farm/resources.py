"""Reads what each task of a farm gets: processors, memory and time as Slurm writes them, names of folders there."""

import re
from dataclasses import dataclass
from pathlib import Path

from facegen.errors import InputError

MOST_GRACE_S = 18 * 3600.0
"""Slurm's notice comes 65,535 s before the end of a task at most; none needs so long to end."""

_CONTROL = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
"""What ends a line or has no bytes in UTF-8, as parts of names that are not UTF-8: no script can hold it."""


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
        if not 0 <= self.grace_s <= MOST_GRACE_S:
            raise InputError(f"--grace {self.grace_s:g}: must be from 0 to {MOST_GRACE_S:g} seconds")
        refuse_control(self.python, what="--python")
        for name in (name for pair in self.path_map for name in pair):
            refuse_control(name, what="--map")
        for argument in self.sbatch_args:
            refuse_control(argument, what="--sbatch-arg")
        # a setup may have several lines
        refuse_control(re.sub("[\n\t]", " ", self.env_setup or ""), what="--env-setup")
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


def refuse_control(text: str, *, what: str) -> None:
    """Refuse text that a line of a script cannot hold; ``what`` names its origin.

    Raises
    ------
    InputError
        If there is a line break, another control character, or a byte that is not UTF-8.
    """
    match = _CONTROL.search(text)
    if match is not None:
        raise InputError(
            f"{what} {text!a}: has the character {match[0]!a}, which scripts of a farm cannot hold; names with line "
            "breaks, control characters or bytes that are not UTF-8 have to be changed first"
        )


def parse_path_pair(text: str) -> tuple[str, str]:
    """Both names of a folder, from ``--map FROM=TO``."""
    source, equals, target = text.partition("=")
    if not (source.startswith("/") and equals and target.startswith("/")):
        raise InputError(f"--map {text!r}: write FROM=TO, both beginning with a slash")
    return source, target


def _seconds(text: str) -> int:
    match = re.fullmatch(r"(?:(\d{1,9})-)?(\d{1,9})(?::(\d{1,9}))?(?::(\d{1,9}))?", text, re.ASCII)
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
    match = re.fullmatch(r"(\d{1,15})([KMGT]?)B?", text, re.IGNORECASE | re.ASCII)
    if match is None:
        raise InputError(f"--mem {text!r}: write a whole number with K, M, G or T, for example 4G")
    return max(
        1, int(int(match[1]) * {"K": 1 / 1024, "": 1, "M": 1, "G": 1024, "T": 1 << 20}[match[2].upper()])
    )
