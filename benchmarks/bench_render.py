"""Measures CPU seconds of a headset picture: by size, paths, scattering and truth; all but path tracing; noise.

    python benchmarks/bench_render.py [datasets/headset.toml] [--samples 8] [--noise 256] [--resident 0]

A sample is everything that a worker does: scene and labels, all views, glints, sensor, files. CPU seconds of all
threads are counted; neighbours on the other thread of a core still make them longer. "outside" is the share of it
outside Cycles' own render calls; ``--samples 0`` leaves that table out. ``--noise PATHS`` renders a reference with so
many paths and says how near fewer come (PSNR in dB, 1 at the 99th percentile), and when a view reaches 33 dB (eyes) or
42 dB (others). ``--resident N`` makes N samples and says how the process's memory grows.

Result (2026-11-21, headset.toml, on two hardware threads of a busy machine, load 10):

| size | paths | scattering | truth | CPU s a sample | outside |
|---|---|---|---|---|---|
| 96 | 2 | False | False | 0.90 | 24% |
| 96 | 2 | False | True | 1.23 | 20% |
| 96 | 2 | True | False | 1.01 | 22% |
| 96 | 4 | False | False | 1.24 | 17% |
| 96 | 4 | True | True | 1.84 | 14% |

On 2026-11-22 (paper.toml, beside one other busy core) 256 px, 8 paths, scattering and truth cost 12.6 CPU s a sample,
4 % of it outside. 500 samples of headset.toml: 685 MB resident after 51, 700 after 251, 703 after 500. Noise of
paper.toml's sample 1 at 160 px against 1,024 paths, denoised like the rest:

| view | 8 paths | 16 paths | 32 paths | 64 paths | enough |
|---|---|---|---|---|---|
| left_eye | 30.8 dB, 2.0 s | 32.3 dB, 3.8 s | 33.9 dB, 7.3 s | | 33 dB: 5.0 s |
| right_eye | 28.1 dB, 1.9 s | 29.9 dB, 3.4 s | 31.4 dB, 6.8 s | 32.9 dB, 14.9 s | 33 dB: some 15 s |
| mouth | 37.4 dB, 1.6 s | 39.3 dB, 2.8 s | 40.8 dB, 5.6 s | 42.1 dB, 11.2 s | 42 dB: 10.4 s |

The denoiser's quick network on noisy guides ("FAST", "NONE") is no way to save: at 96 px, against 256 paths, it gives
28.6, 27.5 and 39.8 dB (left eye, right eye, mouth) with 4 paths for 1.11 CPU s, and 25.1, 24.7 and 36.5 dB with 2; the
usual one gives 28.7, 27.3 and 38.0 dB with 2 for 0.77 CPU s, and 30.5, 29.5 and 41.0 dB with 4. One diffuse bounce and
no glossy ones save less than the measurement's noise. Of a view's fixed cost, 0.08 CPU s, half builds the search tree,
a quarter compiles the lens's shader.
"""

import argparse
import dataclasses
import resource
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np

from facegen.blender import open_renderer
from facegen.blender.renderer import Renderer
from facegen.sampling import draw_samples
from facegen.spec import Spec, load_spec
from facegen.store import begin, resolve
from facegen.work.tasks import Task
from facegen.work.worker import Worker, label_sample

ROOT = Path(__file__).resolve().parents[1]
WAYS = (
    {"size_px": 96, "samples_per_pixel": 2, "subsurface": False, "truth": False},
    {"size_px": 96, "samples_per_pixel": 2, "subsurface": False, "truth": True},
    {"size_px": 96, "samples_per_pixel": 2, "subsurface": True, "truth": False},
    {"size_px": 96, "samples_per_pixel": 4, "subsurface": False, "truth": False},
    {"size_px": 96, "samples_per_pixel": 4, "subsurface": True, "truth": True},
    {"size_px": 256, "samples_per_pixel": 8, "subsurface": True, "truth": True},
)
PATHS = (1, 2, 4, 8, 16, 32, 64)
ENOUGH_DB = {"eye": 33.0, "other": 42.0}
TINY_PX = 16
"""A picture of this size with one path a pixel is all fixed cost."""


class Clock:
    """CPU seconds spent in wrapped functions."""

    def __init__(self) -> None:
        self.spent = 0.0

    def around(self, function: Callable) -> Callable:
        """The function, its time counted."""

        def timed(*args: object, **kwargs: object) -> object:
            start = time.process_time()
            try:
                return function(*args, **kwargs)
            finally:
                self.spent += time.process_time() - start

        return timed


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("spec", nargs="?", type=Path, default=ROOT / "datasets" / "headset.toml")
    parser.add_argument("--samples", type=int, default=8)
    parser.add_argument("--noise", type=int, default=0, metavar="PATHS")
    parser.add_argument("--resident", type=int, default=0, metavar="N")
    arguments = parser.parse_args()
    spec = load_spec(arguments.spec)
    if arguments.samples:
        print_costs(spec, arguments.samples)
        print_fixed(spec, arguments.samples)
    if arguments.noise:
        print_noise(spec, arguments.noise)
    if arguments.resident:
        print_resident(spec, arguments.resident)


