"""Scripts and bundles as texts: golden files, quoting, chunks, the queue, limits as people write them."""

import dataclasses
import json
import os
import re
import shlex
import shutil
import subprocess
from collections import Counter
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from facegen.errors import InputError, Unanswered
from facegen.farm import ENGINES, Chunk, Job, Resources, Submission, cut_chunks
from facegen.farm.openjd import deadline_values, job_template, path_mapping
from facegen.farm.slurm import Slurm, read_squeue, sbatch_script
from facegen.number_ranges import format_ranges, sample_numbers

GOLDEN = Path(__file__).with_name("golden")

JOB = Job(
    name="job-003",
    engine="slurm",
    out="/shared/faces",
    packed="/shared/faces-packed",
    model="/shared/faces-model",
    steps=("generate", "validate", "pack", "train", "export"),
    samples="0-249",
    shards="0",
    chunks=cut_chunks([0], list(range(250)), chunk=100),
    resources=Resources(
        cpus=4,
        mem="4G",
        time="2:00:00",
        max_parallel=8,
        env_setup="module load python/3.11",
        python="/shared/env/bin/python",
        path_map=(("/shared", "/cluster/shared"),),
    ),
)


def check_golden(name: str, text: str, request: pytest.FixtureRequest) -> None:
    """Compare with a golden file; it is written only when --update-golden asks for it."""
    path = GOLDEN / name
    if request.config.getoption("--update-golden"):
        path.write_text(text)
    assert path.is_file(), f"{path} is missing; look at the new text and write it with --update-golden"
    assert text == path.read_text()


@pytest.mark.parametrize("step", JOB.steps)
def test_batch_scripts_are_as_read_over(step, request):
    check_golden(f"{step}.sh", sbatch_script(JOB, step), request)


def test_the_template_is_as_read_over(request):
    check_golden("template.json", json.dumps(job_template(JOB), indent=2) + "\n", request)


@pytest.mark.openjd
def test_scattered_samples_are_as_few_tasks_as_others():
    """OpenJD's own reader makes the tasks; each hole began another one."""
    model = pytest.importorskip("openjd.model")
    numbers = [number**2 for number in range(300)]
    job = dataclasses.replace(JOB, chunks=cut_chunks([0], numbers, chunk=100), resources=Resources())
    template = model.decode_job_template(template=job_template(job), supported_extensions=["TASK_CHUNKING"])
    values = {
        parameter.name: model.ParameterValue(
            type=model.ParameterValueType(parameter.type.value),
            value="/any" if parameter.default is None else str(parameter.default),
        )
        for parameter in template.parameterDefinitions
    }
    made = model.create_job(job_template=template, job_parameter_values=values)
    [pictures] = [step for step in made.steps if step.name == "Pictures"]
    tasks = [task["Ids"].value for task in model.StepParameterSpaceIterator(space=pictures.parameterSpace)]
    assert len(tasks) == 3
    assert [number for task in tasks for number in sample_numbers(task, total=10**6, where="task")] == numbers


@pytest.mark.parametrize("step", JOB.steps)
def test_bash_reads_the_scripts(step):
    assert subprocess.run(["bash", "-n"], input=sbatch_script(JOB, step), text=True).returncode == 0


def test_without_a_setup_no_line_stands_for_one():
    bare = sbatch_script(dataclasses.replace(JOB, resources=Resources()), "validate")
    assert "export PYTHONUNBUFFERED=1\nrc=75\n" in bare
    assert "export PYTHONUNBUFFERED=1\nmodule load python/3.11\nrc=75\n" in sbatch_script(JOB, "validate")


@pytest.mark.parametrize(
    "argument",
    ["--job-name=mine", "--job-name", "--job", "-Jmine", "--clusters=a,b", "-M", "--array=0-3", "-a0-3"],
)
def test_arguments_that_hide_tasks_are_refused(argument):
    hidden = dataclasses.replace(JOB, resources=Resources(sbatch_args=("--partition=cpu", argument)))
    with pytest.raises(InputError, match=rf"--sbatch-arg={argument}: .* would not be found again"):
        sbatch_script(hidden, "generate")


