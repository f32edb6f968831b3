"""Packs arrays that training programs map into memory: pictures by camera, labels in Parquet, the face's basis.

``arrays.json`` says what the arrays are of: headset, cameras, rows, rig, dataset, licence, and what is told of each
row's cameras. ``CAMERA.npy`` is
(rows, h, w) uint8; ``labels.parquet`` has its rows in the same order; ``face.npz`` turns errors of weights into
millimetres: ``displacement`` (52, V, 3) and ``rest`` (V, 3), float32, head frame, metres.
"""

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import (
    BLENDSHAPES,
    CAMERA_TERMS,
    CHIN,
    LANDMARK_GROUPS,
    NOSE_BASE,
    SIDES,
    VIEW_POINTS,
    Part,
)
from facegen.errors import FormatError, InvalidData
from facegen.geometry import Camera, angles_from_direction, camera_terms, invert_transform
from facegen.packing.plan import Options, PackFile, PackFormat
from facegen.packing.rendered import chosen_views, read_rendered
from facegen.packing.view_points import view_points
from facegen.rigs import Rig, evaluate
from facegen.store import Dataset, parse_png, write_json

ABOUT, LABELS, FACE = "arrays.json", "labels.parquet", "face.npz"
VERSION = 3
ROW_GROUP = 1000
"""Rows of labels that are held in memory at a time, about 6 MB."""

SKIN = (Part.SKIN, Part.LIPS, Part.BROWS)
BELOW_CHIN_M = 0.01
"""How far below the chin the face ends; the throat moves with the jaw, but nobody sees it."""

_FROM_SHARDS = ("sample", "person", "session", "clip", "frame", "time_s", "split", "neutral", "component")


def array_parts(dataset: Dataset, samples: Sequence[int], options: Options) -> list[PackFile]:
    """One file a camera, and three of what goes with them; the face is one rig's, so several are refused here."""
    dataset.check_one_rig()
    pictures = [
        PackFile(name=f"{view}.npy", samples=samples, view=view) for view in chosen_views(dataset, options)
    ]
    return [*pictures, *(PackFile(name=name, samples=samples) for name in (LABELS, FACE, ABOUT))]


def write_part(dataset: Dataset, part: PackFile, options: Options, path: Path) -> None:
    """Write one file; at most `ROW_GROUP` samples' labels or one picture are in memory at a time."""
    if part.view is not None:
        _write_pictures(dataset, part, path)
    elif part.name == LABELS:
        _write_labels(dataset, part, chosen_views(dataset, options), path)
    elif part.name == FACE:
        displacement, rest = face_basis(dataset.rig)
        # no compression and, as NumPy writes it, no times: equal arrays give equal bytes
        np.savez(path, displacement=displacement, rest=rest)
    else:
        write_json(path, _about(dataset, part, options))


def array_schema(dataset: Dataset, views: Sequence[str]) -> pa.Schema:
    """Columns of ``labels.parquet`` for these views; every column says its unit and shape."""
    keypoints = dataset.keypoint_schema
    angles = {
        "description": "left yaw, left pitch, right yaw, right pitch of the optical axes",
        "unit": "rad",
    }
    about_points = {
        "description": "VIEW_POINTS of facegen.conventions, NaN where its picture shows none",
        "unit": "px",
    }
    points = pa.list_(pa.float32(), 2 * len(VIEW_POINTS))
    about_camera = {"description": "CAMERA_TERMS of facegen.conventions: the unit's camera as it is"}
    terms = pa.list_(pa.float32(), len(CAMERA_TERMS))
    pose = {"description": "how the headset sits", "shape": "4 4", "unit": "m"}
    slip = {"description": "part of it that changes from frame to frame: x y z, then yaw pitch roll"}
    return pa.schema(
        [
            *(keypoints.field(name) for name in (*_FROM_SHARDS, "weights")),
            pa.field("gaze", pa.list_(pa.float32(), 4), nullable=False, metadata=angles),
            pa.field("head_from_headset", pa.list_(pa.float32(), 16), nullable=False, metadata=pose),
            pa.field("slip", pa.list_(pa.float32(), 6), nullable=False, metadata=slip | {"unit": "m, rad"}),
            *(pa.field(f"points_{view}", points, nullable=False, metadata=about_points) for view in views),
            *(pa.field(f"camera_{view}", terms, nullable=False, metadata=about_camera) for view in views),
        ],
        metadata={"licence": dataset.licence, "spec_hash": dataset.hash},
    )


