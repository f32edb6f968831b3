"""Cuts what is missing into chunks, one for each task of a farm: some shards of keypoints, or some pictures."""

from dataclasses import dataclass

from facegen.errors import InputError
from facegen.spec import format_ranges

MAX_TASKS = 1000
"""Slurm's arrays end at index 1000 (MaxArraySize 1001) unless a site allows more."""

DEFAULT_SAMPLES = 100
"""Pictures a task: at 5 to 10 processor seconds each about ten minutes, against 5 s to start Blender."""


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
        If ``chunk`` makes too many tasks.
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
    sample_tasks = [samples[start : start + size] for start in range(0, len(samples), size)]
    return (
        *(Chunk(shards=format_ranges(numbers)) for numbers in shard_tasks),
        *(Chunk(samples=format_ranges(numbers)) for numbers in sample_tasks),
    )
