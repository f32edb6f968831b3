"""Job bundles with the real openjd-cli: chunks, a failing chunk, dependencies, cancelling, mapping."""

import json
import shutil
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from tests.real_tools.farms import (
    ROOT,
    facegen,
    no_leftovers,
    outcomes,
    processes_with,
    rendered,
    state,
    wait_for,
    write_spec,
)

OPENJD = Path(sys.executable).with_name("openjd")

pytestmark = [
    pytest.mark.openjd,
    pytest.mark.usefixtures("anny"),
    pytest.mark.skipif(
        not OPENJD.is_file(), reason="no openjd-cli here; it comes with facegen's extra `dev`"
    ),
]

SETUP = ("--env-setup", f"export PYTHONPATH={ROOT}", "--grace", "20")


def bundle(tmp_path: Path, *options: str) -> tuple[Path, list[str]]:
    """The dataset's folder, and the arguments that run its newest bundle."""
    out = tmp_path / "out"
    facegen("farm", "submit", write_spec(tmp_path), "--out", out, "--engine", "openjd", *SETUP, *options)
    folder = max((out / "farm").iterdir())
    return out, [str(folder / "bundle" / "template.json"), "-p", f"file://{folder / 'parameters.json'}"]


def openjd(*arguments: str, code: int = 0) -> str:
    done = subprocess.run([OPENJD, *arguments], capture_output=True, text=True, timeout=1200, cwd=ROOT)
    text = done.stdout + done.stderr
    assert done.returncode == code, text
    return text


@pytest.fixture(autouse=True)
def no_session_is_left(tmp_path_factory, monkeypatch):
    """Sessions have a folder of this test's, and leave nothing in it."""
    folder = tmp_path_factory.mktemp("sessions")
    monkeypatch.setenv("TMPDIR", str(folder))
    yield
    assert not list((folder / "OpenJD").glob("*"))


def test_the_template_passes_the_check_with_every_step(tmp_path):
    steps = (
        "--steps",
        "generate,validate,pack,train,export",
        "--mem",
        "4G",
        "--time",
        "2:00:00",
        "--cpus",
        "2",
    )
    out, (template, *parameters) = bundle(
        tmp_path, *steps, "--max-parallel", "7", "--map", "/studio=/mnt/studio"
    )
    assert "passes validation checks" in openjd("check", template)
    summary = openjd("summary", template, *parameters)
    for step in ("Keypoints", "Pictures", "Validate", "Pack", "Train", "Export"):
        assert step in summary
    values = json.loads((out / "farm" / "job-001" / "bundle" / "parameter_values.json").read_text())
    assert {"name": "deadline:maxWorkerCount", "value": 7} in values["parameterValues"]
    assert {path.name for path in Path(template).parent.iterdir()} == {
        *("template.json", "parameter_values.json", "asset_references.json", "spec.toml", "headset.toml")
    }


@pytest.mark.slow
@pytest.mark.blender
def test_chunks_run_and_tell_their_progress(tmp_path):
    out, _ = bundle(tmp_path, "--samples", "0-3", "--chunk", "2", "--steps", "generate,validate", "--wait")
    assert state(out)["missing"] == 0
    assert [step["state"] for step in state(out)["steps"]] == ["done"]
    assert outcomes(out) == ["done"] * 5
    log = (out / "farm" / "job-001" / "logs" / "openjd.out").read_text()
    assert "openjd_progress: 50.0" in log
    assert "openjd_status: 1 of 2 shards and rendered samples" in log
    assert no_leftovers(out)


@pytest.mark.slow
@pytest.mark.blender
def test_a_failing_chunk_stops_what_depends_on_it_until_it_is_mended(tmp_path):
    out, run = bundle(tmp_path, "--samples", "0-3", "--chunk", "2", "--steps", "generate,validate")
    poison = out / "quarantine" / "sample-000000"
    poison.mkdir(parents=True)  # as after three failures
    text = openjd("run", *run, "--step", "Validate", "--run-dependencies", code=1)
    assert "things wrong" not in text, "validate did not run"
    assert rendered(out) == [1], "the rest of the failing chunk is there; openjd-cli starts no further one"
    assert state(out)["quarantined"] == ["sample-000000"]
    assert [step["state"] for step in state(out)["steps"]] == ["to do"]
    shutil.rmtree(poison)
    text = openjd("run", *run, "--step", "Validate", "--run-dependencies")
    assert rendered(out) == [0, 1, 2, 3]
    assert "0 things wrong" in text
    assert [step["state"] for step in state(out)["steps"]] == ["done"]
    # any other cut does as well: chunks are sets of samples and name nothing
    assert "found: 4" in openjd("run", *run, "--step", "Pictures", "-tp", "Ids=0-3")


@pytest.mark.slow
@pytest.mark.blender
def test_a_cancelled_task_drains(tmp_path):
    out, run = bundle(tmp_path, "--samples", "0-44", "--chunk", "45")
    process = subprocess.Popen(
        [OPENJD, "run", *run], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, cwd=ROOT
    )
    try:
        wait_for(lambda: rendered(out), what="a first sample")
        process.send_signal(signal.SIGTERM)
        text, _ = process.communicate(timeout=300)
    finally:
        process.kill()
    assert process.returncode != 0
    assert b"run the same command to go on" in text
    assert set(outcomes(out)) == {"done"}, "the running sample was let end"
    assert 0 < len(rendered(out)) < 45
    assert not processes_with("facegen", str(out))
    assert no_leftovers(out)


@pytest.mark.slow
def test_paths_are_mapped(tmp_path):
    # the submitting machine knows the folder by another name than this worker
    studio, here = tmp_path / "studio", tmp_path / "mnt"
    studio.mkdir()
    _, run = bundle(studio, "--map", f"{studio}={here}")
    studio.rename(here)
    run = [argument.replace(str(studio), str(here)) for argument in run]
    mapping = here / "out" / "farm" / "job-001" / "path_mapping.json"
    openjd("run", *run, "--path-mapping-rules", f"file://{mapping}", "--step", "Keypoints")
    assert (here / "out" / "keypoints" / "shard-00000.parquet").is_file()
    assert not studio.exists()
