"""A worker writes each file of a sample once: on a shared disk all bytes of a farm cross one line."""

import hashlib
import tempfile

import numpy as np

from facegen.scene import Layers
from facegen.spec import parse_spec
from facegen.store import begin, read_exr, resolve
from facegen.work.tasks import Task
from facegen.work.worker import Worker

SIZE_PX = 24
SPEC = {
    "version": 1,
    "kind": "still",
    "seed": 3,
    "people": 1,
    "render": {"headset": "tracking3", "samples": "0", "size_px": SIZE_PX},
}


class Flat:
    """Stands for Blender: every picture is one grey wall."""

    device = "cpu"

    def render(self, *_scene, **_settings) -> Layers:
        shape = (SIZE_PX, SIZE_PX)
        flat = np.full(shape, 0.5, np.float32)
        return Layers(
            radiance=flat,
            depth=flat,
            normal=np.zeros((*shape, 3), np.float32),
            part=np.ones(shape, np.uint8),
            uv=np.zeros((*shape, 2), np.float32),
        )


def test_files_are_written_where_they_are_renamed_from_and_nowhere_else(anny, tmp_path, monkeypatch):
    dataset = resolve(parse_spec(SPEC, where="test"), tmp_path / "out")
    begin(dataset)
    worker = Worker(dataset, threads=1)
    worker._renderer = Flat()
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path / "no such folder"))
    size = worker.make(Task("sample", 0))
    folder, record = dataset.folder.render(0), dataset.sample(0)
    assert size == sum(path.stat().st_size for path in folder.iterdir())
    assert record["sha256"] == {
        path.name: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.iterdir()
        if path.name != "sample.json"
    }
    assert len(record["sha256"]) == 2 * len(dataset.headset.camera_names)
    assert (read_exr(folder / "mouth.exr").depth == 0.5).all()
    assert not list((tmp_path / "out" / "tmp").iterdir())
