"""What is true of a whole head's pictures: pupils against their labels, depth and normals against rays cast by hand."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from facegen.blender import open_renderer
from facegen.conventions import Part
from facegen.geometry import Ellipse, direction_from_angles, invert_transform, unproject
from facegen.headsets import load_headset
from facegen.labels import label_rendered
from facegen.labels.rendered import RenderedSample
from facegen.raster import triangles_of
from facegen.sampling import draw_samples
from facegen.scene import Layers, Mesh
from facegen.sessions import draw_sample_scene
from facegen.spec import parse_spec
from facegen.store import resolve

pytestmark = [pytest.mark.blender, pytest.mark.slow]

EYE_VIEWS = ("left_eye", "left_eye_nasal")
"""Cameras of training9 with a fisheye and a pinhole lens."""
VIEWS = (*EYE_VIEWS, "mouth")
GAZES = {"nasal": (-22.0, -5.0), "temporal": (18.0, -5.0)}
"""Yaw and pitch of both eyes in degrees: each is oblique for one of the eye views."""
STRANDS = (Part.LASHES, Part.HAIR)
OUTLINE_M = 2e-3
"""A pixel is away from outlines where rays two pixels beside it end no further before or behind it than this."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Seen:
    """Labels of a sample, and its layers by view."""

    labels: RenderedSample
    layers: dict[str, Layers]


@pytest.fixture(scope="module")
def seen(anny, tmp_path_factory) -> dict[str, Seen]:
    """One person's pictures of 640 x 480 pixels by gaze."""
    table = {"version": 1, "kind": "still", "seed": 9, "people": 1, "render": {"headset": "training9"}}
    table |= {"looks": {"beard": 0.0, "glasses": 0.0}}
    dataset = resolve(parse_spec(table, where="here"), tmp_path_factory.mktemp("truth"))
    headset = load_headset("training9").scaled(640)
    cut = [replace(camera, height=480, cy=camera.cy - 80.0) for camera in headset.cameras]
    headset = replace(headset, cameras=tuple(cut))
    row = draw_samples(dataset.plan, anny, 0).rows(slice(0, 1))
    renderer = open_renderer(threads=2, subsurface=False)
    seen = {}
    for name, degrees in GAZES.items():
        gaze = np.broadcast_to(direction_from_angles(*np.radians(degrees)), (1, 2, 3))
        labels = label_rendered(
            dataset.spec, anny, draw_sample_scene(dataset.spec, anny, headset, replace(row, gaze=gaze))
        )
        layers = {
            view: renderer.render(labels.sample.scene, view, samples=1, seed=0, denoise=False)
            for view in (VIEWS if name == "nasal" else EYE_VIEWS)
        }
        seen[name] = Seen(labels=labels, layers=layers)
    return seen


@pytest.mark.parametrize("view", EYE_VIEWS)
@pytest.mark.parametrize("gaze", GAZES)
def test_the_pupils_ellipse_is_the_pupil_that_is_seen(seen, gaze, view):
    part, outlines = seen[gaze].layers[view].part, seen[gaze].labels.views[view].outlines.left
    assert _agreement(outlines.pupil, part) > 0.99  # half a pixel aside it would be below 0.987
    assert _agreement(outlines.pupil_bare, part) < 0.9


def _agreement(ellipse: Ellipse, part: np.ndarray) -> float:
    """Intersection over union of an ellipse, where no lid or lash hides it, and the pixels of the pupil."""
    v, u = np.mgrid[: part.shape[0], : part.shape[1]]
    offset = np.stack([u, v], axis=-1) - ellipse.center
    cosine, sine = np.cos(ellipse.angle), np.sin(ellipse.angle)
    along, across = offset @ [cosine, sine], offset @ [-sine, cosine]
    inside = np.hypot(along / ellipse.semi_axes[0], across / ellipse.semi_axes[1]) <= 1.0
    inside &= np.isin(part, (Part.SCLERA, Part.IRIS, Part.PUPIL))
    pupil = part == Part.PUPIL
    assert pupil.sum() > 1000
    return (inside & pupil).sum() / (inside | pupil).sum()


