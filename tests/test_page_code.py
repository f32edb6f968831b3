"""Python that a page shows runs, on small stand-ins of what it reads; a page with code and no test is told."""

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from threadpoolctl import threadpool_limits

from facegen.rigs import Rig
from facegen.spec import load_spec
from facegen.store import resolve, write_shard
from facegen.store.blocks import draw_block, label_block
from regress.runtime.ready_made import HEADSET, LANDMARKS, ready_made_models
from tests.samples import SAMPLES, rows

ROOT = Path(__file__).parents[1]

ELSEWHERE = {
    "docs/exports.md": "tests/regress/exporters/test_examples.py",
    "docs/keypoint-pictures.md": "tests/facegen/packing/test_keypoint_pictures.py",
    "docs/reading-a-dataset.md": "tests/facegen/test_reading_a_dataset.py",
    "docs/room-studies.md": "tests/room/test_studies.py",
}
"""Pages whose code runs in tests of their own."""


def snippets(page: str) -> list[str]:
    """Python of a page, block by block."""
    return re.findall(r"^```python\n(.*?)^```", (ROOT / page).read_text(encoding="utf-8"), flags=re.M | re.S)


def talking_face() -> np.ndarray:
    """The first two seconds of the sample's landmarks, (60, 68, 2)."""
    header, values = rows(SAMPLES / "talking-face.csv")
    first = header.index("x_0")
    return np.stack([values[:60, first : first + 68], values[:60, first + 68 : first + 136]], axis=-1)


def head_pose(names: dict[str, Any]) -> None:
    assert 0.2 < names["z"] < 2.0
    assert max(map(abs, (names["yaw"], names["pitch"], names["roll"]))) < 0.5


def motion(names: dict[str, Any]) -> None:
    sentence = names["sentence"]
    assert set(sentence["component"]) == {"sentence"}
    assert sentence["time_s"].min() == 0
    assert len(sentence) == 120


def training(names: dict[str, Any]) -> None:
    assert names["network"].score(names["x"], names["y"]) > 0.9
    assert names["network"].result_.outcomes[0].value.endswith(".")


def using_a_model(names: dict[str, Any]) -> None:
    assert names["weights"].shape == (60, 52)
    assert names["answer"].weights.shape == (52,)
    assert len(names["last"]) >= 1


def your_camera(names: dict[str, Any]) -> None:
    assert names["stream"] is not None


PAGES: dict[str, Callable[[dict[str, Any]], None]] = {
    "docs/head-pose.md": head_pose,
    "docs/motion.md": motion,
    "docs/training.md": training,
    "docs/using-a-model.md": using_a_model,
    "docs/your-camera.md": your_camera,
}
"""By page, what its names hold in the end."""


@pytest.fixture(scope="module")
def place(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with what the pages read: a take's points, the default model, a placement, a shard of the protocol."""
    folder = tmp_path_factory.mktemp("pages")
    for name in ("landmarks.npy", "points.npy"):
        np.save(folder / name, talking_face())
    shutil.copytree(ready_made_models()[LANDMARKS], folder / "models" / "default")
    (folder / "placement.toml").write_text(
        'version = 1\nmodel = "headset-tracking3"\n[cameras.left_eye]\nx = 0.45\ny = 0.5\nsize = 1.2\n'
    )
    made = folder / "datasets" / "out" / "protocol" / "keypoints"
    made.mkdir(parents=True)
    dataset = resolve(load_spec(ROOT / "datasets" / "protocol.toml"), folder / "none")
    for block in (6, 7):  # clip 77 lies across their edge
        write_shard(
            label_block(dataset, block, draw_block(dataset, block)), made / f"shard-{block:05d}.parquet"
        )
    return folder


@pytest.mark.parametrize("page", PAGES)
def test_code_of_a_page_runs(page: str, place: Path, monkeypatch: pytest.MonkeyPatch):
    pytest.importorskip("pandas")
    monkeypatch.chdir(place)
    names: dict[str, Any] = {}
    with threadpool_limits(limits=1, user_api="blas"):  # small products: more threads wait for each other
        for number, snippet in enumerate(snippets(page)):
            exec(compile(snippet, f"{page}, block {number + 1}", "exec"), names)
        PAGES[page](names)


def test_the_loop_of_headset_pictures_runs(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """The block of docs/exports.md that its own test has no export for."""
    (snippet,) = (each for each in snippets("docs/exports.md") if "HeadsetStream" in each)
    shutil.copytree(ready_made_models()[HEADSET], tmp_path / "models" / "headset")
    monkeypatch.chdir(tmp_path)
    take = {
        name: sorted((SAMPLES / "headset" / name).iterdir()) for name in ("left_eye", "right_eye", "mouth")
    }
    rest, talking = (
        {name: cv2.imread(str(paths[frame]), cv2.IMREAD_GRAYSCALE) for name, paths in take.items()}
        for frame in (0, 60)
    )
    names = {
        "neutral": rest,
        "left": talking["left_eye"],
        "right": talking["right_eye"],
        "mouth": talking["mouth"],
    }
    exec(snippet, names)
    assert names["answer"].weights.shape == (52,)
    assert names["answer"].faults == {}


def test_every_page_with_code_is_run():
    pages = [ROOT / "README.md", *(ROOT / "docs").glob("**/*.md")]
    found = {page.relative_to(ROOT).as_posix() for page in pages}
    assert {page for page in found if snippets(page)} == PAGES.keys() | ELSEWHERE.keys()
    for page, test in ELSEWHERE.items():
        assert Path(page).name in (ROOT / test).read_text(encoding="utf-8"), f"{test} says nothing of {page}"
