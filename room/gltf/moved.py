"""Counts what a browser moves for a glTF file in every picture, or goes through at the start, and bounds it.

References
----------
.. [1] https://github.com/vrm-c/vrm-specification, which says where springs and expressions of both versions stand.
"""

from collections import Counter
from itertools import chain
from typing import Any

from room.errors import FormatError
from room.gltf.document import Document, named
from room.gltf.extensions import LIGHTS

MOST_JOINTS = 20_000
"""Of all skins together: avatars have 20 to 300 bones, and some have a skin of all of them for each of 20 meshes."""

MOST_SPRUNG = 4_000
"""Joints of springs and their colliders: hair and clothes have up to some hundred."""

MOST_COLLISIONS = 150_000
"""Joints times the colliders that each is held against in every picture: hair of 300 joints beside ten has 3,000, and
VRM 0 has everything below a bone spring, 900 joints beside 56. Of these, 50,000 take a page 1.3 to 2.5 ms."""

MOST_BINDS = 10_000
"""What expressions change, and they themselves: 70 expressions of ten meshes have 770. What changes materials counts
for each part that is drawn."""

MOST_CHANNELS = 10_000
"""Movements of single nodes in all animations: a walk of 65 bones has 195."""

MOST_SCENES = 16
"""One is seen; each is gone through."""

MOST_LIGHTS = 64
"""Lamps of all nodes: scenes of modellers have one to ten, and a graphics card counts each in every picture."""


def check_moved(told: Document, drawn: Counter[int], parts: int, *, most_nodes: int) -> None:
    """Refuse what would take a browser's time in every picture.

    Parameters
    ----------
    told
        The document, whose nodes are a tree.
    drawn
        How often each mesh is.
    parts
        That are drawn one by one.
    most_nodes
        Of this kind of file: scenes have no more of them either.

    Raises
    ------
    FormatError
        If there is too much; it begins behind the name of the file.
    """
    for scene in told.scenes:
        for node in scene.nodes:
            named(told.nodes, node, "node")
    for joint in chain.from_iterable(skin.joints for skin in told.skins):
        named(told.nodes, joint, "node")
    sprung, collisions = _sprung(told)
    for amount, most, what, help in (
        (len(told.scenes), MOST_SCENES, "scenes", "export one alone"),
        (sum(len(scene.nodes) for scene in told.scenes), most_nodes, "nodes in its scenes", "join some"),
        (
            sum(len(skin.joints) for skin in told.skins),
            MOST_JOINTS,
            "joints in its skins",
            "join meshes of one skin",
        ),
        (
            sum(len(each.channels) for each in told.animations),
            MOST_CHANNELS,
            "movements",
            "export it without animations",
        ),
        (sprung, MOST_SPRUNG, "joints and colliders of springs", "give fewer bones springs"),
        (
            collisions,
            MOST_COLLISIONS,
            "joints of springs times colliders",
            "give its springs fewer colliders",
        ),
        (
            sum(LIGHTS in node.extensions for node in told.nodes),
            MOST_LIGHTS,
            "lamps",
            "export it without lights",
        ),
        (
            _binds(told, drawn, parts),
            MOST_BINDS,
            "changes by its expressions",
            "export it with fewer expressions",
        ),
    ):
        if amount > most:
            raise FormatError(f"has {amount:,} {what}, and at most {most:,} are loaded; {help}")


def _sprung(told: Document) -> tuple[int, int]:
    """Joints and colliders of springs, and how many of these are held against each other in every picture."""
    found = [_springs(told.extensions.get("VRMC_springBone")), _springs_of_0(told)]
    return sum(amount for amount, _ in found), sum(collisions for _, collisions in found)


def _springs(extension: object) -> tuple[int, int]:
    groups = [len(_list(group, "colliders")) for group in _list(extension, "colliderGroups")]
    amount, collisions = len(_list(extension, "colliders")), 0
    for spring in _list(extension, "springs"):
        joints = len(_list(spring, "joints"))
        amount += joints
        collisions += joints * _held_against(spring, groups)
    return amount, collisions


def _springs_of_0(told: Document) -> tuple[int, int]:
    """The same of VRM 0, where all that hangs on a bone springs with it, its colliders as well."""
    extension = _get(told.extensions.get("VRM"), "secondaryAnimation")
    groups, held = [], Counter[int]()
    for group in _list(extension, "colliderGroups"):
        groups.append(len(_list(group, "colliders")))
        held[_number(_get(group, "node"))] += groups[-1]
    below = _below(told, held)
    amount = collisions = 0
    for spring in _list(extension, "boneGroups"):
        bones = (_number(bone) for bone in _list(spring, "bones"))
        joints = sum(below[bone] for bone in bones if 0 <= bone < len(below))
        amount += joints
        collisions += joints * _held_against(spring, groups)
    return amount + sum(groups), collisions


def _held_against(spring: object, groups: list[int]) -> int:
    """Colliders of a spring; also groups of none are gone through."""
    held = (_number(group) for group in _list(spring, "colliderGroups"))
    return sum(1 + groups[group] for group in held if 0 <= group < len(groups))


def _below(told: Document, held: Counter[int]) -> list[int]:
    """Of each node, how many hang on it, itself among them, with what else ``held`` says of each."""
    children = set(chain.from_iterable(node.children for node in told.nodes))
    order = [number for number in range(len(told.nodes)) if number not in children]
    for number in order:  # grows while it is gone through
        order += told.nodes[number].children
    below = [1 + held[number] for number in range(len(told.nodes))]
    for number in reversed(order):
        below[number] += sum(below[child] for child in told.nodes[number].children)
    return below


def _binds(told: Document, drawn: Counter[int], parts: int) -> int:
    """Expressions and what they change: shapes of a mesh wherever it is drawn, and materials at most in all parts."""
    binds = 0
    expressions = _get(told.extensions.get("VRMC_vrm"), "expressions")
    for kind in ("preset", "custom"):
        found = _get(expressions, kind)
        for expression in found.values() if isinstance(found, dict) else ():
            materials = _list(expression, "materialColorBinds") + _list(expression, "textureTransformBinds")
            binds += 1 + len(_list(expression, "morphTargetBinds")) + len(materials) * parts
    for group in _list(_get(told.extensions.get("VRM"), "blendShapeMaster"), "blendShapeGroups"):
        meshes = [_get(bind, "mesh") for bind in _list(group, "binds")]
        shapes = sum(max(1, drawn[_number(mesh)]) for mesh in meshes if mesh is not None)
        binds += 1 + shapes + len(_list(group, "materialValues")) * parts
    return binds


def _number(found: object) -> int:
    """A number of the file's records, -1 where it is none; browsers would take texts for one as well."""
    if found is None:
        return -1
    if type(found) is float and found.is_integer():  # as some exporters write whole ones
        return int(found)
    if type(found) is not int:
        raise FormatError("is damaged: its springs or expressions name something by what is no whole number")
    return found


def _get(record: object, key: str) -> Any:
    return record.get(key) if isinstance(record, dict) else None


def _list(record: object, key: str) -> list:
    """A list of a record; what is none there has a browser fail by itself."""
    found = _get(record, key)
    return found if isinstance(found, list) else []
