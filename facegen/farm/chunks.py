"""Cuts what is missing into chunks, one for each task of a farm: some shards of keypoints, or some pictures."""

from dataclasses import dataclass

from facegen.errors import InputError
from facegen.spec import format_ranges

MAX_TASKS = 1000
"""Slurm's arrays end at index 1000 (MaxArraySize 1001) unless a site allows more."""

DEFAULT_SAMPLES = 100
"""Pictures a task: at 5 to 10 processor seconds each about ten minutes, against 5 s to start Blender."""

_LONGEST_WORD = 131_071
"""Bytes of one word of a command on Linux (``MAX_ARG_STRLEN``, less its end): a task with a longer one never starts."""


@dataclass(frozen=True, kw_only=True)
class Chunk:
    """Ranges as `facegen generate` takes them; one of the two is empty."""

    shards: str = ""
    samples: str = ""

    @property
    def arguments(self) -> tuple[str, ...]:
        """Arguments of ``facegen generate`` that make this chunk and nothing else."""
        if self.samples:
            return ("--samples", self.samples, "--shards", "none")
        return ("--shards", self.shards)


def cut_chunks(shards: list[int], samples: list[int], *, chunk: int | None = None) -> tuple[Chunk, ...]:
    """Cut what is missing into at most `MAX_TASKS` tasks, shards first.

    Parameters
    ----------
    shards, samples
        Numbers of what is missing, sorted.
    chunk
        Samples a task; without, `DEFAULT_SAMPLES`, or as many as make the tasks fit.

    Raises
    ------
    InputError
        If ``chunk`` makes too many tasks, or one whose samples are more scattered than a command can name.
    """
    per_shard_task = -(-len(shards) // (MAX_TASKS // 2)) or 1
    shard_tasks = [shards[start : start + per_shard_task] for start in range(0, len(shards), per_shard_task)]
    room = MAX_TASKS - len(shard_tasks)
    least = -(-len(samples) // room)
    if chunk is not None and chunk < least:
        raise InputError(
            f"--chunk {chunk}: {len(samples)} samples and {len(shards)} shards are more than {MAX_TASKS} "
            f"tasks; give at least --chunk {least}"
        )
    size = chunk or max(DEFAULT_SAMPLES, least)
    sample_tasks = [_shortest(samples[start : start + size]) for start in range(0, len(samples), size)]
    longest = max(map(len, sample_tasks), default=0)
    if longest > _LONGEST_WORD:
        raise InputError(
            f"--chunk {size}: the numbers of a task's samples take {longest:,} characters, and a command takes at most "
            f"{_LONGEST_WORD:,}; give --chunk {max(least, size * _LONGEST_WORD // (2 * longest))} or so"
        )
    return (
        *(Chunk(shards=format_ranges(numbers)) for numbers in shard_tasks),
        *(Chunk(samples=text) for text in sample_tasks),
    )


def _shortest(numbers: list[int]) -> str:
    return min(format_ranges(numbers), _stepped(numbers), key=len)


def _stepped(numbers: list[int]) -> str:
    """Ascending numbers as `format_ranges` writes them, and three or more of equal distances as ``first-last:step``."""
    pieces, start = [], 0
    while start < len(numbers):
        step = numbers[start + 1] - numbers[start] if start + 1 < len(numbers) else 1
        end = start + 1
        while end < len(numbers) and numbers[end] - numbers[end - 1] == step:
            end += 1
        if step > 1 and end - start < 3:
            end = start + 1
        first, last = numbers[start], numbers[end - 1]
        by = f":{step}" if step > 1 else ""
        pieces.append(str(first) if first == last else f"{first}-{last}{by}")
        start = end
    return ",".join(pieces)
