"""Processors and memory come from the scheduler's allocation."""

import os

import pytest

from facegen.work import available_cpus, available_memory, memory_note, side_by_side

BOUND = len(os.sched_getaffinity(0))
NOWHERE = "/nonexistent"


def cgroups(tmp_path, **files):
    for name, text in files.items():
        (tmp_path / name.replace("_", ".")).write_text(text)
    return tmp_path


def test_slurm_says_the_processors_of_a_task(tmp_path):
    job = {"SLURM_JOB_ID": "7"}
    assert available_cpus(job | {"SLURM_CPUS_PER_TASK": "1", "SLURM_CPUS_ON_NODE": "8"}, tmp_path) == 1
    assert available_cpus(job | {"SLURM_CPUS_ON_NODE": "1"}, tmp_path) == 1
    assert available_cpus(job | {"SLURM_CPUS_PER_TASK": "4096"}, tmp_path) == BOUND
    assert available_cpus({"SLURM_CPUS_PER_TASK": "1"}, tmp_path) == BOUND, "a leftover outside a job"
    assert available_cpus({}, tmp_path) == BOUND


@pytest.mark.parametrize(
    ("quota", "cpus"), [("100000 100000", 1), ("50000 100000", 1), ("max 100000", BOUND)]
)
def test_a_container_has_a_quota(tmp_path, quota, cpus):
    assert available_cpus({}, cgroups(tmp_path, cpu_max=quota)) == cpus


def test_windows_cannot_wait_for_more_than_thirty_processes():
    """`multiprocessing.connection.wait` has 63 handles there, and a supervisor waits for two of each."""
    assert 2 * side_by_side(500, system="nt") <= 63
    assert side_by_side(500, system="posix") == 500
    assert side_by_side(3, system="nt") == 3


def test_memory_is_the_least_of_what_is_said(tmp_path):
    whole = available_memory({}, tmp_path)
    assert whole > 1 << 30
    assert available_memory({"SLURM_JOB_ID": "7", "SLURM_MEM_PER_NODE": "512"}, tmp_path) == 512 << 20
    per_cpu = {"SLURM_JOB_ID": "7", "SLURM_MEM_PER_CPU": "100", "SLURM_CPUS_ON_NODE": "2"}
    assert available_memory(per_cpu, tmp_path) == 200 << 20
    assert available_memory({}, cgroups(tmp_path, memory_max="1000000\n")) == 1_000_000
    assert available_memory({}, cgroups(tmp_path, memory_max="max\n")) == whole


def test_too_little_memory_is_told_with_what_is_enough():
    said = memory_note(4 << 30, 8)
    assert "8 workers in 4.3 GB of memory are too many" in said
    assert said.endswith("give 12 GB, or 4 workers")
    assert memory_note(4 << 30, 4) == memory_note(12e9, 8) == ""
    assert memory_note(0.5e9, 1).endswith("give 1.5 GB"), "no worker is enough of none"
