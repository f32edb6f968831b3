"""Finds how many processors and how much memory this process may use: its scheduler's or container's share."""

import os
from collections.abc import Mapping
from pathlib import Path

import psutil

_MIB = 1 << 20

MEMORY_SHARE = 0.8
"""A worker above this share of what it may take is renewed before the system kills it."""

_RENDERING_BYTES = 800_000_000
"""What a worker that renders may hold: some 700 MB, Blender and a rig among it."""

_WINDOWS_WORKERS = 30
"""Processes: one waits for 63 things at a time there, and for two of each process."""


def available_cpus(environ: Mapping[str, str] = os.environ, cgroups: Path = Path("/sys/fs/cgroup")) -> int:
    """Count the processors that this process may use, at least 1.

    The least of the processors it is bound to, its control groups' quota (what ``docker run --cpus`` sets),
    and in a Slurm job the processors of the task: a cluster that binds no processes says these only in the
    environment.
    """
    bound = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    limits = [bound]
    if "SLURM_JOB_ID" in environ:
        # the first is there only where --cpus-per-task was given
        limits += _numbers(environ, "SLURM_CPUS_PER_TASK", "SLURM_CPUS_ON_NODE")[:1]
    for folder in _own_cgroups(cgroups):
        limits += _cpu_quota(folder)
    return max(1, min(limits))


def side_by_side(workers: int, *, system: str = os.name) -> int:
    """How many processes can work side by side, of so many that are wanted."""
    return min(workers, _WINDOWS_WORKERS) if system == "nt" else workers


def available_memory(environ: Mapping[str, str] = os.environ, cgroups: Path = Path("/sys/fs/cgroup")) -> int:
    """Find how many bytes of memory this process and its children may use."""
    limits = [psutil.virtual_memory().total]
    if "SLURM_JOB_ID" in environ:
        limits += [size * _MIB for size in _numbers(environ, "SLURM_MEM_PER_NODE") if size]
        per_cpu, cpus = _numbers(environ, "SLURM_MEM_PER_CPU"), _numbers(environ, "SLURM_CPUS_ON_NODE")
        if per_cpu and cpus:
            limits.append(per_cpu[0] * cpus[0] * _MIB)
    for folder in _own_cgroups(cgroups):
        limits += [int(text) for text in _words(folder / "memory.max") if text.isdigit()]
    return min(limits)


def memory_share(memory: float, workers: int) -> int:
    """Bytes above which one of so many workers is renewed."""
    return int(MEMORY_SHARE * memory / workers)


def memory_note(memory: float, workers: int) -> str:
    """A sentence where workers that render would be renewed after each sample; nothing where memory is enough."""
    if memory_share(memory, workers) >= _RENDERING_BYTES:
        return ""
    enough = int(MEMORY_SHARE * memory // _RENDERING_BYTES)
    advice = f", or {enough} workers" if 0 < enough < workers else ""
    return (
        f"{workers} workers in {memory / 1e9:.1f} GB of memory are too many: one that renders holds some 0.7 GB, so "
        f"each would be started anew after every sample; give {workers * 1.5:g} GB{advice}"
    )


def _own_cgroups(root: Path) -> list[Path]:
    """Folders of this process's control group (version 2) and all above it: each may set a limit."""
    try:
        lines = Path("/proc/self/cgroup").read_text().splitlines()
    except OSError:
        return []
    own = next((line[3:].strip("/") for line in lines if line.startswith("0::")), "")
    path = root / own
    return [path, *(parent for parent in path.parents if parent == root or root in parent.parents)]


def _cpu_quota(folder: Path) -> list[int]:
    words = _words(folder / "cpu.max")
    if len(words) == 2 and words[0].isdigit():
        return [max(1, int(words[0]) // int(words[1]))]
    return []


def _words(path: Path) -> list[str]:
    try:
        return path.read_text().split()
    except OSError:
        return []


def _numbers(environ: Mapping[str, str], *names: str) -> list[int]:
    return [int(environ[name]) for name in names if environ.get(name, "").isdigit()]
