"""Jobs one after the other, with an engine that says what the test tells it."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest
from typer.testing import CliRunner, Result

from facegen.cli import app
from facegen.errors import InputError, Unanswered
from facegen.farm import ENGINES, Activity, Job, Submission, slurm
from facegen.farm.job import asked_jobs
from facegen.rigs import rigs_folder
from facegen.store import DatasetFolder, open_dataset
from facegen.work import generate

pytestmark = pytest.mark.usefixtures("anny")

SPEC = """\
version = 1
kind = "still"
seed = 3
people = 3
"""
RENDERED = '[render]\nsamples = "0-19"\n'


class Told:
    """An engine with the activity of each job that it was told; it writes down what it cancels."""

    def __init__(self) -> None:
        self.doing: dict[str, Activity | None] = {}
        self.cancelled: list[str] = []

    def files(self, job: Job) -> dict[str, str]:
        return {}

    def check(self, folder: Path) -> None: ...

    def notes(self, job: Job) -> list[str]:
        return []

    def instructions(self, job: Job) -> list[str]:
        return []

    def submit(self, job: Job) -> Submission:
        return Submission(ids=dict.fromkeys(job.steps, "7"))

    def activity(self, job: Job, submission: Submission) -> Activity | None:
        return self.doing.get(job.name, Activity())

    def cancel(self, job: Job, submission: Submission) -> None:
        self.cancelled.append(job.name)


@pytest.fixture
def engine(monkeypatch) -> Told:
    told = Told()
    monkeypatch.setitem(ENGINES, "slurm", told)
    return told


def farm(*arguments: object) -> Result:
    return CliRunner().invoke(app, ["farm", *map(str, arguments)])


def submit(folder: Path, *options: str, spec: str = SPEC, engine: str = "slurm") -> Path:
    (folder / "spec.toml").write_text(spec)
    out = folder / "out"
    done = farm("submit", folder / "spec.toml", "--out", out, "--engine", engine, *options)
    assert done.exit_code == 0, done.output
    return out


def resume(out: Path, *options: str) -> tuple[str, ...]:
    """Steps of the job that a resume made."""
    done = farm("resume", out, "--json", *options)
    assert done.exit_code == 0, done.output
    return tuple(json.loads(done.stdout).get("steps", ()))


def test_later_steps_of_an_older_job_are_not_lost(engine, tmp_path):
    out = submit(tmp_path, "--steps", "generate,validate,pack", "--packed", str(tmp_path / "p"))
    # the chunk has failed, and Slurm has not yet cancelled what needs it
    engine.doing["job-001"] = Activity(steps={"validate": "pending", "pack": "pending"})
    assert resume(out) == ("generate",)
    engine.doing = {"job-002": Activity(running=frozenset({0}))}
    assert resume(out) == (), "they would fail for want of what is being made"
    generate(open_dataset(out), workers=1)
    engine.doing = {}
    assert resume(out) == ("validate", "pack")
    assert asked_jobs(DatasetFolder(out))[-1].packed == str(tmp_path / "p")
    for step in ("validate", "pack"):
        (out / "farm" / "job-003" / f"{step}.done").touch()
    assert resume(out) == ()


def nothing_more(out: Path, *options: str) -> Result:
    """Submit again; no further job may come of it."""
    jobs = sorted((out / "farm").iterdir())
    done = farm("submit", out.parent / "spec.toml", "--out", out, "--engine", "slurm", "--json", *options)
    assert sorted((out / "farm").iterdir()) == jobs
    return done


def test_what_a_task_is_at_is_not_submitted_again(engine, tmp_path):
    out = submit(tmp_path, "--samples", "0-4", spec=SPEC + RENDERED)
    engine.doing["job-001"] = Activity(running=frozenset({0}), waiting=frozenset({1}))
    assert json.loads(nothing_more(out, "--samples", "0-4").stdout) == {"job": None, "tasks": 0}
    submit(tmp_path, spec=SPEC + RENDERED.replace("19", "29"))
    assert [chunk.samples for chunk in asked_jobs(DatasetFolder(out))[-1].chunks] == ["5-29"]


def test_later_steps_do_not_overtake_tasks_of_another_job(engine, tmp_path):
    out = submit(tmp_path, "--samples", "0-4", spec=SPEC + RENDERED)
    engine.doing["job-001"] = Activity(waiting=frozenset({0, 1}))
    refusal = nothing_more(out, "--steps", "generate,validate,pack").exception
    assert isinstance(refusal, InputError)
    assert "tasks of another job are at 6 things that validate needs" in str(refusal)
    engine.doing["job-001"] = Activity(waiting=frozenset({1}))  # the shard is there
    generate(open_dataset(out), shards="0", workers=1)
    submit(tmp_path, "--samples", "5-9", "--steps", "generate,pack", spec=SPEC + RENDERED)


@pytest.mark.parametrize(
    ("step", "option", "folder"), [("pack", "--packed", "p"), ("export", "--model", "m")]
)
def test_no_two_steps_write_into_one_folder(engine, tmp_path, step, option, folder):
    place = ("--steps", step, option, str(tmp_path / folder))
    out = submit(tmp_path, *place)
    engine.doing["job-001"] = Activity(steps={step: "pending"})
    refusal = nothing_more(out, *place).exception
    assert isinstance(refusal, InputError)
    assert f"{tmp_path / folder}: the step {step!r} of job-001 is to write there" in str(refusal)
    submit(tmp_path, *place[:-1], str(tmp_path / "other"))


def begin_pack(out: Path, samples: list[int], *options: str) -> None:
    """Let `pack` begin with samples that are there by name alone; it stops at the first."""
    for number in samples:
        (out / "renders" / "000" / f"{number:06d}").mkdir(parents=True, exist_ok=True)
    done = CliRunner().invoke(app, ["pack", str(out), "--out", f"{out}-packed", *options])
    assert done.exit_code
    assert Path(f"{out}-packed", "pack.json").is_file()


def test_a_job_that_has_grown_is_told_before_that_its_pack_cannot_go_where_the_first_one_went(
    engine, tmp_path
):
    few = RENDERED.replace("19", "4")
    out = submit(tmp_path, "--steps", "generate,pack", spec=SPEC + few)
    begin_pack(out, [0, 1, 2, 3, 4])
    submit(tmp_path, "--steps", "generate,pack", spec=SPEC + few)  # goes on with it
    jobs = sorted((out / "farm").iterdir())
    (tmp_path / "spec.toml").write_text(SPEC + RENDERED)
    for more in ((), ("--samples", "0-3")):
        again = ("--out", out, "--engine", "slurm", "--steps", "generate,pack", *more)
        refusal = farm("submit", tmp_path / "spec.toml", *again).exception
        assert isinstance(refusal, InputError)
        assert f"{out}-packed: holds another pack" in str(refusal)
        assert "--packed" in str(refusal)
        assert sorted((out / "farm").iterdir()) == jobs
        submit(
            tmp_path,
            "--steps",
            "generate,pack",
            *more,
            "--packed",
            f"{out}-{len(more)}",
            spec=SPEC + RENDERED,
        )
        shutil.rmtree(out / "farm" / "job-003")


def test_a_slices_pack_goes_on_where_that_slice_was_packed(engine, tmp_path):
    slice_of = ("--samples", "5-6")
    out = submit(tmp_path, "--steps", "generate,pack", *slice_of, spec=SPEC + RENDERED)
    begin_pack(out, [5, 6], *slice_of)
    submit(tmp_path, "--steps", "generate,pack", *slice_of, spec=SPEC + RENDERED)


def test_a_dry_run_does_not_narrow_what_is_resumed(engine, tmp_path):
    out = submit(tmp_path, spec=SPEC + RENDERED)
    submit(tmp_path, "--samples", "0-9", "--steps", "generate,train", "--dry-run", spec=SPEC + RENDERED)
    assert resume(out) == ("generate",)
    assert asked_jobs(DatasetFolder(out))[-1].samples == "0-19"


def test_a_narrower_job_does_not_narrow_what_is_resumed(engine, tmp_path):
    out = submit(tmp_path, spec=SPEC + RENDERED)
    submit(tmp_path, "--samples", "0-4", spec=SPEC + RENDERED)
    engine.doing["job-002"] = Activity(running=frozenset({0, 1}))
    for _ in range(2):  # the new job is asked for as much, or the next one would be narrower
        assert resume(out) == ("generate",)
        job = asked_jobs(DatasetFolder(out))[-1]
        assert (job.samples, job.whole) == ("0-19", True)
        assert [chunk.samples for chunk in job.chunks if chunk.samples] == ["5-19"]


@pytest.mark.parametrize("need", ["--dependency=afterok:7", "-dafterok:7", "--depend=afterok:7"])
def test_what_a_job_waited_for_is_not_waited_for_again(engine, tmp_path, need):
    """Slurm forgets jobs that have ended, and cancels what is to wait for one that it does not know."""
    out = submit(tmp_path, "--sbatch-arg=--partition=cpu", f"--sbatch-arg={need}")
    assert resume(out) == ("generate",)
    arguments = [job.resources.sbatch_args for job in asked_jobs(DatasetFolder(out))]
    assert arguments == [("--partition=cpu", need), ("--partition=cpu",)]


def test_of_an_engine_that_does_not_answer_nothing_is_submitted_twice(engine, tmp_path):
    out = submit(tmp_path)
    engine.doing["job-001"] = None
    for again in (farm("resume", out), nothing_more(out)):
        assert isinstance(again.exception, Unanswered)
        assert "slurm does not say what it does with job-001" in str(again.exception)
        assert not (out / "farm" / "job-002").exists()


def test_a_dry_run_needs_no_answer_and_says_what_it_does_not_know(engine, tmp_path):
    out = submit(tmp_path)
    engine.doing["job-001"] = None
    for words in (("submit", tmp_path / "spec.toml", "--out", out, "--engine", "slurm"), ("resume", out)):
        done = farm(*words, "--dry-run", "--json")
        assert (done.exit_code, json.loads(done.stdout)["tasks"]) == (0, 1)
        assert "facegen: job-001: no answer says what these tasks are at" in done.stderr


def test_an_engine_that_is_silent_for_good_does_not_hold_a_dataset_up(engine, tmp_path):
    out = submit(tmp_path, "--steps", "generate,validate")
    engine.doing["job-001"] = None
    generate(open_dataset(out), workers=1)
    record = out / "farm" / "job-001" / "submission.json"
    refusal = nothing_more(out, "--steps", "pack").exception
    assert isinstance(refusal, Unanswered), "the engine may be validating"
    assert f"or remove {record} if it is gone for good" in str(refusal)
    moved = tmp_path / "elsewhere" / "out"
    shutil.copytree(out, moved)
    record.unlink()
    submit(tmp_path, "--steps", "pack", engine="openjd")
    (moved / "farm" / "job-001" / "validate.done").touch()
    submit(moved.parent, "--steps", "pack", engine="openjd")
    assert not farm("submit", moved.parent / "spec.toml", "--out", moved, "--engine", "slurm").stderr.count(
        "job-"
    )


def test_tasks_that_no_engine_can_be_asked_about_are_told(engine, tmp_path):
    out = submit(tmp_path, engine="openjd")
    told = "facegen: job-001: no engine can be asked what these tasks are at"
    assert told in farm("submit", tmp_path / "spec.toml", "--out", out, "--engine", "openjd").stderr
    assert "job-001, job-002: no engine" in farm("resume", out).stderr
    generate(open_dataset(out), workers=1)
    again = farm("submit", tmp_path / "spec.toml", "--out", out, "--engine", "openjd", "--steps", "validate")
    assert (again.exit_code, "no engine" in again.stderr) == (0, False)


@pytest.mark.parametrize("taken", [True, False])
def test_records_of_what_failed_go_with_the_job_that_tries_again(engine, tmp_path, taken):
    out = submit(tmp_path, spec=SPEC + RENDERED)
    record = out / "quarantine" / "sample-000003"
    record.mkdir(parents=True)
    (record / "first.log").write_text("why")
    seen: list[bool] = []

    def answer(job: Job) -> Submission:
        seen.append(record.exists())
        if not taken:
            raise InputError("sbatch refused: no such partition")
        return Submission(ids={"generate": "8"})

    engine.submit = answer
    done = farm("resume", out, "--retry-quarantined")
    assert seen == [False], "the tasks would leave it out"
    assert (done.exit_code == 0) == taken
    assert record.exists() != taken
    assert taken or (record / "first.log").read_text() == "why"
    assert not list((out / "tmp").iterdir())


@pytest.mark.parametrize(("mem", "told"), [("4G", True), ("12G", False)])
def test_too_little_memory_for_the_workers_of_a_task_is_told(engine, tmp_path, mem, told):
    (tmp_path / "spec.toml").write_text(SPEC + RENDERED)
    words = ("--out", tmp_path / "out", "--engine", "slurm", "--cpus", "8", "--mem", mem)
    said = farm("submit", tmp_path / "spec.toml", *words).stderr
    assert ("--mem 4G: 8 workers in 4.3 GB of memory are too many" in said) == told
    assert said.endswith("give 12 GB, or 4 workers\n" if told else "")


def dry_script(folder: Path, step: str, *options: str) -> str:
    """A step's script for Slurm, which is asked for nothing."""
    (folder / "spec.toml").write_text(SPEC + RENDERED)
    words = ("--engine", "slurm", "--steps", "generate,validate,pack", "--dry-run", "--json", *options)
    done = farm("submit", folder / "spec.toml", "--out", folder / "out", *words)
    assert done.exit_code == 0, done.output
    return json.loads(done.stdout)["files"][f"{step}.sh"]


