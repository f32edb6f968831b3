"""What keypoint faces without pictures cost: seconds, rate and memory of `facegen generate` for 10^4 faces and more,
and the share of each stage.

    python benchmarks/bench_keypoints.py [--million] [--rig anny] [--workers N] [--json]

Run it on an idle machine, from the repository; other work shows as processor seconds below workers x seconds, and slows
those, too. The largest process's memory is the bound for a worker: it makes one shard of 10,000 faces after another.

Result (2026-11-21, idle machine, 2 processors, AMD EPYC; Python 3.11.7, NumPy 1.26.4, Numba 0.68.1, pyarrow 22.0.0):
10^6 faces in 153 s, 6,549 a second, 299 processor seconds, 462 MB in the largest process (449 MB for 10^5, 445 MB for
10^4). Evaluating is 43 %, visibility 34 %, drawing 7 %, writing 6 %: the processors are the bound. Each process starts
for about 2 processor seconds, which 10^4 faces feel (7.8 s, 780 us a face). It was 114 s with a coarser mesh to hide
landmarks; a face's own share of that is 258 us of processor instead of 227 (both trees in turns, same day).
"""

import argparse
import json
import os
import platform
import resource
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from importlib.metadata import version
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")
ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from facegen.conventions import BLOCK  # noqa: E402
from facegen.geometry import apply_transform  # noqa: E402
from facegen.labels import label_keypoints  # noqa: E402
from facegen.labels.keypoints import AT_ONCE, KEYPOINT_TOLERANCE_M  # noqa: E402
from facegen.raster import hidden_by_own  # noqa: E402
from facegen.rigs import evaluate, occluder  # noqa: E402
from facegen.sampling import draw_samples  # noqa: E402
from facegen.spec import load_spec  # noqa: E402
from facegen.store import keypoint_table, resolve, write_shard  # noqa: E402

SPEC = 'version = 1\nkind = "still"\nseed = 9\npeople = {people}\nrig = "{rig}"\n[still]\nneutral = 1\nfaces = 9\n'
"""Ten faces a person, as in datasets/default.toml; everything else as it comes."""


def header() -> str:
    """The machine and the versions that the figures belong to."""
    info = Path("/proc/cpuinfo").read_text().splitlines()
    cpu = next((line.split(":")[1].strip() for line in info if line.startswith("model name")), "unknown")
    packages = ", ".join(f"{name} {version(name)}" for name in ("numpy", "numba", "pyarrow"))
    return (
        f"{len(os.sched_getaffinity(0))} processors ({cpu}), {platform.platform()}, Python "
        f"{platform.python_version()}, {packages}; load before: {os.getloadavg()[0]:.1f}"
    )


def written_spec(folder: Path, faces: int, rig: str) -> Path:
    """A spec of that many faces."""
    path = folder / f"{faces}.toml"
    path.write_text(SPEC.format(people=faces // 10, rig=rig))
    return path


def whole_run(folder: Path, faces: int, rig: str, workers: int) -> dict[str, float]:
    """`facegen generate` as a user runs it, from its start to its end."""
    spec = written_spec(folder, faces, rig)
    command = [
        sys.executable,
        "-m",
        "facegen",
        "generate",
        spec,
        "--out",
        folder / "out",
        "--workers",
        workers,
    ]
    environ = dict(os.environ) | {"PYTHONPATH": str(ROOT)}
    before, started = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run([*map(str, command)], check=True, env=environ, capture_output=True)
    seconds = time.perf_counter() - started
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    shards = list((folder / "out" / "keypoints").iterdir())
    size = sum(shard.stat().st_size for shard in shards)
    shutil.rmtree(folder / "out")
    return {
        "faces": faces,
        "seconds": seconds,
        "processor_seconds": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime,
        "largest_process_mb": after.ru_maxrss / 1e3,
        "bytes_a_face": size / faces,
    }


def stages(folder: Path, rig: str, rounds: int = 3) -> dict[str, float]:
    """Processor microseconds a face of each stage, in this process: the least of some blocks."""
    dataset = resolve(load_spec(written_spec(folder, 10**6, rig)), folder / "none")
    spec, rig = dataset.spec, dataset.rig
    best: dict[str, float] = {}

    def timed(name: str, action: Callable[[], object], faces: int) -> object:
        started = time.process_time()
        result = action()
        spent = (time.process_time() - started) / faces * 1e6
        best[name] = min(spent, best.get(name, spent))
        return result

    for block in range(rounds + 1):
        if block == 1:
            best.clear()  # the first block compiled, and filled caches
        samples = timed("drawing", lambda b=block: draw_samples(dataset.plan, rig, b), BLOCK)
        for start in range(0, BLOCK, AT_ONCE):
            some = samples.rows(slice(start, start + AT_ONCE))
            inputs = some.identity, some.weights, some.gaze
            faces = timed("evaluating", lambda i=inputs: evaluate(rig, *i, cage_only=True), AT_ONCE)
            points = apply_transform(some.camera_from_head, faces.landmarks)
            mesh = faces.vertices, some.camera_from_head, occluder(rig).faces
            timed(
                "visibility",
                lambda p=points, m=mesh: hidden_by_own(p, *m, tolerance_m=KEYPOINT_TOLERANCE_M),
                AT_ONCE,
            )
        keypoints = timed("labels", lambda s=samples: label_keypoints(spec, rig, s), BLOCK)
        table = timed("table", lambda s=samples, k=keypoints: keypoint_table(spec, s, k), BLOCK)
        timed("writing", lambda t=table: write_shard(t, folder / "shard.parquet"), BLOCK)
    best["other labels"] = max(0.0, best.pop("labels") - best["evaluating"] - best["visibility"])
    return best


def main() -> None:
    """Print the figures."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--million", action="store_true", help="also 10^6 faces")
    parser.add_argument("--rig", default="anny")
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    sizes = [10**4, 10**5] + [10**6] * arguments.million
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(temporary)
        shares = stages(folder, arguments.rig)
        runs = [whole_run(folder, faces, arguments.rig, arguments.workers) for faces in sizes]
    if arguments.json:
        print(json.dumps({"machine": header(), "runs": runs, "stages_us": shares}))
        return
    print(f"{header()}; rig {arguments.rig}, {arguments.workers} workers")
    for run in runs:
        faces, seconds, processor_s = run["faces"], run["seconds"], run["processor_seconds"]
        print(
            f"{faces:9,} faces: {seconds:7.1f} s, {faces / seconds:7,.0f} a second; {processor_s:6.1f} processor "
            f"seconds, {processor_s / faces * 1e6:5.0f} us a face; largest process "
            f"{run['largest_process_mb']:.0f} MB; {run['bytes_a_face']:,.0f} bytes a face"
        )
    total = sum(shares.values())
    print(f"one process, {total:.0f} us of processor a face:")
    for name, spent in sorted(shares.items(), key=lambda item: -item[1]):
        print(f"  {name:14} {spent:6.1f} us  {spent / total:4.0%}")
    print(
        f"bound by: {max(shares, key=shares.get)}, on the processors; disk and start-up are the rest of the seconds"
    )


if __name__ == "__main__":
    main()
