"""Labels of rendered samples do not follow looks, materials or sensors; glints may only be hidden by other hair."""

import dataclasses
import json

import numpy as np
import pytest

from facegen.conventions import Visibility
from facegen.geometry import rotation_from_angles
from facegen.headsets import Lens, Tolerances
from facegen.labels import VIEW_LABEL_KEYS, label_rendered
from facegen.labels.rendered import _share
from facegen.sampling import draw_samples
from facegen.scene import draw_look
from facegen.sessions import draw_sample_scene, sample_scene, session
from facegen.spec import Looks, parse_spec
from facegen.store import resolve, sample_record


@pytest.fixture(scope="module")
def dataset(anny, tmp_path_factory):
    table = {
        "version": 1,
        "kind": "still",
        "seed": 9,
        "people": 3,
        "render": {"samples": "0-2", "size_px": 64},
    }
    return resolve(parse_spec(table, where="here"), tmp_path_factory.mktemp("labels"))


def labelled(spec, rig, headset, row):
    return label_rendered(spec, rig, draw_sample_scene(spec, rig, headset, row))


def _record(dataset, headset) -> dict:
    block = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(1, 2))
    rendered = labelled(dataset.spec, dataset.rig, headset, block)
    return sample_record(rendered, rig="anny", dataset_hash="")


def test_keypoint_labels_do_not_change_with_materials_hair_or_sensor(dataset, monkeypatch):
    before = _record(dataset, dataset.headset)
    monkeypatch.setattr(session, "draw_look", lambda _, rig: draw_look(np.random.default_rng(77), rig))
    session.draw_session.cache_clear()
    sensor = dataclasses.replace(dataset.headset.sensor, exposure=2.0, black_level=40, veiling_glare=0.2)
    after = _record(dataset, dataclasses.replace(dataset.headset, sensor=sensor))
    assert before["headset"].pop("sensor") != after["headset"].pop("sensor")
    seen = [
        [[glint.pop("seen") for glint in view["glints"]] for view in record["views"].values()]
        for record in (before, after)
    ]
    assert before == after
    assert sum(map(len, seen[0])) >= 10


def test_the_list_of_labels_names_every_key_of_a_view_once(dataset):
    names = [key.name for key in VIEW_LABEL_KEYS]
    assert len(names) == len(set(names))
    for view in _record(dataset, dataset.headset)["views"].values():
        assert {*view} == {*names, "camera", "camera_from_head", "shot"}


def test_accessories_change_no_label_but_what_a_frame_hides(dataset):
    block = draw_samples(dataset.plan, dataset.rig, 0)
    shares = {"bare": 0.0, "worn": 1.0}
    for row in range(3):  # men and women
        samples = block.rows(slice(row, row + 1))
        bare, worn = (
            labelled(
                dataclasses.replace(dataset.spec, looks=Looks(beard=share, glasses=share, make_up=share)),
                dataset.rig,
                dataset.headset,
                samples,
            )
            for share in shares.values()
        )
        accessories = worn.sample.session.accessories
        assert accessories.glasses is not None
        assert (accessories.beard is None) == samples.female[0] == (accessories.make_up is not None)
        for key, values in bare.keypoints.columns.items():
            assert np.array_equal(values, worn.keypoints.columns[key])
        for name, view in bare.views.items():
            after = worn.views[name]
            for key in ("points_2d", "points_camera"):
                assert np.array_equal(getattr(view.landmarks, key), getattr(after.landmarks, key))
            for key in ("pupil_center_2d", "gaze_camera"):
                assert np.array_equal(getattr(view.eyes, key), getattr(after.eyes, key))
            hidden = view.landmarks.visibility != after.landmarks.visibility
            assert (after.landmarks.visibility[hidden] == Visibility.HIDDEN).all()
            assert hidden.sum() <= 8
        record = sample_record(worn, rig="anny", dataset_hash="")
        assert set(record["accessories"]) == {"glasses", "make_up" if samples.female[0] else "beard"}
        assert "accessories" not in sample_record(bare, rig="anny", dataset_hash="")
        json.dumps(record)


def test_labels_do_not_change_with_teeth_and_tongue(dataset, monkeypatch):
    with_ours = _record(dataset, dataset.headset)
    monkeypatch.setattr(sample_scene, "has_own_teeth", lambda rig: True)
    assert _record(dataset, dataset.headset) == with_ours


