"""Makes meshes of the headset's housing: lenses' rims, gasket and nose piece."""

import numpy as np

from facegen.conventions import Part
from facegen.geometry import apply_transform
from facegen.headsets import Headset
from facegen.scene.scene import Mesh


def headset_meshes(headset: Headset, head_from_headset: np.ndarray) -> tuple[Mesh, ...]:
    """The headset's occluders in the head frame as one mesh, with their albedos at the vertices; () without any."""
    if not headset.occluders:
        return ()
    vertices, faces, albedo = [], [], []
    for occluder in headset.occluders:
        points, corners = occluder.mesh()
        faces.append(corners + sum(map(len, vertices)))
        vertices.append(points)
        albedo.append(np.full(len(points), occluder.albedo))
    corners = np.concatenate(faces).astype(np.int32)
    return (
        Mesh(
            name="headset",
            vertices=apply_transform(head_from_headset, np.concatenate(vertices)),
            faces=corners,
            part=np.full(len(corners), Part.HEADSET, np.uint8),
            materials=("headset",),
            face_material=np.zeros(len(corners), np.int32),
            fields={"albedo": np.concatenate(albedo)},
        ),
    )
