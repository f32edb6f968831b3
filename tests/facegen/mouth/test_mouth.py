"""Teeth, gums and tongue: sizes and places of the anatomy, the jaw's motion, and nothing through the lips."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX, Part
from facegen.geometry import apply_transform, rotation_from_angles
from facegen.mouth import draw_mouth, has_own_teeth, mouth_meshes
from facegen.mouth.arch import course, crowns, half_length, seats
from facegen.mouth.cavity import cavity_surface, has_own_cavity
from facegen.mouth.crowns import LOWER, UPPER, crown
from facegen.mouth.jaw import bone_vertices, jaw_motion, rigid_fit
from facegen.mouth.wall import wall_faces
from facegen.raster import nearest_along_z, triangles_of
from facegen.rigs import evaluate, neutral_landmarks

FACES = (
    {},
    {"jawOpen": 0.5},
    {"mouthSmileLeft": 0.9, "mouthSmileRight": 0.9, "mouthUpperUpLeft": 0.5, "mouthUpperUpRight": 0.5},
    {"mouthRollUpper": 0.8, "mouthRollLower": 0.8},
    {"jawLeft": 0.8, "jawOpen": 0.3, "mouthPucker": 0.6},
)
GRID = {"origin": np.array([-0.045, -0.03]), "step": 4e-4, "shape": (200, 225)}
"""Samples of a view from the front over the mouth."""
STILL = {name: np.zeros((2, 14)) for name in ("turn_rad", "outwards_m", "down_m")}


def _row(**weights) -> np.ndarray:
    row = np.zeros(52)
    for name, value in weights.items():
        row[BLENDSHAPE_INDEX[name]] = value
    return row


def _face(rig, person: int, **weights):
    """Vertices, landmarks and mouth meshes by name of one face."""
    rng = np.random.default_rng(person)
    identity = np.clip(rng.standard_normal(rig.components), -2.0, 2.0)
    axis = np.broadcast_to([0.0, 0.0, 1.0], (1, 2, 3))
    face = evaluate(rig, identity[None], _row(**weights)[None], axis)
    meshes = mouth_meshes(
        rig, draw_mouth(rng), identity=identity, weights=_row(**weights), vertices=face.vertices[0]
    )
    return identity, face.vertices[0], face.landmarks[0], {mesh.name: mesh for mesh in meshes}


@pytest.mark.parametrize(
    "tooth", [*UPPER, *LOWER], ids=lambda tooth: f"{tooth.kind}-{tooth.width}x{tooth.length}"
)
def test_crowns_have_the_sizes_of_the_table(tooth):
    vertices, faces = crown(tooth)
    above_gum = vertices[vertices[:, 2] <= 1e-3 * tooth.length]
    width, depth, length = 1e3 * np.ptp(above_gum, axis=0)
    assert width == pytest.approx(tooth.width, rel=0.02)
    assert depth == pytest.approx(tooth.depth, rel=0.06)
    assert length == pytest.approx(tooth.length, rel=0.12)  # cusps are what is lower than their tips
    a, b, c = (vertices[triangles_of(faces)[:, i]] for i in range(3))
    assert np.einsum("ij,ij->", np.cross(a, b), c) > 0.0  # the volume: outsides are out


def test_arches_are_symmetric_and_their_teeth_touch():
    for kinds in (UPPER, LOWER):
        line = course(half_length(kinds, 1.0), 0.8)
        none = {name: values[0] for name, values in STILL.items()}
        vertices, faces, tooth = crowns(line, seats(kinds, 1.0, **none, missing=np.zeros(14, bool)))
        mirrored = vertices[tooth == 6] * [-1.0, 1.0, 1.0]
        assert np.abs(mirrored[:, None] - vertices[tooth == 7]).sum(axis=-1).min(axis=1).max() < 1e-5
        for left, right in zip(range(13), range(1, 14), strict=True):
            a, b = vertices[tooth == left], vertices[tooth == right]
            assert np.linalg.norm(a[:, None] - b, axis=-1).min() < 0.7e-3
        a, b, c = (vertices[triangles_of(faces)[:, i]] for i in range(3))
        assert np.einsum("ij,ij->", np.cross(a, b), c) > 0.0


@settings(max_examples=30, deadline=None)
@given(st.lists(st.floats(-0.5, 0.5), min_size=6, max_size=6))
def test_a_rigid_motion_is_found(values):
    motion = np.eye(4)
    motion[:3, :3], motion[:3, 3] = rotation_from_angles(*values[:3]), values[3:]
    points = np.random.default_rng(3).normal(size=(20, 3))
    assert np.allclose(rigid_fit(points, apply_transform(motion, points)), motion, atol=1e-9)


@pytest.mark.parametrize(
    "weights", [{"jawOpen": 1.0}, {"jawOpen": 0.4, "jawRight": 1.0}, {"jawForward": 1.0}]
)
def test_the_jaw_moves_as_the_rigs_lower_teeth_do(anny, weights):
    bone, identity = bone_vertices(anny), np.zeros(anny.components)
    moved = anny.vertices[bone] + sum(
        v * anny.expression[BLENDSHAPE_INDEX[k], bone] for k, v in weights.items()
    )
    found = apply_transform(jaw_motion(anny, identity, _row(**weights)), anny.vertices[bone])
    assert np.sqrt(np.square(found - moved).sum(axis=1).mean()) < 0.6e-3
    lips = jaw_motion(anny, identity, _row(**weights, mouthShrugLower=1.0, mouthFunnel=1.0))
    assert np.array_equal(lips, jaw_motion(anny, identity, _row(**weights)))


def test_upper_teeth_stay_and_lower_ones_go_with_the_jaw(anny):
    identity, _, _, rest = _face(anny, 4)
    _, _, _, moved = _face(anny, 4, jawOpen=0.6)
    step = np.linalg.norm(moved["teeth"].vertices - rest["teeth"].vertices, axis=1)
    upper = rest["teeth"].vertices[:, 1] > rest["teeth"].vertices[:, 1].mean()
    still = step < 1e-9
    assert still[upper].mean() > 0.8
    assert (step > 5e-3).sum() > 0.4 * len(step)
    motion = jaw_motion(anny, identity, _row(jawOpen=0.6))
    off = np.linalg.norm(apply_transform(motion, rest["teeth"].vertices) - moved["teeth"].vertices, axis=1)
    assert np.median(off[~still]) < 1e-6


def _through_lips(rig, vertices, points, faces) -> tuple[int, int]:
    """Of the picture's samples that show a mesh, seen from the front: how many have skin or lips behind it, and all."""
    lips = wall_faces(rig)
    a, b, c = (vertices[lips[:, i]] for i in range(3))
    facing = np.cross(b - a, c - a)[:, 2] > 0.0
    skin = np.maximum(nearest_along_z(vertices, lips[facing], **GRID).value, -1.0)
    inside = nearest_along_z(points, triangles_of(faces), **GRID).value
    seen = inside > skin
    return int((seen & (inside < skin + 12e-3)).sum()), int(seen.sum())


