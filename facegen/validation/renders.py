"""Checks rendered samples: files, labels, and labels against pixels."""

import hashlib
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES, BLOCK, LANDMARK_COUNT, SIDES, Part, Visibility
from facegen.errors import InputError
from facegen.formats.litter import is_litter
from facegen.geometry import Camera, project
from facegen.labels import label_rendered
from facegen.sampling import Samples
from facegen.scene import Layers
from facegen.scene.beards import LENGTH_M
from facegen.sessions import draw_sample_scene
from facegen.store import Dataset, draw_block, read_exr, read_json, read_png, sample_record
from facegen.validation.agreement import disagreements
from facegen.validation.finding import Finding, FindingKind
from facegen.validation.keypoints import FAR_SHARE, REPROJECTION_PX
from facegen.validation.ranges import impossible

DEPTH_M = 1e-3
"""A visible landmark's depth must be this near to the best of the 3x3 pixels around it."""

STRANDS_M = {Part.LASHES: 15e-3, Part.HAIR: max(high for _, high in LENGTH_M.values()) + 2e-3}
"""Strands hide no landmark (docs/conventions.md), and stand no further than this before their skin: a lash's length,
and the longest beard's."""

SIDECAR = "sample.json"

RENDER_SETTINGS = {
    "engine": str,
    "blender": str,
    "device": str,
    "samples_per_pixel": int,
    "denoise": bool,
    "subsurface": bool,
}
"""Keys of ``render`` in ``sample.json`` (`facegen.work.worker`), and Python's types of their values."""


