"""Makes shards and rendered samples, each committed by one rename."""

import dataclasses
import hashlib
import importlib.metadata
from collections.abc import Callable
from pathlib import Path

import pyarrow as pa

from facegen.conventions import BLOCK
from facegen.labels import RenderedSample, label_rendered, with_glints
from facegen.randomness import stream
from facegen.sampling import Samples
from facegen.sensor import develop_view
from facegen.sessions import draw_sample_scene
from facegen.store import (
    Dataset,
    commit_file,
    commit_folder,
    draw_block,
    label_block,
    png_bytes,
    sample_record,
    shard_samples,
    staging,
    write_exr,
    write_json,
    write_shard,
)
from facegen.work.tasks import Task


class Worker:
    """Makes the tasks of one dataset; Blender is started by the first picture and kept.

    Parameters
    ----------
    dataset
        What to make.
    threads
        Threads for Blender.
    """

    def __init__(self, dataset: Dataset, *, threads: int) -> None:
        self.dataset = dataset
        self.threads = threads
        self._renderer = None
        self._block: tuple[int, dict[str, Samples]] | None = None

    def make(self, task: Task, on_phase: Callable[[str], None] = lambda phase: None) -> int:
        """Make one task and let it appear under its name; returns the bytes written.

        ``on_phase`` is called with a word before each part of the work, as a sign of life.
        """
        make = self._make_shard if task.kind == "shard" else self._make_sample
        return make(task.number, on_phase)

    def _drawn(self, block: int) -> dict[str, Samples]:
        """A block as each rig shows it."""
        if self._block is None or self._block[0] != block:
            self._block = block, draw_block(self.dataset, block)
        return self._block[1]

    def _make_shard(self, number: int, on_phase: Callable[[str], None]) -> int:
        dataset = self.dataset
        rows = shard_samples(number, total=dataset.plan.samples)
        tables = []
        for block in range(rows.start // BLOCK, -(-rows.stop // BLOCK)):
            on_phase(f"block {block}")
            tables.append(label_block(dataset, block, self._drawn(block)))
        with staging(dataset.folder, f"shard-{number}") as stage:
            path = stage / "shard.parquet"
            write_shard(pa.concat_tables(tables).combine_chunks(), path)
            size = path.stat().st_size
            commit_file(path, dataset.folder.shard(number))
        return size

    def _make_sample(self, number: int, on_phase: Callable[[str], None]) -> int:
        dataset = self.dataset
        on_phase("draw")
        rig = dataset.rig_of(number)
        rendered = label_sample(dataset, number, self._drawn(number // BLOCK)[rig.name])
        record = sample_record(rendered, dataset_hash=dataset.hash, rig=rig.name)
        # each file is written once, where it is renamed from: on a shared disk all bytes of a farm cross one line
        with staging(dataset.folder, f"sample-{number}") as stage:
            self._write_pictures(rendered, stage, on_phase)
            record["render"] = {
                "engine": "cycles",
                "blender": importlib.metadata.version("bpy"),
                "device": str(self._renderer.device),
                "samples_per_pixel": dataset.spec.render.samples_per_pixel,
                "denoise": dataset.spec.render.denoise,
                "subsurface": dataset.spec.render.subsurface,
            }
            record["sha256"] = {path.name: _sha256(path) for path in stage.iterdir()}
            write_json(stage / "sample.json", record)
            size = sum(file.stat().st_size for file in stage.iterdir())
            commit_folder(stage, dataset.folder.render(number))
        return size

    def _write_pictures(
        self, rendered: RenderedSample, folder: Path, on_phase: Callable[[str], None]
    ) -> None:
        from facegen.blender import open_renderer  # starting Blender costs 250 MB that shards do not need

        settings = self.dataset.spec.render
        if self._renderer is None:
            on_phase("start Blender")
            self._renderer = open_renderer(threads=self.threads, subsurface=settings.subsurface)
        sample = rendered.sample
        for view in sample.scene.views:
            on_phase(f"render {view.name}")
            render = self._renderer.render if settings.truth else self._renderer.glimpse
            layers = render(
                sample.scene,
                view.name,
                samples=settings.samples_per_pixel,
                seed=draw_render_seed(self.dataset.spec.seed, view.name, int(sample.row.sample[0])),
                denoise=settings.denoise,
            )
            glints = rendered.views[view.name].glints
            layers = dataclasses.replace(layers, radiance=with_glints(layers.radiance, glints))
            grey = develop_view(
                layers,
                sample.session.unit.camera(view.name),
                view.camera_from_head,
                sample.session.unit.sensor,
                sample.shots[view.name],
            )
            (folder / f"{view.name}.png").write_bytes(png_bytes(grey))
            if settings.truth:
                write_exr(layers, folder / f"{view.name}.exr")


def _sha256(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def draw_render_seed(seed: int, view: str, sample: int) -> int:
    """Seed of the renderer's noise in one view of a sample."""
    return int(stream(seed, f"render/{view}", sample).integers(1, 2**31 - 1))


def label_sample(dataset: Dataset, number: int, block: Samples) -> RenderedSample:
    """Scene and labels of one sample out of its block, drawn on its person's rig."""
    row, rig = block.rows(slice(number % BLOCK, number % BLOCK + 1)), dataset.rig_of(number)
    return label_rendered(dataset.spec, rig, draw_sample_scene(dataset.spec, rig, dataset.headset, row))
