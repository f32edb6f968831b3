"""Small scenes with known answers, for the renderer's tests."""

import numpy as np

from facegen.conventions import Part
from facegen.geometry import Camera, direction_from_angles, invert_transform, look_at
from facegen.rigs import eye_geometry
from facegen.scene import Lamp, Mesh, Scene, View, eye_meshes

PINHOLE = Camera(
    width=200,
    height=160,
    fx=150.0,
    fy=158.0,
    cx=104.2,
    cy=76.9,
    distortion=(-0.28, 0.09, 0.001, -0.0015, -0.012),
)
FISHEYE = Camera(
    model="fisheye",
    width=180,
    height=200,
    fx=95.0,
    fy=97.5,
    cx=85.3,
    cy=104.2,
    distortion=(0.02, -0.01, 0.003, -0.0004),
)


def sphere(
    name: str,
    center: np.ndarray,
    radius: float,
    *,
    part: Part = Part.SKIN,
    material: str = "emitter",
    rings: int = 24,
) -> Mesh:
    """A sphere of ``rings`` by twice as many quads, poles along y."""
    polar, around = (
        np.linspace(0.0, np.pi, rings + 1),
        np.linspace(0.0, 2.0 * np.pi, 2 * rings, endpoint=False),
    )
    p, a = np.meshgrid(polar, around, indexing="ij")
    unit = np.stack([np.sin(p) * np.sin(a), np.cos(p), np.sin(p) * np.cos(a)], axis=-1)
    i, j = np.meshgrid(np.arange(rings), np.arange(2 * rings), indexing="ij")
    k = (j + 1) % (2 * rings)
    faces = np.stack(
        [i * 2 * rings + j, (i + 1) * 2 * rings + j, (i + 1) * 2 * rings + k, i * 2 * rings + k], axis=-1
    )
    faces = faces.reshape(-1, 4).astype(np.int32)
    return Mesh(
        name=name,
        vertices=center + radius * unit.reshape(-1, 3),
        faces=faces,
        part=np.full(len(faces), part, np.uint8),
        materials=(material,),
        face_material=np.zeros(len(faces), np.int32),
    )


def eye_scene(size: int = 48, *, yaw_rad: float = 0.1, cornea: bool = True) -> Scene:
    """One eye before a plain fisheye camera 35 mm from its cornea, with two lamps."""
    eye = eye_geometry(np.zeros(3), 0.012, direction_from_angles(yaw_rad, 0.0))
    camera = Camera(
        model="fisheye",
        width=size,
        height=size,
        fx=0.9 * size,
        fy=0.9 * size,
        cx=size / 2 - 0.5,
        cy=size / 2 - 0.5,
    )
    position = (eye.cornea_center_offset + eye.cornea_radius + 0.035) * direction_from_angles(yaw_rad, 0.0)
    meshes = tuple(m for m in eye_meshes(eye, "left") if cornea or not m.name.endswith("cornea"))
    lamps = tuple(
        Lamp(
            name=f"lamp_{side}",
            position=np.array([side * 0.02, 0.01, 0.045]),
            direction=-np.array([side * 0.02, 0.01, 0.035]) / np.linalg.norm([0.02, 0.01, 0.035]),
            diameter_m=1.5e-3,
            power_w=1.2e-3,
            spread_rad=1.8,
        )
        for side in (-1, 1)
    )
    view = View(
        name="eye",
        camera=camera,
        camera_from_head=invert_transform(look_at(position, np.zeros(3))),
        lamps=tuple(lamp.name for lamp in lamps),
    )
    return Scene(meshes=meshes, lamps=lamps, views=(view,))
