"""A session is drawn once; the scenes of its samples follow from it and their rows without any random number."""

import dataclasses

import numpy as np
import pytest

from facegen.sampling import draw_samples, draw_shots
from facegen.sessions import build_sample_scene, draw_sample_scene, draw_session
from facegen.spec import parse_spec
from facegen.store import Dataset, resolve


@pytest.fixture(scope="module")
def dataset(anny, tmp_path_factory) -> Dataset:
    table = {"version": 1, "kind": "still", "seed": 9, "people": 2, "render": {"size_px": 64}}
    table |= {"still": {"sessions": 2, "neutral": 0, "faces": 1}, "looks": {"glasses": 1.0, "make_up": 1.0}}
    return resolve(parse_spec(table, where="here"), tmp_path_factory.mktemp("sessions"))


def test_looks_and_mouth_are_the_persons_and_the_unit_is_the_sessions(dataset: Dataset):
    spec, rig, headset = dataset.spec, dataset.rig, dataset.headset
    first, second, other = (
        draw_session(spec, rig, headset, person=person, session=session, female=True)
        for person, session in ((0, 0), (0, 1), (1, 2))
    )
    assert first.mouth.size == second.mouth.size != other.mouth.size
    assert first.accessories.glasses == second.accessories.glasses != other.accessories.glasses
    iris = [drawn.look.materials["iris"] for drawn in (first, second, other)]
    assert iris[0] == iris[1] != iris[2]
    assert first.unit != second.unit
    assert first.accessories.make_up != second.accessories.make_up
    assert first.look.materials["skin"]["liner"] == first.accessories.make_up.liner
    assert draw_session(spec, rig, headset, person=0, session=0, female=True) is first


def test_a_scene_is_built_without_random_numbers(dataset: Dataset, monkeypatch: pytest.MonkeyPatch):
    spec, rig = dataset.spec, dataset.rig
    row = draw_samples(dataset.plan, rig, 0).rows(slice(1, 2))
    drawn = draw_sample_scene(spec, rig, dataset.headset, row)
    assert drawn.shots == draw_shots(spec, drawn.session.unit, session=1, sample=1)
    dark = {
        name: dataclasses.replace(shot, dropped_led=drawn.scene.views[0].lamps[0])
        for name, shot in drawn.shots.items()
    }
    monkeypatch.setattr(np.random, "Generator", None)
    built = build_sample_scene(spec, rig, drawn.session, drawn.shots, row)
    for mesh, same in zip(drawn.scene.meshes, built.scene.meshes, strict=True):
        np.testing.assert_array_equal(mesh.vertices, same.vertices)
    assert built.scene.materials == drawn.scene.materials
    darker = build_sample_scene(spec, rig, drawn.session, dark, row).scene
    assert darker.views[0].lamps == drawn.scene.views[0].lamps[1:]
    assert [view.lamps for view in darker.views[1:]] == [view.lamps for view in drawn.scene.views[1:]]
