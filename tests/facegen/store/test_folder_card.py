"""Every dataset says what it is: a card and Croissant metadata, of the same bytes whoever begins it."""

import json
import re
import shutil
from pathlib import Path

import pytest

from facegen.errors import InputError
from facegen.spec import load_spec
from facegen.store import Dataset, begin, merge, resolve
from facegen.store.card import _size

SPEC = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n'
CARDS = ("README.md", "croissant.json", "LICENSE.txt")


@pytest.fixture
def spec(tmp_path: Path, anny) -> Path:
    path = tmp_path / "spec.toml"
    path.write_text(SPEC)
    return path


def begun(spec: Path, out: Path) -> Dataset:
    dataset = resolve(load_spec(spec), out)
    begin(dataset)
    return dataset


def cards(folder: Path) -> list[bytes]:
    return [(folder / name).read_bytes() for name in CARDS]


def test_equal_datasets_have_equal_cards_whatever_is_rendered(spec: Path, tmp_path: Path):
    first = cards(begun(spec, tmp_path / "first").folder.path)
    spec.write_text(SPEC + '[render]\nsamples = "0-1"\n')
    assert cards(begun(spec, tmp_path / "second").folder.path) == first


def test_the_card_says_splits_columns_licence_and_how_it_was_made(spec: Path, tmp_path: Path):
    spec.write_text(SPEC + "split_shares = [0.6, 0.0, 0.4]\n")
    dataset = begun(spec, tmp_path / "out")
    text = dataset.folder.card.read_text()
    front = text.split("---\n")[1]
    assert "license: cc0-1.0\n" in front
    assert "path: keypoints/shard-*.parquet\n" in front
    assert re.findall(r"^\| (\w+) \| (\d+)% \|$", text, re.M) == [("train", "60"), ("test", "40")]
    assert dataset.hash in text
    assert dataset.licence in text
    assert all(f"| `{field.name}` |" in text for field in dataset.keypoint_schema)


def test_croissant_names_the_pictures_of_each_camera(spec: Path, tmp_path: Path):
    dataset = begun(spec, tmp_path / "out")
    rows = [rows["name"] for rows in json.loads(dataset.folder.croissant_json.read_text())["recordSet"]]
    assert rows == ["samples", "rendered", *(f"{view}_pictures" for view in dataset.headset.camera_names)]


@pytest.mark.parametrize("name", CARDS)
def test_a_card_that_a_stop_left_out_is_written_by_the_next_run(spec: Path, tmp_path: Path, name: str):
    folder = begun(spec, tmp_path / "out").folder.path
    whole = cards(folder)
    (folder / name).unlink()
    begun(spec, folder)
    assert cards(folder) == whole


def test_what_a_person_wrote_stays(spec: Path, tmp_path: Path):
    dataset = begun(spec, tmp_path / "out")
    dataset.folder.card.write_text("mine")
    begun(spec, tmp_path / "out")
    assert dataset.folder.card.read_text() == "mine"
    (tmp_path / "others").mkdir()
    (tmp_path / "others" / "README.md").write_text("mine")
    with pytest.raises(InputError, match="is not empty"):
        begun(spec, tmp_path / "others")
    assert (tmp_path / "others" / "README.md").read_text() == "mine"


def test_joined_datasets_keep_the_card(spec: Path, tmp_path: Path):
    folder = begun(spec, tmp_path / "out").folder.path
    copied = shutil.copytree(folder, tmp_path / "copy")
    merge([folder, copied], tmp_path / "joined")
    assert cards(tmp_path / "joined") == cards(folder)


@pytest.mark.parametrize(
    ("samples", "words"),
    [
        (999, "n<1K"),
        (1_000, "1K<n<10K"),
        (9_999_999, "1M<n<10M"),
        (10_000_000, "10M<n<100M"),
        (5_000_000_000, "1B<n<10B"),
        (999_999_999_999, "100B<n<1T"),
        (10**12, "n>1T"),
    ],
)
def test_sizes_are_called_as_hugging_face_calls_them(samples: int, words: str):
    assert _size(samples) == words
