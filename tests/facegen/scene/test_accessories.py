"""Beards and glasses: where they belong on every face, outside its skin, and the same person's in every session."""

import dataclasses

import numpy as np
import pytest
from scipy.spatial import cKDTree

from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.raster import triangles_of
from facegen.rigs import evaluate, eye_geometry
from facegen.scene.accessories import draw_accessories
from facegen.scene.beard_maps import beard_map
from facegen.scene.beards import BEARD_KINDS, LENGTH_M, beard_strands, draw_beard
from facegen.scene.glasses import draw_glasses, glasses_meshes, place_lenses

EXPRESSIONS = (
    {},
    {"jawOpen": 0.8, "mouthUpperUpLeft": 0.7, "mouthUpperUpRight": 0.7},
    {"mouthSmileLeft": 1.0, "mouthSmileRight": 1.0, "cheekSquintLeft": 1.0, "cheekSquintRight": 1.0},
    {"browDownLeft": 1.0, "browDownRight": 1.0, "noseSneerLeft": 1.0, "noseSneerRight": 1.0},
)


def _face(rig, seed: int = 0, **weights: float):
    row = np.zeros((1, 52))
    for name, value in weights.items():
        row[0, BLENDSHAPE_INDEX[name]] = value
    identity = np.random.default_rng(seed).normal(0.0, 0.7, (1, rig.components)) * (seed > 0)
    return evaluate(rig, identity, row, np.broadcast_to([0.0, 0.0, 1.0], (1, 2, 3)))


def _heights(vertices: np.ndarray, triangles: np.ndarray, places: np.ndarray) -> np.ndarray:
    """How far places stand out of the nearest vertex's tangent plane, metres."""
    used, corners = np.unique(triangles, return_inverse=True)
    skin, corners = vertices[used], corners.reshape(-1, 3)
    a, b, c = (skin[corners[:, i]] for i in range(3))
    normal = np.zeros_like(skin)
    for i in range(3):
        np.add.at(normal, corners[:, i], np.cross(b - a, c - a))
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    nearest = cKDTree(skin).query(places)[1]
    return ((places - skin[nearest]) * normal[nearest]).sum(axis=-1)


def _beards(rig, count: int = 12):
    return [draw_beard(np.random.default_rng(i), np.random.default_rng(90 + i), rig) for i in range(count)]


def test_beards_grow_on_the_lower_face_alone_and_stay_out_of_skin_and_mouth(anny):
    beards = _beards(anny)
    assert {beard.kind for beard in beards} == set(BEARD_KINDS)
    for beard, weights in zip(beards, EXPRESSIONS * 3, strict=True):
        face = _face(anny, seed=3, **weights)
        landmarks, strands = face.landmarks[0], beard_strands(beard, anny, face.vertices[0])
        root, rest = strands.points[:, 0], strands.points[:, 1:]
        assert root[:, 1].max() < landmarks[[0, 16], 1].max() + 12e-3
        assert (np.linalg.norm(np.diff(strands.points, axis=1), axis=-1) < 8e-3).all()
        skin = beard_map(anny).skin
        # the tangent plane of a vertex stands off a curved skin by some tenths of a millimetre
        heights = _heights(face.vertices[0], skin, rest.reshape(-1, 3))
        assert (heights > -0.3e-3).mean() > 0.99
        upper, lower = landmarks[[60, 61, 62, 63, 64]], landmarks[[60, 67, 66, 65, 64]]
        x, y, z = np.moveaxis(rest, -1, 0)
        below, above = (np.interp(x, lip[:, 0], lip[:, 1], left=0.0, right=0.0) for lip in (upper, lower))
        opening = (y < below - 1e-3) & (y > above + 1e-3) & (np.abs(x) < 0.02) & (z < upper[:, 2].max())
        assert not opening.any()


def test_a_person_keeps_their_roots_and_kind_and_hair_grows_from_session_to_session(anny):
    sessions = [draw_beard(np.random.default_rng(4), np.random.default_rng(i), anny) for i in range(12)]
    own = {beard.kind for beard in sessions} - {"stubble"}
    assert len(own) <= 1
    assert len({beard.length_m for beard in sessions}) == 12
    for beard in sessions:
        low, high = LENGTH_M[beard.kind]
        assert low <= beard.length_m <= high
        same = next(other for other in sessions if other.kind == beard.kind)
        np.testing.assert_array_equal(beard.triangle, same.triangle)
        assert (beard.reach_m <= beard.length_m + 1e-12).all()


@pytest.mark.parametrize("weights", EXPRESSIONS, ids=lambda weights: next(iter(weights), "rest"))
@pytest.mark.parametrize("seed", [0, 1, 2])
def test_glasses_stand_before_the_eyes_and_outside_the_skin(anny, seed, weights):
    face = _face(anny, seed, **weights)
    eyes = tuple(
        eye_geometry(face.eye_center[0, s], float(face.eye_radius[0, s]), np.array([0.0, 0.0, 1.0]))
        for s in (0, 1)
    )
    glasses = draw_glasses(np.random.default_rng(seed))
    lenses = place_lenses(glasses, anny, face.vertices[0], eyes)
    frame, panes = glasses_meshes(glasses, lenses, anny, face.vertices[0])
    assert set(frame.part) == {Part.GLASSES}
    assert set(panes.part) == {Part.LENS}
    assert np.isfinite(frame.vertices).all()
    skin = triangles_of(anny.faces[np.isin(anny.part, (Part.SKIN, Part.BROWS))])
    # temples pass the ears, which a frame's wearer bends and this face does not
    before_ears = frame.vertices[frame.vertices[:, 2] > -0.03]
    assert _heights(face.vertices[0], skin, before_ears).min() > -0.2e-3
    for eye, lens in zip(eyes, lenses, strict=True):
        assert lens.middle[2] > eye.center[2] + 0.022
        assert lens.holds(lens.middle[None]).all()
        assert abs(lens.middle[0] - eye.center[0]) < 8e-3
    assert np.allclose(panes.vertices[:, 0].mean(), frame.vertices[:, 0].mean(), atol=2e-3)


def test_shares_say_who_wears_what_and_every_draw_is_there_for_all(anny):
    def worn(seed: int, female: bool, **shares: float):
        streams = np.random.default_rng(seed), np.random.default_rng(1000 + seed)
        return draw_accessories(
            *streams, anny, female=female, **({"beard": 0, "glasses": 0, "make_up": 0} | shares)
        )

    nothing = worn(1, False)
    assert not any(getattr(nothing, field.name) for field in dataclasses.fields(nothing))
    assert worn(1, True, beard=1.0).beard is None
    assert worn(1, False, make_up=1.0).make_up is None
    alone, together = worn(1, False, glasses=1.0), worn(1, False, glasses=1.0, beard=1.0)
    assert alone.glasses == together.glasses
    share = np.mean([worn(seed, True, glasses=0.3).glasses is not None for seed in range(400)])
    assert share == pytest.approx(0.3, abs=0.07)