@pytest.mark.parametrize(
    ("asked", "chosen"),
    [((), ""), (("--samples", "0-19"), ""), (("--samples", "0-4"), " --samples 0-4")],
    ids=["all", "all by number", "a slice"],
)
def test_a_slice_is_packed_as_one(tmp_path, asked: tuple[str, ...], chosen: str):
    command = next(
        line for line in dry_script(tmp_path, "pack", *asked).splitlines() if "facegen pack" in line
    )
    assert command.strip().removesuffix(" &").endswith(f"--out {tmp_path}/out-packed{chosen}")


def test_tasks_find_the_rigs_and_the_python_of_the_folder_that_submitted(tmp_path, monkeypatch):
    """Slurm's tasks begin in /, where a package that was installed without -e would look for its rigs."""
    built = rigs_folder().resolve()
    monkeypatch.chdir(tmp_path)
    (tmp_path / "my rigs").symlink_to(built)
    monkeypatch.setenv("FACEGEN_RIGS", "my rigs")
    (tmp_path / "python").write_text('#!/bin/bash\necho "$FACEGEN_RIGS"\n')
    (tmp_path / "python").chmod(0o755)
    script = dry_script(tmp_path, "validate", "--python", "./python")
    (tmp_path / "out" / "farm" / "job-001").mkdir(parents=True, exist_ok=True)
    done = subprocess.run(["bash"], input=script, cwd="/", capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout.strip()) == (0, str(built)), done.stderr


