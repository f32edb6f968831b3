"""The avatar's head: its file says what the rig says, and other programs open it."""

import json
import struct
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.avatars import export_avatar
from facegen.avatars.eyeballs import clearance
from facegen.avatars.hair import draw_hair_surfaces
from facegen.avatars.haircuts import STYLES
from facegen.avatars.shapes import CLEAR_M, face_shapes
from facegen.cli.rig import rig_app
from facegen.conventions import BLENDSHAPES, Part
from facegen.errors import InputError
from facegen.formats.gltf import read_gltf
from facegen.raster import triangles_of
from facegen.rigs import Rig
from tests.facegen.avatars.validator import complaints

pytestmark = pytest.mark.slow

COMMITTED = Path(__file__).parents[3] / "track" / "page" / "static" / "head.glb"
MOST_BYTES = 1_500_000
"""Of the page's avatar."""


@pytest.fixture(scope="module")
def head(anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("avatar") / "head.glb"
    path.write_bytes(export_avatar("anny", hair="short", seed=7, person=None))
    return path


def _document(path: Path) -> dict:
    content = path.read_bytes()
    return json.loads(content[20 : 20 + struct.unpack_from("<I", content, 12)[0]])


def test_skin_is_the_rigs(anny: Rig, head: Path) -> None:
    """Skin away from the lids is where the rig has it, at rest and with every shape."""
    skin = next(part for part in read_gltf(head) if part.material == "skin")
    assert list(skin.morphs) == list(BLENDSHAPES)
    coarse = anny.cage_vertices
    gap = np.linalg.norm(skin.positions[:, None] - anny.vertices[None, :coarse], axis=-1)
    row, near = gap.argmin(axis=1), gap.min(axis=1)
    lids = np.isin(row, anny.lid_vertices)
    kept = ~lids & (skin.positions[:, 1] > -0.16)
    assert kept.sum() > 2000
    assert near[kept].max() < 1e-6
    for index, name in enumerate(BLENDSHAPES):
        difference = skin.morphs[name][kept] - anny.expression[index, row[kept]]
        assert np.linalg.norm(difference, axis=1).max() < 1.51e-4, name


def test_lids_never_cut_the_eye(anny: Rig) -> None:
    """On the straight way from open to shut the lids' skin stays before the eye that is drawn."""
    shapes = face_shapes(anny)
    skin = np.setdiff1d(anny.faces[anny.part == Part.SKIN], [-1])
    ahead = np.array([0.0, 0.0, 1.0])
    for eye, side in enumerate(("Left", "Right")):
        centre, radius = anny.eye_center[eye], float(anny.eye_radius[eye])
        lid = np.intersect1d(anny.lid_vertices[eye], skin)
        moved = shapes.moved[BLENDSHAPES.index(f"eyeBlink{side}")][lid]
        for weight in np.linspace(0.0, 1.0, 21):
            gap = clearance(shapes.neutral[lid] + weight * moved, centre, radius, ahead)
            assert gap.min() > 0.75 * CLEAR_M, (side, weight)


def test_hair_has_no_seam(anny: Rig) -> None:
    style = STYLES["bob"]
    drawn = {"colour": (0.5, 0.4, 0.3), "rng": np.random.default_rng(2)}
    (hair,) = draw_hair_surfaces(
        anny.vertices, triangles_of(anny.faces[anny.part == Part.SKIN]), style, **drawn
    )
    _, place, count = np.unique(np.round(hair.positions, 7), axis=0, return_inverse=True, return_counts=True)
    normals = hair.normals[np.argsort(place.ravel(), kind="stable")]
    for together in np.split(normals, np.cumsum(count)[:-1]):
        np.testing.assert_allclose(together, together[:1].repeat(len(together), axis=0), atol=1e-9)
    assert (count > 1).sum() > 10


def test_bones_leave_the_rest_as_it_is(head: Path) -> None:
    """Skinned by the pose in the file, vertices lie where the file has them unskinned."""
    document = _document(head)
    skinned = read_gltf(head)
    positions = [
        document["accessors"][primitive["attributes"]["POSITION"]]
        for mesh in document["meshes"]
        for primitive in mesh["primitives"]
    ]
    assert len(skinned) == len(positions)
    for part, accessor in zip(skinned, positions, strict=True):
        assert np.abs(part.positions.min(axis=0) - accessor["min"]).max() < 1e-6
        assert np.abs(part.positions.max(axis=0) - accessor["max"]).max() < 1e-6
    names = [node["name"] for node in document["nodes"]]
    assert {"Neck", "Head", "LeftEye", "RightEye"} <= set(names)


def test_file_says_what_it_is(head: Path) -> None:
    asset = _document(head)["asset"]
    assert "CC0" in asset["copyright"]
    assert asset["extras"]["licence"].startswith("CC0")
    assert len(head.read_bytes()) <= MOST_BYTES


def test_committed_head_is_what_the_command_writes(head: Path) -> None:
    made, kept = read_gltf(head), read_gltf(COMMITTED)
    assert [part.material for part in made] == [part.material for part in kept]
    for one, other in zip(made, kept, strict=True):
        np.testing.assert_array_equal(one.triangles, other.triangles)
        np.testing.assert_allclose(one.positions, other.positions, atol=2e-5)
        for name in one.morphs:
            np.testing.assert_allclose(one.morphs[name], other.morphs[name], atol=1.7e-4)


def test_validator_has_no_complaint(head: Path) -> None:
    assert complaints(head) == []


@pytest.mark.blender
def test_blender_opens_it(head: Path) -> None:
    bpy = pytest.importorskip("bpy")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(head))
    face = bpy.data.objects["Head"]
    assert [key.name for key in face.data.shape_keys.key_blocks[1:]] == list(BLENDSHAPES)
    assert {"Neck", "Head", "LeftEye", "RightEye"} <= {bone.name for bone in bpy.data.armatures[0].bones}


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (["--out", "head.obj"], "ends with .glb"),
        (["--hair", "mohawk"], "allowed are short, cropped"),
        (["--body", "--sex", "robot"], "allowed are female, male"),
        (["--body", "--build", "tall"], "allowed are average"),
        (["--body", "--clothes", "armour"], "allowed are scrubs"),
        (["--body", "--ancestry", "elf"], "allowed are caucasian"),
    ],
)
def test_bad_options_are_refused(
    options: list[str], words: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    run = CliRunner().invoke(rig_app, ["export", "anny", *options])
    assert isinstance(run.exception, InputError)
    assert words in str(run.exception)
    assert not list(tmp_path.iterdir())


def test_options_are_what_avatars_know() -> None:
    from facegen.avatars.export import SKINS
    from facegen.avatars.garments import OUTFITS
    from facegen.avatars.people import BUILDS
    from facegen.cli import rig as command

    assert set(command.HAIR) == set(STYLES)
    assert set(command.BUILD) == set(BUILDS)
    assert set(command.CLOTHES) == set(OUTFITS)
    assert set(command.ANCESTRIES) == set(SKINS)
