"""Measures how long a frame takes: in NumPy, and in each export by what runs it here."""

import json
import os
import shutil
import subprocess
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from regress.exporters import export_model
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.model import FastPredictor, Model
from regress.runtime.onnx_session import open_session

BATCH_FRAMES = 20_000
HEADSET_BATCH_FRAMES = 64


@dataclass(frozen=True, kw_only=True)
class Timing:
    """One way to run a model.

    Parameters
    ----------
    name
        For people.
    microseconds
        A frame, the best of several runs: others share the machine; None where it cannot run here.
    note
        What ran it, or why nothing did.
    """

    name: str
    microseconds: float | None
    note: str


def time_model(model: Model, faces: np.ndarray) -> tuple[Timing, ...]:
    """Time a model on faces (n, 68, 2), one frame at a time and in a batch; one thread each but for one row."""
    from threadpoolctl import threadpool_limits

    with tempfile.TemporaryDirectory() as temporary, threadpool_limits(limits=1):
        folder = Path(temporary)
        formats = ("c", "javascript") if find_spec("onnx") is None else ("onnx", "c", "javascript")
        export_model(model, folder, name="face", formats=formats)
        compares = model.calibrated is not None
        # a person whose neutral face is known: what users of such a model run, and what its exports are given
        model = model.calibrate(faces[1:2]) if compares else model
        fast = FastPredictor(model)
        batch = faces[np.arange(BATCH_FRAMES) % len(faces)]
        return (
            Timing(
                name="NumPy, one frame",
                microseconds=_best(lambda: model.predict(faces[:1]), repeat=200),
                note="Model.predict",
            ),
            Timing(
                name=f"NumPy, {BATCH_FRAMES:,} frames",
                microseconds=_best(lambda: model.predict(batch), repeat=1) / BATCH_FRAMES,
                note="Model.predict, a frame's share",
            ),
            Timing(
                name="fast, one frame",
                microseconds=_best(lambda: fast.predict_frame(faces[0]), repeat=500),
                note="FastPredictor.predict_frame, NumPy in float32",
            ),
            Timing(
                name=f"fast, {BATCH_FRAMES:,} frames",
                microseconds=_best(lambda: fast.predict(batch, threads=1), repeat=1) / BATCH_FRAMES,
                note="FastPredictor.predict, a frame's share",
            ),
            Timing(
                name=f"fast, {BATCH_FRAMES:,} frames, all cores",
                microseconds=_best(lambda: fast.predict(batch), repeat=1) / BATCH_FRAMES,
                note=f"FastPredictor.predict in {os.cpu_count()} threads, a frame's share",
            ),
            _time_onnx(folder, faces, compares=compares),
            _time_c(folder, faces, compares=compares),
            _time_javascript(folder, faces, compares=compares),
        )


def time_headset(predictor: HeadsetPredictor) -> tuple[Timing, ...]:
    """Time a headset's network on pictures of noise, on one core, uncalibrated and with neutral pictures.

    Runs are of a millisecond, shorter than the turns that a busy machine gives its programs.
    """
    rng = np.random.default_rng(0)
    note = f"onnxruntime {version('onnxruntime')}, {len(predictor.sizes)} cameras"

    def noise(count: int) -> dict[str, np.ndarray]:
        return {
            name: rng.integers(0, 256, (count, height, width), dtype=np.uint8)
            for name, (width, height) in predictor.sizes.items()
        }

    one, batch, neutral = noise(1), noise(HEADSET_BATCH_FRAMES), {name: p[0] for name, p in noise(1).items()}
    return (
        Timing(
            name="ONNX, one frame",
            microseconds=_best(lambda: predictor.predict(one), repeat=3, runs=100),
            note=note,
        ),
        Timing(
            name="ONNX, calibrated",
            microseconds=_best(lambda: predictor.predict(one, neutral=neutral), repeat=3, runs=100),
            note=note,
        ),
        Timing(
            name=f"ONNX, {HEADSET_BATCH_FRAMES} frames",
            microseconds=_best(lambda: predictor.predict(batch), repeat=1, runs=20) / HEADSET_BATCH_FRAMES,
            note=f"{note}, a frame's share",
        ),
    )


