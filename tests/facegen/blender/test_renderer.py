"""The renderer against geometry: where things appear, how far away, what they are; always the same bytes."""

import dataclasses
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.ndimage import binary_erosion

from facegen.blender import open_renderer
from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.errors import InputError
from facegen.geometry import (
    Camera,
    apply_transform,
    direction_from_angles,
    invert_transform,
    look_at,
    pixel_rays,
    project,
    unproject,
)
from facegen.headsets import head_from_headset, load_headset
from facegen.rigs import evaluate, eye_geometry
from facegen.scene import Mesh, Scene, View, assemble, draw_look
from facegen.scene.assembly import headset_views
from facegen.scene.scene import Strands
from facegen.sensor import develop
from facegen.store.images import read_exr, write_exr
from tests.facegen.blender.digest import digest
from tests.facegen.blender.scenes import FISHEYE, PINHOLE, eye_scene, sphere

pytestmark = pytest.mark.blender

OBLIQUE = invert_transform(look_at([0.02, -0.03, 0.07], [0.0, 0.0, 0.0]))
SYNTHETIC = [
    View(name="pinhole", camera=PINHOLE, camera_from_head=OBLIQUE),
    View(name="fisheye", camera=FISHEYE, camera_from_head=OBLIQUE),
]
TRACKING3 = list(
    headset_views(
        load_headset("tracking3"), head_from_headset(load_headset("tracking3"), np.zeros(3), np.zeros(6))
    )
)


@pytest.fixture(scope="module")
def renderer():
    return open_renderer(threads=2)


@pytest.mark.parametrize("view", SYNTHETIC + TRACKING3, ids=lambda view: view.name)
def test_markers_appear_where_geometry_projects_them(renderer, view):
    # a 4 x 4 grid over the whole picture, at depths from 25 to 60 mm, as points of the head
    width, height = view.camera.width, view.camera.height
    u, v = np.meshgrid(np.linspace(14.3, width - 15.6, 4), np.linspace(14.1, height - 15.2, 4))
    rays = unproject(view.camera, np.stack([u.ravel(), v.ravel()], axis=-1))
    distance = np.linspace(0.025, 0.06, 16)
    centers = apply_transform(invert_transform(view.camera_from_head), rays * distance[:, None])
    radius = 2.5 / view.camera.fx * distance
    markers = tuple(
        sphere(f"m{i}", c, r, rings=12) for i, (c, r) in enumerate(zip(centers, radius, strict=True))
    )
    scene = Scene(meshes=markers, lamps=(), views=(view,))
    radiance = renderer.render(scene, view.name, samples=24, seed=3, denoise=False).radiance
    expected = project(view.camera, apply_transform(view.camera_from_head, centers))
    errors = np.array([_centroid(radiance, point) - point for point in expected])
    assert np.abs(errors).max() < 0.1
    assert np.linalg.norm(errors.mean(axis=0)) < 0.02


def _centroid(image: np.ndarray, near: np.ndarray) -> np.ndarray:
    u, v = np.rint(near).astype(int)
    rows, columns = slice(max(v - 9, 0), v + 10), slice(max(u - 9, 0), u + 10)
    window = image[rows, columns].astype(np.float64)
    y, x = np.mgrid[
        rows.start : rows.start + window.shape[0], columns.start : columns.start + window.shape[1]
    ]
    return np.array([(window * x).sum(), (window * y).sum()]) / window.sum()


@pytest.mark.parametrize("view", SYNTHETIC, ids=lambda view: view.name)
def test_depth_normal_and_part_are_those_of_the_sphere(renderer, view):
    center, radius = np.array([0.004, -0.003, 0.0]), 0.012
    ball = sphere("ball", center, radius, part=Part.TONGUE, rings=96)
    layers = renderer.render(Scene(meshes=(ball,), lamps=(), views=(view,)), view.name, samples=1, seed=0)

    rays = pixel_rays(view.camera)
    middle = apply_transform(view.camera_from_head, center[None])[0]
    along = rays @ middle
    inside = radius**2 - (middle @ middle - along**2)
    hit = inside > 0
    points = rays * (along - np.sqrt(np.maximum(inside, 0.0)))[..., None]
    # a grazing ray slips past the polygons' edges: leave out the outermost 2 % of the radius
    well_inside = inside > (0.2 * radius) ** 2

    assert (
        np.abs(layers.depth - points[..., 2])[well_inside].max() < 2e-5
    )  # 96 rings stay 6 micrometres inside
    normal = (points - middle) / radius
    assert np.abs(layers.normal - normal)[well_inside].max() < 0.01
    assert (layers.part[well_inside] == Part.TONGUE).all()
    assert set(np.unique(layers.part)) == {Part.BACKGROUND, Part.TONGUE}
    far = inside < -((0.05 * radius) ** 2)
    assert np.isinf(layers.depth[far & ~hit]).all()
    assert (layers.normal[far] == 0).all()


