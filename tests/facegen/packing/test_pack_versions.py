"""A pack is of one version of its format: one that goes on in another's folder would be half of each, or stay old."""

import dataclasses
import json

import pytest

from facegen.errors import InputError
from facegen.packing import PACK_FORMATS, Options, plan_pack, write_pack


@pytest.mark.parametrize("stopped", [True, False])
@pytest.mark.parametrize(("told", "now"), [(None, 2), (1, 2), (2, 1)])
def test_a_pack_of_another_version_is_refused_and_stays(recorded, tmp_path, monkeypatch, stopped, told, now):
    plan, out = plan_pack(recorded, "livelink", Options(samples="0-59")), tmp_path / "pack"
    write_pack(plan, out)
    about = json.loads((out / "pack.json").read_text()) | {"version": told}
    (out / "pack.json").write_text(json.dumps({key: v for key, v in about.items() if v is not None}))
    if stopped:
        (out / "index.json").unlink()
    before = {path.name: path.read_bytes() for path in out.iterdir()}
    monkeypatch.setitem(PACK_FORMATS, "livelink", dataclasses.replace(PACK_FORMATS["livelink"], version=now))
    with pytest.raises(InputError, match=r"packed by another version of facegen.*another folder, or delete"):
        write_pack(plan, out)
    assert {path.name: path.read_bytes() for path in out.iterdir()} == before


def test_a_pack_that_tells_no_version_goes_on_where_nothing_has_changed(recorded, tmp_path):
    plan, out = plan_pack(recorded, "livelink", Options(samples="0-59")), tmp_path / "pack"
    write_pack(plan, out)
    about = json.loads((out / "pack.json").read_text())
    assert about.pop("version") == PACK_FORMATS["livelink"].version == 1
    (out / "pack.json").write_text(json.dumps(about))
    again = write_pack(plan, out)
    assert (again.written, again.found) == (0, 1)
    with pytest.raises(InputError, match="holds another pack"):
        write_pack(plan_pack(recorded, "livelink", Options(samples="60-119")), out)