def _time_onnx(folder: Path, faces: np.ndarray, *, compares: bool) -> Timing:
    if not (folder / "face.onnx").exists():
        return Timing(name="ONNX, one frame", microseconds=None, note="its export needs the learn extra")
    session = open_session((folder / "face.onnx").read_bytes())
    feed = {"points": faces[:1].astype(np.float32)}
    if compares:
        feed["neutral"] = faces[1:2].astype(np.float32)
    return Timing(
        name="ONNX, one frame",
        microseconds=_best(lambda: session.run(None, feed), repeat=200),
        note=f"onnxruntime {version('onnxruntime')}",
    )


_C_PROGRAM = """
#include <stdio.h>
#include <time.h>
#include "face.h"
static const float points[FACE_POINTS][2] = {%s};
%s
int main(void) {
    float weights[FACE_WEIGHTS], sum = 0;
    double best = 1e30;
    BEGIN();
    for (int run = 0; run < 7; run++) {
        const clock_t began = clock();
        for (int i = 0; i < 2000; i++) { PREDICT(); sum += weights[17]; }
        const double taken = (double)(clock() - began) / CLOCKS_PER_SEC / 2000 * 1e6;
        if (taken < best) best = taken;
    }
    printf("%%g %%g\\n", best, (double)sum);
    return 0;
}
"""


_C_ALONE = """#define BEGIN()
#define PREDICT() face_predict(points, weights)"""
_C_PLAYER = """static const float neutral[FACE_POINTS][2] = {%s};
static face_player player;
#define BEGIN() face_neutral(&player, neutral)
#define PREDICT() face_predict(&player, points, weights)"""


def _time_c(folder: Path, faces: np.ndarray, *, compares: bool) -> Timing:
    name = "C, one frame"
    if shutil.which("cc") is None:
        return Timing(name=name, microseconds=None, note="no cc on this machine")
    points, neutral = (", ".join(f"{{{x:.9g}, {y:.9g}}}" for x, y in face) for face in faces[:2])
    (folder / "main.c").write_text(_C_PROGRAM % (points, _C_PLAYER % neutral if compares else _C_ALONE))
    command = ["cc", "-std=c99", "-O2", "main.c", "face.c", "-o", "face", "-lm"]
    try:
        subprocess.run(command, cwd=folder, check=True, capture_output=True)
        done = subprocess.run([str(folder / "face")], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        return Timing(name=name, microseconds=None, note=f"cc failed: {error}")
    return Timing(name=name, microseconds=float(done.stdout.split()[0]), note="cc -O2")


_JAVASCRIPT_PROGRAM = """
import * as face from {module};
const points = Float64Array.from({points}), weights = new Float32Array(52);
const predict = {neutral} ? face.player({neutral}) : face.predict;
let best = Infinity;
for (let run = 0; run < 7; run++) {{
  const began = performance.now();
  for (let i = 0; i < 1000; i++) predict(points, weights);
  best = Math.min(best, performance.now() - began);
}}
console.log(best);
"""


def _time_javascript(folder: Path, faces: np.ndarray, *, compares: bool) -> Timing:
    name = "JavaScript, one frame"
    if shutil.which("node") is None:
        return Timing(name=name, microseconds=None, note="no node on this machine")
    module = json.dumps((folder / "face.js").as_uri())
    points, neutral = (json.dumps(face.ravel().tolist()) for face in faces[:2])
    program = _JAVASCRIPT_PROGRAM.format(
        module=module, points=points, neutral=neutral if compares else "null"
    )
    command = ["node", "--input-type=module", "--eval", program]
    try:
        done = subprocess.run(command, check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError) as error:
        return Timing(name=name, microseconds=None, note=f"node failed: {error}")
    # 1000 calls in milliseconds are microseconds a call
    return Timing(name=name, microseconds=float(done.stdout), note="node")


def _best(call: Callable[[], object], *, repeat: int, runs: int = 7) -> float:
    """Microseconds of a call: the best of several runs of ``repeat`` calls."""
    call()
    taken = []
    for _ in range(runs):
        began = time.perf_counter()
        for _ in range(repeat):
            call()
        taken.append((time.perf_counter() - began) / repeat)
    return min(taken) * 1e6
