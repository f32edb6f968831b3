"""Finds the bones of an avatar's eyes, where no morph target turns the same eyeballs.

Some avatars have eye bones, and eyeLook targets that turn what hangs on them: those would turn twice. Where the targets
move lids alone, bones and targets work together. The page in the browser has the same rule (web/avatar/eyes.ts).
"""

from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError
from facegen.formats.gltf import COMPRESSIONS, GltfFile, accessor_values, damage_told
from facegen.formats.gltf_buffers import read_buffers
from facegen.formats.gltf_container import read_gltf_bytes
from facegen.formats.gltf_head import HeadBone, listed, named_bone
from facegen.formats.gltf_targets import target_names

_SIDES = ("left", "right")
_LOOKS = tuple(f"eyelookout{side}" for side in _SIDES)


def eye_bones(document: dict[str, Any], path: Path) -> tuple[HeadBone, ...]:
    """The left and the right eye's bone of a binary file; neither where one is missing or a target turns an eye.

    What cannot be read of the file's meshes, as where they are compressed, is taken for a target that does.
    """
    bones = _both_bones(document)
    if not bones or not _has_looks(document):
        return bones
    if _is_compressed(document):
        return ()
    with suppress(FormatError), damage_told(path):
        from pygltflib import GLTF2

        gltf = GLTF2().load_from_bytes(read_gltf_bytes(path))
        file = GltfFile(gltf, read_buffers(gltf, path.parent))
        turning = (_turns(file, bone.node, name) for bone, name in zip(bones, _LOOKS, strict=True))
        if not any(turning):
            return bones
    return ()


def hides_eyes(document: dict[str, Any]) -> bool:
    """Whether eyes have bones that are left alone because the meshes are compressed."""
    return bool(_both_bones(document)) and _has_looks(document) and _is_compressed(document)


def _both_bones(document: dict[str, Any]) -> tuple[HeadBone, ...]:
    bones = tuple(named_bone(document, f"{side}Eye") for side in _SIDES)
    return () if None in bones else bones


def _has_looks(document: dict[str, Any]) -> bool:
    return any(_letters(name) in _LOOKS for mesh in document.get("meshes", []) for name in target_names(mesh))


def _is_compressed(document: dict[str, Any]) -> bool:
    named = [name for key in ("extensionsUsed", "extensionsRequired") for name in listed(document.get(key))]
    return any(name in named for name in COMPRESSIONS)


def _turns(file: GltfFile, bone: int, name: str) -> bool:
    """Whether a morph target of that name moves what hangs on a bone."""
    below = _below(file, bone)
    for number, node in enumerate(file.gltf.nodes):
        if node.mesh is None:
            continue
        mesh = file.item("meshes", node.mesh)
        targets = [at for at, one in enumerate(target_names(mesh)) if _letters(one) == name]
        for primitive in mesh.primitives if targets else ():
            moved = _moved(file, primitive, targets[0])
            if number in below and moved.any():
                return True
            if node.skin is not None and (moved & _carried(file, node.skin, primitive, bone)).any():
                return True
    return False


def _moved(file: GltfFile, primitive: Any, target: int) -> np.ndarray:
    """Which vertices (V,) a target moves."""
    record = primitive.targets[target]
    positions = (record if isinstance(record, dict) else vars(record)).get("POSITION")
    count = file.item("accessors", primitive.attributes.POSITION).count
    if positions is None:
        return np.zeros(count, dtype=bool)
    return accessor_values(file, positions, "VEC3", count).any(axis=1)


def _carried(file: GltfFile, skin: int, primitive: Any, bone: int) -> np.ndarray:
    """Which vertices (V,) hang on a bone by more than half."""
    joints = np.array(file.item("skins", skin).joints)
    count = file.item("accessors", primitive.attributes.POSITION).count
    chosen = accessor_values(file, primitive.attributes.JOINTS_0, "VEC4", count).astype(int)
    shares = accessor_values(file, primitive.attributes.WEIGHTS_0, "VEC4", count)
    return (shares * (joints[chosen] == bone)).sum(axis=1) > 0.5


def _below(file: GltfFile, bone: int) -> set[int]:
    """The bone, and all nodes that hang on it."""
    found, waiting = set(), [bone]
    while waiting:
        number = waiting.pop()
        if number not in found:
            found.add(number)
            waiting += file.item("nodes", number).children or []
    return found


def _letters(name: str) -> str:
    """Of a target's name; ``_L`` and ``_R`` at its end are sides."""
    text = name
    for short, long in (("_L", "Left"), ("_R", "Right")):
        text = text.removesuffix(short) + long if text.endswith(short) else text
    return "".join(filter(str.isalnum, text.lower()))