@pytest.mark.parametrize(
    "camera",
    [
        # the corners lie 0.8 and 0.9 % before the distortion turns back; headsets may go to 0.5 %
        Camera(width=200, height=160, fx=150.0, fy=150.0, cx=99.5, cy=79.5, distortion=(-0.2,)),
        Camera(
            model="fisheye",
            width=160,
            height=160,
            fx=138.5,
            fy=138.5,
            cx=79.5,
            cy=79.5,
            distortion=(-0.2, -0.012),
        ),
    ],
    ids=lambda camera: camera.model,
)
def test_rays_of_the_strongest_distortion_are_those_of_the_camera_model(renderer, camera):
    # a slanting plane: its depth tells where a ray goes
    corners = np.array([[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]])
    slant = np.array([0.2, 0.3])
    plane = Mesh(
        name="plane",
        vertices=np.column_stack([corners, 0.05 + corners @ slant]),
        faces=np.array([[0, 1, 2, 3]], np.int32),
        part=np.full(1, Part.SKIN, np.uint8),
        materials=("emitter",),
        face_material=np.zeros(1, np.int32),
    )
    view = View(name="edge", camera=camera, camera_from_head=np.eye(4))
    layers = renderer.render(Scene(meshes=(plane,), lamps=(), views=(view,)), "edge", samples=1, seed=0)
    rays = pixel_rays(camera)
    depth = 0.05 / (1.0 - rays[..., :2] @ slant / rays[..., 2])
    assert (depth > 0.0).all()
    # 32-bit numbers 9 m away are a micrometre apart
    pixels = (np.abs(layers.depth - depth) - 3e-6) / np.hypot(*np.gradient(depth))
    assert pixels.max() < 0.02


def test_pupil_appears_magnified_by_the_cornea(renderer):
    seen, straight = (
        (renderer.render(eye_scene(320, cornea=c), "eye", samples=1, seed=0).part == Part.PUPIL).sum()
        for c in (True, False)
    )
    # half angles at which rays meet the pupil's rim, traced by hand with Snell's law and without a cornea;
    # 288 px a radian
    assert straight == pytest.approx(np.pi * (288 * 0.051767) ** 2, rel=0.02)
    assert seen == pytest.approx(np.pi * (288 * 0.059048) ** 2, rel=0.02)


def test_cornea_has_depth_and_normal_but_no_label(renderer):
    layers = renderer.render(eye_scene(64), "eye", samples=1, seed=0)
    assert Part.CORNEA not in layers.part
    assert {Part.IRIS, Part.PUPIL, Part.SCLERA} <= set(np.unique(layers.part))
    pupil = layers.part == Part.PUPIL
    assert np.abs(layers.depth[pupil] - 0.035).max() < 1e-3
    assert (layers.normal[pupil][:, 2] < -0.9).all()
    iris = layers.part == Part.IRIS
    assert layers.uv[iris][:, 1].min() < 0.1
    assert 0.7 < layers.uv[iris][:, 1].max() < 1.2


def test_pictures_do_not_depend_on_process_threads_or_what_came_before(renderer):
    script = str(Path(__file__).with_name("digest.py"))
    others = [
        subprocess.run(
            [sys.executable, script, threads], capture_output=True, text=True, check=True
        ).stdout.strip()
        for threads in ("1", "3")
    ]
    assert len(others[0]) == 64, "only the digest may reach stdout"
    renderer.render(eye_scene(40, yaw_rad=-0.2), "eye", samples=2, seed=1)
    assert {*others, digest(renderer)} == {others[0]}


def test_files_hold_a_render_exactly(renderer, tmp_path):
    layers = renderer.render(eye_scene(), "eye", samples=2, seed=1)
    path = tmp_path / "eye.exr"
    write_exr(layers, path)
    back = read_exr(path)
    for name in ("radiance", "depth", "normal", "part", "uv"):
        assert np.array_equal(getattr(back, name), getattr(layers, name)), name


