"""Draws: what follows from (spec, sample) alone."""

import tracemalloc
from dataclasses import fields, replace

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLOCK, RECORDED_WEIGHTS
from facegen.errors import InputError
from facegen.formats import live_link_csv
from facegen.randomness import stream
from facegen.rigs import eye_centers
from facegen.sampling import COMPONENT_NAMES, draw_samples, plan_dataset
from facegen.sampling.gaze import axes_from_target, axes_from_weights, weights_from_axes
from facegen.sampling.people import _split_of_everyone, split_of
from facegen.spec import idle_note, parse_spec, spec_hash
from facegen.spec.idle_keys import IDLE
from facegen.validation.ranges import impossible

STILL = {"version": 1, "kind": "still", "seed": 7, "people": 450, "still": {"neutral": 1, "faces": 6}}


def spec(**change):
    return parse_spec(STILL | change, where="test")


def test_streams_depend_on_their_key_alone():
    first = stream(1, "gaze", 0).random(5)
    stream(1, "expression", 0).random(100)
    np.testing.assert_array_equal(stream(1, "gaze", 0).random(5), first)
    others = [stream(2, "gaze", 0), stream(1, "gaze2", 0), stream(1, "gaze", 1)]
    assert all(not np.array_equal(other.random(5), first) for other in others)


def test_streams_are_the_ones_that_datasets_were_made_with():
    # golden: changing these changes every dataset; raise LABEL_VERSION and say so in CHANGELOG.md
    np.testing.assert_allclose(
        stream(7, "identity", 3).random(3), [0.24326285, 0.65993490, 0.48084303], atol=5e-9
    )


def test_a_block_is_the_same_however_it_is_reached(anny):
    plan = plan_dataset(spec())
    once, again = draw_samples(plan, anny, 2), draw_samples(plan, anny, 2)
    for field in fields(once):
        np.testing.assert_array_equal(getattr(once, field.name), getattr(again, field.name))
        assert len(getattr(once, field.name)) == BLOCK


def test_people_do_not_depend_on_how_many_faces_they_show_nor_on_who_else_is_there(anny):
    few, many = plan_dataset(spec()), plan_dataset(spec(still={"neutral": 1, "faces": 12}, people=900))
    a, b = draw_samples(few, anny, 1), draw_samples(many, anny, 1)
    shared = sorted(set(a.person) & set(b.person))
    assert len(shared) > 10
    for person in shared:
        row_a, row_b = np.flatnonzero(a.person == person)[0], np.flatnonzero(b.person == person)[0]
        np.testing.assert_array_equal(a.identity[row_a], b.identity[row_b])
        assert a.age_years[row_a] == b.age_years[row_b]


def test_one_person_across_the_edge_of_two_blocks_stays_one_person(anny):
    plan = plan_dataset(spec())  # 7 faces a person: person 142 has samples 994 to 1000
    first, second = draw_samples(plan, anny, 0), draw_samples(plan, anny, 1)
    assert first.person[-1] == second.person[0] == 142
    np.testing.assert_array_equal(first.identity[-1], second.identity[0])
    np.testing.assert_array_equal(first.donning[-1], second.donning[0])
    assert first.split[-1] == second.split[0]


def test_a_person_plays_a_recording_in_one_pose_before_one_camera(anny, tmp_path):
    weights = np.random.default_rng(3).random((700, len(BLENDSHAPES)))
    (tmp_path / "take.csv").write_text(live_link_csv(weights, np.arange(700) / 30))
    playback = {"recording": str(tmp_path / "take.csv"), "fps": 30}
    played = parse_spec(
        {"version": 1, "kind": "playback", "seed": 7, "people": 3, "playback": playback}, where="test"
    )
    blocks = [
        draw_samples(plan_dataset(played), anny, block) for block in range(3)
    ]  # people cross their edges
    person, frame = (np.concatenate([getattr(b, name) for b in blocks]) for name in ("person", "frame"))
    np.testing.assert_allclose(
        np.concatenate([b.weights for b in blocks])[:2100], weights[frame[:2100]], atol=1e-6
    )
    for name in ("camera_from_head", "intrinsics", "pupil_radius_m", "slip"):
        values = np.concatenate([getattr(b, name) for b in blocks]).reshape(len(person), -1)
        of_people = [np.unique(values[person == number], axis=0) for number in range(3)]
        assert [len(rows) for rows in of_people] == [1, 1, 1]
        assert name == "intrinsics" or len(np.unique(np.concatenate(of_people), axis=0)) == 3


