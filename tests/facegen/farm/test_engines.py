"""Every engine of the table keeps to the interface, also where its scheduler is not installed."""

import inspect
import re
from pathlib import PurePosixPath

import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import FacegenError, InputError
from facegen.farm import ENGINES, Activity, Engine, Job, Resources, Submission, cut_chunks, prepare, remaining
from facegen.farm.job import list_jobs
from facegen.farm.state import farm_state
from facegen.spec import parse_spec
from facegen.store import Dataset, resolve

pytestmark = pytest.mark.parametrize("name", ENGINES)

SPEC = {"version": 1, "kind": "still", "seed": 3, "people": 3, "render": {"samples": "0-4"}}
STEPS = ("generate", "validate", "pack", "train", "export")


def job_at(out: str, name: str, **resources: object) -> Job:
    return Job(
        name="job-003",
        engine=name,
        out=out,
        packed=f"{out}-packed",
        model=f"{out}-model",
        steps=STEPS,
        samples="0-249",
        shards="0",
        chunks=cut_chunks([0], list(range(250)), chunk=100),
        resources=Resources(**resources),
    )


@pytest.fixture
def dataset(anny, tmp_path) -> Dataset:
    return resolve(parse_spec(SPEC, where="test"), tmp_path / "out")


@pytest.fixture
def no_scheduler(monkeypatch, tmp_path) -> None:
    monkeypatch.setenv("PATH", str(tmp_path))
    monkeypatch.setattr("sys.executable", str(tmp_path / "python"))


def test_it_has_every_method_with_the_same_parameters(name):
    methods = {
        key: value for key, value in vars(Engine).items() if inspect.isfunction(value) and key[0] != "_"
    }
    assert methods
    for key, method in methods.items():
        own = inspect.signature(getattr(ENGINES[name], key)).parameters
        assert list(own) == list(inspect.signature(method).parameters)[1:]


def test_files_are_texts_below_the_jobs_folder_and_the_same_every_time(name):
    job = job_at("/shared/faces", name, cpus=4, mem="4G", time="2:00:00", max_parallel=8)
    files = ENGINES[name].files(job)
    assert files
    assert files == ENGINES[name].files(job)
    for path, text in files.items():
        assert ".." not in PurePosixPath(path).parts
        assert not PurePosixPath(path).is_absolute()
        assert text.endswith("\n")
    # the words of a command stand behind each other, in a line of a script or in a list of JSON
    words = re.sub(r'[",\s]+', " ", "".join(files.values()))
    for step in ("facegen generate", "facegen validate", "facegen pack", "regress train", "regress export"):
        assert f" -m {step} " in words


def test_a_dry_run_says_how_to_start(name):
    job = job_at("/shared/my faces", name)
    assert all("job-003" in line for line in ENGINES[name].instructions(job))
    assert ENGINES[name].instructions(job)


def test_folders_are_written_as_the_farm_sees_them(name):
    files = ENGINES[name].files(job_at("/studio/faces", name, path_map=(("/studio", "/mnt/studio"),)))
    assert any("/mnt/studio" in text for text in files.values())


@pytest.mark.usefixtures("no_scheduler")
def test_without_its_scheduler_it_refuses_in_a_sentence_or_has_nothing_to_ask(name, dataset):
    engine, left = ENGINES[name], remaining(dataset, None)
    job = prepare(dataset, left, engine=name, steps=STEPS, samples=None, resources=Resources())
    refusals = []
    try:
        submission = engine.submit(job)
    except InputError as refusal:
        refusals, submission = [str(refusal)], Submission(ids={"generate": "7"})
    assert "\n" not in "".join(refusals)
    activity = engine.activity(job, submission)
    assert activity is None or isinstance(activity, Activity)
    with pytest.raises(FacegenError):
        engine.cancel(job, submission)


def test_a_job_that_nobody_started_is_waiting_for_a_resume(name, dataset):
    left = remaining(dataset, None)
    prepare(dataset, left, engine=name, steps=STEPS, samples=None, resources=Resources())
    [(job, submission)] = list_jobs(dataset.folder)
    assert (job.engine, submission) == (name, None)
    state = farm_state(dataset)
    assert (state.missing, state.running, state.waiting) == (6, None, None)
    assert [step.state for step in state.steps] == ["to do"] * 4


def test_a_wrong_name_is_answered_with_this_one(name, tmp_path):
    arguments = ["submit", "datasets/tiny.toml", "--out", str(tmp_path), "--engine", "none"]
    refusal = CliRunner().invoke(app, ["farm", *arguments]).exception
    assert isinstance(refusal, InputError)
    assert name in str(refusal)
