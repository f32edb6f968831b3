"""Names and setups that would break out of scripts, directives and templates are refused or encoded."""

import os
import shlex
import subprocess
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError
from facegen.farm import ENGINES, Job, Resources, cut_chunks
from facegen.farm.job import list_jobs
from facegen.store import DatasetFolder
from facegen.work import read_journals

pytestmark = pytest.mark.slow

SPEC = 'version = 1\nkind = "still"\nseed = 3\npeople = 3\n'
STEPS = ("generate", "validate", "pack", "train", "export")


def job_at(out: str, *, engine: str, **resources: object) -> Job:
    return Job(
        name="job-003",
        engine=engine,
        out=out,
        packed=f"{out}-packed",
        model=f"{out}-model",
        steps=STEPS,
        samples="0-249",
        shards="0",
        chunks=cut_chunks([0], list(range(250)), chunk=100),
        resources=Resources(**resources),
    )


def submit(tmp_path: Path, name: str, engine: str, *arguments: str) -> Exception | None:
    """Submit a dataset of this name in a dry run; the refusal, if any."""
    (tmp_path / "spec.toml").write_text(SPEC)
    command = ["farm", "submit", str(tmp_path / "spec.toml"), "--out", str(tmp_path / name), "--dry-run"]
    result = CliRunner().invoke(app, [*command, "--engine", engine, "--steps", ",".join(STEPS), *arguments])
    return result.exception


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    "name",
    [
        "a{{Param.OutDir}}",
        "x" * 200,
        "$(touch own)",
        "`id`; 'x",
        "a b%j",
        "ä€𝛼",
        "a\n#SBATCH --uid=0",
        "a\x1b[2J",
        "a\udcff",
    ],
)
def test_a_name_is_refused_or_written_so_that_the_scheduler_reads_it(anny, tmp_path, engine, name):
    refusal = submit(tmp_path, name, engine)
    out = tmp_path / name
    if not name.isprintable():
        assert isinstance(refusal, InputError), refusal
        assert not os.path.exists(os.fsencode(out))
        return
    assert refusal is None
    [(job, _)] = list_jobs(DatasetFolder(out))
    ENGINES[engine].check(job.folder)
    scripts = list(job.folder.glob("*.sh"))
    for script in scripts:
        directives = [line for line in script.read_text().splitlines() if line.startswith("#SBATCH")]
        assert not [line for line in directives if "--uid" in line]
        assert subprocess.run(["bash", "-n", script], capture_output=True).stderr == b""


@pytest.mark.parametrize("engine", ENGINES)
@pytest.mark.parametrize(
    "setup",
    [
        "echo 'open",
        'echo "open',
        "cat <<END",
        "if true; then",
        "module load x \\",
        "echo )",
        "echo \x00",
        "a\r\nb",
        "x &&",
    ],
)
def test_a_setup_that_is_not_whole_is_refused_before_anything_is_written(anny, tmp_path, engine, setup):
    refusal = submit(tmp_path, "out", engine, "--env-setup", setup)
    assert isinstance(refusal, InputError), refusal
    assert "--env-setup" in str(refusal)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize("engine", ENGINES)
def test_a_setup_of_several_lines_is_written(anny, tmp_path, engine):
    setup = "module load python/3.11\nif [ -n \"$X\" ]; then\n\texport Y='a b'\nfi"
    assert submit(tmp_path, "out", engine, "--env-setup", setup) is None


@pytest.mark.parametrize(
    "arguments",
    [
        ("--grace", "inf"),
        ("--grace", "nan"),
        ("--grace", "1e300"),
        ("--time", "9" * 5000),
        ("--time", "\u0661:00:00"),
        ("--mem", "9" * 5000 + "G"),
        ("--mem", "\uff14G"),
        ("--map", "/a\nb=/c"),
        ("--python", "/opt/\udcff/python"),
        ("--sbatch-arg", "--comment=a\nb"),
    ],
    ids=lambda arguments: f"{arguments[0]} {arguments[1][:12]!a}",
)
def test_resources_that_no_scheduler_takes_are_refused(anny, tmp_path, arguments):
    for engine in ENGINES:
        result = submit(tmp_path, "out", engine, *arguments)
        assert isinstance(result, InputError | SystemExit), result
        assert getattr(result, "code", 2) == 2
        assert not (tmp_path / "out").exists()


