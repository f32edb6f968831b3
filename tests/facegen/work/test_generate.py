"""Datasets made for real: bytes repeat over runs, workers and slices; stopping and failing lose nothing."""

import json
import os
import signal
import subprocess
import sys
import time
import tracemalloc
from pathlib import Path

import numpy as np
import psutil
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.conventions import BLENDSHAPES
from facegen.errors import InputError, OutputError
from facegen.machine import is_alive
from facegen.spec import load_spec, parse_spec
from facegen.store import begin, column_array, open_dataset, resolve
from facegen.work import generate, plan_work

ROOT = Path(__file__).resolve().parents[3]
TINY = ROOT / "datasets" / "tiny.toml"
KEYPOINTS_ONLY = {"version": 1, "kind": "still", "seed": 5, "people": 30, "still": {"neutral": 1, "faces": 3}}

pytestmark = pytest.mark.usefixtures("anny")


def files_of(folder: Path) -> dict[str, bytes]:
    kept = [
        p
        for p in sorted(folder.rglob("*"))
        if p.is_file() and p.relative_to(folder).parts[0] not in ("logs", "tmp")
    ]
    return {str(p.relative_to(folder)): p.read_bytes() for p in kept}


def keypoints_dataset(out: Path, **change):
    return resolve(parse_spec(KEYPOINTS_ONLY | change, where="test"), out)


@pytest.mark.slow
@pytest.mark.blender
def test_bytes_repeat_over_workers_runs_and_slices(tmp_path, rendered):
    spec = load_spec(TINY)
    with_two = generate(resolve(spec, tmp_path / "two"), workers=2)
    assert (with_two.made, with_two.left, with_two.quarantined) == (3, 0, ())
    generate(resolve(spec, tmp_path / "slice"), "1", workers=1)
    # the third is of one worker
    two, part, one = map(files_of, (tmp_path / "two", tmp_path / "slice", rendered.folder.path))
    assert sum(name.endswith(".exr") for name in two) == 6
    assert two == one
    assert {name for name in two if name not in part} == {
        n for n in two if n.startswith("renders/000/000000/")
    }
    assert all(two[name] == content for name, content in part.items())
    again = generate(resolve(spec, tmp_path / "slice"), workers=1)
    assert (again.made, again.found) == (1, 2)
    assert files_of(tmp_path / "slice") == two


def test_keypoints_repeat_and_hold_what_their_columns_say(tmp_path):
    dataset = keypoints_dataset(tmp_path / "a")
    assert generate(dataset, workers=1).made == 1
    generate(keypoints_dataset(tmp_path / "b"), workers=1)
    assert files_of(tmp_path / "a") == files_of(tmp_path / "b")
    table = open_dataset(tmp_path / "a").keypoints()
    assert table.num_rows == 120
    assert column_array(table, "weights").shape == (120, len(BLENDSHAPES))
    assert column_array(table, "points_3d").shape == (120, 68, 3)
    exact, detected = column_array(table, "points_2d"), column_array(table, "detected_2d")
    width = np.linalg.norm(exact[:, 0] - exact[:, 16], axis=-1)
    np.testing.assert_allclose(column_array(table, "face_width"), width, rtol=1e-5)
    # 68 x 2 x 120 draws of a normal distribution: its sd is known to 0.6 %
    noise = ((detected - exact) / width[:, None, None]).std()
    assert noise == pytest.approx(0.001, rel=0.03)
    right_jaw, left_jaw = exact[:, 0, 0], exact[:, 16, 0]
    assert (right_jaw < left_jaw).all(), "the subject's right jaw (index 0) is at the image's left"


def test_another_seed_is_another_dataset_and_another_folder(tmp_path):
    generate(keypoints_dataset(tmp_path / "a"), workers=1)
    with pytest.raises(InputError, match="holds a dataset of another spec"):
        generate(keypoints_dataset(tmp_path / "a", seed=6), workers=1)
    generate(keypoints_dataset(tmp_path / "b", seed=6), workers=1)
    a, b = (open_dataset(tmp_path / name).array("points_2d") for name in ("a", "b"))
    assert not np.isclose(a, b).all(axis=(1, 2)).any()


def test_a_folder_with_other_things_and_one_that_cannot_be_written_are_refused(tmp_path):
    (tmp_path / "full").mkdir()
    (tmp_path / "full" / "thesis.doc").write_text("mine")
    with pytest.raises(InputError, match="is not empty and holds no facegen dataset"):
        generate(keypoints_dataset(tmp_path / "full"), workers=1)
    assert [p.name for p in (tmp_path / "full").iterdir()] == ["thesis.doc"]
    (tmp_path / "file").write_text("a file, where the folder should go")
    with pytest.raises(OutputError, match="cannot be written"):
        generate(keypoints_dataset(tmp_path / "file" / "out"), workers=1)


def test_a_start_that_was_killed_is_no_obstacle(tmp_path):
    dataset = keypoints_dataset(tmp_path / "a")
    begin(dataset)
    folder = dataset.folder
    # those that come last, backwards
    last = (folder.licences_txt, folder.croissant_json, folder.card, folder.dataset_json)
    for count in range(1, 5):
        for path in last[:count]:
            path.unlink()
        begin(dataset)
        assert all(path.is_file() for path in last)
    assert json.loads(folder.dataset_json.read_text())["spec_hash"] == dataset.hash


