"""Draws docs/pictures/avatar-shapes.jpg and avatar-people.jpg with Blender's Cycles.

    facegen rig export anny --out head.glb
    facegen rig people --out people
    python docs/figures/avatar.py shapes head.glb
    python docs/figures/avatar.py people people/*.glb

The first is what each of the 52 weights means at 1: eyes turn by their bones, and mouthClose and tongueOut are shown
with an open jaw.
"""

import sys
import tempfile
from pathlib import Path

import bpy
import cv2
import numpy as np
from mathutils import Quaternion, Vector

from facegen.conventions import BLENDSHAPES
from facegen.sampling.gaze import FULL_PITCH_RAD, FULL_YAW_RAD

PICTURES = Path(__file__).resolve().parents[1] / "pictures"
SAMPLES = 10
FACE_PX, COLUMNS = 230, 9
WITH = {"tongueOut": {"jawOpen": 0.6}, "mouthClose": {"jawOpen": 1.0}}
"""Shapes that mean something with another one only: mouthClose shuts the lips of an open jaw."""


def main() -> None:
    """Draw the sheet that is asked for."""
    what, *files = sys.argv[1:]
    sheet = _shapes(files[0]) if what == "shapes" else _people(files)
    out = PICTURES / f"avatar-{what}.jpg"
    cv2.imwrite(str(out), sheet, [cv2.IMWRITE_JPEG_QUALITY, 80])
    print(out)


def _shapes(file: str) -> np.ndarray:
    camera = _stage(file)
    _aim(camera, yaw_deg=12, target=(0.0, 0.04, -0.012), distance=0.9, field_deg=16.5)
    faces = []
    for name in ("neutral", *BLENDSHAPES):
        weights = {name: 1.0} | WITH.get(name, {})
        for mesh in bpy.data.objects:
            if mesh.type == "MESH" and mesh.data.shape_keys:
                for key in mesh.data.shape_keys.key_blocks:
                    key.value = weights.get(key.name, 0.0)
        _look(name)
        faces.append(_labelled(_picture(FACE_PX, FACE_PX), name))
    faces += [np.full_like(faces[0], 255)] * (-len(faces) % COLUMNS)
    return np.vstack([np.hstack(faces[i : i + COLUMNS]) for i in range(0, len(faces), COLUMNS)])


def _people(files: list[str]) -> np.ndarray:
    columns = []
    for file in files:
        camera = _stage(file)
        top = max(
            (mesh.matrix_world @ Vector(corner)).z
            for mesh in bpy.data.objects
            if mesh.type == "MESH"
            for corner in mesh.bound_box
        )
        _aim(camera, yaw_deg=20, target=(0.0, 0.0, 0.9), distance=5.0, field_deg=25)
        whole = _picture(300, 460)
        _aim(camera, yaw_deg=15, target=(0.0, 0.0, top - 0.17), distance=2.2, field_deg=11.5)
        columns.append(np.vstack([_labelled(_picture(300, 300), Path(file).stem), whole]))
    return np.hstack(columns)


def _stage(file: str) -> "bpy.types.Object":
    """Open an avatar before a grey wall, with two lamps and a sky; returns the camera."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=file)
    for thing in list(bpy.data.objects):
        if thing.name.startswith("Icosphere"):  # the importer's drawing of bones
            bpy.data.objects.remove(thing)
    scene = bpy.context.scene
    scene.render.engine, scene.cycles.device = "CYCLES", "CPU"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.max_bounces = SAMPLES, True, 2
    scene.cycles.transparent_max_bounces = 16
    scene.view_settings.view_transform = "Standard"
    world = bpy.data.worlds.new("sky")
    scene.world, world.use_nodes = world, True
    background = world.node_tree.nodes["Background"]
    background.inputs[0].default_value, background.inputs[1].default_value = (0.58, 0.62, 0.69, 1.0), 0.6
    for strength, turn in ((2.8, (0.95, 0.0, 0.65)), (0.7, (1.1, 0.0, -0.9)), (1.6, (0.9, 0.0, 3.6))):
        lamp = bpy.data.lights.new("lamp", "SUN")
        lamp.energy, lamp.angle = strength, 0.3
        thing = bpy.data.objects.new("lamp", lamp)
        thing.rotation_euler = turn
        scene.collection.objects.link(thing)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.collection.objects.link(camera)
    scene.camera = camera
    return camera


def _aim(
    camera: "bpy.types.Object", *, yaw_deg: float, target: tuple, distance: float, field_deg: float
) -> None:
    yaw = np.radians(yaw_deg)
    away = Vector((np.sin(yaw), -np.cos(yaw), 0.03)).normalized()
    camera.location = Vector(target) + distance * away
    camera.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    camera.data.angle = np.radians(field_deg)


def _look(name: str) -> None:
    """Turn the eyes' bones as an eyeLook shape asks."""
    armature = next(thing for thing in bpy.data.objects if thing.type == "ARMATURE")
    for side, outwards in (("Left", 1.0), ("Right", -1.0)):
        kind = name.removeprefix("eyeLook").removesuffix(side) if name.endswith(side) else ""
        yaw = outwards * FULL_YAW_RAD * {"Out": 1.0, "In": -1.0}.get(kind, 0.0)
        pitch = FULL_PITCH_RAD * {"Up": 1.0, "Down": -1.0}.get(kind, 0.0)
        bone = armature.pose.bones[f"{side}Eye"]
        rest = bone.bone.matrix_local.to_quaternion()
        turn = Quaternion((0.0, 0.0, 1.0), yaw) @ Quaternion((1.0, 0.0, 0.0), -pitch)
        bone.rotation_mode, bone.rotation_quaternion = "QUATERNION", rest.inverted() @ turn @ rest


def _picture(width: int, height: int) -> np.ndarray:
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = width, height
    with tempfile.TemporaryDirectory() as folder:
        render.filepath = str(Path(folder) / "picture.png")
        bpy.ops.render.render(write_still=True)
        return cv2.imread(render.filepath)


def _labelled(picture: np.ndarray, text: str) -> np.ndarray:
    for colour, width in (((60, 50, 45), 3), ((255, 255, 255), 1)):
        cv2.putText(picture, text, (7, 18), cv2.FONT_HERSHEY_SIMPLEX, 0.47, colour, width, cv2.LINE_AA)
    return picture


if __name__ == "__main__":
    main()