@pytest.mark.parametrize("view", VIEWS)
def test_depth_and_normals_are_those_of_rays_cast_on_the_meshes(seen, view):
    scene, layers = seen["nasal"].labels.sample.scene, seen["nasal"].layers[view]
    (shot,) = (shot for shot in scene.views if shot.name == view)
    # a mesh's triangles, normals at their corners, and a tree of all
    vertices = np.concatenate([mesh.vertices for mesh in scene.meshes])
    starts = np.cumsum([0, *(len(mesh.vertices) for mesh in scene.meshes)])
    triangles = np.concatenate(
        [triangles_of(mesh.faces) + start for mesh, start in zip(scene.meshes, starts, strict=False)]
    )
    corner_normals = np.concatenate([_vertex_normals(mesh) for mesh in scene.meshes])[triangles]
    tree = _tree(vertices, triangles)
    # one pixel in 36, and those around it tell where outlines are
    v, u = np.mgrid[3:480:6, 3:640:6].reshape(2, -1)
    around = np.array([[0, 0], [2, 0], [-2, 0], [0, 2], [0, -2]])
    rays = unproject(shot.camera, np.stack([u, v], axis=-1)[:, None] + around)
    head_from_camera = invert_transform(shot.camera_from_head)
    depth, triangle, points = _cast(tree, head_from_camera, rays)
    shown = ~np.isin(layers.part[v, u], STRANDS)
    inner = shown & (np.abs(depth - depth[:, :1]) < OUTLINE_M).all(axis=1)
    assert inner.sum() > 3000
    error_m = np.abs(layers.depth[v, u] - depth[:, 0])[inner]
    corners = vertices[triangles[triangle[inner, 0]]]
    normal = (_barycentric(points[inner, 0], corners)[..., None] * corner_normals[triangle[inner, 0]]).sum(
        axis=1
    )
    normal = normal @ shot.camera_from_head[:3, :3].T
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    normal *= np.where((normal * rays[inner, 0]).sum(axis=-1) > 0.0, -1.0, 1.0)[:, None]
    sine = np.linalg.norm(np.cross(normal, layers.normal[v, u][inner]), axis=-1)
    assert np.percentile(error_m, 99) < 1e-4
    assert np.degrees(np.percentile(np.arcsin(sine), 99)) < 1.0


def _tree(vertices: np.ndarray, triangles: np.ndarray):
    from mathutils.bvhtree import BVHTree

    return BVHTree.FromPolygons(vertices.tolist(), triangles.tolist(), all_triangles=True)


def _cast(tree, head_from_camera: np.ndarray, rays_camera: np.ndarray) -> tuple[np.ndarray, ...]:
    """Depth along the camera's axis, triangle and point in the head frame of rays (..., 3); NaN where none is met."""
    shape = rays_camera.shape[:-1]
    rays = rays_camera.reshape(-1, 3)
    origin = head_from_camera[:3, 3].tolist()
    hits = [tree.ray_cast(origin, ray) for ray in (rays @ head_from_camera[:3, :3].T).tolist()]
    distance = np.array([np.nan if hit[3] is None else hit[3] for hit in hits])
    triangle = np.array([-1 if hit[2] is None else hit[2] for hit in hits])
    points = np.array([(np.nan,) * 3 if hit[0] is None else hit[0] for hit in hits])
    return (distance * rays[:, 2]).reshape(shape), triangle.reshape(shape), points.reshape(*shape, 3)


def _vertex_normals(mesh: Mesh) -> np.ndarray:
    """Unit normals (V, 3): those of the faces around, weighted by their angles there, as Blender has them."""
    normals = np.zeros_like(mesh.vertices)
    for corners in (3, 4):
        faces = mesh.faces[(mesh.faces >= 0).sum(axis=1) == corners][:, :corners]
        points = mesh.vertices[faces]
        before, after = (np.roll(points, step, axis=1) - points for step in (1, -1))
        face = np.cross(after, before).sum(
            axis=1
        )  # twice or four times the area: of a quad, that of its diagonals
        face /= np.maximum(np.linalg.norm(face, axis=-1, keepdims=True), 1e-30)
        lengths = np.linalg.norm(before, axis=-1) * np.linalg.norm(after, axis=-1)
        angle = np.arccos(np.clip((before * after).sum(axis=-1) / np.maximum(lengths, 1e-30), -1.0, 1.0))
        np.add.at(normals, faces, angle[..., None] * face[:, None])
    return normals / np.maximum(np.linalg.norm(normals, axis=-1, keepdims=True), 1e-30)


def _barycentric(points: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """Weights (n, 3) of triangles' corners (n, 3, 3) at points (n, 3) in their planes."""
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    parts = [np.cross(corners[:, i - 2] - points, corners[:, i - 1] - points) for i in range(3)]
    return (
        np.stack([(part * across).sum(axis=-1) for part in parts], axis=-1)
        / (across**2).sum(axis=-1)[:, None]
    )