@pytest.mark.parametrize(
    "argument", ["--account=mine", "-Amine", "--mail-type=END", "mine", "--comment=--array"]
)
def test_other_arguments_are_passed_on(argument, tmp_path, monkeypatch):
    """To every step's sbatch, as one word each and before the script: what stands behind it is the script's own."""
    told = tmp_path / "told.txt"
    sbatch = tmp_path / "sbatch"
    sbatch.write_text(f"#!/bin/sh\nprintf '%s\\n' \"$@\" >> {told}\necho end >> {told}\necho 41\n")
    sbatch.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    resources = Resources(sbatch_args=("--partition=cpu", argument))
    job = dataclasses.replace(JOB, out=str(tmp_path), steps=("generate", "validate"), resources=resources)
    for step in job.steps:
        sbatch_script(job, step)  # refuses nothing
    assert Slurm().submit(job).ids == {"generate": "41", "validate": "41"}
    first, second = told.read_text().split("end\n")[:2]
    ours = ["--kill-on-invalid-dep=yes", "--partition=cpu", argument]
    assert first.splitlines() == ["--parsable", *ours, str(job.folder / "generate.sh")]
    assert second.splitlines() == [
        *("--parsable", "--dependency=afterok:41", *ours, str(job.folder / "validate.sh")),
    ]


@pytest.mark.parametrize("argument", ["--wait", "-W", "--test-only", "--test", "-d", "--dependency", "--dep"])
def test_arguments_that_hold_up_or_name_nothing_are_refused(argument):
    held = dataclasses.replace(JOB, resources=Resources(sbatch_args=(argument,)))
    with pytest.raises(InputError, match=rf"--sbatch-arg={argument}: "):
        sbatch_script(held, "validate")


@pytest.fixture
def sbatch(tmp_path, monkeypatch) -> Path:
    """A stand-in that writes its words down, a line a call, and counts up from 41 after a banner."""
    told, program = tmp_path / "told.txt", tmp_path / "sbatch"
    program.write_text(
        f'#!/bin/bash\necho "Welcome; 7 nodes"\necho "$@" >> {told}\necho "$((40 + $(wc -l < {told})));tux"\n'
    )
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    return told


@pytest.mark.parametrize("given", ["--dependency=afterok:7", "-dafterok:7", "--depend=afterok:7"])
def test_a_users_dependency_is_the_first_steps_and_the_others_keep_theirs(given, sbatch, tmp_path):
    steps = ("generate", "validate", "pack")
    job = dataclasses.replace(JOB, out=str(tmp_path), steps=steps, resources=Resources(sbatch_args=(given,)))
    assert Slurm().submit(job).ids == {"generate": "41", "validate": "42", "pack": "43"}
    needs = [
        [word for word in line.split() if word[:2] == "-d" or "--d" in word]
        for line in sbatch.read_text().splitlines()
    ]
    assert needs == [[given], ["--dependency=afterok:41"], ["--dependency=afterok:42"]]
    for line, need in zip(Slurm().instructions(job), needs, strict=True):
        own = need[0].replace("41", "$generate").replace("42", "$validate")
        assert f" {own} " in line  # not quoted: a shell puts the number there


def test_an_answer_without_a_number_is_none(tmp_path, monkeypatch):
    """Slurm may have taken the job: it is not as if it had refused."""
    (tmp_path / "sbatch").write_text("#!/bin/sh\necho Welcome\n")
    (tmp_path / "sbatch").chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    with pytest.raises(Unanswered, match="gave no job's number, but 'Welcome'"):
        Slurm().submit(dataclasses.replace(JOB, out=str(tmp_path)))


@pytest.mark.parametrize("program", ["bash", "openjd"])
def test_a_reader_of_scripts_that_is_not_done_in_time_is_told(program, tmp_path, monkeypatch):
    (tmp_path / program).write_text(f"#!{shutil.which('bash')}\nexec {shutil.which('sleep')} 60\n")
    (tmp_path / program).chmod(0o755)
    monkeypatch.setenv("PATH", str(tmp_path), prepend=os.pathsep)
    monkeypatch.setattr("facegen.farm.openjd._openjd", lambda: str(tmp_path / "openjd"))
    for module, limit in (("shell", "_READ_TIMEOUT_S"), ("openjd", "_CHECK_TIMEOUT_S")):
        monkeypatch.setattr(f"facegen.farm.{module}.{limit}", 0.2)
    (tmp_path / "generate.sh").write_text("true\n")
    engine = ENGINES["slurm" if program == "bash" else "openjd"]
    with pytest.raises(Unanswered, match=r"has not read .* within 0\.2 s"):
        engine.check(tmp_path)


