"""Glints: where they are, what hides them, and what they add to a picture."""

import dataclasses

import numpy as np
import pytest

from facegen.conventions import Part
from facegen.geometry import Camera, apply_transform, fresnel, invert_transform, look_at, pixel_rays, project
from facegen.labels import with_glints
from facegen.labels.glints import label_glints
from facegen.labels.occluders import occluders
from facegen.rigs import eye_geometry
from facegen.scene import Lamp, Mesh, Scene, View
from facegen.scene.glasses import LensMirror
from facegen.scene.lamps import radiant_intensity
from tests.facegen.blender.scenes import eye_scene

EYE = eye_geometry(np.zeros(3), 0.012, np.array([0.0, 0.0, 1.0]))
FAR = eye_geometry(np.array([0.0, 0.0, 5.0]), 0.012, np.array([0.0, 0.0, 1.0]))


NO_TEARS = np.array([[0.0, 0.0, 9.0], [0.0, 0.0, 9.1]])
"""Behind the camera."""


def _glints(scene, *more: Mesh, tears=NO_TEARS, lenses=()):
    occluder = occluders((*scene.meshes, *more), transparent=(Part.CORNEA,))
    return label_glints(scene.views[0], scene.lamps, (EYE, FAR), (tears, NO_TEARS), occluder, lenses)


def _plate(middle, half_m: float, part: Part) -> Mesh:
    corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]]) * half_m + middle
    return Mesh(
        name="plate",
        vertices=corners,
        faces=np.array([[0, 1, 2, 3]], np.int32),
        part=np.full(1, part, np.uint8),
        materials=("skin",),
        face_material=np.zeros(1, np.int32),
    )


def _scene(size: int = 96):
    return eye_scene(size, yaw_rad=0.0)


def test_every_lamp_has_its_glint_on_the_cornea_and_its_centroid_is_the_solution():
    scene = _scene()
    glints = _glints(scene)
    assert [(n, e, s) for n, e, s in zip(glints.lamps, glints.eyes, glints.surfaces, strict=True)] == [
        ("lamp_-1", "left", "cornea"),
        ("lamp_1", "left", "cornea"),
    ]
    assert glints.seen.all()
    for i in range(2):
        one = dataclasses.replace(glints, seen=np.arange(2) == i)
        added = with_glints(np.zeros((96, 96), np.float32), one).astype(np.float64)
        v, u = np.mgrid[:96, :96]
        centroid = np.array([(added * u).sum(), (added * v).sum()]) / added.sum()
        assert np.abs(centroid - glints.points_2d[i]).max() < 0.1
        assert added.sum() == pytest.approx(glints.volume[i], rel=2e-3)
    assert glints.points_2d[0, 0] == pytest.approx(95 - glints.points_2d[1, 0], abs=1e-9)


@pytest.mark.parametrize("part", [Part.SKIN, Part.LASHES])
def test_a_lid_or_a_lash_before_the_cornea_hides_its_glint_from_the_camera_or_from_the_lamp(part):
    scene = _scene()
    free = _glints(scene)
    mirror = apply_transform(invert_transform(scene.views[0].camera_from_head), free.points_camera)
    camera_m = invert_transform(scene.views[0].camera_from_head)[:3, 3]
    for origin in (camera_m, scene.lamps[0].position):
        plate = _plate(mirror[0] + 0.1 * (origin - mirror[0]), 2e-4, part)
        assert _glints(scene, plate).seen.tolist() == [False, True]
    hidden = _glints(scene, _plate(np.array([0.0, 0.0, 0.016]), 0.01, part))
    assert not hidden.seen.any()
    assert np.array_equal(hidden.points_2d, free.points_2d)
    assert not with_glints(np.zeros((96, 96), np.float32), hidden).any()


@pytest.mark.parametrize("x", [-40.0, 0.0, 3.0, 95.0, 140.0])
def test_rays_of_a_lens_leave_the_picture(x):
    glints = _glints(_scene())
    on_lens = dataclasses.replace(
        glints,
        surfaces=("lens",) * 2,
        points_2d=np.array([[x, 48.0]] * 2),
        clump_px=np.full(2, 3.0),
        seen=np.array([True, False]),
    )
    added = with_glints(np.zeros((96, 96), np.float32), on_lens)
    assert bool(added.any()) == (-33.0 <= x <= 128.0)
    assert added.sum() <= glints.volume[0] * 1.001


