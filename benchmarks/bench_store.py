"""Measures what a sample costs: processor seconds and bytes to make, check, pack and merge it, and 10^6 of them.

    python benchmarks/bench_store.py [--samples 12] [--size 256] [--json]

Everything runs in this process. Processor seconds are those of all its threads: Blender has two even for one
worker, and threads that wait for each other on a busy machine count: figures get up to twice as large.
docs/planning-a-farm-job.md holds the figures of one run.
"""

import argparse
import json
import os
import shutil
import statistics
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

from facegen.conventions import SHARD_ROWS
from facegen.packing import Options, plan_pack, write_pack
from facegen.spec import load_spec
from facegen.store import Dataset, begin, merge, resolve
from facegen.validation import check_renders, check_shard
from facegen.work.tasks import Task
from facegen.work.worker import Worker

ROOT = Path(__file__).resolve().parents[1]
MILLION = 10**6


def timed(action: Callable[[], object]) -> float:
    """Processor seconds of an action, all threads of this process."""
    started = time.process_time()
    action()
    return time.process_time() - started


def size_of(folder: Path, pattern: str) -> int:
    """Bytes of the files that match."""
    return sum(path.stat().st_size for path in folder.rglob(pattern) if path.is_file())


def prepared(out: Path, size_px: int) -> Dataset:
    """``datasets/default.toml`` with another picture size, begun."""
    text = (ROOT / "datasets" / "default.toml").read_text().replace("size_px = 256", f"size_px = {size_px}")
    (out / "spec.toml").write_text(text)
    dataset = resolve(load_spec(out / "spec.toml"), out / "dataset")
    begin(dataset)
    return dataset


def measure(samples: int, size_px: int) -> dict[str, float]:
    """All figures, a sample each unless the name says otherwise."""
    with tempfile.TemporaryDirectory() as temporary:
        out = Path(temporary)
        dataset = prepared(out, size_px)
        worker = Worker(dataset, threads=1)
        shard_s = timed(lambda: worker.make(Task("shard", 0)))
        first_s = timed(lambda: worker.make(Task("sample", 0)))  # starts Blender
        renders = [timed(lambda n=n: worker.make(Task("sample", n))) for n in range(1, samples)]
        folder, numbers = dataset.folder.path, tuple(range(samples))
        figures = {
            "keypoints core-s": shard_s / SHARD_ROWS,
            "keypoints bytes": size_of(folder / "keypoints", "*.parquet") / SHARD_ROWS,
            "render core-s (median)": statistics.median(renders),
            "render core-s (largest)": max(renders),
            "first render, starts Blender, s": first_s,
            "render files": len(list(dataset.folder.render(0).iterdir())),
        }
        for name in ("*.png", "*.exr", "sample.json", "*.*"):
            figures[f"render bytes {name}"] = size_of(folder / "renders", name) / samples
        figures["validate keypoints core-s"] = timed(lambda: list(check_shard(dataset, 0))) / SHARD_ROWS
        figures["validate render core-s"] = timed(lambda: list(check_renders(dataset, numbers))) / samples
        chosen = f"0-{samples - 1}"
        for name, options in {
            "webdataset": Options(samples=chosen),
            "webdataset --no-exr": Options(samples=chosen, exr=False),
            "parquet": Options(samples=chosen),
        }.items():
            target = out / name.replace(" ", "")
            plan = plan_pack(dataset, name.split()[0], options)
            figures[f"pack {name} core-s"] = timed(lambda p=plan, t=target: write_pack(p, t)) / samples
            figures[f"pack {name} bytes"] = size_of(target, "shard-*") / samples
        figures["merge core-s"] = timed(lambda: merge([folder], out / "merged")) / (samples + 1)
        shutil.rmtree(out / "merged")
    return figures


def main() -> None:
    """Print the figures, and what a million samples come to."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=12)
    parser.add_argument("--size", type=int, default=256)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    figures = measure(arguments.samples, arguments.size)
    if arguments.json:
        print(json.dumps(figures))
        return
    print(f"{arguments.samples} samples of {arguments.size} px, one worker; a million samples on the right")
    for name, value in figures.items():
        if "bytes" in name:
            print(f"{name:34} {value:12,.0f} B  {value * MILLION / 1e12:9.4f} TB")
        elif name.endswith(" s"):
            print(f"{name:34} {value:12.4f} s")
        elif "core-s" in name:
            print(f"{name:34} {value:12.4f} s  {value * MILLION / 3600:9,.1f} core-hours")
        else:
            print(f"{name:34} {value:12.0f}")


if __name__ == "__main__":
    main()
