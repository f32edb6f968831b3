"""A shard is whole however large its pictures are, and wrong where one of its labels moved."""

import pyarrow as pa

from facegen.labels import label_keypoints
from facegen.sampling import draw_samples
from facegen.spec import parse_spec
from facegen.store import column_array, keypoint_table, resolve, write_shard
from facegen.validation.keypoints import check_shard

NARROW = {"width_px": 16384, "height_px": 16384, "fov_deg": 5, "distance_m": 0.2}
"""The largest picture from the nearest place, where float32 rounds points by more than a hundredth of a pixel."""


def test_rounding_in_a_very_large_picture_is_no_damage_but_a_pixel_is(anny, tmp_path):
    table = {"version": 1, "kind": "still", "seed": 1, "people": 40, "camera": NARROW}
    spec = parse_spec(table | {"still": {"neutral": 0, "faces": 10}}, where="test")
    dataset = resolve(spec, tmp_path)
    samples = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(0, dataset.plan.samples))
    made = keypoint_table(spec, samples, label_keypoints(spec, dataset.rig, samples))
    path = dataset.folder.shard(0)
    path.parent.mkdir(parents=True)
    write_shard(made, path)
    assert not list(check_shard(dataset, 0))

    points = column_array(made, "points_2d").copy()
    points[12, 33, 1] += 1.0
    place = made.schema.get_field_index("points_2d")
    field = made.schema.field(place)
    moved = pa.FixedSizeListArray.from_arrays(pa.array(points.ravel()), type=field.type)
    write_shard(made.set_column(place, field, moved), path)
    said = [finding.what for finding in check_shard(dataset, 0)]
    assert any(what.startswith("landmark 33 in 3D projects 1.00") for what in said), said
