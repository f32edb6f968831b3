"""Avatars that nobody may bring, by what is wrong with them, with the sentence that refuses each."""

import struct

from room.avatars.check import (
    MOST_AVATAR_BYTES,
    MOST_DOCUMENT_BYTES,
    MOST_DRAWN,
    MOST_NODES,
    MOST_TRIANGLES,
)
from room.gltf.check import MOST_PICTURES, MOST_SIDE_PIXELS, MOST_TEXTURE_PIXELS
from room.gltf.extensions import HOW
from room.gltf.moved import (
    MOST_BINDS,
    MOST_CHANNELS,
    MOST_COLLISIONS,
    MOST_JOINTS,
    MOST_LIGHTS,
    MOST_SCENES,
    MOST_SPRUNG,
)
from room.gltf.numbers import MOST_NUMBERS
from tests.room.avatars import POINTS, avatar, png, textured


def nodes(count: int):
    return lambda made: made["nodes"].extend({} for _ in range(count))


def at(*path: object, **values: object):
    """Change a record of the document."""

    def change(made: dict) -> None:
        for key in path:
            made = made[key]
        made.update(values)

    return change


def with_zeros(primitive: dict | None = None, *, count: int, type: str = "VEC3", **records: object) -> bytes:
    """An avatar with an accessor (2) that has no view, whatever may read it."""

    def change(made: dict) -> None:
        zeros = {"componentType": 5125 if type == "SCALAR" else 5126, "count": count, "type": type}
        made["accessors"] = [*made["accessors"][:2], zeros]
        made.update(records)
        if primitive:
            made["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}, **primitive})

    return avatar(change)


def springs(*, joints: int = 1, colliders: int = 1, groups: int = 0, named: list | None = None):
    """Springs of VRM 1: a group of all colliders, and more of none."""
    spring = {"joints": [{"node": 1}] * joints, "colliderGroups": named or [*range(groups + 1)]}
    springs = {
        "specVersion": "1.0",
        "colliders": [{"node": 1, "shape": {"sphere": {}}}] * colliders,
        "colliderGroups": [{"colliders": [*range(colliders)]}, *[{"colliders": []}] * groups],
        "springs": [spring],
    }
    return at(extensions={"VRMC_springBone": springs})


def old_springs(*, bones: list = [1], colliders: int = 1, named: list = [0]):  # noqa: B006
    """Springs of VRM 0."""
    group = {"node": 1, "colliders": [{"radius": 0.1}] * colliders}
    springs = {"boneGroups": [{"bones": bones, "colliderGroups": named}], "colliderGroups": [group]}
    return at(extensions={"VRM": {"secondaryAnimation": springs}})


def expressions(**binds: list) -> dict:
    return {"VRMC_vrm": {"expressions": {"preset": {"aa": binds}}}}


def old_expressions(**binds: list) -> dict:
    return {"VRM": {"blendShapeMaster": {"blendShapeGroups": [{"name": "A", **binds}]}}}


def _many_pictures(made: dict) -> None:
    made["images"] *= MOST_PICTURES + 1


def _large_pictures(made: dict) -> None:
    made["images"] *= MOST_TEXTURE_PIXELS // MOST_SIDE_PIXELS**2 + 1


LAMP = {"KHR_lights_punctual": {"light": 0}}

LARGE = png(MOST_SIDE_PIXELS, MOST_SIDE_PIXELS, whole=False)

REFUSED = {
    "nothing": (b"", "is not a binary glTF"),
    "text": (b"{}", "is not a binary glTF"),
    "too large": (bytes(MOST_AVATAR_BYTES + 1), "smaller textures"),
    "cut": (avatar()[:-8], "is cut off"),
    "a document that is too large": (
        avatar(lambda made: made.update(extras="x" * MOST_DOCUMENT_BYTES)),
        "document",
    ),
    "a file beside it": (avatar(at("images", 0, uri="https://elsewhere.example/skin.png")), "beside itself"),
    "a buffer beside it": (avatar(at("buffers", 0, uri="body.bin")), "beside itself"),
    "an address in an extension": (
        avatar(lambda made: made.update(extensions={"X": [{"a": {"uri": "javascript:alert(1)"}}]})),
        "beside itself",
    ),
    "behaviour": (avatar(lambda made: made.update(extensionsUsed=["KHR_interactivity"])), "acts by itself"),
    "sound": (avatar(lambda made: made.update(extensionsUsed=["KHR_audio_emitter"])), "acts by itself"),
    "copies": (
        avatar(lambda made: made.update(extensionsUsed=["EXT_mesh_gpu_instancing"])),
        "acts by itself",
    ),
    "copies that nobody declared": (
        avatar(at("nodes", 0, extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}})),
        "acts by itself",
    ),
    "many lamps": (
        avatar(lambda made: made["nodes"].extend([{"extensions": LAMP}] * (MOST_LIGHTS + 1))),
        "without lights",
    ),
    "a shape of no mesh": (
        avatar(at("meshes", 0, "primitives", 0, attributes={}, indices=1)),
        "moves other vertices",
    ),
    "a shape of other directions alone": (
        avatar(at("meshes", 0, "primitives", 0, targets=[{"NORMAL": 1}])),
        "moves other vertices",
    ),
    "shapes of one vertex": (avatar(at("accessors", 1, count=1)), "moves other vertices"),
    "shapes that move nothing": (
        with_zeros(
            {"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}] + [{}] * 2_000}, count=10_000
        ),
        "fewer vertices",
    ),
    "a skin of many joints": (avatar(at(skins=[{"joints": [0, 1] * MOST_JOINTS}])), "joints in its skins"),
    "a joint that is not there": (avatar(at(skins=[{"joints": [2]}])), "names node 2"),
    "many scenes": (avatar(at(scenes=[{}] * (MOST_SCENES + 1))), "scenes"),
    "a scene of one node many times": (avatar(at(scenes=[{"nodes": [0] * (MOST_NODES + 1)}])), "scenes"),
    "many movements": (
        with_zeros(
            count=1,
            animations=[
                {"samplers": [{"input": 2, "output": 2}], "channels": [{"sampler": 0}] * (MOST_CHANNELS + 1)}
            ],
        ),
        "without animations",
    ),
    "springs of many joints": (avatar(springs(joints=MOST_SPRUNG + 1)), "fewer bones springs"),
    "springs of many colliders": (avatar(springs(colliders=MOST_SPRUNG + 1)), "fewer bones springs"),
    "springs beside many colliders": (
        avatar(springs(joints=1_000, colliders=MOST_COLLISIONS // 1_000 + 1)),
        "fewer colliders",
    ),
    "springs beside many groups of none": (
        avatar(springs(joints=1_000, groups=MOST_COLLISIONS // 1_000 + 1)),
        "fewer colliders",
    ),
    "springs of a group by its text": (avatar(springs(named=["0"])), "no whole number"),
    "old springs of many colliders": (avatar(old_springs(colliders=MOST_SPRUNG + 1)), "fewer bones springs"),
    "old springs again and again": (avatar(old_springs(bones=[0] * 3_000)), "fewer bones springs"),
    "old springs beside many colliders": (
        avatar(old_springs(bones=[0] * 10, colliders=100, named=[0] * 200)),
        "fewer colliders",
    ),
    "old springs of a bone by its text": (avatar(old_springs(bones=["0"])), "no whole number"),
    "many expressions": (
        avatar(
            at(
                extensions={
                    "VRMC_vrm": {"expressions": {"custom": {f"a{n}": {} for n in range(MOST_BINDS + 1)}}}
                }
            )
        ),
        "fewer expressions",
    ),
    "an expression of many shapes": (
        avatar(at(extensions=expressions(morphTargetBinds=[{"node": 0, "index": 0}] * MOST_BINDS))),
        "fewer expressions",
    ),
    "an old expression of one mesh many times": (
        avatar(
            lambda made: (
                made["nodes"].extend([{"mesh": 0}] * 99),
                at(extensions=old_expressions(binds=[{"mesh": 0, "index": 0}] * (MOST_BINDS // 100)))(made),
            )
        ),
        "fewer expressions",
    ),
    "old expressions of many materials": (
        avatar(at(extensions=old_expressions(materialValues=[{"materialName": "a"}] * MOST_BINDS))),
        "fewer expressions",
    ),
    "Draco": (
        avatar(lambda made: made.update(extensionsRequired=["KHR_draco_mesh_compression"])),
        HOW["KHR_draco_mesh_compression"],
    ),
    "an extension that nobody knows": (
        avatar(lambda made: made.update(extensionsRequired=["ACME_x"])),
        "ACME_x",
    ),
    "SVG": (
        textured(b"<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>"),
        "is no PNG",
    ),
    "half a picture": (textured(png(4, 4)[:12]), "is no PNG"),
    "a wide texture": (textured(png(MOST_SIDE_PIXELS + 1, 1, whole=False)), "a side"),
    "many textures": (avatar(_many_pictures), "textures"),
    "large textures": (
        avatar(
            lambda made: (_large_pictures(made), made["bufferViews"][1].update(byteLength=len(LARGE))),
            POINTS + LARGE,
        ),
        "together",
    ),
    "no mesh": (avatar(at("nodes", 0, mesh=None)), "nothing to look at"),
    "points alone": (avatar(at("meshes", 0, "primitives", 0, mode=0)), "nothing to look at"),
    "many triangles by zeros": (
        avatar(
            lambda made: (
                at("accessors", 1, count=3 * MOST_TRIANGLES + 3, type="SCALAR", componentType=5125)(made),
                at("meshes", 0, "primitives", 0, indices=1, targets=[])(made),
            )
        ),
        "triangles",
    ),
    "one mesh many times": (avatar(lambda made: made["nodes"].extend([{"mesh": 0}] * MOST_DRAWN)), "parts"),
    "a shape of zeros": (
        with_zeros(
            {"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}], "mode": 0}, count=MOST_NUMBERS // 3
        ),
        "fewer vertices",
    ),
    "one shape again and again": (
        with_zeros({"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}] * 2_001}, count=10_000),
        "fewer vertices",
    ),
    "indices of points": (
        with_zeros({"mode": 0, "indices": 2}, count=2**31, type="SCALAR"),
        "fewer vertices",
    ),
    "indices of lines": (
        with_zeros({"mode": 1, "indices": 2}, count=2**28, type="SCALAR"),
        "fewer vertices",
    ),
    "a skin of zeros": (with_zeros(count=2**28, type="MAT4", skins=[{"inverseBindMatrices": 2}]), "bones"),
    "a skin again and again": (
        with_zeros(count=2**20, type="MAT4", skins=[{"inverseBindMatrices": 2}] * 4),
        "bones",
    ),
    "a movement of zeros": (
        with_zeros(count=2**30, animations=[{"samplers": [{"input": 2, "output": 2}]}]),
        "without animations",
    ),
    "a movement of many things": (
        with_zeros(
            count=10**6,
            animations=[{"samplers": [{"input": 2, "output": 2}], "channels": [{"sampler": 0}] * 10}],
        ),
        "without animations",
    ),
    "zeros that nothing names": (with_zeros(count=2**30), "fewer vertices"),
    "a movement that is not there": (
        with_zeros(count=3, animations=[{"channels": [{"sampler": 0}]}]),
        "names sampler 0",
    ),
    "many nodes": (avatar(nodes(MOST_NODES)), "nodes"),
    "a node below itself": (avatar(at("nodes", 1, children=[0])), "hang on themselves"),
    "a node below two": (avatar(lambda made: made["nodes"].append({"children": [1]})), "hangs on two"),
    "a node that is not there": (avatar(at("nodes", 1, children=[7])), "names node 7"),
    "a mesh that is not there": (avatar(at("nodes", 0, mesh=1)), "names mesh 1"),
    "an accessor that is not there": (
        avatar(at("meshes", 0, "primitives", 0, attributes={"POSITION": 9})),
        "names accessor 9",
    ),
    "a view behind the file": (avatar(at("bufferViews", 0, byteLength=10**6)), "ends behind"),
    "an accessor behind its view": (avatar(at("accessors", 0, count=4)), "reads behind"),
    "a buffer without bytes": (avatar(at("buffers", 0, byteLength=10**6)), "binary part"),
    "two buffers": (avatar(lambda made: made["buffers"].append({"byteLength": 4})), "binary part"),
    "sparse values that are too many": (
        avatar(
            at(
                "accessors",
                1,
                sparse={
                    "count": 4,
                    "indices": {"bufferView": 0, "componentType": 5121},
                    "values": {"bufferView": 0},
                },
            )
        ),
        "sparse",
    ),
    "a component of no kind": (avatar(at("accessors", 0, componentType=5130)), "of no kind"),
    "a count of text": (avatar(at("accessors", 0, count="3")), "accessors[0].count"),
    "a negative offset": (avatar(at("accessors", 0, byteOffset=-4)), "accessors[0].byteOffset"),
    "chunks without end": (
        avatar()[:8] + struct.pack("<I", 0) + struct.pack("<I4s", 0, b"JSON") * 2000,
        "chunks",
    ),
}