def test_recordings_that_nobody_can_play_are_refused_and_played_around(tmp_path):
    recorded = np.full((20, len(BLENDSHAPES)), 0.5)
    recorded[[3, 4, 11]] = np.nan
    recorded[7, BLENDSHAPE_INDEX["jawOpen"]], recorded[9, 0] = 1.61, -0.11
    recorded[12, 0], recorded[13, 0] = RECORDED_WEIGHTS
    (tmp_path / "take.csv").write_text(live_link_csv(recorded, np.arange(20) / 30))

    def plan(first_frame: int, frames: int):
        playback = {"recording": str(tmp_path / "take.csv"), "fps": 30}
        playback |= {"first_frame": first_frame, "frames": frames}
        return plan_dataset(spec(kind="playback", playback=playback))

    with pytest.raises(
        InputError, match=r"take\.csv: has 3 frames \(3-4,11; frame 0 is row 2\) without a face"
    ):
        plan(2, 18)
    with pytest.raises(InputError, match=r"2 frames \(7,9; .*outside -0.1 to 1.6 .*jawOpen = 1.61\)"):
        plan(5, 6)
    played = plan(12, 8)
    assert played.frames == 8
    nothing = impossible(
        weights=played.recording.astype(np.float32).astype(np.float64),
        visibility=np.zeros(8),
        gaze=np.tile([0.0, 0.0, 1.0], (8, 2, 1)),
        transforms=np.tile(np.eye(4), (8, 1, 1)),
        recorded=True,
    )
    assert not list(nothing), "what is played is valid"


@pytest.mark.parametrize("kind", ["still", "sequence", "playback"])
def test_shapes_that_a_rig_lacks_are_zero_and_nothing_else_moves(anny, tmp_path, kind):
    """Eyeballs turn by eyeLook on every head, so these weights are seen."""
    table = {
        "still": {},
        "sequence": {"people": 1, "sequence": {"range_of_motion": {"count": 1, "seconds": 30.0}}},
        "playback": {"playback": {"recording": str(tmp_path / "take.csv"), "fps": 30}},
    }[kind]
    recorded = np.random.default_rng(3).random((20, len(BLENDSHAPES)))
    (tmp_path / "take.csv").write_text(live_link_csv(recorded, np.arange(20) / 30))
    lacks = ("mouthSmileLeft", "cheekPuff", "eyeLookUpLeft")
    plan = plan_dataset(spec(kind=kind, **table))
    whole, less = (draw_samples(plan, rig, 0) for rig in (anny, replace(anny, missing=lacks)))
    zero = [BLENDSHAPE_INDEX[name] for name in lacks[:2]]
    assert (whole.weights[:, zero] > 0).any(axis=0).all()
    assert not less.weights[:, zero].any()
    whole.weights[:, zero] = 0.0
    for field in fields(whole):
        np.testing.assert_array_equal(getattr(whole, field.name), getattr(less, field.name))


IDLE_VALUES = {
    "still": {"faces": 2},
    "sequence": {"sessions": 2},
    "playback": {"recording": "none.csv", "fps": 30},
    "gaze.wide": {"wide": 0.5},
    "gaze": {"yaw_deg": 5},
    "expression.mixture": {"mixture": {"speech": 1.0}},
    "expression.subtle": {"subtle": 0.9},
    "expression.blinks": {"blinks": 0.9},
    "expression": {"resting": 0.0},
}
"""For each idle key or table, what stands in its table."""


@pytest.mark.parametrize(("kind", "name"), [(kind, name) for kind, names in IDLE.items() for name in names])
def test_keys_that_are_told_as_idle_change_no_sample_but_the_hash(anny, tmp_path, kind, name):
    (tmp_path / "take.csv").write_text(
        live_link_csv(np.full((20, len(BLENDSHAPES)), 0.3), np.arange(20) / 30)
    )
    own = {"playback": {"recording": str(tmp_path / "take.csv"), "fps": 30}} if kind == "playback" else {}
    table = {"version": 1, "kind": kind, "seed": 7, "people": 300, **own}
    given = {name.split(".")[0]: IDLE_VALUES[name]}
    plain, idle = (parse_spec(table | more, where="test") for more in ({}, given))
    one, other = (draw_samples(plan_dataset(each), anny, 1) for each in (plain, idle))
    for field in fields(one):
        np.testing.assert_array_equal(getattr(one, field.name), getattr(other, field.name))
    assert spec_hash(plain, asset_sha256={}) != spec_hash(idle, asset_sha256={})
    assert not idle_note(plain)
    assert idle_note(idle).startswith(f'{name}: no sample depends on it where kind = "{kind}"')


def test_neutral_faces_are_neutral_and_look_ahead(anny):
    samples = draw_samples(plan_dataset(spec()), anny, 0)
    assert samples.neutral[::7].all()
    assert samples.neutral.sum() == len(samples.neutral[::7])
    assert not samples.weights[samples.neutral].any()
    np.testing.assert_array_equal(samples.component == COMPONENT_NAMES.index("neutral"), samples.neutral)
    np.testing.assert_array_equal(samples.gaze[samples.neutral], np.broadcast_to([0, 0, 1], (143, 2, 3)))


