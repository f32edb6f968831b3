"""Developing anew: the dataset's own pictures without options, others with them, always the same bytes."""

import json
import os

import numpy as np
import pytest
from typer.testing import CliRunner

from facegen.cli import app
from facegen.errors import InputError
from facegen.store import read_png
from facegen.work import Settings, develop_dataset

pytestmark = [pytest.mark.blender, pytest.mark.slow]


def pictures(folder) -> dict[str, bytes]:
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*.png"))}


def test_plain_settings_give_the_datasets_own_bytes(rendered, tmp_path):
    result = CliRunner().invoke(app, ["develop", str(rendered.folder.path), "--out", str(tmp_path / "a")])
    assert result.exit_code == 0, result.output
    own = pictures(rendered.folder.path)
    assert len(own) == 6
    assert pictures(tmp_path / "a") == own
    assert (tmp_path / "a" / "LICENSE.txt").read_bytes() == rendered.folder.licences_txt.read_bytes()
    shots = json.loads((tmp_path / "a" / "renders" / "000" / "000001" / "shots.json").read_text())
    recorded = {name: view["shot"] for name, view in rendered.sample(1)["views"].items()}
    assert shots == recorded
    assert develop_dataset(rendered, tmp_path / "a") == 0, "what is there is kept"


def test_exposure_and_seed_change_pictures_and_repeat(rendered, tmp_path):
    exposure = rendered.headset.sensor.exposure
    runs = {
        "dark": Settings(exposure=0.5 * exposure),
        "other": Settings(seed=8),
        "again": Settings(seed=8),
        "quiet": Settings(noise=0.0),
    }
    for name, settings in runs.items():
        assert develop_dataset(rendered, tmp_path / name, settings, [1]) == 1
    own = rendered.folder.render(1)
    for view in rendered.headset.camera_names:
        levels = {name: read_png(next((tmp_path / name).rglob(f"{view}.png"))).astype(float) for name in runs}
        plain = read_png(own / f"{view}.png").astype(float)
        black = rendered.sample(1)["headset"]["sensor"]["black_level"]
        assert (levels["dark"] - black).mean() == pytest.approx(0.5 * (plain - black).mean(), rel=0.03)
        assert 0.1 < np.abs(levels["other"] - plain).mean()
        assert (levels["other"] == levels["again"]).all()
        assert 0.2 < (plain - levels["quiet"]).std() < 3.0


def test_what_a_killed_run_left_is_swept(rendered, tmp_path):
    left = tmp_path / "a" / "tmp" / "develop-0-another-machine"
    left.mkdir(parents=True)
    (left / "mouth.png").write_bytes(b"half")
    os.utime(left, (0, 0))
    develop_dataset(rendered, tmp_path / "a", numbers=[0])
    assert not left.exists()


def test_other_settings_missing_samples_and_strange_folders_are_refused(rendered, tmp_path):
    develop_dataset(rendered, tmp_path / "a", numbers=[0])
    with pytest.raises(InputError, match="holds pictures of another dataset or with other settings"):
        develop_dataset(rendered, tmp_path / "a", Settings(seed=3), [0])
    with pytest.raises(InputError, match="sample 7 has not been rendered"):
        develop_dataset(rendered, tmp_path / "b", numbers=[7])
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "thesis.doc").write_text("mine")
    with pytest.raises(InputError, match="is not empty and holds no developed pictures"):
        develop_dataset(rendered, tmp_path / "c")
