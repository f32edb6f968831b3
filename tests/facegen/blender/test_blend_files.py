"""A .blend file opened by another process renders what the dataset's renderer renders."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from facegen.cli.blend import blend
from facegen.errors import InputError

ROOT = Path(__file__).resolve().parents[3]
SPEC = """
version = 1
kind = "still"
seed = 3
people = 2
[render]
size_px = 32
samples_per_pixel = 2
"""
OPEN_AND_COMPARE = """
import json, sys
from pathlib import Path
import numpy as np
from facegen.blender import open_renderer
from facegen.blender.runtime import import_bpy, quiet_stdout
from facegen.sampling import draw_samples
from facegen.spec import load_spec
from facegen.store import resolve
from facegen.work.worker import draw_render_seed, label_sample

bpy = import_bpy()
with quiet_stdout():
    bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
from facegen.blender.passes import passes_of_renders

with passes_of_renders() as passes, quiet_stdout():
    bpy.ops.render.render()
opened = passes["Combined"][..., 0].copy()
said = {
    "cameras": sorted(o.name for o in bpy.data.objects if o.type == "CAMERA"),
    "active": bpy.context.scene.camera.name,
    "missing": [image.filepath for image in bpy.data.images if image.source == "FILE" and not image.packed_file],
    "libraries": len(bpy.data.libraries),
    "texts": [text.name for text in bpy.data.texts],
    "licences": bpy.data.texts["LICENSE.txt"].as_string(),
}
dataset = resolve(load_spec(sys.argv[2]), sys.argv[3])
made = label_sample(dataset, 1, draw_samples(dataset.plan, dataset.rig, 0))
layers = open_renderer().render(made.sample.scene, "mouth", samples=2, seed=draw_render_seed(3, "mouth", 1))
said["difference"] = float(np.abs(opened - layers.radiance).max())
said["brightest"] = float(layers.radiance.max())
print(json.dumps(said))
"""


def run(*arguments: object) -> str:
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    result = subprocess.run(
        [sys.executable, *map(str, arguments)], capture_output=True, text=True, cwd=ROOT, env=environment
    )
    assert result.returncode == 0, result.stderr
    return result.stdout


@pytest.mark.blender
@pytest.mark.slow
def test_an_opened_file_renders_the_same_radiance(anny, tmp_path):
    spec, file = tmp_path / "spec.toml", tmp_path / "sample.blend"
    spec.write_text(SPEC)
    said = run("-m", "facegen", "blend", spec, "--sample", 1, "--view", "mouth", "--out", file)
    assert said.strip() == str(file)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["sample.blend", "spec.toml"]
    found = json.loads(run("-c", OPEN_AND_COMPARE, file, spec, tmp_path).splitlines()[-1])
    assert found["cameras"] == ["left_eye", "mouth", "right_eye"]
    assert found["active"] == "mouth"
    assert (found["missing"], found["libraries"], found["texts"]) == ([], 0, ["lens.osl", "LICENSE.txt"])
    assert "MakeHuman" in found["licences"]
    assert "CC0-1.0" in found["licences"]
    assert found["brightest"] > 0.1
    assert found["difference"] < 1e-3 * found["brightest"], "16-bit floats hold three digits"


def test_unknown_cameras_and_samples_are_refused_and_leave_nothing(anny, tmp_path):
    spec = tmp_path / "spec.toml"
    spec.write_text(SPEC)
    with pytest.raises(
        InputError, match="headset 'tracking3' has no camera 'nose'; it has left_eye, right_eye, mouth"
    ):
        blend(spec, 1, tmp_path / "a.blend", "nose")
    with pytest.raises(InputError, match="sample 99 does not exist; this dataset has samples 0-19"):
        blend(spec, 99, tmp_path / "a.blend")
    assert [p.name for p in tmp_path.iterdir()] == ["spec.toml"]


@pytest.mark.blender
@pytest.mark.slow
def test_a_disk_that_is_full_is_said_to_be(tmp_path, anny):
    """A limit on the size of files stands for the disk; what lay under the name stays."""
    (tmp_path / "spec.toml").write_text(SPEC)
    (tmp_path / "scene.blend").write_text("old")
    limited = "import resource, runpy; resource.setrlimit(resource.RLIMIT_FSIZE, (20_000, 20_000)); "
    command = [sys.executable, "-c", limited + "runpy.run_module('facegen', run_name='__main__')"]
    arguments = ["blend", tmp_path / "spec.toml", "--sample", "1", "--out", tmp_path / "scene.blend"]
    done = subprocess.run([*command, *map(str, arguments)], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 74, done.stderr
    assert done.stderr.startswith(f"facegen: {tmp_path / 'scene.blend'}: cannot be written")
    assert done.stderr.count("\n") == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["scene.blend", "spec.toml"]
    assert (tmp_path / "scene.blend").read_text() == "old"