def test_stills_in_sessions_start_each_with_neutral_faces_and_are_put_on_anew(anny):
    still = {"sessions": 2, "neutral": 1, "faces": 3}
    plan = plan_dataset(spec(still=still, people=125))
    assert plan.samples == 1000
    drawn = draw_samples(plan, anny, 0)
    session = np.arange(1000) // 4
    np.testing.assert_array_equal(drawn.session, session)
    np.testing.assert_array_equal(drawn.person, session // 2)
    np.testing.assert_array_equal(drawn.neutral, np.arange(1000) % 4 == 0)
    for seat in (0, 1):  # one donning a session, others in the next one of the same person
        assert (drawn.donning[4 * seat : 4 * seat + 4] == drawn.donning[4 * seat]).all()
    assert not (drawn.donning[::8] == drawn.donning[4::8]).any()
    np.testing.assert_array_equal(drawn.identity[::8], drawn.identity[4::8])
    by_session = draw_samples(plan_dataset(spec(still=still, people=125, split="session")), anny, 0)
    first, second = by_session.split[::8], by_session.split[4::8]
    assert (first != second).any()
    assert (by_session.split == np.repeat(by_session.split[::4], 4)).all()
    assert (drawn.split[::8] == drawn.split[4::8]).all()


def test_splits_have_their_shares_exactly_and_split_by_person():
    split = split_of(spec(people=2000), np.arange(2000))
    assert np.bincount(split).tolist() == [1400, 300, 300]
    assert np.array_equal(split_of(spec(people=2000), np.array([5, 5, 1999])), split[[5, 5, 1999]])


def test_both_eyes_meet_at_the_target_and_weights_say_the_same(anny):
    samples = draw_samples(plan_dataset(spec()), anny, 0)
    target = np.tile([0.05, -0.1, 0.8], (BLOCK, 1))
    axes = axes_from_target(target, eye_centers(anny, samples.identity))
    np.testing.assert_allclose(np.linalg.norm(axes, axis=-1), 1, atol=1e-12)
    weights = np.zeros((BLOCK, len(BLENDSHAPES)))
    for index, value in weights_from_axes(axes).items():
        weights[:, index] = value
    np.testing.assert_allclose(axes_from_weights(weights), axes, atol=1e-12)
    # the target is to the subject's left and below: the left eye looks out, the right one in, both down
    assert (weights[:, BLENDSHAPE_INDEX["eyeLookInRight"]] > 0).all()
    assert (weights[:, BLENDSHAPE_INDEX["eyeLookDownLeft"]] > 0).all()
    assert not weights[:, BLENDSHAPE_INDEX["eyeLookUpLeft"]].any()
    # vergence: the axes cross, so the left eye is turned more to the right than the right eye
    assert (axes[:, 0, 0] < axes[:, 1, 0]).all()


def test_spread_zero_gives_the_mean_of_each_trait(anny):
    samples = draw_samples(
        plan_dataset(spec(identity={"spread": 0.0, "female": 1.0, "age_years": 40})), anny, 0
    )
    assert samples.female.all()
    assert (samples.age_years == 40).all()
    np.testing.assert_allclose(samples.ancestry.sum(axis=1), 1.0)
    assert anny.traits == ("one", "female", "age", "african", "asian")
    age = np.full(BLOCK, (40 - 25) / (90 - 25))
    known = np.stack([np.ones(BLOCK), np.ones(BLOCK), age, *samples.ancestry[:, :2].T], axis=-1)
    np.testing.assert_allclose(samples.identity, known @ anny.identity_from_traits.T, atol=1e-9)


def test_people_are_split_in_chunks_as_all_at_once(monkeypatch):
    shares = (0.7, 0.15, 0.15)
    whole = _split_of_everyone.__wrapped__(3, 10_007, shares)
    monkeypatch.setattr("facegen.sampling.people._CHUNK", 100)
    np.testing.assert_array_equal(_split_of_everyone.__wrapped__(3, 10_007, shares), whole)
    assert np.bincount(whole).tolist() == [7005, 1501, 1501]


def test_splitting_many_people_takes_little_more_memory_than_their_order():
    people = 10_000_000
    tracemalloc.start()
    try:
        _split_of_everyone.__wrapped__(3, people, (0.7, 0.15, 0.15))
        assert tracemalloc.get_traced_memory()[1] < 14 * people, (
            "8 bytes of the order, 1 of the split, and a chunk"
        )
    finally:
        tracemalloc.stop()
