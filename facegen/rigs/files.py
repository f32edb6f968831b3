"""Writes and reads rigs: NAME.npz holds the arrays, NAME.json describes them to people and programs.

Both are written byte for byte the same by every build from the same arrays: entries in a fixed order, no time
stamps, no compression (its bytes depend on the version of zlib). Datasets name their rig by the SHA-256 kept
in the JSON.
"""

import hashlib
import io
import json
import zipfile
from functools import lru_cache
from pathlib import Path

import numpy as np

from facegen.archives import MOST_BYTES, check_shapes, parse_npz
from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, Part
from facegen.documents import read_bytes
from facegen.errors import FormatError, InputError
from facegen.files import output_errors, write_whole
from facegen.rigs.record import RIG_FORMAT, made_again, read_record, rigs_folder
from facegen.rigs.rig import Rig
from facegen.rigs.versions import VERSIONS

_TEXTS = ("licence", "source", "version")
_INDICES = ("faces", "cage_faces", "landmark_vertices", "upper_lid", "lower_lid", "lid_vertices")
_ARRAYS = (
    *("vertices", "faces", "cage_faces", "uv", "part"),
    *("identity", "identity_from_traits", "identity_residual", "expression"),
    *("landmark_vertices", "landmark_weights"),
    *("eye_center", "eye_center_identity", "eye_radius", "eye_radius_identity"),
    *("upper_lid", "lower_lid", "lid_vertices"),
)


def save_rig(rig: Rig, folder: Path | None = None) -> Path:
    """Write ``NAME.npz`` and ``NAME.json`` into ``folder`` (default `rigs_folder`); return the first's path.

    Arrays are cast to float32 and int32 here. Each file appears by one rename, the JSON last.

    Raises
    ------
    OutputError
        The folder cannot be written or is full.
    """
    folder = Path(folder) if folder is not None else rigs_folder()
    content = _zip_bytes({name: _on_disk(name, getattr(rig, name)) for name in _ARRAYS})
    npz, record = folder / f"{rig.name}.npz", _record(rig, content)
    with output_errors(folder):
        folder.mkdir(parents=True, exist_ok=True)
    write_whole(npz, content)
    write_whole(npz.with_suffix(".json"), json.dumps(record, indent=2) + "\n")
    return npz


def load_rig(name: str, folder: Path | None = None) -> Rig:
    """Read a built rig.

    Parameters
    ----------
    name
        Name of the rig: one of `facegen.rigs.building.RIGS`, or of a head that was added.
    folder
        Where it lies; default `rigs_folder`.

    Raises
    ------
    MissingAsset
        No rig of this name has been built.
    InputError
        The file is of another build than this version takes, or its content is not what its checksum says.
    """
    folder = Path(folder) if folder is not None else rigs_folder()
    return _load(name, folder, *(_stamp(folder / f"{name}{ending}") for ending in (".json", ".npz")))


def _stamp(path: Path) -> tuple[int, ...] | None:
    """What changes with a file's content; None where there is none."""
    try:
        found = path.stat()
    except (OSError, ValueError):
        return None
    return found.st_mtime_ns, found.st_size, found.st_ino


@lru_cache(maxsize=8)
def _load(name: str, folder: Path, *_stamps: tuple[int, ...] | None) -> Rig:
    """Read each version of the files once: 0.25 s, and a merge opens hundreds of data sets of one rig."""
    record = read_record(name, folder)
    path = folder / f"{name}.npz"
    if record["version"] != VERSIONS.get(name, record["version"]):
        raise InputError(
            f"{path} is {record['version']!r}, and this version takes {VERSIONS[name]!r}, with other shapes or eyes; "
            f"build it again with: facegen rig build {name}"
        )
    content = read_bytes(path, most_bytes=2 * MOST_BYTES)
    if hashlib.sha256(content).hexdigest() != record["sha256"]:
        raise InputError(
            f"{path} is not the file that was built (its SHA-256 differs from {name}.json's); {made_again(name)}"
        )
    arrays = parse_npz(content, where=str(path))
    _check_arrays(arrays, record, where=str(path))
    values = {key: _in_memory(key, arrays[key]) for key in _ARRAYS}
    texts = {key: record[key] for key in _TEXTS}
    return Rig(
        name=record["name"],
        cage_vertices=record["cage_vertices"],
        traits=tuple(record["traits"]),
        sha256=record["sha256"],
        missing=tuple(record["missing"]),
        **texts,
        **values,
    )