def test_a_glimpse_is_the_same_picture_and_shows_the_same_surfaces(renderer):
    scene = eye_scene()
    layers = renderer.render(scene, "eye", samples=2, seed=1)
    glimpse = renderer.glimpse(scene, "eye", samples=2, seed=1)
    np.testing.assert_array_equal(glimpse.radiance, layers.radiance)
    # one that stored guides must not change what comes after it
    np.testing.assert_array_equal(renderer.render(scene, "eye", samples=2, seed=1).radiance, layers.radiance)
    # guides are averaged over their pixels: away from edges they are what is true at the middle
    within = {
        part: binary_erosion(layers.part == part) for part in (Part.SCLERA, Part.BACKGROUND, Part.PUPIL)
    }
    assert all(inner.any() for inner in within.values())
    sclera = within[Part.SCLERA]
    np.testing.assert_allclose(glimpse.normal[sclera], layers.normal[sclera], atol=0.2)
    assert not glimpse.normal[within[Part.BACKGROUND]].any()
    assert 0.25 < glimpse.albedo[sclera].mean() < 0.6
    assert glimpse.albedo[within[Part.PUPIL]].mean() < 0.5 * glimpse.albedo[sclera].mean()


def test_seed_changes_noise_and_nothing_else(renderer):
    a, b = (renderer.render(eye_scene(), "eye", samples=2, seed=seed, denoise=False) for seed in (1, 2))
    assert not np.array_equal(a.radiance, b.radiance)
    for name in ("depth", "normal", "part", "uv"):
        assert np.array_equal(getattr(a, name), getattr(b, name))


def test_only_the_views_own_lamps_are_lit(renderer):
    scene = eye_scene()
    dark = dataclasses.replace(scene, views=(dataclasses.replace(scene.views[0], lamps=()),))
    assert renderer.render(dark, "eye", samples=2, seed=1, denoise=False).radiance.max() == 0.0
    assert renderer.render(scene, "eye", samples=2, seed=1).radiance.mean() > 0.0


def test_moved_vertices_and_new_topology_are_taken_up(renderer):
    view = View(
        name="pinhole", camera=PINHOLE, camera_from_head=invert_transform(look_at([0, 0, 0.06], [0, 0, 0]))
    )

    def nearest(ball):
        return renderer.render(
            Scene(meshes=(ball,), lamps=(), views=(view,)), "pinhole", samples=1, seed=0
        ).depth.min()

    assert nearest(sphere("ball", np.zeros(3), 0.010)) == pytest.approx(0.050, abs=1e-4)
    assert nearest(sphere("ball", np.zeros(3), 0.015)) == pytest.approx(0.045, abs=1e-4)
    assert nearest(sphere("ball", np.zeros(3), 0.020, rings=30)) == pytest.approx(0.040, abs=1e-4)


def test_hair_shows_where_it_is_and_a_lens_shows_what_is_behind_it_a_little_darker(renderer):
    scene = eye_scene(64, cornea=False)
    view = dataclasses.replace(scene.views[0], lamps=("lamp_1",))  # whose light does not meet the pane
    scene = dataclasses.replace(scene, views=(view,))
    pose = invert_transform(view.camera_from_head)
    # a strand across the picture 10 mm before the camera, and a pane behind it over the left half
    strand = apply_transform(pose, np.array([[-0.02, 0.002, 0.01], [0.0, 0.002, 0.01], [0.02, 0.002, 0.01]]))
    corners = np.array([[-0.05, -0.05, 0.02], [0.0, -0.05, 0.02], [0.0, 0.05, 0.02], [-0.05, 0.05, 0.02]])
    pane = Mesh(
        name="lenses",
        vertices=apply_transform(pose, corners),
        faces=np.array([[0, 1, 2, 3]], np.int32),
        part=np.full(1, Part.LENS, np.uint8),
        materials=("lens",),
        face_material=np.zeros(1, np.int32),
    )
    hair = Strands(
        name="beard",
        points=np.stack([strand, strand]),
        radius_m=np.full((2, 3), 3e-4),
        part=Part.HAIR,
        material="hair",
    )
    worn = dataclasses.replace(scene, meshes=(*scene.meshes, pane), strands=(hair,))
    bare, layers = (renderer.render(s, "eye", samples=8, seed=1, denoise=False) for s in (scene, worn))
    again = renderer.render(scene, "eye", samples=8, seed=1, denoise=False)
    assert np.array_equal(bare.radiance, again.radiance)
    v, u = np.rint(project(view.camera, np.array([[0.0, 0.002, 0.01]]))[0][::-1]).astype(int)
    shown = layers.part == Part.HAIR
    assert shown[v, 8:56].all()
    assert not shown[: v - 4].any()
    assert not shown[v + 5 :].any()
    assert layers.depth[v, u] == pytest.approx(0.01, abs=4e-4)
    assert Part.LENS not in layers.part
    clear = np.s_[4 : v - 4]
    assert np.array_equal(layers.part[clear], bare.part[clear])
    np.testing.assert_allclose(layers.depth[clear], bare.depth[clear], atol=1e-6)
    left, right = (
        layers.radiance[clear][:, side].sum() / bare.radiance[clear][:, side].sum()
        for side in (slice(4, 28), slice(36, 60))
    )
    assert left == pytest.approx(0.92, abs=0.01)
    assert right == pytest.approx(1.0, abs=0.01)


