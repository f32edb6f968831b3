"""The snippets of docs/reading-a-dataset.md run, in order, on a dataset where the page has it."""

import re
import shutil
from pathlib import Path

import pytest

from facegen.store import labels_reference

PAGE = Path(__file__).resolve().parents[2] / "docs" / "reading-a-dataset.md"
FILES, LABELS = PAGE.with_name("dataset-files.md"), PAGE.with_name("labels.md")
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE.read_text(encoding="utf-8"), flags=re.DOTALL)


@pytest.mark.blender
@pytest.mark.slow
def test_snippets_run_and_say_what_the_page_says(rendered, tmp_path, monkeypatch, capsys):
    pytest.importorskip("pandas")
    shutil.copytree(rendered.folder.path, tmp_path / "datasets" / "out" / "tiny")
    monkeypatch.chdir(tmp_path)
    names: dict = {}
    for snippet in SNIPPETS:
        exec(compile(snippet, str(PAGE), "exec"), names)
    assert names["weights"].shape == (30, 52)
    assert names["detected"].shape == names["exact"].shape == (30, 68, 2)
    assert names["in_head"].shape == (30, 68, 3)
    assert (names["layers"].depth == names["depth"]).all()
    assert names["visible"].any()
    said = capsys.readouterr().out
    assert "30 samples" in said
    assert "jawOpen is" in said
    assert re.search(r"the iris has [1-9][0-9]* pixels; skin is 0\.0[0-9]+ m away", said)
    assert (tmp_path / "datasets" / "out" / "packed" / "index.json").is_file()


@pytest.mark.blender
@pytest.mark.slow
def test_the_table_of_fields_names_every_field(rendered):
    record = rendered.sample(1)
    page = FILES.read_text(encoding="utf-8") + LABELS.read_text(encoding="utf-8")
    view = record["views"]["left_eye"]
    fields = {*record, *record["keypoints"], *record["eyes"]["left"], *record["headset"], *view}
    fields -= {"name", "rig", "headset", "eyes", "views"}  # said in words, or by what is below them
    missing = sorted(field for field in fields if not re.search(rf"`[\w.]*\b{field}`", page))
    assert not missing, f"docs/dataset-files.md and docs/labels.md say nothing of {missing}"


def test_the_page_of_labels_is_what_the_lists_say():
    assert LABELS.read_text(encoding="utf-8") == labels_reference(), (
        "run: facegen spec labels > docs/labels.md"
    )


def test_the_page_has_snippets():
    assert len(SNIPPETS) >= 8
