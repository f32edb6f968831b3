"""The Slurm job of docs/farm.md: its lines as they stand make as many tasks as the page says."""

import json
import re
import shlex
from pathlib import Path

from typer.testing import CliRunner

from facegen.cli import app
from facegen.rigs import rigs_folder
from facegen.spec import load_spec

ROOT = Path(__file__).resolve().parents[3]
PAGE = (ROOT / "docs" / "farm.md").read_text(encoding="utf-8")
BLOCK = re.search(r"^## Slurm\n.*?\n\n((?: {4}[^\n]*\n)+)", PAGE, re.M | re.S)[1].replace("\\\n", " ")
LINES = [shlex.split(line, comments=True) for line in BLOCK.splitlines()]


def line_of(*words: str) -> list[str]:
    """The words of the page's line that begins so."""
    (line,) = [line for line in LINES if tuple(line[: len(words)]) == words]
    return line


def edited_spec(folder: Path) -> Path:
    """The spec that the page's line of `sed` makes."""
    _, edit, source, arrow, name = line_of("sed")
    _, old, new, _ = edit.split("/")
    text, count = re.subn(old, new, (ROOT / source).read_text(encoding="utf-8"), flags=re.M)
    assert (arrow, count) == (">", 1)
    (folder / name).write_text(text, encoding="utf-8")
    return folder / name


def test_the_job_has_as_many_tasks_as_the_page_says(anny, tmp_path, monkeypatch):
    monkeypatch.setenv("FACEGEN_RIGS", str(rigs_folder().resolve()))
    spec = edited_spec(tmp_path)
    words = line_of("facegen", "farm", "submit")[1:]
    assert words[2] == spec.name
    words[2], words[words.index("--out") + 1] = str(spec), str(tmp_path / "faces")
    done = CliRunner().invoke(app, [*words, "--dry-run", "--json"])
    assert done.exit_code == 0, done.output
    chunks = json.loads((tmp_path / "faces" / "farm" / "job-001" / "job.json").read_text())["chunks"]
    pictures = [chunk for chunk in chunks if chunk["samples"]]
    said = re.search(r"array has (\d+) tasks: (\d+) of (\d+) samples, and (\d+) shards", PAGE)
    chunk = int(words[words.index("--chunk") + 1])
    assert [int(number) for number in said.groups()] == [
        len(chunks),
        len(pictures),
        chunk,
        len(chunks) - len(pictures),
    ]
    assert len(pictures) * chunk == 10_000


def test_the_job_renders_far_more_than_its_example_and_the_rig_is_built_before(tmp_path):
    assert load_spec(edited_spec(tmp_path)).render.samples == "0-9999"
    assert LINES.index(line_of("export")) < LINES.index(line_of("facegen", "rig", "build"))
    assert LINES.index(line_of("facegen", "rig", "build")) < LINES.index(line_of("facegen", "farm", "submit"))