def check_renders(dataset: Dataset, numbers: tuple[int, ...]) -> Iterator[Finding]:
    """Findings in rendered samples of one block, which is drawn once for all of them."""
    drawn = draw_block(dataset, numbers[0] // BLOCK)
    for number in numbers:
        block = drawn[dataset.rig_of(number).name]
        yield from check_render(dataset, number, block.rows(slice(number % BLOCK, number % BLOCK + 1)))


def check_render(dataset: Dataset, number: int, samples: Samples) -> Iterator[Finding]:
    """Findings in one rendered sample, whose drawn row is ``samples``."""
    folder = dataset.folder.render(number)
    place = folder.relative_to(dataset.folder.path).as_posix()
    views = dataset.headset.camera_names
    files = frozenset(f"{view}.{kind}" for view in views for kind in dataset.picture_kinds)
    present = frozenset(entry.name for entry in folder.iterdir() if not is_litter(entry.name))
    for name in sorted(present - files - {SIDECAR}):
        inner = f"{place}/{name}"
        yield Finding(inner, "is no file of a rendered sample", "extra-file", remove=inner)
    pictures: dict[str, np.ndarray | Layers] = {}
    for name in sorted((files | {SIDECAR}) - present):
        yield Finding(f"{place}/{name}", "is missing", "missing-file", remove=place)
    for check in (
        _decode(folder, files & present, pictures),
        _check_sidecar(dataset, folder, files & present, pictures, samples) if SIDECAR in present else (),
    ):
        for name, what, kind in check:
            yield Finding(f"{place}/{name}", what, kind, remove=place)


_Wrong = Iterator[tuple[str, str, FindingKind]]
"""Name below the sample's folder, what is wrong, and its kind."""


def _decode(folder: Path, names: frozenset[str], pictures: dict[str, np.ndarray | Layers]) -> _Wrong:
    """Fills ``pictures`` with those that can be read."""
    for name in sorted(names):
        try:
            pictures[name] = (read_png if name.endswith(".png") else read_exr)(folder / name)
        except Exception as error:  # whatever a decoder raises, the file is bad
            yield name, f"does not decode ({error})", "unreadable"


def _check_sidecar(
    dataset: Dataset,
    folder: Path,
    names: frozenset[str],
    pictures: dict[str, np.ndarray | Layers],
    samples: Samples,
) -> _Wrong:
    try:
        record = read_json(folder / SIDECAR)
    except InputError as error:
        yield SIDECAR, str(error).removeprefix(f"{folder / SIDECAR}: "), "unreadable"
        return
    checksums = record.get("sha256")
    if not isinstance(checksums, dict):
        yield SIDECAR, "has no table of checksums (sha256)", "unreadable"
        return
    known = {f"{view}.{kind}" for view in dataset.headset.camera_names for kind in dataset.picture_kinds}
    for name in sorted(checksums.keys() - known):
        yield SIDECAR, f"sha256.{name}: is no file of a rendered sample", "label"
    for name in sorted(names):
        if name not in checksums:
            yield SIDECAR, f"has no checksum of {name}", "checksum"
        elif not (folder / name).is_file() or _sha256(folder / name) != checksums[name]:
            yield name, "its content is not what was written (SHA-256 differs)", "checksum"
    if record.get("spec_hash") != dataset.hash:
        stored_hash = str(record.get("spec_hash"))[:12]
        own_hash = dataset.hash[:12]
        yield (
            SIDECAR,
            f"was made from another spec (its hash is {stored_hash}, this dataset's {own_hash})",
            "spec-hash",
        )
        return  # its labels are another spec's, every one of them
    for name, what, kind in _check_labels(dataset, record, samples):
        yield SIDECAR, f"{name}: {what}", kind
    for view in dataset.headset.camera_names:
        if all(f"{view}.{kind}" in pictures for kind in dataset.picture_kinds):
            yield from _check_view(record, view, pictures[f"{view}.png"], pictures.get(f"{view}.exr"))


def _sha256(path: Path) -> str:
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def _check_labels(dataset: Dataset, record: dict, samples: Samples) -> _Wrong:
    rig = dataset.rig_of(int(samples.sample[0]))
    made = sample_record(
        label_rendered(dataset.spec, rig, draw_sample_scene(dataset.spec, rig, dataset.headset, samples)),
        dataset_hash=dataset.hash,
        rig=rig.name,
    )
    labels = {key: value for key, value in record.items() if key not in ("render", "sha256")}
    for name, what in disagreements(labels, json.loads(json.dumps(made))):
        yield name, what, "label"
    for what in _wrong_settings(record.get("render")):
        yield "render", what, "label"
    try:
        for name, _, what in _impossible(dataset, record):
            yield name, what, "range"
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as error:
        yield "labels", f"cannot be used ({error!r})", "unreadable"


def _wrong_settings(settings: object) -> Iterator[str]:
    """What is wrong with the record of who rendered a sample and how."""
    if not isinstance(settings, dict):
        yield "should be a table of how the sample was rendered"
        return
    for key in sorted(settings.keys() - RENDER_SETTINGS.keys()):
        yield f"{key}: is unknown; known are {', '.join(RENDER_SETTINGS)}"
    for key, kind in RENDER_SETTINGS.items():
        if key in settings and type(settings[key]) is not kind:
            yield f"{key}: must be {'a text' if kind is str else 'a whole number' if kind is int else 'true or false'}"


def _impossible(dataset: Dataset, record: dict) -> Iterator[tuple[str, int, str]]:
    views = record["views"].values()
    poses = [record["keypoints"]["camera_from_head"], *(view["camera_from_head"] for view in views)]
    visibility = [record["keypoints"]["visibility"], *(view["visibility"] for view in views)]
    return impossible(
        weights=np.array([[record["weights"][name] for name in BLENDSHAPES]], np.float64),
        visibility=np.array(visibility, np.float64),
        gaze=np.array([[record["eyes"][side]["optical_axis"] for side in SIDES]], np.float64),
        transforms=np.array(poses, np.float64),
        recorded=dataset.plan.recording is not None,
    )


def _check_view(record: dict, name: str, grey: np.ndarray, layers: Layers | None) -> _Wrong:
    try:
        view = record["views"][name]
        numbers = {key: value for key, value in view["camera"].items() if key != "distortion"}
        camera = Camera(**numbers, distortion=tuple(view["camera"]["distortion"]))
        points = np.array(view["points_camera"], np.float64).reshape(LANDMARK_COUNT, 3)
        labelled = np.array(view["points_2d"], np.float64).reshape(LANDMARK_COUNT, 2)
        visible = np.array(view["visibility"]).reshape(LANDMARK_COUNT) == Visibility.VISIBLE
        with np.errstate(invalid="ignore"):
            error = np.linalg.norm(project(camera, points) - labelled, axis=-1)
    except (KeyError, TypeError, ValueError, AttributeError, OverflowError) as unusable:
        yield SIDECAR, f"views.{name} cannot be used ({unusable!r})", "unreadable"
        return
    shapes = [grey.shape, *([layers.depth.shape] if layers else ())]
    if any(shape != (camera.height, camera.width) for shape in shapes):
        sizes = " and ".join(map(str, shapes))
        yield name, f"pictures are {sizes}, the camera says {camera.height, camera.width}", "pixels"
        return
    allowed = REPROJECTION_PX + FAR_SHARE * np.linalg.norm(labelled, axis=-1)
    for landmark in np.flatnonzero(error > allowed):
        distance = f"{error[landmark]:.3f} px"
        yield (
            SIDECAR,
            f"views.{name}: landmark {landmark} in 3D projects {distance} from its 2D label",
            "label",
        )
    if layers is None:
        return
    unknown = np.setdiff1d(layers.part, [int(part) for part in Part])
    if unknown.size:
        yield f"{name}.exr", f"has pixels of the unknown part {int(unknown[0])}", "range"
    surface = layers.depth[layers.part != Part.BACKGROUND]
    if not (np.isfinite(surface) & (surface > 0)).all():
        yield f"{name}.exr", "has pixels that show a surface without a depth", "range"
    for landmark in np.flatnonzero(visible):
        difference = depth_difference(layers, labelled[landmark], points[landmark, 2])
        if not difference <= DEPTH_M:
            off = f"{1e3 * difference:.1f} mm off"
            yield (
                f"{name}.exr",
                f"landmark {landmark} is labelled visible, but the depth there is {off}",
                "pixels",
            )


def depth_difference(layers: Layers, pixel: np.ndarray, depth_m: float) -> float:
    """Smallest difference in metres between a depth and those of the 3x3 pixels around a point (x, y).

    0 where one of them shows a hair or lash that stands before the point: it hides no landmark, but its skin.
    """
    if not np.isfinite(pixel).all():
        return float("inf")
    x, y = np.round(pixel).astype(int)
    around = slice(max(y - 1, 0), max(y + 2, 0)), slice(max(x - 1, 0), max(x + 2, 0))
    difference = np.abs(layers.depth[around].astype(np.float64) - depth_m)
    part, before = layers.part[around], layers.depth[around] < depth_m
    for strand, length_m in STRANDS_M.items():
        difference[(part == strand) & before & (difference < length_m)] = 0.0
    return float(difference.min(initial=np.inf))
