"""Measures how near the expression model comes to recorded faces, against two other ways of drawing them.

    python benchmarks/bench_expressions.py RANGE_OF_MOTION.csv SPEECH.csv [--samples 100000] [--json]
    python benchmarks/bench_expressions.py RANGE_OF_MOTION.csv SPEECH.csv --picture docs/pictures/coactivation.png

The takes are Live Link Face recordings. The model was tuned by looking at a range-of-motion take; a speech take
judges it. For every frame: the distance to the nearest sample (RMS over the 52 weights), and whether it is *inside*:
no further from the nearest sample than 95 % of the sampler's own faces are from the nearest of the others. Inside says
little for a sampler whose faces lie far apart, so its reach (that 95 % distance) stands beside it. The co-activation
matrices are the correlations of the 52 weights; only shapes that move in a take (standard deviation 0.02 or more) are
compared.
"""

import argparse
import json
import os
import time
from pathlib import Path

os.environ.setdefault("OMP_NUM_THREADS", "1")

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLOCK
from facegen.expression import restrain
from facegen.formats import read_live_link
from facegen.randomness import stream
from facegen.sampling.faces import draw_faces
from facegen.spec import parse_spec

SEED = 1
HELD_OUT = 4000
"""Samples of each sampler that are compared with the others of the same sampler."""
MOVES = 0.02
PARTS = {
    **{"eyes": "eyeBlinkLeft", "jaw": "jawForward", "mouth": "mouthClose", "brows": "browDownLeft"},
    "cheeks, nose": "cheekPuff",
}
"""Parts of the face, and the first of each part's shapes in `BLENDSHAPES` order; the tongue ends the last."""
EYES = np.tile([[0.031, 0.0, 0.0], [-0.031, 0.0, 0.0]], (BLOCK, 1, 1))


