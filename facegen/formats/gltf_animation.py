"""Writes morph-target animations into an avatar's .glb file, of which nothing else changes.

The file's JSON is edited as it stands and its binary chunk is only added to: a library with a class for each
part of the format drops what its classes do not know, and avatars (VRM) are full of extensions.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.11 animations (channels with the path ``weights``, one output
   value a target and keyframe), 4 the binary container. Targets' names stand in ``mesh.extras.targetNames``.
"""

from collections.abc import Set
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError
from facegen.formats.gltf_additions import Additions, records
from facegen.formats.gltf_container import glb_bytes, open_glb
from facegen.formats.gltf_expressions import look_expressions, read_expressions
from facegen.formats.gltf_eyes import eye_bones, hides_eyes
from facegen.formats.gltf_head import head_bone, listed, record
from facegen.formats.gltf_targets import target_names

_MOST_WEIGHT = 1e30
"""Of a target at rest: more is no number in float32, in which an animation has it."""


@dataclass(frozen=True, kw_only=True, eq=False)
class AnimatedAvatar:
    """An avatar file with an animation more.

    Attributes
    ----------
    content
        Bytes of the .glb file.
    missing
        Names that no expression with morph targets and no mesh of the avatar has, in their order.
    headless
        Whether a head's turn was given and the avatar has no bone for it.
    compressed
        Whether a gaze was given, and the eyes' bones are left alone because nobody sees what morph targets turn.
    """

    content: bytes
    missing: tuple[str, ...]
    headless: bool = False
    compressed: bool = False


def animate_avatar(
    path: Path,
    names: tuple[str, ...],
    weights: np.ndarray,
    time_s: np.ndarray,
    *,
    title: str,
    head_rad: np.ndarray | None = None,
    gaze_rad: np.ndarray | None = None,
) -> AnimatedAvatar:
    """Add one animation that moves every mesh with known morph targets, and the head, interpolated linearly.

    A name is that of an expression of a VRM avatar, which moves the morph targets that it binds
    (`gltf_expressions`), or else that of a morph target. Names match without regard to case and underscores, and
    ``_L``/``_R`` means ``Left``/``Right``. Targets without a weight keep what the file gives them at rest.

    Parameters
    ----------
    path
        The avatar: a .glb (or .vrm) file.
    names
        What the columns of weights are called.
    weights : (n, k) float
        Rows with NaN become no keyframe.
    time_s : (n,) float
        Seconds, not negative, in order.
    title
        What the animation is called.
    head_rad : (n, 3) float, optional
        Yaw, pitch and roll of the head, which turn its bone (`gltf_head`); 0 where a row has weights and no pose.
    gaze_rad : (n, 4) float, optional
        Yaw and pitch of the left eye, then of the right eye, in the head; they turn the eyes' bones, unless morph
        targets do so (`gltf_eyes`), or expressions of a VRM that says so; 0 where a row has weights and no gaze.

    Raises
    ------
    FormatError
        The file is no .glb file, has no morph target of these names, or no row has weights.
    """
    document, chunks = open_glb(path)
    known = ~np.isnan(weights).any(axis=1)
    times = time_s[known].astype("<f4")
    if not len(times) or times[0] < 0 or not (np.diff(times) > 0).all():
        raise FormatError(f"no animation for {path}: rows with weights need times that start at 0 s and grow")
    columns = {_key(name): weights[known, column] for column, name in enumerate(names)}
    animation: dict[str, Any] = {"name": title, "channels": [], "samplers": []}
    meshes, nodes = (records(document, key, path) for key in ("meshes", "nodes"))
    file = Additions(document, path)
    clock = file.accessor(times, min=[float(times[0])], max=[float(times[-1])])
    faces = [_mesh_of(node, index, meshes, path) for index, node in enumerate(nodes)]
    movements, matched = _movements(document, faces, columns.keys(), path)
    if not matched:
        raise FormatError(
            f"{path} has no morph target called {', '.join(names[:2])}"
            f"{f' or like any other of the {len(names)} shapes' if len(names) > 2 else ''}, and no expression; a "
            "retargeting to its own names may help"
        )
    for index, targets in sorted(movements.items()):
        rest = _at_rest(nodes[index], faces[index], len(_targets(faces[index])), index, path)
        file.check_room(len(times) * len(rest))
        values = np.tile(np.array(rest, dtype=np.float64), (len(times), 1))
        for target, shares in targets.items():
            values[:, target] = sum(
                share * ((columns[key] > 0.5) if binary else columns[key])
                for (key, binary), share in shares.items()
            )
        animation["channels"].append(
            {"sampler": len(animation["samplers"]), "target": {"node": index, "path": "weights"}}
        )
        animation["samplers"].append(
            {"input": clock, "output": file.accessor(values.astype("<f4")), "interpolation": "LINEAR"}
        )
    bone = None if head_rad is None else head_bone(document)
    turns = [] if bone is None else [(bone, head_rad[known])]
    looking = gaze_rad is not None and matched.isdisjoint(map(_key, look_expressions(document)))
    if looking:
        straight = np.zeros((len(times), 1))
        turns += [
            (eye, np.concatenate([gaze_rad[known, 2 * side : 2 * side + 2], straight], axis=1))
            for side, eye in enumerate(eye_bones(document, path))
        ]
    for turned, angles in turns:
        file.check_room(4 * len(times))
        rotations = turned.turned(np.nan_to_num(angles)).astype("<f4")
        animation["channels"].append(
            {"sampler": len(animation["samplers"]), "target": {"node": turned.node, "path": "rotation"}}
        )
        animation["samplers"].append(
            {"input": clock, "output": file.accessor(rotations, kind="VEC4"), "interpolation": "LINEAR"}
        )
    document["animations"] = [*records(document, "animations", path), animation]
    chunks = file.stored(chunks)
    return AnimatedAvatar(
        content=glb_bytes(document, chunks, path),
        missing=tuple(name for name in names if _key(name) not in matched),
        headless=head_rad is not None and bone is None,
        compressed=looking and hides_eyes(document),
    )