def test_unknown_views_parameters_and_devices_are_refused(renderer):
    scene = eye_scene()
    with pytest.raises(InputError, match="no view 'mouth'; it has eye"):
        renderer.render(scene, "mouth", samples=1, seed=0)
    with pytest.raises(InputError, match="no parameter 'shine'"):
        renderer.render(
            dataclasses.replace(scene, materials={"iris": {"shine": 1.0}}), "eye", samples=1, seed=0
        )
    with pytest.raises(InputError, match="device is 'abacus', but must be one of cpu, auto"):
        open_renderer(device="abacus")


def _face(anny, headset, look, **weights):
    axis = np.broadcast_to(direction_from_angles(0.0, 0.0), (1, 2, 3))
    row = np.zeros((1, 52))
    for name, value in weights.items():
        row[0, BLENDSHAPE_INDEX[name]] = value
    face = evaluate(anny, np.zeros((1, anny.components)), row, axis)
    eyes = [
        eye_geometry(c, r, a) for c, r, a in zip(face.eye_center[0], face.eye_radius[0], axis[0], strict=True)
    ]
    fit = head_from_headset(headset, face.landmarks[0, 27], np.zeros(6))
    return assemble(
        anny, face.vertices[0], eyes, headset, fit, look=draw_look(np.random.default_rng(look), anny)
    )


def test_eye_cameras_see_what_real_ones_see(anny):
    # bounds from measured frames of real headsets (benchmarks/bench_look.py), widened by a quarter for three looks of
    # one face that looks straight ahead, at 64 pixels
    headset = load_headset("tracking3").scaled(64)
    renderer = open_renderer(threads=2)
    figures, behind = [], []
    for look in range(3):
        face = _face(anny, headset, look)
        layers = renderer.render(face, "left_eye", samples=6, seed=1)
        grey = develop(layers.radiance, headset.sensor)
        parts = (Part.SKIN, Part.SCLERA, Part.IRIS, Part.PUPIL, Part.LASHES, Part.HAIR)
        level = [grey[layers.part == part].mean() for part in parts]
        figures.append([grey.mean(), grey.std(), *np.percentile(grey, [1, 50, 99]), *level])
        bare = dataclasses.replace(face, meshes=tuple(mesh for mesh in face.meshes if mesh.name != "lashes"))
        radiance = renderer.render(bare, "left_eye", samples=6, seed=1).radiance
        behind.append(develop(radiance, headset.sensor)[layers.part == Part.LASHES].mean())
    mean, deviation, dark, median, bright, skin, sclera, iris, pupil, lashes, hair = np.mean(figures, axis=0)
    assert 60 < mean < 85
    assert 27 < deviation < 45
    assert 11 < dark < 22
    assert 57 < median < 88
    assert 125 < bright < 190
    assert 65 < skin < 95
    assert 0.75 * skin < sclera < 1.1 * skin
    assert 44 < iris < 72
    assert 26 < pupil < 42  # real: 31 to 37; nine pixels across, its rim mixes with the iris
    assert pupil < iris - 15 < sclera
    # a strand is a sixth of a pixel wide here, and still there after denoising: it darkens the lit rim of the lid
    assert lashes < 0.75 * np.mean(behind)
    assert hair < 0.92 * skin
    shut = renderer.render(
        _face(anny, headset, 0, eyeBlinkLeft=1.0, eyeBlinkRight=1.0), "left_eye", samples=1, seed=1
    )
    assert not set(np.unique(shut.part)) & {Part.SCLERA, Part.IRIS, Part.PUPIL}
    # of the wet corner nothing may come through shut lids either
    assert (shut.part == Part.EYE_CAVITY).sum() <= 2