def model(size: int) -> np.ndarray:
    """Weights (size, 52) of the default spec."""
    spec = parse_spec({"version": 1, "kind": "still", "seed": SEED, "people": 1}, where="default")
    blocks = [
        draw_faces(spec, lambda part, b=b: stream(SEED, part, b), EYES) for b in range(-(-size // BLOCK))
    ]
    return np.concatenate([faces.weights for faces in blocks])[:size]


def uniform(size: int) -> np.ndarray:
    """Weights (size, 52), every shape independent and uniform."""
    return np.random.default_rng(SEED).random((size, len(BLENDSHAPES)))


def sparse_and_dense(size: int) -> np.ndarray:
    """Weights (size, 52) as facegen drew them before the model (commit 3c3fd38), the gaze apart.

    Half of the faces move 1 to 6 shapes, the others each shape with a chance of 0.35 up to 0.7; 60 % are symmetric.
    """
    rng = np.random.default_rng(SEED)
    left = [i for i, n in enumerate(BLENDSHAPES) if n.endswith("Left") and n not in ("jawLeft", "mouthLeft")]
    right = [BLENDSHAPE_INDEX[BLENDSHAPES[i].removesuffix("Left") + "Right"] for i in left]
    sparse = rng.random(size) < 0.5
    rank = rng.random((size, len(BLENDSHAPES))).argsort(axis=1).argsort(axis=1)
    active = np.where(
        sparse[:, None],
        rank < rng.integers(1, 7, size)[:, None],
        rng.random((size, len(BLENDSHAPES))) < 0.35,
    )
    weights = np.where(active, rng.random(active.shape) * np.where(sparse, 1.0, 0.7)[:, None], 0.0)
    symmetric = rng.random(size) < 0.6
    weights[np.ix_(symmetric, right)] = weights[np.ix_(symmetric, left)]
    weights[:, BLENDSHAPE_INDEX["mouthClose"]] = np.minimum(
        weights[:, BLENDSHAPE_INDEX["mouthClose"]], weights[:, BLENDSHAPE_INDEX["jawOpen"]]
    )
    looks = [name.startswith("eyeLook") for name in BLENDSHAPES]
    weights[:, looks] = model(size)[:, looks]
    return restrain(weights)


SAMPLERS = {"uniform": uniform, "sparse and dense": sparse_and_dense, "model": model}


def nearest(frames: np.ndarray, samples: np.ndarray) -> np.ndarray:
    """RMS distance (n,) of each of n frames to the nearest of the samples."""
    samples = samples.astype(np.float32)
    squared = (samples**2).sum(axis=1)
    found = []
    for some in np.array_split(frames.astype(np.float32), max(1, len(frames) // 250)):
        product = squared - 2 * some @ samples.T
        found.append(np.maximum(product.min(axis=1) + (some**2).sum(axis=1), 0))
    return np.sqrt(np.concatenate(found) / frames.shape[1])


def coactivation(weights: np.ndarray) -> np.ndarray:
    """Correlations (52, 52); 0 where a shape does not move."""
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.nan_to_num(np.corrcoef(weights.T))


def compare(takes: dict[str, np.ndarray], size: int) -> dict:
    """All figures by sampler and take."""
    figures: dict = {}
    for name, draw in SAMPLERS.items():
        started = time.process_time()
        samples = draw(size)
        seconds = time.process_time() - started
        reach = float(np.percentile(nearest(samples[:HELD_OUT], samples[HELD_OUT:]), 95))
        figures[name] = {"microseconds a face": seconds / size * 1e6, "reach": reach}
        matrix = coactivation(samples)
        for take, frames in takes.items():
            distance = nearest(frames, samples)
            moving = np.flatnonzero(frames.std(axis=0) >= MOVES)
            pairs = np.triu_indices(len(moving), 1)
            real = coactivation(frames)[np.ix_(moving, moving)][pairs]
            ours = matrix[np.ix_(moving, moving)][pairs]
            figures[name][take] = {
                "nearest, median": float(np.median(distance)),
                "nearest, 95 %": float(np.percentile(distance, 95)),
                "within 0.05": float((distance < 0.05).mean()),
                "inside": float((distance <= reach).mean()),
                "co-activation r": float(np.corrcoef(real, ours)[0, 1]),
                "co-activation rms": float(np.sqrt(np.mean((real - ours) ** 2))),
            }
    return figures


def draw_picture(takes: dict[str, np.ndarray], size: int, path: Path) -> None:
    """Co-activation matrices of both takes and of every sampler, side by side."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    from PIL import Image

    sets = {**takes, **{name: draw(size) for name, draw in SAMPLERS.items()}}
    plt.rcParams.update({"font.size": 15, "axes.titlesize": 17, "axes.titlepad": 10})
    figure, axes = plt.subplots(2, 3, figsize=(15, 10.2), layout="constrained")
    starts = [BLENDSHAPE_INDEX[shape] for shape in PARTS.values()]
    ends = [*starts[1:], len(BLENDSHAPES)]
    middles = [(start + end - 1) / 2 for start, end in zip(starts, ends, strict=True)]
    for axis, (name, weights) in zip(axes.flat, sets.items(), strict=False):
        image = axis.imshow(coactivation(weights), vmin=-1, vmax=1, cmap="RdBu_r")
        axis.set_title(name)
        axis.set_xticks(middles, PARTS, rotation=45, ha="right", rotation_mode="anchor")
        axis.set_yticks(middles, PARTS)
        axis.tick_params(length=0)
        for start in starts[1:]:
            axis.axhline(start - 0.5, color="#555555", linewidth=0.6)
            axis.axvline(start - 0.5, color="#555555", linewidth=0.6)
    axes.flat[-1].axis("off")
    place = axes.flat[-1].inset_axes((0.1, 0.0, 0.06, 1.0))
    figure.colorbar(image, cax=place, label="correlation of two weights")
    figure.savefig(path, dpi=100)
    # a palette: a third of the bytes, and no difference to the eye
    Image.open(path).convert("RGB").quantize(256).save(path, optimize=True)


def main() -> None:
    """Print the figures; with ``--picture`` draw the matrices."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("range_of_motion", type=Path)
    parser.add_argument("speech", type=Path)
    parser.add_argument("--samples", type=int, default=100_000)
    parser.add_argument("--picture", type=Path)
    parser.add_argument("--json", action="store_true")
    arguments = parser.parse_args()
    takes = {
        "range of motion": read_live_link(arguments.range_of_motion).weights,
        "speech": read_live_link(arguments.speech).weights,
    }
    figures = compare(takes, arguments.samples)
    changed = {name: float(np.abs(restrain(w) - w).max()) for name, w in takes.items()}
    if arguments.picture:
        draw_picture(takes, min(arguments.samples, 20_000), arguments.picture)
    if arguments.json:
        print(json.dumps({"samplers": figures, "couplings change a take by at most": changed}))
        return
    for name, rows in figures.items():
        print(f"{name}: {rows['microseconds a face']:.1f} us a face, reach {rows['reach']:.3f}")
        for take in takes:
            print(f"  {take:16}", "  ".join(f"{what} {value:.3f}" for what, value in rows[take].items()))
    print("couplings change a weight of a take by at most:", changed)


if __name__ == "__main__":
    main()
