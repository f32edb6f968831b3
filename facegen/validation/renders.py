"""Checks of rendered samples: files, labels, and labels against pixels."""

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES, BLOCK, SHARD_ROWS, Visibility
from facegen.geometry import Camera, project
from facegen.labels import label_rendered
from facegen.sampling import draw_samples
from facegen.scene import Layers
from facegen.store import Dataset, column_array, read_exr, read_png, sample_record
from facegen.validation.finding import Finding
from facegen.validation.keypoints import REPROJECTION_PX

DEPTH_M = 1e-3
"""A visible landmark's depth must be this near to the best of the 3x3 pixels around it."""

_ROW_FIELDS = ("points_2d", "detected_2d", "points_3d", "visibility")


def check_render(dataset: Dataset, number: int) -> Iterator[Finding]:
    """Findings in one rendered sample."""
    folder = dataset.folder.render(number)
    where = str(folder.relative_to(dataset.folder.path))
    try:
        record = json.loads((folder / "sample.json").read_text(encoding="utf-8"))
        checksums, views = record["sha256"], record["views"]
    except (OSError, ValueError, KeyError, TypeError) as error:
        yield Finding(f"{where}/sample.json", f"cannot be read ({error!r})")
        return
    yield from _check_files(folder, where, checksums, views)
    yield from _check_labels(dataset, number, record, where)
    yield from _check_row(dataset, number, record, where)
    for name, view in views.items():
        yield from _check_view(folder, f"{where}/{name}", name, view)


def _check_files(folder: Path, where: str, checksums: dict, views: dict) -> Iterator[Finding]:
    expected = {f"{name}.{kind}" for name in views for kind in ("png", "exr")}
    if set(checksums) != expected:
        yield Finding(f"{where}/sample.json", f"should have checksums of {', '.join(sorted(expected))}")
    for name, sha256 in checksums.items():
        try:
            found = hashlib.sha256((folder / name).read_bytes()).hexdigest()
        except OSError as error:
            yield Finding(f"{where}/{name}", f"cannot be read ({error.strerror})")
            continue
        if found != sha256:
            yield Finding(f"{where}/{name}", "its content is not what was written (SHA-256 differs)")


def _check_labels(dataset: Dataset, number: int, record: dict, where: str) -> Iterator[Finding]:
    block, row = divmod(number, BLOCK)
    samples = draw_samples(dataset.plan, dataset.rig, block).rows(slice(row, row + 1))
    rendered = label_rendered(dataset.spec, dataset.rig, dataset.headset, samples)
    made = sample_record(
        rendered,
        dataset_hash=dataset.hash,
        rig=dataset.rig.name,
        headset=dataset.headset.name,
        sensor=dataset.headset.sensor,
    )
    for key, value in made.items():
        if record.get(key) != json.loads(json.dumps(value)):
            yield Finding(f"{where}/sample.json", f"{key} is not what the spec gives for this sample")


def _check_row(dataset: Dataset, number: int, record: dict, where: str) -> Iterator[Finding]:
    path = dataset.folder.shard(number // SHARD_ROWS)
    if not path.is_file():
        yield Finding(where, f"has no keypoint row: {path.name} is missing")
        return
    row = pq.read_table(path).slice(number % SHARD_ROWS, 1)
    stored = {name: column_array(row, name)[0] for name in (*_ROW_FIELDS, "weights", "identity")}
    written = {name: record["keypoints"][name] for name in _ROW_FIELDS}
    written["weights"] = [record["weights"][name] for name in BLENDSHAPES]
    written["identity"] = record["identity"]
    for name, values in written.items():
        if not np.array_equal(np.asarray(values, stored[name].dtype), stored[name]):
            yield Finding(f"{where}/sample.json", f"{name} differs from row {number % SHARD_ROWS} of {path.name}")


def _check_view(folder: Path, where: str, name: str, view: dict) -> Iterator[Finding]:
    numbers = {key: value for key, value in view["camera"].items() if key != "distortion"}
    camera = Camera(**numbers, distortion=tuple(view["camera"]["distortion"]))
    try:
        grey, layers = read_png(folder / f"{name}.png"), read_exr(folder / f"{name}.exr")
    except Exception as error:  # whatever a decoder raises, the file is bad
        yield Finding(where, f"a picture does not decode ({error})")
        return
    if grey.shape != (camera.height, camera.width) or layers.depth.shape != grey.shape:
        yield Finding(where, f"pictures are {grey.shape} and {layers.depth.shape}, the camera says {camera.height, camera.width}")
        return
    points = np.array(view["points_camera"], np.float64)
    labelled = np.array(view["points_2d"], np.float64)
    with np.errstate(invalid="ignore"):
        error = np.linalg.norm(project(camera, points) - labelled, axis=-1)
    for landmark in np.flatnonzero(error > REPROJECTION_PX):
        yield Finding(where, f"landmark {landmark} in 3D projects {error[landmark]:.3f} px away from its 2D label")
    for landmark in np.flatnonzero(np.array(view["visibility"]) == Visibility.VISIBLE):
        difference = depth_difference(layers, labelled[landmark], points[landmark, 2])
        if not difference <= DEPTH_M:
            yield Finding(where, f"landmark {landmark} is labelled visible, but the picture's depth is {1e3 * difference:.1f} mm off")


def depth_difference(layers: Layers, pixel: np.ndarray, depth_m: float) -> float:
    """Smallest difference in metres between a depth and those of the 3x3 pixels around a point (x, y)."""
    x, y = np.round(pixel).astype(int)
    near = layers.depth[max(y - 1, 0) : y + 2, max(x - 1, 0) : x + 2]
    return float(np.min(np.abs(near.astype(np.float64) - depth_m), initial=np.inf))
