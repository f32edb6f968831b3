"""Licences and credits go along: with a dataset, with joined ones, and with packs of it."""

import shutil
from pathlib import Path

import numpy as np
import pytest

from facegen.errors import InputError
from facegen.formats.live_link import live_link_csv
from facegen.packing import PACK_FORMATS, Options, plan_pack, write_pack
from facegen.rigs import rigs_folder
from facegen.rigs.licence import MOST_LICENCE_BYTES
from facegen.spec import load_spec
from facegen.store import Dataset, begin, merge, resolve
from facegen.work import generate

TEXT = "Permission is hereby granted to the tests.\n"
STILL = 'version = 1\nkind = "still"\nseed = 1\npeople = 3\n[still]\nneutral = 1\nfaces = 1\n'
PLAYED = (
    'version = 1\nkind = "playback"\nseed = 1\npeople = 2\n[playback]\nrecording = "take.csv"\nfps = 30\n'
)


@pytest.fixture
def rigs(anny, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder of rigs in which the text of anny's licence lies beside it."""
    folder = tmp_path / "rigs"
    folder.mkdir()
    for ending in (".json", ".npz"):
        shutil.copyfile(rigs_folder() / f"anny{ending}", folder / f"anny{ending}")
    (folder / "anny.LICENSE").write_text(TEXT)
    monkeypatch.setenv("FACEGEN_RIGS", str(folder))
    return folder


def begun(tmp_path: Path, spec: str, out: str = "out") -> Dataset:
    (tmp_path / "take.csv").write_text(live_link_csv(np.zeros((4, 52)), np.arange(4) / 30))
    (tmp_path / "spec.toml").write_text(spec)
    dataset = resolve(load_spec(tmp_path / "spec.toml"), tmp_path / out)
    begin(dataset)
    return dataset


def test_a_dataset_holds_the_text_and_the_source_of_its_rig(rigs: Path, tmp_path: Path):
    dataset = begun(tmp_path, STILL)
    written = dataset.folder.licences_txt.read_text()
    (rig,) = dataset.rigs
    assert all(words in written for words in (TEXT, rig.source, rig.version, rig.licence))
    dataset.folder.licences_txt.unlink()
    begin(dataset)
    assert dataset.folder.licences_txt.read_text() == written


def test_a_licence_longer_than_any_is_refused(rigs: Path, tmp_path: Path):
    (rigs / "anny.LICENSE").write_text("x" * (MOST_LICENCE_BYTES + 1))
    with pytest.raises(InputError, match=r"anny\.LICENSE"):
        begun(tmp_path, STILL)


@pytest.mark.parametrize("name", [name for name, form in PACK_FORMATS.items() if not form.rendered])
def test_what_is_made_of_a_dataset_has_its_licences(rigs: Path, tmp_path: Path, name: str):
    dataset = begun(tmp_path, PLAYED)
    generate(dataset, workers=1)
    # also where the rig's own text is gone by then
    (rigs / "anny.LICENSE").unlink()
    copied = shutil.copytree(dataset.folder.path, tmp_path / "copy")
    merge([dataset.folder.path, copied], tmp_path / "joined")
    write_pack(plan_pack(dataset, name, Options()), tmp_path / "pack")
    for folder in ("joined", "pack"):
        assert (tmp_path / folder / "LICENSE.txt").read_bytes() == dataset.folder.licences_txt.read_bytes()
        assert TEXT in (tmp_path / folder / "LICENSE.txt").read_text()


def test_the_card_of_a_recording_says_whose_it_is_or_that_nobody_knows(anny, tmp_path: Path):
    unknown = begun(tmp_path, PLAYED)
    card = unknown.folder.card.read_text()
    assert "Nobody in them exists" not in card
    assert "Whose recording: unknown. Licence of the recording: unknown." in card
    assert "license: other\n" in card
    assert "the recording of unknown: unknown" in unknown.licence
    known = begun(tmp_path, PLAYED + 'credit = "Ada, by Ben"\nlicence = "CC0-1.0"\n', "known")
    card = known.folder.card.read_text()
    assert "Whose recording: Ada, by Ben. Licence of the recording: CC0-1.0." in card
    assert "license: cc0-1.0\n" in card
    assert "Whose: Ada, by Ben\nLicence: CC0-1.0" in known.folder.licences_txt.read_text()
    assert known.hash == unknown.hash
    assert "Nobody in them exists" in begun(tmp_path, STILL, "still").folder.card.read_text()
