"""Small heads for tests: an egg with two eyes, a morph target for each of the 52 shapes, and bones; as .glb or .vrm."""

import json
import struct
from collections.abc import Callable, Sequence

import numpy as np

from facegen.conventions import BLENDSHAPES

BONES = {"hips": ((0, 0.9, 0), None), "neck": ((0, 0.5, 0), "hips"), "head": ((0, 0.1, 0), "neck")}
EYES = {"leftEye": (0.032, 0.11, 0.075), "rightEye": (-0.032, 0.11, 0.075)}
OTHERS = (
    *("spine", "leftUpperArm", "leftLowerArm", "leftHand", "rightUpperArm", "rightLowerArm", "rightHand"),
    *("leftUpperLeg", "leftLowerLeg", "leftFoot", "rightUpperLeg", "rightLowerLeg", "rightFoot"),
)
"""Bones that VRM asks for and that these heads do not need; they hang on the hips."""


def egg(rows: int, columns: int, radii: Sequence[float]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (n, 3) float32 and triangles (m, 3) uint16 of an ellipsoid, poles up and down."""
    down, around = np.meshgrid(np.linspace(0, np.pi, rows), np.linspace(0, 2 * np.pi, columns), indexing="ij")
    sphere = np.stack([np.sin(down) * np.sin(around), np.cos(down), np.sin(down) * np.cos(around)], axis=-1)
    first = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).reshape(-1)
    below = first + columns
    triangles = np.concatenate([[first, below, first + 1], [first + 1, below, below + 1]], axis=1).T
    return (sphere.reshape(-1, 3) * radii).astype(np.float32), triangles.astype(np.uint16)


class _File:
    """Collects what a .glb holds."""

    def __init__(self) -> None:
        self.views, self.accessors, self.binary = [], [], b""

    def add(self, values: np.ndarray, kind: str, **more: object) -> int:
        component = {"f4": 5126, "u2": 5123, "u1": 5121}[values.dtype.str[1:]]
        self.views.append({"buffer": 0, "byteOffset": len(self.binary), "byteLength": values.nbytes, **more})
        self.binary += values.tobytes() + bytes(-values.nbytes % 4)
        bounds = {"min": values.min(0).tolist(), "max": values.max(0).tolist()} if kind == "VEC3" else {}
        count = values.size if kind == "SCALAR" else len(values)
        self.accessors.append(
            {
                "bufferView": len(self.views) - 1,
                "componentType": component,
                "count": count,
                "type": kind,
                **bounds,
            }
        )
        return len(self.accessors) - 1


def head(
    *,
    spell: Callable[[str], str] = str,
    shapes: Sequence[str] = BLENDSHAPES,
    colour: Sequence[float] = (0.75, 0.55, 0.45, 1.0),
    leaning: bool = False,
    body: bool = False,
    vrm: Callable[[dict[str, int], list[str]], dict] | None = None,
) -> bytes:
    """A .glb.

    Parameters
    ----------
    spell
        How it spells the names of its shapes.
    shapes
        Those that it has.
    colour
        Of its skin.
    leaning
        Whether its neck's bone lies on its back at rest, with head and eyes in its frame, as Blender's bones do.
    body
        Whether it has a body as high as a person and, with its arms held out, as wide.
    vrm
        Makes the extensions of a VRM from its nodes by name, and its shapes.
    """
    file, names = _File(), ["mesh", *BONES, *EYES, *(OTHERS if vrm else ())]
    nodes = [{"name": name} for name in names]
    joints = [names.index(name) for name in (*BONES, *EYES)]
    for name, (place, parent) in BONES.items():
        nodes[names.index(name)]["translation"] = list(place)
        if parent:
            nodes[names.index(parent)].setdefault("children", []).append(names.index(name))
    for name, place in EYES.items():
        nodes[names.index(name)]["translation"] = list(place)
        nodes[names.index("head")].setdefault("children", []).append(names.index(name))
    nodes[names.index("hips")].setdefault("children", []).extend(
        names.index(name) for name in (OTHERS if vrm else ())
    )
    lying = np.eye(3)
    if leaning:  # a quarter turn about x: y goes to z
        lying = np.array([[1.0, 0, 0], [0, 0, -1], [0, 1, 0]])
        nodes[names.index("neck")]["rotation"] = [float(np.sqrt(0.5)), 0.0, 0.0, float(np.sqrt(0.5))]
        for name in ("head", *EYES):
            node = nodes[names.index(name)]
            node["translation"] = (lying.T @ node["translation"]).tolist()
    at = {"hips": np.array([0, 0.9, 0]), "neck": np.array([0, 1.4, 0]), "head": np.array([0, 1.5, 0])}
    at |= {name: at["head"] + place for name, place in EYES.items()}

    skin, skin_triangles = egg(28, 40, (0.075, 0.12, 0.09))
    skin += (at["head"] + [0, 0.09, 0]).astype(np.float32)
    ball, ball_triangles = egg(12, 16, (0.014, 0.014, 0.014))
    parts = [(skin, skin_triangles, "head", colour)]
    parts += [
        (ball + at[name].astype(np.float32), ball_triangles, name, (0.95, 0.95, 0.95, 1)) for name in EYES
    ]
    if body:
        trunk, trunk_triangles = egg(8, 12, (0.8, 0.75, 0.1))
        parts.append((trunk + np.float32([0, 0.75, 0]), trunk_triangles, "hips", colour))
    primitives, materials = [], []
    for number, (vertices, triangles, bone, paint) in enumerate(parts):
        joint = np.zeros((len(vertices), 4), np.uint8)
        joint[:, 0] = [*BONES, *EYES].index(bone)
        share = np.tile(np.array([1, 0, 0, 0], np.float32), (len(vertices), 1))
        targets = []
        for index in range(len(shapes)):
            moved = np.zeros_like(vertices)
            if bone == "head":  # each shape pushes a dent of its own, all over the front
                angle = 2.4 * index
                place = np.array([0.04 * np.cos(angle), 0.09 + 0.07 * np.sin(angle), 0.08]) + at["head"]
                moved = -0.03 * np.exp(-((np.linalg.norm(vertices - place, axis=1) / 0.02) ** 2))[:, None]
                moved = (moved * [0, 0, 1]).astype(np.float32)
            targets.append({"POSITION": file.add(moved, "VEC3")})
        normals = vertices - vertices.mean(0)
        normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-9)
        attributes = {
            "POSITION": file.add(vertices, "VEC3", target=34962),
            "NORMAL": file.add(normals.astype(np.float32), "VEC3", target=34962),
            "JOINTS_0": file.add(joint, "VEC4", target=34962),
            "WEIGHTS_0": file.add(share, "VEC4", target=34962),
        }
        materials.append({"pbrMetallicRoughness": {"baseColorFactor": list(paint), "metallicFactor": 0.0}})
        primitives.append(
            {
                "attributes": attributes,
                "indices": file.add(triangles.reshape(-1), "SCALAR", target=34963),
                "material": number,
            }
            | ({"targets": targets} if targets else {})
        )
    inverse = np.tile(np.eye(4, dtype=np.float32), (len(joints), 1, 1))
    for joint, name in enumerate((*BONES, *EYES)):
        upright = np.eye(3) if name == "hips" else lying.T
        inverse[joint, :3, :3], inverse[joint, :3, 3] = upright, -upright @ at[name]
    spelled = [spell(name) for name in shapes]
    document = {
        "asset": {"version": "2.0", "generator": "tests of facegen"},
        "scene": 0,
        "scenes": [{"nodes": [0, names.index("hips")]}],
        "nodes": nodes,
        "meshes": [{"primitives": primitives, "extras": {"targetNames": spelled}}],
        "materials": materials,
        "skins": [
            {
                "joints": joints,
                "inverseBindMatrices": file.add(inverse.transpose(0, 2, 1).reshape(-1, 16), "MAT4"),
            }
        ],
        "bufferViews": file.views,
        "accessors": file.accessors,
        "buffers": [{"byteLength": len(file.binary)}],
    }
    nodes[0] |= {"mesh": 0, "skin": 0}
    if vrm:
        extensions = vrm({name: number for number, name in enumerate(names)}, spelled)
        document |= {"extensions": extensions, "extensionsUsed": list(extensions)}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    size = 12 + 8 + len(text) + 8 + len(file.binary)
    return b"".join(
        (
            struct.pack("<III", 0x46546C67, 2, size),
            struct.pack("<II", len(text), 0x4E4F534A) + text,
            struct.pack("<II", len(file.binary), 0x004E4942) + file.binary,
        )
    )


def _bind(index: int, weight: float = 1.0) -> dict:
    return {"morphTargetBinds": [{"node": 0, "index": index, "weight": weight}]}


HALVED = "CheekPuff"
"""An expression that moves its morph target half the way, as makers tune them."""


def vrm1(nodes: dict[str, int], shapes: list[str], *, custom: bool = True) -> dict:
    """VRM 1.0: Perfect Sync's expressions, or presets alone; eyes by bones, 10 degrees for 90."""
    far = {"inputMaxValue": 90.0, "outputScale": 10.0}
    presets = {
        "aa": "jawOpen",
        "ou": "mouthPucker",
        "blinkLeft": "eyeBlinkLeft",
        "blinkRight": "eyeBlinkRight",
    }
    spelled = [shape[0].lower() + shape[1:] for shape in shapes]
    return {
        "VRMC_vrm": {
            "specVersion": "1.0",
            "meta": {"name": "egg", "authors": ["facegen"], "licenseUrl": "https://vrm.dev/licenses/1.0/"},
            "humanoid": {
                "humanBones": {name: {"node": node} for name, node in nodes.items() if name != "mesh"}
            },
            "expressions": {
                "preset": {name: _bind(spelled.index(shape)) for name, shape in presets.items()},
                "custom": {
                    name: _bind(index, 0.5 if name == HALVED else 1.0) for index, name in enumerate(shapes)
                }
                if custom
                else {},
            },
            "lookAt": {
                "type": "bone",
                "offsetFromHeadBone": [0, 0.1, 0],
                **{
                    f"rangeMap{way}": far
                    for way in ("HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp")
                },
            },
        }
    }


def vrm0(nodes: dict[str, int], shapes: list[str]) -> dict:
    """VRM 0.x with Perfect Sync's blend shapes; its models face -z, this one shows its back."""
    far = {"curve": [0, 0, 0, 1, 1, 1, 1, 0], "xRange": 90, "yRange": 10}
    return {
        "VRM": {
            "exporterVersion": "tests of facegen",
            "specVersion": "0.0",
            "meta": {"title": "egg"},
            "humanoid": {
                "humanBones": [{"bone": name, "node": node} for name, node in nodes.items() if name != "mesh"]
            },
            "firstPerson": {
                "firstPersonBone": nodes["head"],
                "lookAtTypeName": "Bone",
                **{
                    f"lookAt{way}": far
                    for way in ("HorizontalInner", "HorizontalOuter", "VerticalDown", "VerticalUp")
                },
            },
            "blendShapeMaster": {
                "blendShapeGroups": [
                    {
                        "name": name,
                        "presetName": "unknown",
                        "binds": [{"mesh": 0, "index": index, "weight": 50 if name == HALVED else 100}],
                    }
                    for index, name in enumerate(shapes)
                ]
            },
            "secondaryAnimation": {"boneGroups": [], "colliderGroups": []},
            "materialProperties": [],
        }
    }