_Shares = dict[tuple[str, bool], float]
"""What drives one morph target: by column, and whether of it only all or nothing counts, the share that is added."""


def _movements(
    document: dict[str, Any], faces: list[dict[str, Any]], columns: Set[str], path: Path
) -> tuple[dict[int, dict[int, _Shares]], set[str]]:
    """What drives each morph target of each node, and the columns that drive any."""
    counts = [len(_targets(mesh)) for mesh in faces]
    movements: dict[int, dict[int, _Shares]] = {}
    matched: set[str] = set()
    for expression in read_expressions(document):
        key = _key(expression.name)
        for bind in expression.binds if key in columns else ():
            if bind.node < len(counts) and bind.target < counts[bind.node]:
                shares = movements.setdefault(bind.node, {}).setdefault(bind.target, {})
                shares[key, expression.binary] = shares.get((key, expression.binary), 0.0) + bind.weight
                matched.add(key)
    named: set[str] = set()
    for index, mesh in enumerate(faces):
        for target, key in enumerate(map(_key, _named_targets(mesh))):
            if key in columns and key not in matched:
                movements.setdefault(index, {}).setdefault(target, {(key, False): 1.0})
                named.add(key)
    return movements, matched | named


def _mesh_of(node: dict[str, Any], number: int, meshes: list[dict[str, Any]], path: Path) -> dict[str, Any]:
    """A node's mesh; an empty one where it has none."""
    index = node.get("mesh")
    if index is None:
        return {}
    if not isinstance(index, int) or not 0 <= index < len(meshes):
        raise FormatError(f"{path} is damaged: node {number} has mesh {index}, and there are {len(meshes)}")
    return meshes[index]


def _at_rest(
    node: dict[str, Any], mesh: dict[str, Any], targets: int, number: int, path: Path
) -> list[float]:
    """Weights of a node's morph targets as the file has them."""
    rest = node.get("weights") or mesh.get("weights") or [0.0] * targets
    known = isinstance(rest, list) and all(
        isinstance(one, int | float) and abs(one) < _MOST_WEIGHT for one in rest
    )
    if not known or len(rest) != targets:
        raise FormatError(
            f"{path} is damaged: node {number} has {targets} morph targets, and no {targets} numbers for their weights"
        )
    return rest


def _targets(mesh: dict[str, Any]) -> list[Any]:
    """Morph targets of a mesh, which all its primitives have."""
    return listed(record(next(iter(listed(mesh.get("primitives"))), None)).get("targets"))


def _named_targets(mesh: dict[str, Any]) -> list[str]:
    """Names of a mesh's morph targets; none where they are not as many."""
    names = target_names(mesh)
    return names if len(names) == len(_targets(mesh)) else []


def _key(name: str) -> str:
    lower = name.lower()
    for short, long in (("_l", "_left"), ("_r", "_right")):
        if lower.endswith(short):
            lower = lower.removesuffix(short) + long
    return lower.replace("_", "")
