"""Packs of clips as OpenFace writes them, read by the reader of `regress`."""

import csv

import numpy as np
import pytest

from facegen.errors import InputError
from facegen.packing import Options, openface, plan_pack, write_pack
from regress.runtime.inputs import read_frames


def test_every_session_is_one_recording_of_what_the_detector_says(recorded, tmp_path):
    write_pack(plan_pack(recorded, "openface"), tmp_path / "pack")
    detected = recorded.array("detected_2d")
    for person in range(2):
        take = read_frames(tmp_path / "pack" / f"person-{person:05d}-session-{person:05d}.csv")
        assert take.labels == tuple(map(str, range(1, 241)))
        np.testing.assert_allclose(take.time_s, np.arange(240) / 30, atol=5.01e-4)
        np.testing.assert_array_equal(take.points, np.rint(detected[person * 240 : (person + 1) * 240]))


def test_a_frame_without_a_face_has_no_success(recorded, tmp_path, monkeypatch):
    def without_a_face(table, name):
        points = recorded.array(name)[:60].copy()
        points[7] = np.nan
        return points

    monkeypatch.setattr(openface, "column_array", without_a_face)
    write_pack(plan_pack(recorded, "openface", Options(samples="0-59")), tmp_path / "pack")
    (path,) = (tmp_path / "pack").glob("*.csv")
    rows = list(csv.DictReader(path.read_text().splitlines()))
    assert [row["success"] for row in rows] == ["1"] * 7 + ["0"] + ["1"] * 52
    assert np.isnan(read_frames(path).points[7]).all()


def test_stills_are_refused(rendered):
    with pytest.raises(InputError, match="holds stills; the format 'openface'"):
        plan_pack(rendered, "openface")