def test_a_bundle_that_cannot_be_cancelled_keeps_no_other_job_from_it(engine, tmp_path):
    submit(tmp_path)
    submit(tmp_path, engine="openjd")
    out = submit(tmp_path)
    submit(tmp_path)  # has ended
    engine.doing = dict.fromkeys(("job-001", "job-003"), Activity(running=frozenset({0})))
    refusal = farm("cancel", out).exception
    assert isinstance(refusal, InputError)
    assert "job-002 is an OpenJD bundle" in str(refusal)
    assert str(refusal).endswith("cancelled: job-001, job-003")
    assert engine.cancelled == ["job-001", "job-003"]


def test_a_folder_that_was_never_submitted_has_nothing_to_cancel(tmp_path):
    refusal = farm("cancel", tmp_path / "mistyped").exception
    assert isinstance(refusal, InputError)
    assert "mistyped: was never submitted to a farm" in str(refusal)


def test_a_job_that_no_engine_took_leaves_nothing(tmp_path, monkeypatch):
    (tmp_path / "spec.toml").write_text(SPEC)
    out = tmp_path / "out"
    programs = tmp_path / "programs"
    programs.mkdir()
    (programs / "bash").symlink_to(shutil.which("bash"))  # reads the scripts over
    monkeypatch.setenv("PATH", str(programs))
    refused = farm("submit", tmp_path / "spec.toml", "--out", out, "--engine", "slurm")
    assert isinstance(refused.exception, InputError)
    assert "sbatch: there is no such command here" in str(refused.exception)
    assert not list((out / "farm").iterdir())
    assert submit(tmp_path, engine="openjd") == out
    assert [path.name for path in (out / "farm").iterdir()] == ["job-001"]


def test_a_job_that_an_engine_may_have_taken_keeps_its_folder(tmp_path, monkeypatch):
    """A slow sbatch may have queued it, and its scripts' logs go there."""
    (tmp_path / "spec.toml").write_text(SPEC)
    out, programs = tmp_path / "out", tmp_path / "programs"
    programs.mkdir()
    (programs / "bash").symlink_to(shutil.which("bash"))
    (programs / "sbatch").write_text(f"#!{shutil.which('bash')}\nexec {shutil.which('sleep')} 60\n")
    (programs / "sbatch").chmod(0o755)
    monkeypatch.setenv("PATH", str(programs))
    monkeypatch.setattr(slurm, "_ASK_TIMEOUT_S", 0.2)
    unanswered = farm("submit", tmp_path / "spec.toml", "--out", out, "--engine", "slurm")
    assert isinstance(unanswered.exception, Unanswered)
    assert f"job-001 may be queued all the same, so {out / 'farm' / 'job-001'} is kept" in str(
        unanswered.exception
    )
    assert (out / "farm" / "job-001" / "generate.sh").is_file()
    assert submit(tmp_path, engine="openjd") == out
    assert sorted(path.name for path in (out / "farm").iterdir()) == ["job-001", "job-002"]
