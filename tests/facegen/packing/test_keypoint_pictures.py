"""The example of docs/keypoint-pictures.md: its camera sees whole faces, and its code reads what its commands make."""

import re
import shlex
import shutil
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.geometry import apply_transform, invert_transform, project
from facegen.headsets import head_from_headset, load_headset
from facegen.number_ranges import sample_numbers
from facegen.rigs import neutral_landmarks
from facegen.spec import load_spec

DOCS = Path(__file__).resolve().parents[3] / "docs"
EXAMPLES = DOCS / "examples"
PAGE = (DOCS / "keypoint-pictures.md").read_text(encoding="utf-8")
(SNIPPET,) = re.findall(r"```python\n(.*?)```", PAGE, flags=re.DOTALL)


def test_the_spec_renders_as_many_pictures_as_the_page_says():
    spec = load_spec(EXAMPLES / "keypoints.toml")
    total = spec.people * (spec.still.neutral + spec.still.faces)
    assert len(sample_numbers(spec.render.samples, total=total, where="render.samples")) == total == 10_000


def test_the_camera_sees_the_whole_face_in_nearly_every_pose(anny):
    headset = load_headset(EXAMPLES / "front.toml")
    (camera,) = headset.cameras
    face = neutral_landmarks(anny, np.zeros((1, anny.components)))[0]
    limits = headset.tolerances
    spread = np.array([*np.multiply(limits.slip_mm, 1e-3), *np.radians(limits.slip_deg)])
    draws = np.random.default_rng(5).standard_normal((400, 6)) * spread
    seen = []
    for slip in draws:
        camera_from_head = invert_transform(
            head_from_headset(headset, face[27], slip) @ camera.headset_from_camera
        )
        pixels = project(camera.camera, apply_transform(camera_from_head, face))
        seen.append(bool(((pixels > -0.5) & (pixels < (camera.width - 0.5, camera.height - 0.5))).all()))
    assert np.mean(seen) > 0.97


@pytest.mark.blender
@pytest.mark.slow
def test_what_the_commands_make_is_what_the_code_reads(anny, tmp_path, monkeypatch, capsys):
    pytest.importorskip("pycocotools.coco")
    monkeypatch.chdir(tmp_path)
    for name in ("front.toml", "keypoints.toml"):
        shutil.copy(EXAMPLES / name, name)
    small = Path("keypoints.toml").read_text(encoding="utf-8").replace("people = 1000", "people = 110")
    Path("keypoints.toml").write_text(small, encoding="utf-8")  # its keypoints take seconds otherwise
    tried = PAGE[PAGE.index("## Try it") : PAGE.index("## All 10,000")]
    lines = [line.strip() for line in tried.splitlines() if line.startswith("    facegen ")]
    assert len(lines) == 4
    for line in lines:
        words = shlex.split(line.replace("0-999:51", "0-102:51"), comments=True)[1:]
        done = CliRunner().invoke(app, words)
        assert done.exit_code == 0, (words, done.output, done.exception)
    exec(compile(SNIPPET, "keypoint-pictures.md", "exec"), names := {})
    assert len(names["labels"].anns) == 3
    assert names["picture"].size == (256, 256)
    assert len(names["keypoints"]) == 68
    assert {v for _, _, v in names["keypoints"].values()} >= {1, 2}
    assert "renders/000/000102/front.png (256, 256)" in capsys.readouterr().out
