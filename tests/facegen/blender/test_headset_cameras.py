"""Every camera of every headset: what Cycles renders lies where the labels' camera model puts it, seen or hidden."""

from dataclasses import replace

import numpy as np
import pytest

from facegen.blender import open_renderer
from facegen.conventions import Part, Visibility
from facegen.geometry import apply_transform, invert_transform, pixel_rays, project, unproject
from facegen.headsets import draw_unit, head_from_headset, list_headsets, load_headset
from facegen.labels import label_rendered
from facegen.raster import nearest_depth, triangles_of
from facegen.sampling import draw_samples
from facegen.scene import Scene
from facegen.scene.assembly import headset_views
from facegen.scene.housing import headset_meshes
from facegen.sensor import develop_view
from facegen.sessions import draw_sample_scene
from facegen.spec import parse_spec
from facegen.store import resolve
from tests.facegen.blender.scenes import sphere

pytestmark = pytest.mark.blender

WIDTH = 64
UNITS = {
    name: draw_unit(load_headset(name).scaled(WIDTH), np.random.default_rng(5)) for name in list_headsets()
}
"""A unit of each: cameras off by their tolerances, so no angle and no centre is round."""
NOWHERE = np.zeros(3), np.zeros(6)
VIEWS = [
    pytest.param(view, id=f"{name}-{view.name}")
    for name, unit in UNITS.items()
    for view in headset_views(unit, head_from_headset(unit, *NOWHERE))
]


@pytest.fixture(scope="module")
def renderer():
    return open_renderer(threads=2)


@pytest.mark.parametrize("view", VIEWS)
def test_markers_appear_where_the_camera_model_projects_them(renderer, view):
    # a 3 x 3 grid over the picture at depths from 25 to 60 mm: further apart than the windows around them
    width, height = view.camera.width, view.camera.height
    u, v = np.meshgrid(np.linspace(9.3, width - 10.6, 3), np.linspace(9.1, height - 10.2, 3))
    distance = np.linspace(0.025, 0.06, 9)
    rays = unproject(view.camera, np.stack([u.ravel(), v.ravel()], axis=-1)) * distance[:, None]
    centers = apply_transform(invert_transform(view.camera_from_head), rays)
    radius = 2.2 / view.camera.fx * distance
    markers = tuple(
        sphere(f"m{i}", c, r, rings=12) for i, (c, r) in enumerate(zip(centers, radius, strict=True))
    )
    scene = Scene(meshes=markers, lamps=(), views=(view,))
    radiance = renderer.render(scene, view.name, samples=48, seed=3, denoise=False).radiance
    expected = project(view.camera, apply_transform(view.camera_from_head, centers))
    errors = np.array([_centroid(radiance, point) - point for point in expected])
    assert np.abs(errors).max() < 0.1
    assert np.linalg.norm(errors.mean(axis=0)) < 0.03


def _centroid(image: np.ndarray, near: np.ndarray) -> np.ndarray:
    u, v = np.rint(near).astype(int)
    window = image[v - 7 : v + 8, u - 7 : u + 8].astype(np.float64)
    y, x = np.mgrid[v - 7 : v + 8, u - 7 : u + 8]
    return np.array([(window * x).sum(), (window * y).sum()]) / window.sum()


@pytest.mark.parametrize("name", [name for name in UNITS if UNITS[name].occluders])
def test_the_housing_is_rendered_where_its_mesh_is(renderer, name):
    unit = UNITS[name]
    fit = head_from_headset(unit, *NOWHERE)
    (mesh,) = headset_meshes(unit, fit)
    seen = 0
    for view in headset_views(unit, fit):
        layers = renderer.render(Scene(meshes=(mesh,), lamps=(), views=(view,)), view.name, samples=1, seed=0)
        in_camera = apply_transform(view.camera_from_head, mesh.vertices)
        rays = pixel_rays(view.camera)
        depth = nearest_depth(rays.reshape(-1, 3), in_camera, triangles_of(mesh.faces)).reshape(
            rays.shape[:2]
        )
        there = np.isfinite(depth)
        # outlines pass between pixels' centres: a tenth of the pixels along them may differ by rounding
        assert ((layers.part == Part.HEADSET) != there).mean() < 0.01
        both = there & (layers.part == Part.HEADSET)
        assert not both.any() or np.percentile(np.abs(layers.depth[both] - depth[both]), 99) < 1e-4
        seen += both.sum()
    assert seen > 100


def _mouth_landmarks(dataset, headset, row):
    sample = draw_sample_scene(dataset.spec, dataset.rig, headset, row)
    return label_rendered(dataset.spec, dataset.rig, sample).views["mouth"].landmarks


def test_landmarks_behind_the_housing_are_labelled_hidden(anny, tmp_path):
    table = {
        "version": 1,
        "kind": "still",
        "seed": 9,
        "people": 2,
        "render": {"headset": "mouth1", "size_px": 64},
    }
    dataset = resolve(parse_spec(table, where="here"), tmp_path)
    row = draw_samples(dataset.plan, anny, 0).rows(slice(0, 1))
    made = _mouth_landmarks(dataset, dataset.headset, row)
    unhoused = replace(dataset.headset, occluders=())
    bare = _mouth_landmarks(dataset, unhoused, row)
    assert (made.points_2d == bare.points_2d).all()
    hidden = (bare.visibility == Visibility.VISIBLE) & (made.visibility == Visibility.HIDDEN)
    assert hidden[36:48].sum() >= 2, "the lower plate hides eyes from a camera below the chin"
    assert not hidden[48:68].any(), "and leaves the mouth free"


def test_mouth1_sees_what_a_real_mouth_camera_sees(renderer, anny, tmp_path):
    # ranges of three real frames (benchmarks/bench_look.py), widened by what four people of twelve differ in mean
    table = {"version": 1, "kind": "still", "seed": 12, "people": 12, "still": {"neutral": 0, "faces": 1}}
    table["render"] = {"headset": "mouth1", "size_px": 48}
    dataset = resolve(parse_spec(table, where="here"), tmp_path)
    block = draw_samples(dataset.plan, anny, 0)
    figures = []
    for number in (0, 2, 5, 9):
        row = block.rows(slice(number, number + 1))
        made = draw_sample_scene(dataset.spec, anny, dataset.headset, row)
        (view,) = made.scene.views
        layers = renderer.render(made.scene, "mouth", samples=4, seed=1)
        unit, shot = made.session.unit, made.shots["mouth"]
        grey = develop_view(layers, unit.camera("mouth"), view.camera_from_head, unit.sensor, shot)
        figures.append([grey.mean(), grey.std(), *np.percentile(grey, [1, 50, 99])])
        assert (grey < 250).all()
    mean, deviation, dark, median, bright = np.mean(figures, axis=0)
    assert 36 < mean < 50
    assert 30 < deviation < 46
    assert 9 < dark < 13
    assert 20 < median < 33
    assert 130 < bright < 185