@given(st.text(min_size=1, max_size=40).filter(lambda text: "/" not in text and "\0" not in text))
def test_a_folder_of_any_name_stays_one_word_of_the_commands(name):
    try:
        files = ENGINES["slurm"].files(job_at(f"/shared/{name}", engine="slurm"))
    except InputError:
        return
    for step in STEPS:
        lines = [
            line
            for line in files[f"{step}.sh"].splitlines()
            if f"-m {'regress' if step in ('train', 'export') else 'facegen'} " in line
        ]
        assert len(lines) == 1
        assert f"/shared/{name}" in " ".join(shlex.split(lines[0].removesuffix("&")))


@pytest.mark.parametrize("record", ['{"ids": {"generate": "--me"}}', '{"ids": {"generate": "1; reboot"}}'])
def test_numbers_of_a_submission_are_numbers(anny, tmp_path, record):
    assert submit(tmp_path, "out", "slurm") is None
    [(job, _)] = list_jobs(DatasetFolder(tmp_path / "out"))
    (job.folder / "submission.json").write_text(record)
    with pytest.raises(InputError, match=r"submission\.json: is not the record of a farm job"):
        list_jobs(DatasetFolder(tmp_path / "out"))


def test_an_engine_that_there_is_not_is_refused(anny, tmp_path):
    assert submit(tmp_path, "out", "slurm") is None
    [record] = (tmp_path / "out" / "farm").glob("*/job.json")
    record.write_text(record.read_text().replace('"slurm"', '"shell"'))
    refusal = CliRunner().invoke(app, ["farm", "resume", str(tmp_path / "out")]).exception
    assert isinstance(refusal, InputError)
    assert "none of slurm, openjd" in str(refusal)


@pytest.mark.openjd
def test_the_scheduler_itself_is_asked(tmp_path):
    """OpenJD refuses what this package may not know of, here a template with a parameter that there is not."""
    (tmp_path / "bundle").mkdir()
    files = ENGINES["openjd"].files(job_at("/shared/faces", engine="openjd"))
    for name, text in files.items():
        (tmp_path / name).write_text(text.replace("{{Param.Python}}", "{{Param.Pythons}}"))
    with pytest.raises(InputError, match="OpenJD does not take the job"):
        ENGINES["openjd"].check(tmp_path)


@pytest.mark.parametrize(
    "line",
    ["[]", "5", "[" * 10_000, '{"task": 1}', "9" * 5000, "\udcff", '{"cpu_seconds": "much"}', "x" * 100_000],
)
def test_a_line_of_a_journal_that_is_none_counts_for_nothing(tmp_path, line):
    good = (
        '{"task": "shard-000000", "outcome": "done", "seconds": 1, "cpu_seconds": 2, "size": 3, "ended": 4}'
    )
    (tmp_path / "logs").mkdir()
    (tmp_path / "logs" / "run-1.jsonl").write_bytes(
        os.fsencode("\n".join([line, good, good.replace("2", "1e999"), good.replace("2", '"2s"'), ""]))
    )
    assert [attempt.cpu_seconds for attempt in read_journals(DatasetFolder(tmp_path))] == [2.0]


@pytest.mark.parametrize(
    ("task", "said"),
    [(["sample-000123"], "has no logs of sample-000123: no attempt"), ([], "no engine has run")],
)
def test_a_task_without_logs_is_told_why(tmp_path, task, said):
    refusal = CliRunner().invoke(app, ["farm", "logs", str(tmp_path), *task]).exception
    assert isinstance(refusal, InputError)
    assert said in str(refusal)


@pytest.mark.parametrize("task", ["**a", "../../x", "sample-1", "*", "sample-" + "9" * 300])
def test_a_task_that_no_farm_has_is_refused(tmp_path, task):
    refusal = CliRunner().invoke(app, ["farm", "logs", str(tmp_path), task]).exception
    assert isinstance(refusal, InputError)