def test_a_lamp_beside_the_eye_has_its_image_on_the_sclera_only():
    scene = _scene(200)
    lamp = dataclasses.replace(
        scene.lamps[0], position=np.array([0.08, 0.0, -0.05]), direction=np.array([-1.0, 0.0, 0.0])
    )
    glints = _glints(dataclasses.replace(scene, lamps=(lamp,)))
    assert glints.surfaces == ("sclera",)


def test_a_line_of_tears_below_the_cornea_has_an_image_of_each_lamp():
    x = np.linspace(-0.012, 0.012, 15)
    tears = np.stack([x, np.full_like(x, -0.0075), 0.0125 - 8.0 * x**2], axis=-1)
    scene = _scene()
    glints = _glints(scene, tears=tears)
    on_tears = np.array(glints.surfaces) == "tears"
    assert [glints.lamps[i] for i in np.flatnonzero(on_tears)] == ["lamp_-1", "lamp_1"]
    assert glints.points_2d[on_tears][0, 0] < 47.5 < glints.points_2d[on_tears][1, 0]
    # the thread's mirror is weaker than the cornea, and its light is all there
    assert (glints.volume[on_tears] < 0.3 * glints.volume[~on_tears]).all()
    added = with_glints(np.zeros((96, 96), np.float32), dataclasses.replace(glints, seen=on_tears))
    assert added.sum() == pytest.approx(glints.volume[on_tears].sum(), rel=5e-3)


def _lens() -> LensMirror:
    middle = np.array([0.0, 0.0, 0.024])
    radius = 0.09
    center = middle - np.array([0.0, 0.0, radius])
    return LensMirror(
        center=center, radius=radius, middle=middle, axes=np.eye(3), half_m=(0.026, 0.018), squareness=3.0
    )


def test_a_lens_mirrors_every_lamp_once_as_a_disc_and_dims_what_is_behind_it():
    scene, lens = _scene(), _lens()
    camera_m = invert_transform(scene.views[0].camera_from_head)[:3, 3]
    free, glints = _glints(scene), _glints(scene, lenses=(lens, lens))
    on_lens = (np.array(glints.surfaces) == "lens") & (np.array(glints.eyes) == "left")
    assert [glints.lamps[i] for i in np.flatnonzero(on_lens)] == ["lamp_-1", "lamp_1"]
    points = apply_transform(invert_transform(scene.views[0].camera_from_head), glints.points_camera)
    assert lens.holds(points[on_lens]).all()
    for lamp, point in zip(scene.lamps, points[on_lens], strict=True):
        normal = (point - lens.center) / lens.radius
        cosines = [(end - point) @ normal / np.linalg.norm(end - point) for end in (lamp.position, camera_m)]
        assert cosines[0] == pytest.approx(cosines[1], abs=1e-9)
    on_cornea = np.array(glints.surfaces) == "cornea"
    np.testing.assert_array_equal(glints.points_2d[on_cornea], free.points_2d)
    np.testing.assert_allclose(glints.volume[on_cornea], 0.92**2 * free.volume)
    added = with_glints(np.zeros((96, 96), np.float32), dataclasses.replace(glints, seen=on_lens))
    assert added.sum() == pytest.approx(glints.volume[on_lens].sum(), rel=2e-3)
    # an even disc of its radius: most of it is about as bright as its middle
    bright = added > 0.5 * added.max()
    assert bright.sum() == pytest.approx(2.0 * np.pi * glints.clump_px[on_lens].mean() ** 2, rel=0.5)


def test_an_led_beams_as_its_renderer_does_and_all_of_its_power():
    lamp = _scene().lamps[0]
    for spread in (np.pi, 2.0, 1.0):
        lamp = dataclasses.replace(
            lamp, spread_rad=spread, position=np.zeros(3), direction=np.array([0, 0, 1.0])
        )
        angle = (np.arange(2000) + 0.5) / 2000 * np.pi / 2
        sent = [radiant_intensity(lamp, np.array([np.sin(a), 0.0, np.cos(a)])) for a in angle]
        total = 2.0 * np.pi * np.sum(sent * np.sin(angle)) * (angle[1] - angle[0])
        assert total == pytest.approx(lamp.power_w, rel=1e-4)


