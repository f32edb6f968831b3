"""Packs of clips as Live Link Face recordings, read by our reader and by pandas."""

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.errors import InputError
from facegen.formats import read_live_link
from facegen.packing import Options, plan_pack, write_pack
from facegen.sampling import plan_dataset
from facegen.spec import parse_spec
from facegen.store import resolve


def test_every_clip_is_a_recording_that_reads_back(recorded, tmp_path):
    write_pack(plan_pack(recorded, "livelink"), tmp_path / "pack")
    names = sorted(path.name for path in (tmp_path / "pack").glob("*.csv"))
    kinds = ["neutral", "peak", "peak", "sentence"]
    assert names == [
        f"person-{n // 4:05d}-session-{n // 4:05d}-clip-{n:06d}-{kinds[n % 4]}.csv" for n in range(8)
    ]
    weights = recorded.array("weights")
    for number, name in enumerate(names):
        take = read_live_link(tmp_path / "pack" / name)
        np.testing.assert_allclose(take.weights, weights[number * 60 : (number + 1) * 60], atol=1e-9)
        np.testing.assert_allclose(take.time_s, np.arange(60) / 30, atol=2e-5)


def test_a_recording_opens_in_pandas(recorded, tmp_path):
    pandas = pytest.importorskip("pandas")
    write_pack(plan_pack(recorded, "livelink", Options(samples="180-239")), tmp_path / "pack")
    (path,) = (tmp_path / "pack").glob("*.csv")
    frame = pandas.read_csv(path)
    assert frame.shape == (60, 63)
    assert frame["Timecode"][1] == "00:00:00:02.000"
    assert (frame["BlendShapeCount"] == 61).all()
    jaw = recorded.array("weights")[180:240, BLENDSHAPE_INDEX["jawOpen"]]
    np.testing.assert_allclose(frame["JawOpen"], jaw, atol=1e-9)
    assert np.ptp(jaw) > 0.05


def test_stills_are_refused(anny, tmp_path):
    still = parse_spec({"version": 1, "kind": "still", "seed": 1, "people": 1}, where="test")
    assert plan_dataset(still).samples == 10
    dataset = resolve(still, tmp_path / "stills")
    dataset.folder.shard(0).parent.mkdir(parents=True)
    dataset.folder.shard(0).touch()
    with pytest.raises(InputError, match="holds stills"):
        plan_pack(dataset, "livelink")