@pytest.mark.parametrize(("grace_s", "told"), [(30.0, False), (31.0, True)])
def test_a_grace_that_slurm_will_not_give_is_told(tmp_path, monkeypatch, grace_s, told):
    """As `scontrol show config` of Slurm 22.05 prints it; where there is none, nothing is said."""
    job = dataclasses.replace(JOB, resources=Resources(grace_s=grace_s))
    monkeypatch.setenv("PATH", str(tmp_path))
    assert Slurm().notes(job) == []
    config = "Configuration data as of 2026-11-29\nKeepAliveTime = SYSTEM_DEFAULT\nKillWait = 30 sec\n"
    (tmp_path / "scontrol").write_text(f"#!/bin/sh\nprintf '{config}'\n".replace("\nK", "\\nK"))
    (tmp_path / "scontrol").chmod(0o755)
    assert ["kills 30 s after" in note for note in Slurm().notes(job)] == [True] * told


@pytest.mark.parametrize(("grace_s", "told"), [(590.0, False), (591.0, True)])
def test_a_grace_that_openjd_will_not_give_is_told(grace_s, told):
    job = dataclasses.replace(JOB, resources=Resources(grace_s=grace_s))
    assert ["590 s at most" in note for note in ENGINES["openjd"].notes(job)] == [True] * told


def test_what_a_site_lets_squeue_say_besides_is_no_task():
    submission = Submission(ids={"generate": "41"})
    assert read_squeue("Welcome to 41\n41\n41|x\n41|3|RUNNING|None\n", submission).running == {3}


def test_names_with_blanks_and_percents_survive():
    job = dataclasses.replace(JOB, out="/shared/my faces 50%", resources=Resources(python="/opt/my python"))
    script = sbatch_script(job, "generate")
    assert '#SBATCH --output="/shared/my faces 50%%/farm/job-003/logs/generate-%a.out"' in script
    line = next(line for line in script.splitlines() if "facegen generate" in line)
    words = shlex.split(line.removesuffix("&"))
    assert words[:5] == ["/opt/my python", "-m", "facegen", "generate", "/shared/my faces 50%/spec.toml"]
    with pytest.raises(InputError, match="cannot name a folder with a quote"):
        sbatch_script(dataclasses.replace(JOB, out='/shared/"faces"'), "generate")


def test_chunks_hold_everything_once_and_fit_an_array():
    assert cut_chunks([0, 1], list(range(5)), chunk=2) == (
        *(Chunk(shards="0"), Chunk(shards="1")),
        *(Chunk(samples="0-1"), Chunk(samples="2-3"), Chunk(samples="4")),
    )
    assert cut_chunks([], [7, 9, 10]) == (Chunk(samples="7,9-10"),)
    assert cut_chunks([], []) == ()
    million = cut_chunks(list(range(100)), list(range(1_000_000)))
    assert len(million) <= 1000
    with pytest.raises(InputError, match="at least --chunk 1000"):
        cut_chunks([], list(range(1_000_000)), chunk=10)


@given(st.sets(st.integers(0, 300)), st.integers(1, 40))
def test_chunks_of_any_samples_are_read_back(numbers, size):
    chunks = cut_chunks([], sorted(numbers), chunk=size)
    read = [sample_numbers(chunk.samples, total=301, where="chunk") for chunk in chunks]
    assert [number for some in read for number in some] == sorted(numbers)
    for chunk, some in zip(chunks, read, strict=True):
        assert len(chunk.samples) <= len(format_ranges(some))


