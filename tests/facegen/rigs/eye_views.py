"""What a headset's cameras see of eyes: which part each ray meets first, by casting rays instead of rendering."""

import numpy as np

from facegen.conventions import SIDES, Part
from facegen.geometry import apply_transform, project, unproject
from facegen.headsets import Headset, head_from_headset
from facegen.raster import nearest_depth, triangles_of
from facegen.rigs import EvaluatedFaces, Rig, eye_geometry
from facegen.scene import Mesh, Scene, View, assemble

EYEBALL = (Part.SCLERA, Part.IRIS, Part.PUPIL, Part.CORNEA)


def scene_of(
    rig: Rig, faces: EvaluatedFaces, index: int, gaze: np.ndarray, headset: Headset, seat: np.ndarray
) -> Scene:
    """The scene of one evaluated face (with all its vertices), without hair.

    Parameters
    ----------
    gaze
        (2, 3) optical axes in the head frame, the subject's left eye first.
    headset, seat
        The headset, and by how much it sits off: (6,) metres along x, y, z, and yaw, pitch, roll in radians.
    """
    eyes = [
        eye_geometry(faces.eye_center[index, side], faces.eye_radius[index, side], gaze[side])
        for side in range(len(SIDES))
    ]
    fit = head_from_headset(headset, faces.landmarks[index, 27], seat)
    return assemble(rig, faces.vertices[index], eyes, headset, fit)


def eyeball_pixels(view: View, scene: Scene) -> int:
    """How many pixels of a view show the outer surface of an eyeball, past lids, nose and housing."""
    ball = np.concatenate([m.vertices for m in scene.meshes if np.isin(m.part, EYEBALL).any()])
    shown = project(view.camera, apply_transform(view.camera_from_head, ball))
    shown = shown[np.isfinite(shown).all(axis=-1)]
    if not len(shown):
        return 0
    size = np.array([view.camera.width, view.camera.height]) - 1
    low, high = (
        np.clip(np.rint(edge), 0, size).astype(int) for edge in (shown.min(axis=0), shown.max(axis=0))
    )
    u, v = np.meshgrid(np.arange(low[0], high[0] + 1), np.arange(low[1], high[1] + 1))
    rays = unproject(view.camera, np.stack([u, v], axis=-1).reshape(-1, 2))
    return int(np.isin(first_parts(view, rays, scene.meshes), EYEBALL).sum())


def before_pupils(view: View, scene: Scene) -> list[Part]:
    """What stands between a camera and the centre of each pupil in its picture: `Part.PUPIL` where nothing does.

    Rays are straight: the cornea is left out. An eye seen from beside hides its pupil itself, by `Part.SCLERA`.
    """
    clear = tuple(mesh for mesh in scene.meshes if not (mesh.part == Part.CORNEA).any())
    centers = np.stack([m.vertices.mean(axis=0) for m in scene.meshes if (m.part == Part.PUPIL).any()])
    in_camera = apply_transform(view.camera_from_head, centers)
    inside = view.camera.contains(project(view.camera, in_camera)) & (in_camera[:, 2] > 0)
    return [Part(part) for part in first_parts(view, in_camera[inside], clear)]


def first_parts(view: View, rays_camera: np.ndarray, meshes: tuple[Mesh, ...]) -> np.ndarray:
    """The part (p,) that each ray (p, 3) of the camera frame meets first; `Part.BACKGROUND` where it meets nothing."""
    first = np.full(len(rays_camera), Part.BACKGROUND, np.uint8)
    nearest = np.full(len(rays_camera), np.inf)
    for mesh in meshes:
        vertices = apply_transform(view.camera_from_head, mesh.vertices)
        for part in np.unique(mesh.part):
            triangles = triangles_of(mesh.faces[mesh.part == part])
            depth = nearest_depth(rays_camera, vertices, triangles)
            first[depth < nearest] = part
            nearest = np.minimum(nearest, depth)
    return first