@pytest.mark.parametrize("weights", FACES, ids=lambda weights: "-".join(weights) or "rest")
def test_no_tooth_or_gum_comes_through_the_lips(anny, weights):
    seen = 0
    for person in range(2):
        _, vertices, _, meshes = _face(anny, person, **weights)
        for name in ("teeth", "gums"):
            through, here = _through_lips(anny, vertices, meshes[name].vertices, meshes[name].faces)
            assert through == 0
            seen += here
        forward = meshes["teeth"].vertices + np.array([0.0, 0.0, 12e-3])
        assert _through_lips(anny, vertices, forward, meshes["teeth"].faces)[0] > 20
    if weights.get("jawOpen") == 0.5:
        assert seen > 500


def test_the_tongue_rests_in_the_lower_arch_and_comes_out_over_the_lip(anny):
    _, _, points, rest = _face(anny, 2, jawOpen=0.5)
    _, _, _, out = _face(anny, 2, jawOpen=0.5, tongueOut=1.0)
    teeth = rest["teeth"].vertices
    lower = teeth[teeth[:, 1] < teeth[:, 1].mean()]
    assert rest["tongue"].vertices[:, 2].max() < lower[:, 2].max() - 2e-3
    assert np.abs(rest["tongue"].vertices[:, 0]).max() < np.abs(lower[:, 0]).max()
    assert out["tongue"].vertices[:, 2].max() > points[57, 2] + 8e-3
    above_lip = out["tongue"].vertices[np.abs(out["tongue"].vertices[:, 2] - points[66, 2]) < 1e-3]
    assert above_lip[:, 1].min() > points[66, 1] - 0.5e-3


def test_people_differ_and_repeat():
    first, again, other = (draw_mouth(np.random.default_rng(seed)) for seed in (1, 1, 2))
    assert first.materials == again.materials
    assert np.array_equal(first.turn_rad, again.turn_rad)
    assert first.size != other.size
    people = [draw_mouth(np.random.default_rng(seed)) for seed in range(400)]
    assert 3 <= sum(person.missing.any() for person in people) <= 40
    assert not any(person.missing[:, 4:10].any() for person in people)  # front teeth are there


def test_parts_and_names_are_those_of_the_rigs_own(anny):
    _, _, _, meshes = _face(anny, 1)
    assert {name: Part(mesh.part[0]) for name, mesh in meshes.items()} == {
        "teeth": Part.TEETH,
        "gums": Part.GUMS,
        "tongue": Part.TONGUE,
    }
    assert not has_own_teeth(anny)
    assert has_own_cavity(anny)


def test_a_pouch_closes_heads_without_one(anny):
    points = neutral_landmarks(anny, np.zeros((1, anny.components)))[0]
    vertices, quads = cavity_surface(points, 1.0)
    rim = vertices[: len(vertices) // 12]
    assert np.linalg.norm(rim[:, None] - points[60:68], axis=-1).min(axis=0).max() < 2e-3
    a, b, c = (vertices[quads[:, i]] for i in range(3))
    inwards = np.cross(b - a, c - a) * (vertices.mean(axis=0) - a)
    assert (inwards.sum(axis=1) > 0.0).mean() > 0.9
    assert np.ptp(vertices[:, 2]) > 60e-3
    front = nearest_along_z(anny.vertices, wall_faces(anny), **GRID).value
    behind = nearest_along_z(vertices, triangles_of(quads), **GRID).value
    covered = np.isfinite(front) & np.isfinite(behind)
    assert covered.sum() > 10_000
    assert (behind > front)[covered].mean() < 5e-3  # the rim hangs on the lips themselves