def face_basis(rig: Rig) -> tuple[np.ndarray, np.ndarray]:
    """How far each blendshape moves the skin of the mean person's face, and where it rests.

    The face reaches back to the rearmost landmark, from a centimetre below the chin to as high above the brows as the
    nose's base is below them (the thirds of the artists' canon). Lids are closed as in pictures.

    Returns
    -------
    displacement
        (52, V, 3) float32, metres, of a weight of 1.
    rest
        (V, 3) float32, metres, head frame.
    """
    shapes = len(BLENDSHAPES)
    weights = np.concatenate([np.zeros((1, shapes)), np.eye(shapes)])
    ahead = np.tile([0.0, 0.0, 1.0], (shapes + 1, 2, 1))
    faces = evaluate(rig, np.zeros((shapes + 1, rig.components)), weights, ahead)
    rest, landmarks = faces.vertices[0], faces.landmarks[0]
    used = np.unique(rig.faces[np.isin(rig.part, SKIN)])
    used = used[used >= 0]
    brows = landmarks[[*LANDMARK_GROUPS["left_brow"], *LANDMARK_GROUPS["right_brow"]], 1].max()
    top, bottom = 2 * brows - landmarks[NOSE_BASE, 1], landmarks[CHIN, 1] - BELOW_CHIN_M
    height, forward = rest[used, 1], rest[used, 2]
    kept = used[(forward >= landmarks[:, 2].min()) & (height <= top) & (height >= bottom)]
    moved = faces.vertices[1:, kept] - rest[kept]
    return moved.astype(np.float32), rest[kept].astype(np.float32)


def _write_pictures(dataset: Dataset, part: PackFile, path: Path) -> None:
    camera = dataset.headset.camera(part.view).camera
    shape = (camera.height, camera.width)
    with open(path, "wb") as file:
        header = {"descr": "|u1", "fortran_order": False, "shape": (len(part.samples), *shape)}
        np.lib.format.write_array_header_1_0(file, header)
        for sample in read_rendered(dataset, part.samples, [f"{part.view}.png"]):
            source = f"{dataset.folder.render(sample.number) / part.view}.png"
            advice = "run facegen validate --repair, then facegen generate"
            try:
                picture = parse_png(sample.pictures[f"{part.view}.png"], where=source)
            except FormatError as error:
                raise InvalidData(f"{error}; {advice}") from None
            if picture.shape != shape:
                raise InvalidData(f"{source}: is no picture of {shape[1]} x {shape[0]} pixels; {advice}")
            file.write(picture.tobytes())


def _write_labels(dataset: Dataset, part: PackFile, views: Sequence[str], path: Path) -> None:
    schema = array_schema(dataset, views)
    with pq.ParquetWriter(path, schema, compression="zstd", write_page_checksum=True) as writer:
        for start in range(0, len(part.samples), ROW_GROUP):
            numbers = part.samples[start : start + ROW_GROUP]
            rows = [_row(sample.record, views) for sample in read_rendered(dataset, numbers, ())]
            writer.write_table(pa.Table.from_pylist(rows, schema=schema), row_group_size=ROW_GROUP)


def _row(record: dict, views: Sequence[str]) -> dict:
    headset = record["headset"]
    axes = np.array([record["eyes"][side]["optical_axis"] for side in SIDES], np.float64)
    points = {f"points_{view}": view_points(record["views"][view]).ravel() for view in views}
    return {name: record[name] for name in _FROM_SHARDS} | {
        "weights": [record["weights"][name] for name in BLENDSHAPES],
        "gaze": np.stack(angles_from_direction(axes), axis=-1).ravel().tolist(),
        "head_from_headset": np.ravel(headset["head_from_headset"]).tolist(),
        "slip": headset["slip"],
        **points,
        **{f"camera_{view}": _camera_terms(record, view) for view in views},
    }


def _camera_terms(record: dict, view: str) -> list[float]:
    """What is told of a view's camera, from the sample's own labels."""
    labels = record["views"][view]
    intrinsics = ("model", "width", "height", "fx", "fy", "cx", "cy")
    camera = Camera(**{name: labels["camera"][name] for name in intrinsics})
    head_from_headset = np.array(record["headset"]["head_from_headset"])
    headset_from_camera = invert_transform(np.array(labels["camera_from_head"]) @ head_from_headset)
    return camera_terms(camera, headset_from_camera).tolist()


def _about(dataset: Dataset, part: PackFile, options: Options) -> dict:
    cameras = [dataset.headset.camera(view).camera for view in chosen_views(dataset, options)]
    return {
        "version": VERSION,
        "headset": dataset.headset.name,
        "cameras": [
            {"name": view, "width": camera.width, "height": camera.height}
            for view, camera in zip(chosen_views(dataset, options), cameras, strict=True)
        ],
        "camera_terms": list(CAMERA_TERMS),
        "drawn": dataset.spec.layout is not None,
        "rows": len(part.samples),
        "rig": dataset.rig.name,
        "dataset_hash": dataset.hash,
        "licence": dataset.licence,
        "seed": dataset.spec.seed,
    }


ARRAYS = PackFormat(
    description="arrays that training maps into memory: pictures (npy, one a camera), labels, the face's basis",
    rendered=True,
    options=frozenset({"views"}),
    shard_size=0,
    parts=array_parts,
    write=write_part,
    version=2,  # the first told nothing of the rows' cameras
)