def test_every_tenth_sample_is_a_few_words_and_what_no_command_takes_is_refused():
    assert (
        cut_chunks([], [*range(3), *range(10, 1_000_000, 10)], chunk=100_000)[0].samples == "0-2,10-999970:10"
    )
    squares = [number**2 for number in range(40_000)]
    with pytest.raises(InputError, match="at most 131,071; give --chunk") as refusal:
        cut_chunks([], squares, chunk=40_000)
    advised = int(re.search(r"give --chunk (\d+)", str(refusal.value))[1])
    longest = max(len(chunk.samples) for chunk in cut_chunks([], squares, chunk=advised))
    subprocess.run(["true", "9" * longest], check=True)


def test_an_array_and_its_steps_are_found_in_the_queue():
    listing = "\n".join(
        ["41|0|RUNNING|None", "41|3|PENDING|Resources", "42|N/A|PENDING|Dependency", "7|0|RUNNING|None", ""]
    )
    activity = read_squeue(listing, Submission(ids={"generate": "41", "validate": "42"}))
    assert (activity.running, activity.waiting) == ({0}, {3})
    assert activity.steps == {"validate": "pending"}
    assert activity.reasons == Counter(Resources=1, Dependency=1)
    assert not read_squeue("", Submission(ids={"generate": "41"})).anything


@pytest.mark.parametrize(
    ("text", "seconds"), [("90", 5400), ("1:30", 90), ("2:00:00", 7200), ("1-0", 86400), ("1-12:30", 131400)]
)
def test_times_are_slurms(text, seconds):
    assert Resources(time=text).time_s == seconds


@pytest.mark.parametrize(
    ("text", "mebibytes"), [("900M", 900), ("4G", 4096), ("1T", 1 << 20), ("2048K", 2), ("1K", 1)]
)
def test_memory_is_slurms(text, mebibytes):
    assert Resources(mem=text).mem_mib == mebibytes


@pytest.mark.parametrize(
    ("resources", "words"),
    [
        ({"time": "soon"}, "--time 'soon': write minutes"),
        ({"time": "0:30"}, "--time 0:30: is less than a minute"),
        ({"mem": "much"}, "--mem 'much': write a whole number"),
    ],
)
def test_what_cannot_be_read_is_refused(resources, words):
    with pytest.raises(InputError, match=words):
        Resources(**resources)


def test_a_notice_before_the_beginning_is_refused():
    """`--time 1:30` are 90 seconds to Slurm, and hours to many people."""
    job = dataclasses.replace(JOB, resources=Resources(time="1:30"))
    with pytest.raises(InputError, match=r"--time 1:30 \(90 s\): Slurm says 60 s before the grace of 30 s"):
        sbatch_script(job, "generate")
    assert "--time=1:31" in sbatch_script(
        dataclasses.replace(JOB, resources=Resources(time="1:31")), "generate"
    )


@pytest.mark.parametrize(
    "state", ["RUNNING", "COMPLETING", "CONFIGURING", "PENDING", "SUSPENDED", "REQUEUED"]
)
def test_a_task_of_slurm_is_at_work_or_waits(state):
    activity = read_squeue(f"41|7|{state}|None", Submission(ids={"generate": "41"}))
    at_work = state in ("RUNNING", "COMPLETING", "CONFIGURING")
    assert (activity.running, activity.waiting) == (({7}, set()) if at_work else (set(), {7}))


def test_folders_are_mapped_by_whole_names():
    resources = Resources(path_map=(("/shared/", "/mnt/s"),))
    assert resources.on_farm("/shared/faces") == "/mnt/s/faces"
    assert resources.on_farm("/shared") == "/mnt/s"
    assert resources.on_farm("/shared2/faces") == "/shared2/faces"
    assert path_mapping(JOB)["path_mapping_rules"][0]["destination_path"] == "/cluster/shared"


def test_deadline_gets_its_own_parameters():
    names = {value["name"] for value in deadline_values(JOB)["parameterValues"]}
    assert names == {
        *("OutDir", "PackedDir", "ModelDir", "Python"),
        *("deadline:maxRetriesPerTask", "deadline:maxWorkerCount"),
    }


def test_braces_in_a_setup_are_refused_for_openjd():
    job = dataclasses.replace(JOB, resources=Resources(env_setup="echo {{x}}"))
    with pytest.raises(InputError, match="--env-setup"):
        job_template(job)
