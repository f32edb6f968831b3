"""Farm jobs on a real Slurm: arrays, kills, preemption, time limits, cancelling, dependencies."""

import json
import os
import signal

import pytest

from tests.real_tools.farms import (
    ROOT,
    children_of,
    facegen,
    no_leftovers,
    outcomes,
    processes_with,
    rendered,
    state,
    wait_for,
    write_spec,
)
from tests.real_tools.slurm_sandbox import SlurmSandbox, missing_programs, processes

pytestmark = [pytest.mark.slurm, pytest.mark.blender, pytest.mark.slow, pytest.mark.usefixtures("anny")]

# Slurm looks at time limits every 30 s: the fastest machine must still be rendering then, and after it
PEOPLE = 80
ALL = 5 * PEOPLE


@pytest.fixture(scope="module")
def slurm():
    missing = missing_programs()
    if missing:
        pytest.skip(
            f"no Slurm here ({', '.join(missing)} missing); on Debian: apt-get install "
            "--no-install-recommends slurmctld slurmd slurm-client munge"
        )
    with SlurmSandbox() as sandbox:
        yield sandbox
    assert not processes(sandbox.folder)
    assert not sandbox.folder.exists()


@pytest.fixture
def submit(slurm, tmp_path):
    """Submits a dataset of small pictures with some options; returns its folder and the numbers that Slurm gave.

    Of few people, as the keypoints of all are made beside the pictures, or before them.
    """
    out = tmp_path / "out"

    def run(*options: str, people: int = 5, code: int = 0):
        setup = ("--env-setup", f"export PYTHONPATH={ROOT}", "--grace", "20")
        command = (
            "farm",
            "submit",
            write_spec(tmp_path, people=people),
            "--out",
            out,
            "--engine",
            "slurm",
            *setup,
            "--json",
            *options,
        )
        answer = json.loads(facegen(*command, environ=slurm.environ, code=code))
        return out, answer.get("ids", {})

    yield run
    slurm.run("scancel", "--full", "--user", str(os.getuid()))
    wait_for(lambda: not slurm.run("squeue", "-h").strip(), what="an empty queue")


def supervisors(out) -> list[int]:
    return processes_with("facegen", "generate", str(out))


def test_an_array_of_four_tasks_and_the_steps_after_it_run(slurm, submit):
    out, _ = submit(
        "--samples", "0-2", "--chunk", "1", "--steps", "generate,validate", "--max-parallel", "2", "--wait"
    )
    told = state(out, slurm.environ)
    assert (told["wanted"], told["done"], told["missing"], told["quarantined"]) == (4, 4, 0, [])
    assert [(step["step"], step["state"]) for step in told["steps"]] == [("validate", "done")]
    assert told["core_hours"] > 0
    assert (told["running"], told["waiting"], told["seconds_left"]) == (0, 0, 0.0)
    assert outcomes(out) == ["done"] * 4
    assert no_leftovers(out)
    assert len(list((out / "farm" / "job-001" / "logs").glob("generate-*.out"))) == 4
    again = facegen("farm", "resume", out, "--json", environ=slurm.environ)
    assert json.loads(again) == {"job": None, "tasks": 0}


def test_kills_in_mid_render_are_made_good(slurm, submit):
    out, ids = submit("--samples", "0-23", "--chunk", "24", "--max-parallel", "1")
    wait_for(lambda: rendered(out), what="a first sample")
    (supervisor,) = supervisors(out)
    (worker,) = children_of(supervisor)
    os.kill(worker, signal.SIGKILL)  # the supervisor tries again
    count = len(rendered(out))
    wait_for(lambda: len(rendered(out)) > count, what="a sample of the next worker")
    os.kill(supervisor, signal.SIGKILL)  # the job's script tries again
    wait_for(lambda: supervisors(out) not in ([], [supervisor]), what="a second supervisor")
    count = len(rendered(out))
    wait_for(lambda: len(rendered(out)) > count, what="a sample of the second supervisor")
    script = next(
        p for p in processes_with("bash", "slurm_script") if slurm.folder.name in " ".join(_cmdline(p))
    )
    os.killpg(script, signal.SIGKILL)  # the whole task is gone: Slurm calls it failed and does not come back
    wait_for(lambda: not slurm.run("squeue", "-h").strip(), what="an empty queue")
    assert "FAILED" in slurm.show(ids["generate"], "JobState")
    assert state(out, slurm.environ)["missing"] > 0
    facegen("farm", "resume", out, "--wait", environ=slurm.environ)
    assert rendered(out) == list(range(24))
    assert state(out, slurm.environ)["retries"] == 1
    assert no_leftovers(out)


