"""Puts a scene together: one evaluated head, its eyes, and a headset in place, with lamps and views."""

from collections.abc import Sequence

import numpy as np

from facegen.conventions import SIDES, Part
from facegen.geometry import apply_transform, invert_transform
from facegen.headsets import Headset
from facegen.rigs import EyeGeometry, Rig
from facegen.scene.accessories import WornAccessories
from facegen.scene.eyes import eye_meshes
from facegen.scene.housing import headset_meshes
from facegen.scene.lid_edges import lid_edge_meshes
from facegen.scene.lids import caruncle_meshes, crease_fields
from facegen.scene.looks import Look, hair_meshes
from facegen.scene.scene import Lamp, Mesh, Scene, View

MATERIAL_OF_PART: dict[Part, str] = {
    Part.SKIN: "skin",
    Part.LIPS: "lips",
    Part.BROWS: "skin",
    Part.TEETH: "teeth",
    Part.GUMS: "gums",
    Part.TONGUE: "tongue",
    Part.MOUTH_CAVITY: "cavity",
    Part.EYE_CAVITY: "conjunctiva",
}
"""Material of each part that a rig's faces may have."""

MESHES_OF_HEAD: dict[str, tuple[Part, ...]] = {
    "head": (Part.SKIN, Part.LIPS, Part.BROWS, Part.MOUTH_CAVITY, Part.EYE_CAVITY),
    "teeth": (Part.TEETH, Part.GUMS),
    "tongue": (Part.TONGUE,),
}
"""Objects that a head is cut into: light scatters within an object, not from lip to tooth. A rig's lash strips are
no surface, strands grow along them (`facegen.scene.lashes`)."""


def assemble(
    rig: Rig,
    vertices: np.ndarray,
    eyes: Sequence[EyeGeometry],
    headset: Headset,
    head_from_headset: np.ndarray,
    *,
    look: Look | None = None,
    mouth: Sequence[Mesh] = (),
    worn: WornAccessories = WornAccessories(),
) -> Scene:
    """The scene of one sample.

    Parameters
    ----------
    rig
        Topology, parts and texture coordinates.
    vertices
        (V, 3) the evaluated head, head frame, metres.
    eyes
        The subject's left and right eye.
    headset, head_from_headset
        The headset and where it sits (`facegen.headsets.head_from_headset`).
    look
        The person's materials and hair; without one the materials' defaults, and no hair.
    mouth
        Meshes that stand in for those of the rig of the same names (`facegen.mouth.mouth_meshes`).
    worn
        Beard and glasses on this head.
    """
    instead = {mesh.name for mesh in mouth}
    head = [mesh for mesh in head_meshes(rig, vertices) if mesh.name not in instead]
    eye_parts = [mesh for eye, side in zip(eyes, SIDES, strict=True) for mesh in eye_meshes(eye, side)]
    eye_parts += lid_edge_meshes(rig, vertices, eyes)
    eye_parts += caruncle_meshes(rig, vertices, np.stack([eye.center for eye in eyes]))
    eye_parts += headset_meshes(headset, head_from_headset)
    hair = hair_meshes(look, vertices) if look else ()
    return Scene(
        meshes=(*head, *mouth, *eye_parts, *hair, *worn.meshes),
        lamps=headset_lamps(headset, head_from_headset),
        views=headset_views(headset, head_from_headset),
        materials=look.materials if look else {},
        strands=worn.strands,
    )


def head_meshes(rig: Rig, vertices: np.ndarray) -> tuple[Mesh, ...]:
    """The head cut into `MESHES_OF_HEAD`, without those that the rig has no faces for."""
    meshes, fields = [], crease_fields(rig)
    for name, parts in MESHES_OF_HEAD.items():
        chosen = np.isin(rig.part, parts)
        if not chosen.any():
            continue
        faces, part = rig.faces[chosen], rig.part[chosen]
        used, renumbered = np.unique(faces, return_inverse=True)
        renumbered = renumbered.reshape(faces.shape)
        if used[0] == -1:  # padding of triangles
            used, renumbered = used[1:], renumbered - 1
        names = tuple(dict.fromkeys(MATERIAL_OF_PART[Part(p)] for p in parts))
        index_of_part = np.zeros(max(Part) + 1, np.int32)
        for p in parts:
            index_of_part[p] = names.index(MATERIAL_OF_PART[p])
        meshes.append(
            Mesh(
                name=name,
                vertices=vertices[used],
                faces=renumbered.astype(np.int32),
                part=part,
                materials=names,
                face_material=index_of_part[part],
                uv=rig.uv[chosen],
                fields={key: field[used] for key, field in fields.items()} if name == "head" else {},
            )
        )
    return tuple(meshes)


def headset_lamps(headset: Headset, head_from_headset: np.ndarray) -> tuple[Lamp, ...]:
    """The headset's LEDs in the head frame."""
    return tuple(
        Lamp(
            name=led.name,
            position=apply_transform(head_from_headset, led.position[None])[0],
            direction=head_from_headset[:3, :3] @ led.direction,
            diameter_m=led.diameter_mm * 1e-3,
            power_w=led.power_mw * 1e-3,
            spread_rad=float(np.radians(led.beam_deg)),
        )
        for led in headset.leds
    )


def headset_views(headset: Headset, head_from_headset: np.ndarray) -> tuple[View, ...]:
    """The headset's cameras in the head frame, each with its own LEDs."""
    return tuple(
        View(
            name=camera.name,
            camera=camera.camera,
            camera_from_head=invert_transform(head_from_headset @ camera.headset_from_camera),
            lamps=tuple(led.name for led in headset.leds if led.camera == camera.name),
        )
        for camera in headset.cameras
    )
