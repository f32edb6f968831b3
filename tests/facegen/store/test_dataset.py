"""A dataset's folder holds all that says what it is."""

import re
from pathlib import Path

import pytest

from facegen.errors import InputError
from facegen.headsets import headset_path
from facegen.spec import load_spec
from facegen.store import begin, open_dataset, resolve

SPEC = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n[render]\nheadset = "mine.toml"\n'


@pytest.fixture
def folder(tmp_path, anny) -> Path:
    own = headset_path("tracking3").read_text().replace('name = "tracking3"', 'name = "mine"')
    (tmp_path / "mine.toml").write_text(own)
    (tmp_path / "spec.toml").write_text(SPEC)
    return tmp_path


def test_a_headset_beside_the_spec_is_used_and_copied(folder):
    dataset = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(dataset)
    (folder / "mine.toml").unlink()
    opened = open_dataset(folder / "out")
    assert opened.headset.name == "mine"
    assert opened.hash == dataset.hash


def test_where_a_headset_lies_does_not_matter_but_what_it_says_does(folder):
    hash_here = resolve(load_spec(folder / "spec.toml"), folder / "out").hash
    (folder / "elsewhere").mkdir()
    for name in ("mine.toml", "spec.toml"):
        (folder / name).rename(folder / "elsewhere" / name)
    spec = folder / "elsewhere" / "spec.toml"
    assert resolve(load_spec(spec), folder / "out").hash == hash_here
    changed = folder / "elsewhere" / "mine.toml"
    text, replaced = re.subn(r"(?m)^black_level = .*", "black_level = 2", changed.read_text())
    assert replaced == 1
    changed.write_text(text)
    assert resolve(load_spec(spec), folder / "out").hash != hash_here


def test_a_headset_that_is_not_there_is_named(folder):
    (folder / "mine.toml").unlink()
    with pytest.raises(InputError, match=r"render\.headset = 'mine\.toml': there is no file"):
        load_spec(folder / "spec.toml")


def test_a_damaged_description_is_refused(folder):
    dataset = resolve(load_spec(folder / "spec.toml"), folder / "out")
    begin(dataset)
    dataset.folder.headset_toml.write_text(
        headset_path("tracking3").read_text().replace("fx = 229.0", "fx = 228.0", 1)
    )
    with pytest.raises(InputError, match="another version"):
        open_dataset(folder / "out")
