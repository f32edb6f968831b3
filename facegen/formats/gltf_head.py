"""Finds the bones of an avatar's head and eyes, and turns them as a head or an eye is turned.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.5 nodes; an asset's front faces +z, y is up.
.. [2] VRM Consortium, "VRMC_vrm 1.0": ``humanoid.humanBones.head``; VRM 0.x: ``humanBones`` as a list, models face -z.
.. [3] B. K. P. Horn, "Closed-form solution of absolute orientation using unit quaternions", JOSA A 4, 1987: the largest
   eigenvector of a symmetric matrix is the rotation that is nearest to a matrix.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadBone:
    """A node, and what its turn is beside the head's.

    Parameters
    ----------
    node
        Its number.
    at_rest : (4,) float64
        Its rotation as the file has it: x, y, z, w as in glTF.
    above : (4,) float64
        Rotation of all nodes above it, without their scales and mirrors.
    faces_away
        Whether the model faces -z.
    """

    node: int
    at_rest: np.ndarray
    above: np.ndarray
    faces_away: bool

    def turned(self, angles_rad: np.ndarray) -> np.ndarray:
        """Rotations (n, 4) of the node for yaw, pitch and roll (n, 3) of the head (docs/conventions.md)."""
        yaw, pitch, roll = angles_rad.T
        if self.faces_away:
            pitch, roll = -pitch, -roll
        zero = np.zeros_like(yaw)

        def about(x: np.ndarray, y: np.ndarray, z: np.ndarray) -> np.ndarray:
            half = np.stack([x, y, z], axis=-1) / 2
            return np.concatenate([np.sin(half), np.cos(half.sum(axis=-1, keepdims=True))], axis=-1)

        head = _product(_product(about(zero, yaw, zero), about(-pitch, zero, zero)), about(zero, zero, -roll))
        inverse = self.above * [-1, -1, -1, 1]
        return _product(_product(_product(inverse, head), self.above), self.at_rest)


def head_bone(document: dict[str, Any]) -> HeadBone | None:
    """The bone that VRM names, or a node called Head, whatever its capitals and what stands before a colon.

    None where there is none that an animation can turn: one with a matrix cannot be.
    """
    return named_bone(document, "head")


def named_bone(document: dict[str, Any], name: str) -> HeadBone | None:
    """The bone that VRM calls ``head``, ``leftEye`` or ``rightEye``, or a node that is called so (`_NAMES`)."""
    nodes = document.get("nodes") or []
    named, faces_away = _named_by_vrm(document, name)
    if named is None:
        called = [_letters(node.get("name", "")) for node in nodes]
        fitting = [number for one in _NAMES[name] for number, letters in enumerate(called) if letters == one]
        bones = [number for number in fitting if "mesh" not in nodes[number]]
        # a mesh is turned where it is the head, but not about an eye's middle
        named = next(iter(bones or (fitting if name == "head" else [])), None)
    if not isinstance(named, int) or not 0 <= named < len(nodes) or "matrix" in nodes[named]:
        return None
    parents = {
        child: number
        for number, node in enumerate(nodes)
        for child in listed(node.get("children"))
        if isinstance(child, int)
    }
    above, at, passed = _NO_TURN, named, {named}
    while (at := parents.get(at)) is not None and at not in passed:
        passed.add(at)
        above = _product(_turn_of(nodes[at]), above)
    return HeadBone(node=named, at_rest=_rotation_of(nodes[named]), above=above, faces_away=faces_away)


_NO_TURN = np.array([0.0, 0.0, 0.0, 1.0])

_LARGEST = 1e100
"""Of a number in a node."""

_NAMES = {
    "head": ("head",),
    "leftEye": ("lefteye", "eyeleft", "eyel", "leye"),
    "rightEye": ("righteye", "eyeright", "eyer", "reye"),
}
"""Letters of nodes' names behind a colon: ``mixamorig:LeftEye``, ``eye.L``."""


def _letters(name: object) -> str:
    return "".join(filter(str.isalnum, str(name).rpartition(":")[2].lower()))


def _named_by_vrm(document: dict[str, Any], name: str) -> tuple[object, bool]:
    """Number of the node that the VRM extension calls so, and whether the model faces -z."""
    extensions = record(document.get("extensions"))
    bones = record(record(extensions.get("VRMC_vrm")).get("humanoid")).get("humanBones")
    if bones is not None:
        return record(record(bones).get(name)).get("node"), False
    bones = record(record(extensions.get("VRM")).get("humanoid")).get("humanBones")
    return next(
        (record(bone).get("node") for bone in listed(bones) if record(bone).get("bone") == name), None
    ), ("VRM" in extensions)


def listed(value: object) -> list[Any]:
    """A list as it is; an empty one for what is none."""
    return value if isinstance(value, list) else []


def record(value: object) -> dict[str, Any]:
    """A record as it is; an empty one for what is none."""
    return value if isinstance(value, dict) else {}


def _rotation_of(node: dict[str, Any]) -> np.ndarray:
    """A node's rotation as a unit quaternion; none where it has no four numbers."""
    value = _numbers(node.get("rotation"), 4)
    length = 0.0 if value is None else np.linalg.norm(value)
    if not 0.5 < length < 2:  # glTF's are of length 1
        return _NO_TURN
    return value / length


def _turn_of(node: dict[str, Any]) -> np.ndarray:
    """A unit quaternion of what a node turns by its matrix, or by rotation and scale.

    One that mirrors is taken times -1, which is a rotation: both bring a turn of the model to the same one below.
    """
    matrix = _numbers(node.get("matrix"), 16)
    if matrix is not None:
        return _nearest_rotation(matrix.reshape(4, 4).T[:3, :3])
    scale = _numbers(node.get("scale"), 3)
    signs = np.ones(3) if scale is None else np.sign(scale) * np.sign(scale).prod()
    # two axes that are turned round are half a turn about the third
    return _product(_rotation_of(node), np.array([*(signs > 0), 0.0]) if (signs < 0).any() else _NO_TURN)


def _nearest_rotation(matrix: np.ndarray) -> np.ndarray:
    """The unit quaternion that is nearest to a matrix (3, 3), or to its opposite where it mirrors [3]_."""
    m = matrix / max(np.abs(matrix).max(), 1 / _LARGEST)
    m = m * np.sign(np.linalg.det(m))
    likeness = np.zeros((4, 4))
    likeness[:3, :3] = m + m.T - np.trace(m) * np.eye(3)
    likeness[3] = m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], np.trace(m)
    return np.linalg.eigh(likeness)[1][:, -1]  # of a symmetric matrix the lower half is read


def _numbers(value: object, count: int) -> np.ndarray | None:
    """So many numbers; none where it is something else."""
    if not isinstance(value, list) or len(value) != count:
        return None
    known = all(isinstance(one, int | float) and abs(one) < _LARGEST for one in value)
    return np.array(value, dtype=np.float64) if known else None


def _product(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Quaternions (..., 4) multiplied: the second turns first."""
    axis, other = first[..., :3], second[..., :3]
    real, others = first[..., 3:], second[..., 3:]
    vector = real * other + others * axis + np.cross(axis, other)
    return np.concatenate([vector, real * others - (axis * other).sum(axis=-1, keepdims=True)], axis=-1)