@pytest.mark.blender
@pytest.mark.parametrize("spread_rad", [np.pi, 2.0, 1.2])
def test_an_led_lights_a_matte_plate_in_the_renderer_as_the_formula_says(spread_rad: float):
    """Whose own integral says nothing of Cycles: glints would be of another brightness than what LEDs light."""
    import bpy

    from facegen.blender import open_renderer

    albedo, camera_m, lamp_m = 0.5, np.array([0.0, 0.0, 0.2]), np.array([-0.01, 0.004, 0.04])
    slant = np.array([0.2, 0.0, -1.0])
    lamp = Lamp(
        name="lamp",
        position=lamp_m,
        direction=slant / np.linalg.norm(slant),
        diameter_m=1e-3,
        power_w=1e-3,
        spread_rad=spread_rad,
    )
    view = View(
        name="plate",
        camera=Camera(width=48, height=48, fx=120.0, fy=120.0, cx=23.5, cy=23.5),
        camera_from_head=invert_transform(look_at(camera_m, np.zeros(3))),
        lamps=("lamp",),
    )
    scene = Scene(meshes=(_plate(np.zeros(3), 0.06, Part.SKIN),), lamps=(lamp,), views=(view,))
    renderer = open_renderer(threads=2)
    matte = bpy.data.materials.new("matte")
    matte.use_nodes = True
    nodes = matte.node_tree.nodes
    nodes.clear()
    diffuse, output = nodes.new("ShaderNodeBsdfDiffuse"), nodes.new("ShaderNodeOutputMaterial")
    diffuse.inputs["Color"].default_value = (albedo, albedo, albedo, 1.0)
    matte.node_tree.links.new(diffuse.outputs["BSDF"], output.inputs["Surface"])
    bpy.context.scene.view_layers[0].material_override = matte
    radiance = renderer.glimpse(scene, "plate", samples=256, seed=1, denoise=False).radiance

    rays = pixel_rays(view.camera)
    points = rays * (camera_m[2] / rays[..., 2:])
    points = apply_transform(invert_transform(view.camera_from_head), points.reshape(-1, 3))
    expected = np.empty(len(points))
    for i, point in enumerate(points):
        from_lamp = point - lamp_m
        far = np.linalg.norm(from_lamp)
        expected[i] = radiant_intensity(lamp, point) * -from_lamp[2] / far**3 * albedo / np.pi
    lit = expected > 0.1 * expected.max()
    assert lit.mean() > 0.1
    shown = radiance.reshape(-1)
    assert np.abs(shown[lit] / expected[lit] - 1.0).max() < 0.1
    assert shown[lit].sum() == pytest.approx(expected[lit].sum(), rel=0.01)


def test_fresnel_at_normal_and_grazing_incidence():
    assert fresnel(np.array(1.0), 1.336) == pytest.approx((0.336 / 2.336) ** 2)
    assert fresnel(np.array(0.0), 1.336) == pytest.approx(1.0)


@pytest.mark.blender
def test_the_rendered_cornea_mirrors_the_lamp_where_the_label_says():
    from facegen.blender import open_renderer

    scene = _scene(240)
    view = scene.views[0]
    layers = open_renderer(threads=2).render(scene, "eye", samples=1, seed=0)
    glints = _glints(scene)
    rays = pixel_rays(view.camera)
    points = rays * (layers.depth / rays[..., 2])[..., None]
    out = rays - 2.0 * (rays * layers.normal).sum(axis=-1, keepdims=True) * layers.normal
    for lamp, point_2d in zip(scene.lamps, glints.points_2d, strict=True):
        u, v = np.rint(point_2d).astype(int)
        near = np.s_[v - 4 : v + 5, u - 4 : u + 5]
        to_lamp = apply_transform(view.camera_from_head, lamp.position[None])[0] - points[near]
        miss = (np.cross(out[near], to_lamp)).reshape(-1, 3)  # 0 where the mirrored ray meets the lamp
        y, x = np.mgrid[near]
        design = np.stack([x.ravel(), y.ravel(), np.ones(x.size)], axis=-1)
        slopes, *_ = np.linalg.lstsq(design, miss, rcond=None)
        found, *_ = np.linalg.lstsq(slopes[:2].T, -slopes[2], rcond=None)
        assert np.abs(found - point_2d).max() < 0.5
        assert layers.part[v, u] in (Part.IRIS, Part.PUPIL)
    assert np.allclose(project(view.camera, glints.points_camera), glints.points_2d)
