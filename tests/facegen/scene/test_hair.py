"""Lashes and brows: strands on every rig, rooted where they should be, carried along by the face."""

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, LANDMARK_GROUPS, Part
from facegen.rigs import evaluate
from facegen.rigs.lash_strips import lash_strips
from facegen.scene import draw_look
from facegen.scene.looks import hair_meshes
from facegen.scene.strands import TUBE_SIDES, strand_tubes


def _face(rig, **weights):
    row = np.zeros((1, 52))
    for name, value in weights.items():
        row[0, BLENDSHAPE_INDEX[name]] = value
    axis = np.broadcast_to([0.0, 0.0, 1.0], (1, 2, 3))
    return evaluate(rig, np.zeros((1, rig.components)), row, axis)


def test_tubes_keep_their_radius_and_face_outwards():
    rng = np.random.default_rng(1)
    centres = np.cumsum(rng.normal(size=(40, 6, 3)) * 0.2 + [1.0, 0.5, -0.3], axis=1) * 1e-3
    radius = np.linspace(1e-4, 2e-5, 6)[None] * np.ones((40, 1))
    vertices, quads = strand_tubes(centres, radius)
    away = vertices.reshape(40, 6, TUBE_SIDES, 3) - centres[:, :, None]
    assert np.allclose(np.linalg.norm(away, axis=-1), radius[..., None])
    a, b, c = (vertices[quads[:, i]] for i in range(3))
    middle = np.repeat(0.5 * (centres[:, :-1] + centres[:, 1:]).reshape(-1, 3), TUBE_SIDES, axis=0)
    outwards = (np.cross(b - a, c - a) * (vertices[quads].mean(axis=1) - middle)).sum(axis=-1)
    assert (outwards > 0).mean() > 0.99


def test_lash_strips_run_from_the_inner_corner_and_from_the_lid(anny):
    strips = lash_strips(anny)
    assert sorted(strip.lid for strip in strips) == ["lower", "lower", "upper", "upper"]
    for strip in strips:
        places = anny.vertices[strip.grid]
        away = np.linalg.norm(places[:, :, None] - anny.eye_center, axis=-1).min(axis=-1)
        assert away[:, -1].mean() > away[:, 0].mean() + 4e-3
        assert np.abs(places[0, 0, 0]) < np.abs(places[-1, 0, 0])


def test_hair_grows_at_lids_and_brows_and_moves_with_them(anny):
    look = draw_look(np.random.default_rng(5), anny)
    open_face, closed = _face(anny), _face(anny, eyeBlinkLeft=1.0, eyeBlinkRight=1.0, browInnerUp=1.0)
    for face in (open_face, closed):
        lashes, hair = hair_meshes(look, face.vertices[0])
        assert set(lashes.part) == {Part.LASHES}
        assert set(hair.part) == {Part.HAIR}
        rim = np.concatenate([face.vertices[0, margin] for margin in (*anny.upper_lid, *anny.lower_lid)])
        roots = lashes.vertices.reshape(-1, 7, TUBE_SIDES, 3)[:, 0].mean(axis=1)
        assert np.linalg.norm(roots[:, None] - rim, axis=-1).min(axis=1).max() < 4e-3
        line = face.landmarks[0, [*LANDMARK_GROUPS["right_brow"], *LANDMARK_GROUPS["left_brow"]]]
        roots = hair.vertices.reshape(-1, 5, TUBE_SIDES, 3)[:, 0].mean(axis=1)
        assert np.linalg.norm(roots[:, None] - line, axis=-1).min(axis=1).max() < 12e-3
        assert (roots[:, 0] > 0).mean() == pytest.approx(0.5, abs=0.05)
    tips_open, tips_closed = (
        hair_meshes(look, face.vertices[0])[0].vertices.reshape(-1, 7, TUBE_SIDES, 3)[:, -1].mean(axis=1)
        for face in (open_face, closed)
    )
    upper = tips_open[:, 1] > 0
    assert (tips_closed[upper, 1] < tips_open[upper, 1] - 4e-3).mean() > 0.9


def test_people_have_looks_of_their_own_which_repeat(anny):
    first, again, other = (draw_look(np.random.default_rng(seed), anny) for seed in (1, 1, 2))
    assert first.materials == again.materials != other.materials
    assert all(np.array_equal(a, b) for a, b in zip(first.lashes.place, again.lashes.place, strict=True))
    albedos = [draw_look(np.random.default_rng(seed), anny).materials["skin"]["albedo"] for seed in range(40)]
    assert 0.5 <= min(albedos) < max(albedos) <= 0.7
