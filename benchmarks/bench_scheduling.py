"""What scheduling costs: samples without pictures in one process, by workers and by a Slurm array; and
how rendering grows with workers.

Run on an idle machine, from the repository: python benchmarks/bench_scheduling.py --samples 100000 --repeat 3
It prints its figures under a header with the machine and the versions. The array runs on a Slurm of its own
(Debian: slurmctld slurmd slurm-client munge) and is left out where there is none.

Result (2026-11-21, idle machine, 2 processors, AMD EPYC; bpy 4.5.15, NumPy 1.26.4; `--samples 100000 --pictures 20`):
100,000 samples without pictures take one worker 25.7 s, two 15.0 s (1.71x), a Slurm array of ten tasks, one a shard,
48.0 s: each task starts Python anew. 20 samples of three 128x128 views take one worker 57.4 s, two 30.1 s with starting
(1.91x), and 22.7 against 46.3 samples a minute once going (2.04x: alone, Blender's two threads share a processor);
medians of 3.
"""

import argparse
import json
import os
import platform
import statistics
import subprocess
import sys
import tempfile
import time
from importlib.metadata import version
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from tests.real_tools.slurm_sandbox import SlurmSandbox, missing_programs  # noqa: E402

KEYPOINTS = 'version = 1\nkind = "still"\nseed = 3\npeople = {people}\n[still]\nneutral = 1\nfaces = 4\n'
PICTURES = (
    KEYPOINTS.format(people=20)
    + '[render]\nheadset = "tracking3"\nsamples = "0-{last}"\nsize_px = {size}\nsamples_per_pixel = 4\n'
)


def facegen(*arguments: object, cpus: set[int] | None = None, environ: dict | None = None) -> float:
    """Seconds of a facegen command, on some processors only."""
    environ = dict(os.environ if environ is None else environ) | {"PYTHONPATH": str(ROOT)}
    started = time.perf_counter()
    subprocess.run(
        [sys.executable, "-m", "facegen", *map(str, arguments)],
        check=True,
        env=environ,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        preexec_fn=(lambda: os.sched_setaffinity(0, cpus)) if cpus else None,
    )
    return time.perf_counter() - started


def header() -> str:
    """The machine and the versions that the figures belong to."""
    info = Path("/proc/cpuinfo").read_text().splitlines()
    cpu = next((line.split(":")[1].strip() for line in info if line.startswith("model name")), "unknown")
    packages = ", ".join(f"{name} {version(name)}" for name in ("bpy", "numpy", "pyarrow"))
    return (
        f"# {len(os.sched_getaffinity(0))} processors ({cpu}), {platform.platform()}, Python "
        f"{platform.python_version()}, {packages}; load before: {os.getloadavg()[0]:.1f}"
    )


def keypoints(folder: Path, samples: int) -> dict[str, float]:
    """Seconds for samples without pictures: one worker, two, and an array of eight tasks."""
    spec = folder / "keypoints.toml"
    spec.write_text(KEYPOINTS.format(people=samples // 5))
    seconds = {}
    for workers in (1, 2):
        cpus = {min(os.sched_getaffinity(0))} if workers == 1 else None
        seconds[f"{workers} workers"] = facegen(
            "generate", spec, "--out", folder / f"w{workers}", "--workers", workers, cpus=cpus
        )
    if not missing_programs():
        with SlurmSandbox() as slurm:
            command = ("farm", "submit", spec, "--out", folder / "array", "--engine", "slurm", "--wait")
            setup = ("--env-setup", f"export PYTHONPATH={ROOT}")
            seconds["Slurm array"] = facegen(*command, *setup, environ=slurm.environ)
    return seconds


def pictures(folder: Path, repeat: int, count: int, size: int) -> dict[str, list[dict[str, float]]]:
    """Rendered samples by one single-threaded worker, and by two: whole seconds, and samples a second once going."""
    spec = folder / "pictures.toml"
    spec.write_text(PICTURES.format(last=count - 1, size=size))
    found: dict[str, list[dict[str, float]]] = {"1 worker": [], "2 workers": []}
    for round_ in range(repeat):
        for workers, name in ((1, "1 worker"), (2, "2 workers")):
            cpus = {min(os.sched_getaffinity(0))} if workers == 1 else None
            out = folder / f"p{workers}-{round_}"
            seconds = facegen("generate", spec, "--out", out, "--workers", workers, cpus=cpus)
            found[name].append({"seconds": seconds, "rate": steady_rate(out, after=2 * workers)})
    return found


def steady_rate(out: Path, *, after: int) -> float:
    """Samples a second from the end of the ``after``-th picture on, when every worker has started and compiled."""
    lines = [line for log in (out / "logs").glob("run-*.jsonl") for line in log.read_text().splitlines()]
    attempts = [json.loads(line) for line in lines]
    ends = sorted(attempt["ended"] for attempt in attempts if attempt["task"].startswith("sample"))[
        after - 1 :
    ]
    return (len(ends) - 1) / (ends[-1] - ends[0])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=100_000, help="samples without pictures")
    parser.add_argument("--pictures", type=int, default=40, help="rendered samples")
    parser.add_argument("--size", type=int, default=128, help="pixels of a picture's side")
    parser.add_argument("--repeat", type=int, default=3)
    arguments = parser.parse_args()
    print(header())
    with tempfile.TemporaryDirectory() as folder:
        alone = None
        for name, seconds in keypoints(Path(folder), arguments.samples).items():
            alone = alone or seconds
            rate = arguments.samples / seconds
            print(
                f"{arguments.samples} samples, {name}: {seconds:.1f} s, {rate:.0f}/s, {alone / seconds:.2f}x"
            )
        found = pictures(Path(folder), arguments.repeat, arguments.pictures, arguments.size)
        medians = {
            name: {key: statistics.median(run[key] for run in runs) for key in runs[0]}
            for name, runs in found.items()
        }
        alone = medians["1 worker"]
        for name, median in medians.items():
            print(
                f"{arguments.pictures} rendered samples, {name}: {median['seconds']:.1f} s with starting "
                f"({alone['seconds'] / median['seconds']:.2f}x), then {60 * median['rate']:.1f} samples a minute "
                f"({median['rate'] / alone['rate']:.2f}x); medians of {arguments.repeat}"
            )
        print(json.dumps(found))


if __name__ == "__main__":
    main()
