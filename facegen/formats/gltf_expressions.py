"""Reads which morph targets the expressions of a VRM avatar move, and by how much.

What an expression does beside that (colours, textures, keeping other expressions back) is no animation of glTF's, and
is left out. A record that is damaged is no expression.

References
----------
.. [1] VRM Consortium, "VRMC_vrm 1.0", expressions: ``preset`` and ``custom`` with ``morphTargetBinds`` of nodes,
   weights from 0 to 1; one that is binary is whole from beyond one half. ``lookAt.type`` is bone or expression.
.. [2] VRM Consortium, "VRM 0.x": ``blendShapeMaster.blendShapeGroups`` with ``binds`` of meshes, weights from 0 to
   100. ``firstPerson.lookAtTypeName`` is Bone or BlendShape.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from facegen.formats.gltf_head import listed, record

_VRM_0_WHOLE = 100

_LOOKS = ("lookup", "lookdown", "lookleft", "lookright")
"""Presets of either VRM, in small letters; ``eyeLookUpLeft`` and others of ARKit's are custom ones."""


@dataclass(frozen=True, kw_only=True)
class Bind:
    """One morph target that an expression moves.

    Parameters
    ----------
    node, target
        Of which node's mesh which target, by their numbers.
    weight
        Of the target where the expression's own is 1.
    """

    node: int
    target: int
    weight: float


@dataclass(frozen=True, kw_only=True)
class Expression:
    """One expression, as far as it moves morph targets.

    Parameters
    ----------
    name
        As the avatar has it; a preset's is VRM's.
    binds
        At least one.
    binary
        Whether there is nothing between not at all and whole.
    """

    name: str
    binds: tuple[Bind, ...]
    binary: bool = False


def read_expressions(document: dict[str, Any]) -> list[Expression]:
    """Expressions with morph targets, of a document of either VRM; none where it is no VRM."""
    extensions = record(document.get("extensions"))
    found = _of_vrm_1(extensions) if "VRMC_vrm" in extensions else _of_vrm_0(extensions, document)
    return [expression for expression in found if expression.binds]


def look_expressions(document: dict[str, Any]) -> list[str]:
    """Names of the expressions that turn the eyes, of a VRM that says that expressions do so and not bones."""
    extensions = record(document.get("extensions"))
    one = record(record(extensions.get("VRMC_vrm")).get("lookAt")).get("type") == "expression"
    other = record(record(extensions.get("VRM")).get("firstPerson")).get("lookAtTypeName") == "BlendShape"
    if not (one if "VRMC_vrm" in extensions else other):
        return []
    names = [expression.name for expression in read_expressions(document)]
    return [name for name in names if name.lower() in _LOOKS or name.lower().startswith("eyelook")]


def _of_vrm_1(extensions: dict[str, Any]) -> Iterator[Expression]:
    expressions = record(record(extensions.get("VRMC_vrm")).get("expressions"))
    for kind in ("preset", "custom"):
        for name, given in record(expressions.get(kind)).items():
            binds = (
                _bind(bind.get("node"), bind.get("index"), bind.get("weight"), 1)
                for bind in map(record, listed(record(given).get("morphTargetBinds")))
            )
            yield Expression(name=name, binds=_known(binds), binary=record(given).get("isBinary") is True)


def _of_vrm_0(extensions: dict[str, Any], document: dict[str, Any]) -> Iterator[Expression]:
    meshes: dict[object, list[int]] = {}
    for number, node in enumerate(map(record, listed(document.get("nodes")))):
        if _is_number(node.get("mesh")):
            meshes.setdefault(node["mesh"], []).append(number)
    groups = record(record(extensions.get("VRM")).get("blendShapeMaster")).get("blendShapeGroups")
    for group in map(record, listed(groups)):
        preset = group.get("presetName")
        name = preset if isinstance(preset, str) and preset not in ("", "unknown") else group.get("name")
        binds = (
            _bind(node, bind.get("index"), bind.get("weight"), _VRM_0_WHOLE)
            for bind in map(record, listed(group.get("binds")))
            if _is_number(bind.get("mesh"))
            for node in meshes.get(bind["mesh"], [])
        )
        yield Expression(name=str(name), binds=_known(binds), binary=group.get("isBinary") is True)


def _known(binds: Iterator[Bind | None]) -> tuple[Bind, ...]:
    return tuple(bind for bind in binds if bind is not None)


def _bind(node: object, target: object, weight: object, whole: float) -> Bind | None:
    if not (_is_number(node) and _is_number(target)) or isinstance(weight, bool):
        return None
    if not isinstance(weight, int | float) or not 0 <= weight <= whole:
        return None
    return Bind(node=node, target=target, weight=weight / whole)


def _is_number(value: object) -> bool:
    """Whether something can be a record's number; in Python true and false are whole numbers as well."""
    return isinstance(value, int) and not isinstance(value, bool) and value >= 0