def _cmdline(process: int) -> list[str]:
    with open(f"/proc/{process}/cmdline") as file:
        return file.read().split("\0")


def test_preemption_drains_and_goes_on(slurm, submit):
    out, ids = submit("--samples", "0-15", "--chunk", "16", "--cpus", "2")
    wait_for(lambda: rendered(out), what="a first sample")
    slurm.run("sbatch", "--partition=urgent", "--cpus-per-task=2", "--output=/dev/null", "--wrap", "sleep 2")
    wait_for(lambda: max(map(int, slurm.show(ids["generate"], "Restarts"))) == 1, what="a requeue")
    wait_for(lambda: len(rendered(out)) == 16, what="all samples")
    assert set(outcomes(out)) <= {"done", "stopped"}
    # the last sample appears before the run that made it has tidied up
    wait_for(lambda: no_leftovers(out), what="an empty tmp")
    runs = list((out / "logs").glob("run-*.jsonl"))
    assert len(runs) >= 2


def test_the_time_limit_drains_and_goes_on(slurm, submit):
    # an hour, as a slow machine has a first sample late
    out, ids = submit("--chunk", str(ALL), "--time", "60", "--grace", "120", people=PEOPLE)
    task = f"{ids['generate']}_1"
    wait_for(lambda: rendered(out), what="a first sample")
    assert slurm.show(task, "TimeLimit") == ["01:00:00"]
    # now the end is two or three minutes away, and notice is to come three before it: at Slurm's next look
    _, minutes, _ = map(int, slurm.show(task, "RunTime")[0].split(":"))
    slurm.run("scontrol", "update", f"JobId={task}", f"TimeLimit={minutes + 3}")
    wait_for(lambda: int(slurm.show(task, "Restarts")[0]) > 0, what="a requeue")
    slurm.run("scontrol", "update", f"JobId={task}", "TimeLimit=60")
    assert 0 < len(rendered(out)) < ALL
    count = len(rendered(out))
    wait_for(lambda: len(rendered(out)) > count, what="more samples after the requeue")
    assert set(outcomes(out)) <= {"done", "stopped"}


def test_what_is_cancelled_drains_and_stays_cancelled(slurm, submit):
    out, ids = submit("--chunk", str(ALL), "--steps", "generate,validate", people=PEOPLE)
    shards = out / "keypoints"  # by another task, which is to have ended too
    wait_for(lambda: rendered(out) and list(shards.glob("*.parquet")), what="a first sample and its shard")
    assert "job-001" in facegen("farm", "cancel", out, environ=slurm.environ)
    wait_for(lambda: not slurm.run("squeue", "-h").strip(), what="an empty queue")
    count = len(rendered(out))
    assert slurm.show(f"{ids['generate']}_1", "JobState") == ["CANCELLED"]
    assert slurm.show(ids["validate"], "JobState") == ["CANCELLED"]
    wait_for(lambda: not supervisors(out), what="no supervisor")
    # a requeued job would start after cred_expire, 5 s
    with pytest.raises(AssertionError):
        wait_for(lambda: slurm.run("squeue", "-h").strip(), seconds=8)
    assert len(rendered(out)) == count
    assert set(outcomes(out)) == {"done"}, "the running sample was let end"
    assert no_leftovers(out)
    assert state(out, slurm.environ)["missing"] == ALL - count


def test_steps_whose_need_fails_are_cancelled_and_do_not_hang(slurm, submit, tmp_path):
    # sample 1 turns out to have failed three times; submission leaves out what is known to
    fail = f"export PYTHONPATH={ROOT}; mkdir -p {tmp_path}/out/quarantine/sample-000001"
    options = ("--samples", "0-1", "--steps", "generate,validate,export", "--wait", "--env-setup", fail)
    out, _ = submit(*options, code=1)
    assert rendered(out) == [0]
    ids = json.loads((out / "farm" / "job-001" / "submission.json").read_text())["ids"]
    told = state(out, slurm.environ)
    assert (told["missing"], told["quarantined"]) == (0, ["sample-000001"])
    assert {step["state"] for step in told["steps"]} == {"to do"}
    assert slurm.show(f"{ids['generate']}_1", "ExitCode") == ["1:0"]
    assert slurm.show(ids["validate"], "JobState") == ["CANCELLED"]
    assert slurm.show(ids["export"], "JobState") == ["CANCELLED"]