def test_keypoints_do_not_change_with_units_shots_or_rooms(dataset):
    block = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(0, 1))
    off = {
        "tolerances": 0.0,
        "noise": 0.0,
        "motion_deg_s": 0.0,
        "room": "dark",
        "flash": 0.0,
        "dropped_led": 1.0,
    }
    spec = dataclasses.replace(dataset.spec, sensor=dataclasses.replace(dataset.spec.sensor, **off))
    plain, other = (labelled(s, dataset.rig, dataset.headset, block) for s in (dataset.spec, spec))
    for key, values in plain.keypoints.columns.items():
        assert np.array_equal(values, other.keypoints.columns[key])
    assert np.allclose(
        plain.views["mouth"].landmarks.points_2d, other.views["mouth"].landmarks.points_2d, atol=3.0
    )
    assert not np.array_equal(
        plain.views["mouth"].landmarks.points_2d, other.views["mouth"].landmarks.points_2d
    )
    # an LED that stays dark is not lit and has no glint
    dark = {name: shot.dropped_led for name, shot in other.sample.shots.items()}
    assert all(dark[view.name] and dark[view.name] not in view.lamps for view in other.sample.scene.views)
    assert not {*dark.values()} & {lamp for view in other.views.values() for lamp in view.glints.lamps}
    assert other.sample.session.unit.cameras[0].fx == dataset.headset.cameras[0].fx


def test_donning_and_slip_make_the_pose(dataset):
    block = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(0, 1))
    record = sample_record(
        labelled(dataset.spec, dataset.rig, dataset.headset, block), rig="anny", dataset_hash=""
    )
    tight = dataclasses.replace(dataset.headset, tolerances=Tolerances())
    rest = labelled(dataset.spec, dataset.rig, tight, block)
    assert not rest.sample.donning.any()
    assert not rest.sample.slip.any()
    off = np.add(record["headset"]["donning"], record["headset"]["slip"])
    assert 1e-4 < np.abs(off[:3]).max() < 2e-2
    pose = np.array(record["headset"]["head_from_headset"])
    assert np.allclose(pose[:3, 3], rest.sample.head_from_headset[:3, 3] + off[:3])
    assert np.allclose(pose[:3, :3], rotation_from_angles(*off[3:]))


def test_a_doubled_slip_is_twice_as_far_and_nothing_else(dataset):
    block = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(0, 1))
    loose = dataclasses.replace(dataset.spec, sensor=dataclasses.replace(dataset.spec.sensor, slip=2.0))
    one, two = (labelled(s, dataset.rig, dataset.headset, block) for s in (dataset.spec, loose))
    assert one.sample.slip.any()
    np.testing.assert_allclose(two.sample.slip, 2 * one.sample.slip)
    np.testing.assert_array_equal(two.sample.donning, one.sample.donning)
    np.testing.assert_allclose(
        two.sample.head_from_headset[:3, 3] - one.sample.head_from_headset[:3, 3],
        one.sample.slip[:3],
        atol=1e-12,
    )


def test_what_the_rim_of_a_lens_covers_is_hidden(dataset):
    block = draw_samples(dataset.plan, dataset.rig, 0).rows(slice(0, 1))

    def labels(radius: float | None):
        lens = Lens(aperture_radius=radius)
        cameras = tuple(dataclasses.replace(camera, lens=lens) for camera in dataset.headset.cameras)
        headset = dataclasses.replace(dataset.headset, cameras=cameras)
        return labelled(dataset.spec, dataset.rig, headset, block).views["left_eye"]

    clear, covered = labels(None), labels(0.25)
    middle = (64 - 1) / 2
    outside = np.linalg.norm(clear.landmarks.points_2d - middle, axis=-1) > 0.25 * 64
    free, rimmed = clear.landmarks.visibility, covered.landmarks.visibility
    assert (free[outside] == Visibility.VISIBLE).any()
    assert (free[~outside] == Visibility.VISIBLE).any()
    assert (rimmed[outside] == np.minimum(free[outside], Visibility.HIDDEN)).all()
    assert (rimmed[~outside] == free[~outside]).all()
    aside = np.linalg.norm(clear.glints.points_2d - middle, axis=-1) > 0.25 * 64
    assert clear.glints.seen[aside].any()
    assert (covered.glints.seen == (clear.glints.seen & ~aside)).all()


def test_eyes_that_are_shut_at_rest_are_not_open():
    """A user's head may have lids that touch; nothing is divided by their gap."""
    with np.errstate(all="raise"):
        assert _share(np.array([0.004, 0.0]), np.array([0.008, 0.0])).tolist() == [0.5, 0.0]
