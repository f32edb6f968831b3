"""Datasets and packs of Parquet carry a card and Croissant metadata: both open without a script."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import SPLITS
from facegen.packing import Options, plan_pack, write_pack
from facegen.store import read_png

pytestmark = [pytest.mark.blender, pytest.mark.slow]

OPENED = """
import json, sys
import datasets
import mlcroissant

folder, column = sys.argv[1:]
opened = datasets.load_dataset(folder)
card = mlcroissant.Dataset(folder + "/croissant.json")
said = {
    "splits": {name: list(rows["sample"]) for name, rows in opened.items()},
    "numbers": {name: list(rows[column]) for name, rows in opened.items()},
    "pictures": [getattr(rows[0].get("left_eye"), "size", None) for rows in opened.values()],
    "records": [[r["samples/sample"], list(map(float, r["samples/" + column]))] for r in card.records("samples")],
    "warnings": list(card.metadata.issues.warnings),
}
print(json.dumps(said))
"""
"""In a process of its own: both libraries warn on import."""


FOLDER_OPENED = """
import json, sys
import datasets
import mlcroissant

folder = sys.argv[1]
opened = datasets.load_dataset(folder)
card = mlcroissant.Dataset(folder + "/croissant.json")
trained = datasets.load_dataset(folder, split="samples", filters=[("split", "==", "train")])
pictures = list(card.records("left_eye_pictures"))
grey_of = {p["left_eye_pictures/sample"]: p["left_eye_pictures/picture"].convert("L") for p in pictures}
records = list(card.records("rendered"))
said = {
    "splits": {name: list(rows["sample"]) for name, rows in opened.items()},
    "train": list(trained["sample"]),
    "records": [[r["samples/sample"], list(map(float, r["samples/weights"]))] for r in card.records("samples")],
    "pictures": {number: list(picture.tobytes()) for number, picture in grey_of.items()},
    "labels": {r["rendered/sample"]: json.loads(r["rendered/record"])["sample"] for r in records},
    "warnings": list(card.metadata.issues.warnings),
}
print(json.dumps(said))
"""

LIBRARIES = ("datasets==5.2.0", "mlcroissant==1.1.1", "pillow")
"""In an environment of their own: they want a pyarrow and an fsspec beyond what Blender's NumPy and PyTorch allow."""

LEFT = "import os\nsys.stdout.flush()\nos._exit(0)\n"
"""Behind a program that has said all: threads of libraries may outlive it, and C++ then aborts (seen once in CI)."""


@pytest.fixture(scope="module")
def python(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("libraries")
    subprocess.run([sys.executable, "-m", "venv", "--without-pip", folder], check=True)
    pip = [sys.executable, "-m", "pip", "--python", folder / "bin" / "python"]
    install = [*pip, "install", "--quiet", "--no-compile", *LIBRARIES]
    done = subprocess.run(install, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip(f"{' '.join(LIBRARIES)} cannot be installed here: {done.stderr.strip().splitlines()[-1]}")
    return folder / "bin" / "python"


def opened(python: Path, folder: Path, *, program: str, words: tuple[str, ...] = ()) -> dict:
    # clean of PYTHONPATH, which may name an environment with other versions
    home = {
        "PYTHONPATH": "",
        "HF_HOME": str(folder.parent / "home"),
        "HF_HUB_OFFLINE": "1",
        "HOME": str(folder.parent),
    }
    done = subprocess.run(
        [python, "-W", "ignore", "-c", program + LEFT, str(folder), *words],
        env={**os.environ, **home},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


@pytest.mark.parametrize("name", ["keypoints", "parquet"])
def test_a_pack_opens_by_its_card_and_by_its_croissant_metadata(
    rendered, python: Path, tmp_path: Path, name: str
):
    plan = plan_pack(rendered, name, Options(shard_size=7))
    write_pack(plan, tmp_path / "pack")
    table = rendered.keypoints()
    split_of = dict(zip(table["sample"].to_pylist(), table["split"].to_pylist(), strict=True))
    weights = dict(zip(table["sample"].to_pylist(), table["weights"].to_pylist(), strict=True))
    said = opened(python, tmp_path / "pack", program=OPENED, words=("weights",))
    expected = {split: [s for s in plan.samples if split_of[s] == split] for split in SPLITS}
    assert said["splits"] == {split: samples for split, samples in expected.items() if samples}
    for split, rows in said["numbers"].items():
        np.testing.assert_allclose(rows, [weights[sample] for sample in expected[split]], atol=1e-7)
    assert sorted(sample for sample, _ in said["records"]) == sorted(plan.samples)
    for sample, row in said["records"]:
        np.testing.assert_allclose(row, weights[sample], atol=1e-7)
    camera = rendered.headset.camera("left_eye").camera
    size = [camera.width, camera.height] if name == "parquet" else None
    assert said["pictures"] == [size] * len(said["pictures"])
    # a date of publication would make equal packs differ
    assert [text for text in said["warnings"] if "datePublished" not in text] == []


def test_a_rendered_folder_opens_by_its_card_and_by_its_croissant_metadata(
    rendered, python: Path, tmp_path: Path
):
    folder = shutil.copytree(rendered.folder.path, tmp_path / "folder")
    table = rendered.keypoints()
    samples, splits = table["sample"].to_pylist(), table["split"].to_pylist()
    said = opened(python, folder, program=FOLDER_OPENED)
    assert said["splits"] == {"samples": samples}
    train = [sample for sample, split in zip(samples, splits, strict=True) if split == "train"]
    assert said["train"] == train
    assert 0 < len(train) < len(samples)
    assert [sample for sample, _ in said["records"]] == samples
    np.testing.assert_allclose([row for _, row in said["records"]], table["weights"].to_pylist(), atol=1e-7)
    numbers = rendered.folder.rendered()
    assert said["labels"] == {str(number): number for number in numbers}
    assert sorted(map(int, said["pictures"])) == numbers
    for number in numbers:
        grey = read_png(rendered.folder.render(number) / "left_eye.png")
        assert said["pictures"][str(number)] == grey.ravel().tolist()
    assert [text for text in said["warnings"] if "datePublished" not in text] == []


def test_the_card_states_licence_counts_and_how_it_was_made(rendered, tmp_path: Path):
    plan = plan_pack(rendered, "keypoints")
    write_pack(plan, tmp_path / "pack")
    card = (tmp_path / "pack" / "README.md").read_text()
    front = card.split("---\n")[1]
    assert "license: cc0-1.0" in front
    assert f"{len(plan.samples):,} samples" in card
    assert rendered.hash in card
    assert rendered.licence in card
    for field in rendered.keypoint_schema:
        assert f"| `{field.name}` |" in card