def test_what_is_in_quarantine_is_left_alone_until_it_is_asked_for(tmp_path):
    dataset = keypoints_dataset(tmp_path / "a", people=30)
    begin(dataset)
    dataset.folder.quarantine("shard-000000").mkdir(parents=True)
    assert [task.name for task in generate(dataset, workers=1).quarantined] == ["shard-000000"]
    healed = generate(dataset, workers=1, retry_quarantined=True)
    assert (healed.made, healed.quarantined) == (1, ())
    assert not (tmp_path / "a" / "quarantine" / "shard-000000").exists()


def start(out: Path, *arguments: str) -> subprocess.Popen:
    program = "from facegen.cli import main; main()"
    command = [sys.executable, "-c", program, "generate", str(TINY), "--out", str(out), *arguments]
    return subprocess.Popen(command, cwd=ROOT, stderr=subprocess.PIPE, stdout=subprocess.PIPE, text=True)


@pytest.mark.slow
@pytest.mark.blender
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT])
def test_a_stop_drains_and_the_next_run_ends_the_same(tmp_path, rendered, number):
    process = start(tmp_path / "a", "--samples", "0-7", "--workers", "1", "--grace", "60")
    deadline = time.monotonic() + 300
    while not (tmp_path / "a" / "keypoints").exists() and time.monotonic() < deadline:
        time.sleep(0.05)
    process.send_signal(number)
    _, err = process.communicate(timeout=300)
    assert process.returncode == 75, err
    assert "run the same command to go on" in err
    assert "Traceback" not in err
    assert not list((tmp_path / "a" / "tmp").iterdir())
    left = plan_work(resolve(load_spec(TINY), tmp_path / "a"), "0-7").missing
    assert left
    if number == signal.SIGINT:
        return  # what is left is as after the other
    process = start(tmp_path / "a", "--samples", "0-1", "--workers", "1")
    _, err = process.communicate(timeout=600)
    assert process.returncode == 0, err
    wanted, found = files_of(rendered.folder.path), files_of(tmp_path / "a")
    made = [name for name in wanted if name.startswith(("keypoints/", "renders/"))]
    assert len(made) > 7
    assert [name for name in made if found.get(name) != wanted[name]] == []


@pytest.mark.slow
def test_workers_die_with_a_supervisor_that_is_killed(tmp_path):
    process = start(tmp_path / "a", "--samples", "0-7", "--workers", "1")
    logs = tmp_path / "a" / "logs"
    deadline = time.monotonic() + 300
    while not list(logs.glob("worker-*")) and time.monotonic() < deadline:
        time.sleep(0.05)
    children = [child.pid for child in psutil.Process(process.pid).children()]
    assert children
    process.kill()
    process.communicate()
    deadline = time.monotonic() + 120
    while any(is_alive(pid) for pid in children) and time.monotonic() < deadline:
        time.sleep(0.1)
    assert not any(is_alive(pid) for pid in children)


@pytest.mark.parametrize("others", [False, True])
def test_a_dry_run_counts_nothing_of_somebody_elses_folder(tmp_path, others):
    if others:
        (tmp_path / "a").mkdir()
        (tmp_path / "a" / "notes.txt").touch()
    else:
        begin(keypoints_dataset(tmp_path / "a"))
    result = CliRunner().invoke(app, ["generate", str(TINY), "--out", str(tmp_path / "a"), "--dry-run"])
    assert isinstance(result.exception, InputError)
    assert ("is not empty" if others else "of another spec") in str(result.exception)


def test_a_dataset_that_is_not_one_is_said_to_be_none(tmp_path):
    with pytest.raises(InputError, match="not a facegen dataset"):
        open_dataset(tmp_path)


def test_root_may_write_anywhere_else_the_message_names_the_place(tmp_path):
    if os.geteuid() == 0:
        pytest.skip("root is not refused by permissions; a file in the way is tested above")
    (tmp_path / "locked").mkdir(mode=0o500)
    with pytest.raises(OutputError, match="locked"):
        generate(keypoints_dataset(tmp_path / "locked" / "out"), workers=1)


GIGANTIC = {
    "people": 100_000_000,
    "still": {"sessions": 1000, "neutral": 1, "faces": 9_999_999},
    "render": {"samples": "0-99999999999"},
}


def test_what_nobody_could_list_is_counted(tmp_path):
    dataset = keypoints_dataset(tmp_path / "a", **GIGANTIC)
    folder = dataset.folder
    folder.render(99_999_999_999).mkdir(parents=True)
    folder.quarantine("shard-000007").mkdir(parents=True)
    tracemalloc.start()
    work = plan_work(dataset, None)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 10_000_000, "bytes"
    assert (work.left("shard"), work.left("sample"), work.done) == (10**14 - 1, 10**11 - 1, 1)
    with pytest.raises(InputError, match="of which at most"):
        generate(dataset, workers=1)
    assert not folder.dataset_json.exists()
    assert [task.number for task in plan_work(dataset, "99999999998-99999999999", shards="").missing] == [
        99_999_999_998
    ]
