"""Arrays of headset pictures: neutral pictures of the own and the other seat, what training leaves out, refusals."""

import json
import re
import shutil
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX
from regress.errors import InputError
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from tests.regress.headset.drawn import write_drawn_arrays


def test_neutral_rows_are_of_the_own_seat_or_of_the_other(arrays: HeadsetArrays):
    own, other = arrays.neutral_rows(), arrays.neutral_rows(other_seat=True)
    for found in (own, other):
        assert (found >= 0).all()
        assert arrays.neutral[found].all()
        np.testing.assert_array_equal(arrays.person[found], arrays.person)
    np.testing.assert_array_equal(arrays.session[own], arrays.session)
    assert (arrays.session[other] != arrays.session).all()


def test_without_another_seat_there_is_no_neutral_row_of_it(tmp_path: Path):
    arrays = read_arrays(write_drawn_arrays(tmp_path / "one", people=3, sessions=1))
    assert (arrays.neutral_rows(other_seat=True) == -1).all()
    assert (arrays.neutral_rows() >= 0).all()


def test_withheld_frames_are_not_among_the_kept(arrays: HeadsetArrays):
    everything = arrays.kept_rows("train")
    np.testing.assert_array_equal(everything, arrays.rows("train"))
    regions = arrays.kept_rows("train", withhold="regions")
    assert set(arrays.component[regions]) == {"neutral", "upper_face", "lower_face"}
    combined = np.setdiff1d(everything, arrays.kept_rows("train", withhold="combined"))
    blink = arrays.weights[:, [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]].max(
        axis=1
    )
    both = (arrays.weights[:, BLENDSHAPE_INDEX["jawOpen"]] > 0.25) & (blink > 0.2)
    np.testing.assert_array_equal(combined, np.flatnonzero(both & (arrays.split == "train")))
    assert len(np.unique(arrays.person[arrays.kept_rows("train", people=5)])) == 5


def test_nothing_left_is_refused(arrays: HeadsetArrays):
    with pytest.raises(InputError, match="nowhere split has no row"):
        arrays.kept_rows("nowhere")


@pytest.fixture
def copy(arrays_folder: Path, tmp_path: Path) -> Path:
    return Path(shutil.copytree(arrays_folder, tmp_path / "copy"))


def test_a_missing_folder_names_the_command_that_makes_it(tmp_path: Path):
    with pytest.raises(InputError, match="facegen pack DATASET --format arrays"):
        read_arrays(tmp_path)


@pytest.mark.parametrize("name", ["labels.parquet", "mouth.npy", "face.npz"])
def test_a_missing_or_damaged_file_is_refused(copy: Path, name: str):
    (copy / name).write_bytes(b"not this")
    with pytest.raises(InputError, match="copy"):
        read_arrays(copy)
    (copy / name).unlink()
    with pytest.raises(InputError, match="copy"):
        read_arrays(copy)


def test_pictures_of_another_size_are_refused(copy: Path):
    np.save(copy / "mouth.npy", np.zeros((3, 24, 24), np.uint8))
    with pytest.raises(InputError, match=r"mouth\.npy holds uint8 \(3, 24, 24\)"):
        read_arrays(copy)


def test_another_version_is_refused(copy: Path):
    description = json.loads((copy / "arrays.json").read_text())
    (copy / "arrays.json").write_text(json.dumps({**description, "version": 1}))
    with pytest.raises(
        InputError, match=rf"version 1; .*another folder or after {re.escape(str(copy))} is deleted"
    ):
        read_arrays(copy)


def test_a_dataset_in_place_of_its_arrays_is_told_which_command_packs_it(tmp_path):
    with pytest.raises(
        InputError, match=r"arrays\.json does not exist; a folder of arrays is what facegen pack"
    ):
        read_arrays(tmp_path)
    (tmp_path / "dataset.json").write_text("{}")
    with pytest.raises(InputError, match=f"is a dataset.* facegen pack {tmp_path} --format arrays"):
        read_arrays(tmp_path)