def _check_arrays(arrays: dict[str, np.ndarray], record: dict, *, where: str) -> None:
    """Refuse arrays that do not fit each other, or whose indices point outside them."""
    components, faces = record["identity_components"], record["faces"]
    vertices, traits, shapes = record["vertices"], len(record["traits"]), len(BLENDSHAPES)
    wanted = {
        "vertices": (vertices, 3),
        "faces": (faces, 4),
        "cage_faces": (None, 4),
        "uv": (faces, 4, 2),
        "part": (faces,),
        "identity": (components, vertices, 3),
        "identity_from_traits": (components, traits),
        "identity_residual": (components, components),
        "expression": (shapes, vertices, 3),
        "landmark_vertices": (LANDMARK_COUNT, None),
        "landmark_weights": (LANDMARK_COUNT, None),
        "eye_center": (2, 3),
        "eye_center_identity": (components, 2, 3),
        "eye_radius": (2,),
        "eye_radius_identity": (components, 2),
        "upper_lid": (2, None),
        "lower_lid": (2, None),
        "lid_vertices": (2, None),
    }
    check_shapes(arrays, wanted, where=where)
    if arrays["landmark_vertices"].shape != arrays["landmark_weights"].shape:
        raise FormatError(f"{where}: landmark_vertices and landmark_weights must have one shape")
    caged = record["cage_vertices"]
    for name in _INDICES:
        # triangles and lists of unequal length are padded
        low = -1 if name in ("faces", "cage_faces", "lid_vertices") else 0
        high = vertices if name in ("faces", "lid_vertices") else caged
        array = arrays[name]
        if array.dtype.kind not in "iu" or not array.size or array.min() < low or array.max() >= high:
            raise FormatError(f"{where}: array {name!r} must hold whole numbers from {low} to {high - 1}")
    for name in ("upper_lid", "lower_lid"):
        for side, margin, lids in zip(("left", "right"), arrays[name], arrays["lid_vertices"], strict=True):
            if len(apart := np.setdiff1d(margin, lids)):
                raise FormatError(
                    f"{where}: array {name!r} has vertex {apart[0]} on the {side} eye's margin, and 'lid_vertices' of "
                    "this eye does not; margins close with their lid, so add all of theirs there"
                )
    if not np.isin(arrays["part"], [int(part) for part in Part]).all():
        raise FormatError(f"{where}: array 'part' has a number that stands for no part of a head")


def _on_disk(name: str, array: np.ndarray) -> np.ndarray:
    if name == "part":
        return np.ascontiguousarray(array, np.uint8)
    return np.ascontiguousarray(array, np.int32 if name in _INDICES else np.float32)


def _in_memory(name: str, array: np.ndarray) -> np.ndarray:
    array = array if name == "part" or name in _INDICES else array.astype(np.float64)
    array.setflags(write=False)
    return array


def _record(rig: Rig, content: bytes) -> dict:
    present = [int(value) for value in np.unique(rig.part)]
    return {
        "name": rig.name,
        "format": RIG_FORMAT,
        "sha256": hashlib.sha256(content).hexdigest(),
        **{key: getattr(rig, key) for key in _TEXTS},
        "vertices": len(rig.vertices),
        "faces": len(rig.faces),
        "cage_vertices": rig.cage_vertices,
        "identity_components": rig.components,
        "traits": list(rig.traits),
        "missing": list(rig.missing),
        "parts": {Part(value).name.lower(): int((rig.part == value).sum()) for value in present},
        "eye_distance_mm": round(float(1e3 * (rig.eye_center[0, 0] - rig.eye_center[1, 0])), 3),
        "eye_radius_mm": [round(float(1e3 * radius), 3) for radius in rig.eye_radius],
    }


def _zip_bytes(arrays: dict[str, np.ndarray]) -> bytes:
    """An .npz as `numpy.savez` makes it, with time stamps of 1980: equal arrays give equal bytes."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_STORED) as archive:
        for name, array in arrays.items():
            entry = io.BytesIO()
            np.lib.format.write_array(entry, array, version=(1, 0), allow_pickle=False)
            archive.writestr(
                zipfile.ZipInfo(f"{name}.npy", date_time=(1980, 1, 1, 0, 0, 0)), entry.getvalue()
            )
    return stream.getvalue()