def changed(spec: Spec, **render: object) -> Spec:
    """The spec with other keys of [render]."""
    return dataclasses.replace(spec, render=dataclasses.replace(spec.render, **render))


def print_costs(spec: Spec, count: int) -> None:
    """CPU seconds of whole samples."""
    print("| size | paths | scattering | truth | CPU s a sample | outside |")
    print("|---|---|---|---|---|---|")
    plain = Renderer._passes
    for way in WAYS:
        cycles = Clock()
        Renderer._passes = cycles.around(plain)
        with tempfile.TemporaryDirectory() as folder:
            worker = new_worker(changed(spec, **way), folder)
            worker.make(Task("sample", 0))
            cycles.spent, start = 0.0, time.process_time()
            for number in range(1, count + 1):
                worker.make(Task("sample", number))
            spent = time.process_time() - start
        said = " | ".join(str(value) for value in way.values())
        outside = 1 - cycles.spent / spent
        print(f"| {said} | {spent / count:.2f} | {outside:.0%} |", flush=True)
    Renderer._passes = plain


def print_fixed(spec: Spec, count: int) -> None:
    """What does not depend on the number of paths."""
    dataset = resolve(changed(spec, size_px=TINY_PX, samples_per_pixel=1), "nowhere")
    block = draw_samples(dataset.plan, dataset.rig, 0)
    label_sample(dataset, 0, block)
    start = time.process_time()
    made = [label_sample(dataset, number, block).sample for number in range(count)]
    labels = (time.process_time() - start) / count
    renderer = open_renderer(threads=1, subsurface=spec.render.subsurface)
    renderer._contents.load(made[-1].scene)
    start = time.process_time()
    for one in made:
        renderer._contents.load(one.scene)
    load = (time.process_time() - start) / count
    start = time.process_time()
    for view in made[-1].scene.views:
        renderer.glimpse(made[-1].scene, view.name, samples=1, seed=1, denoise=False)
    views = time.process_time() - start
    print(
        f"\nfixed, a sample: scene and labels {labels:.2f}, into Blender {load:.2f}, "
        f"{len(made[-1].scene.views)} views of {TINY_PX} px {views:.2f} CPU s"
    )


def print_noise(spec: Spec, paths: int) -> None:
    """How near few paths come to many, view by view."""
    dataset = resolve(spec, "nowhere")
    scene = label_sample(dataset, 1, draw_samples(dataset.plan, dataset.rig, 0)).sample.scene
    renderer = open_renderer(threads=1, subsurface=spec.render.subsurface)

    def radiance(view: str, samples: int, seed: int) -> tuple[np.ndarray, float]:
        start = time.process_time()
        found = renderer.glimpse(scene, view, samples=samples, seed=seed).radiance.astype(np.float64)
        return found, time.process_time() - start

    print(f"\n| view, {spec.render.size_px} px | " + " | ".join(f"{n} paths" for n in PATHS) + " | enough |")
    print("|---" * (len(PATHS) + 2) + "|")
    for view in scene.views:
        reference, _ = radiance(view.name, paths, 99)
        white = np.percentile(reference, 99)
        enough = ENOUGH_DB["eye" if view.name.endswith("_eye") else "other"]
        cells, reached = [], []
        for count in PATHS:
            found, spent = radiance(view.name, count, 1)
            error = np.mean((np.clip(found / white, 0, 1) - np.clip(reference / white, 0, 1)) ** 2)
            reached.append((-10 * np.log10(error), spent))
            cells.append(f"{reached[-1][0]:.1f} dB, {spent:.2f} s")
            if reached[-1][0] >= enough:
                break
        near, seconds = np.array(reached).T
        when = (
            f"{np.exp(np.interp(enough, near, np.log(seconds))):.1f} s"
            if near[-1] >= enough
            else "not reached"
        )
        cells += [""] * (len(PATHS) - len(cells)) + [f"{enough:g} dB: {when}"]
        print(f"| {view.name} | " + " | ".join(cells) + " |", flush=True)


def print_resident(spec: Spec, count: int) -> None:
    """Memory of a worker that goes on."""
    with tempfile.TemporaryDirectory() as folder:
        worker = new_worker(spec, folder)
        marks = sorted({count // 10, count // 2, count - 1})
        for number in range(count):
            worker.make(Task("sample", number))
            if number in marks:
                print(f"after {number + 1} samples: {resident_mb()} MB resident, {peak_mb()} MB at most")


def new_worker(spec: Spec, folder: str) -> Worker:
    """A worker with a dataset of its own."""
    dataset = resolve(spec, Path(folder) / "out")
    begin(dataset)
    return Worker(dataset, threads=1)


def resident_mb() -> int:
    """Memory of this process."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * resource.getpagesize() >> 20


def peak_mb() -> int:
    """The most that this process ever had."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss >> 10


if __name__ == "__main__":
    main()
