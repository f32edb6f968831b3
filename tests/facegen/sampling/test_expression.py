"""The expression model on 100,000 faces: couplings, marginals, gaze, mixture, left and right."""

from dataclasses import asdict, fields
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, MIRRORED_BLENDSHAPES
from facegen.expression import COMPONENTS, UNMIXED, load_emotions, load_templates, restrain
from facegen.expression.couplings import CLOSE_BEYOND_JAW, EXCLUSIVE, MEETING, TONGUE_NEEDS_JAW
from facegen.expression.sides import LEFT, RIGHT, draw_shapes, draw_sides
from facegen.geometry import angles_from_direction
from facegen.randomness import stream
from facegen.sampling import COMPONENT_NAMES
from facegen.sampling.faces import LIDS_FOLLOW_DOWN, LIDS_FOLLOW_UP, DrawnFaces, draw_faces
from facegen.sampling.gaze import axes_from_weights
from facegen.spec import Spec, load_spec, parse_spec, spec_schema

DATASETS = Path(__file__).resolve().parents[3] / "datasets"

EYES = np.tile([[0.031, 0.0, 0.0], [-0.031, 0.0, 0.0]], (1000, 1, 1))
"""Eyeball centres of a thousand equal people; the model knows no more of the rig."""


def spec(**expression) -> Spec:
    table = {"version": 1, "kind": "still", "seed": 7, "people": 1, "expression": expression}
    return parse_spec(table, where="test")


def block(of: Spec, number: int) -> DrawnFaces:
    return draw_faces(of, lambda part: stream(of.seed, part, number), EYES)


def drawn(of: Spec, blocks: int) -> DrawnFaces:
    made = [block(of, number) for number in range(blocks)]
    return DrawnFaces(
        **{f.name: np.concatenate([getattr(one, f.name) for one in made]) for f in fields(DrawnFaces)}
    )


@pytest.fixture(scope="module")
def faces() -> DrawnFaces:
    """A hundred thousand faces of the default spec."""
    return drawn(spec(), 100)


def column(faces: DrawnFaces, name: str) -> np.ndarray:
    return faces.weights[:, BLENDSHAPE_INDEX[name]]


def is_from(faces: DrawnFaces, name: str) -> np.ndarray:
    return faces.component == COMPONENT_NAMES.index(name)


def test_every_component_has_a_key_in_the_spec_and_no_key_lacks_one():
    assert list(asdict(spec().expression.mixture)) == list(COMPONENTS)


def test_couplings_hold_on_every_face(faces):
    assert faces.weights.min() >= 0
    assert faces.weights.max() <= 1
    for first, second in EXCLUSIVE:
        assert not np.minimum(column(faces, first), column(faces, second)).any(), (first, second)
    jaw, close = column(faces, "jawOpen"), column(faces, "mouthClose")
    assert (close <= jaw + CLOSE_BEYOND_JAW).all()
    assert not column(faces, "tongueOut")[jaw <= TONGUE_NEEDS_JAW].any()
    for name in MEETING:  # lips 0.6 apart neither press nor roll in by more than a quarter
        assert column(faces, name)[jaw - close > 0.6].max() <= 0.25 + 1e-12, name
    for name, away in (("mouthRollUpper", "mouthUpperUpLeft"), ("mouthPucker", "mouthSmileRight")):
        assert (column(faces, name) + column(faces, away)).max() <= 1 + 1e-12


def test_lips_close_over_the_jaw_as_often_as_in_people(faces):
    talking = is_from(faces, "speech") | is_from(faces, "movement") | is_from(faces, "rest")
    jaw, close = column(faces, "jawOpen")[talking], column(faces, "mouthClose")[talking]
    # more than half of recorded frames have mouthClose above jawOpen, where the mouth is closed
    assert 0.3 < (close > jaw).mean() < 0.7
    assert ((close > 0.3) & (close > jaw - 0.05)).mean() > 0.02


@given(arrays(np.float64, (3, len(BLENDSHAPES)), elements=st.floats(0, 1)))
@settings(max_examples=100, deadline=None)
def test_restraining_once_is_enough_and_only_lowers(weights):
    once = restrain(weights)
    np.testing.assert_array_equal(restrain(once), once)
    assert (once <= weights).all()
    assert (once >= 0).all()
    jaw, close = once[:, BLENDSHAPE_INDEX["jawOpen"]], once[:, BLENDSHAPE_INDEX["mouthClose"]]
    assert (close <= jaw + CLOSE_BEYOND_JAW).all()
    np.testing.assert_array_equal(restrain(weights[:, MIRRORED_BLENDSHAPES])[:, MIRRORED_BLENDSHAPES], once)


def test_every_shape_covers_its_range(faces):
    for index, name in enumerate(BLENDSHAPES):
        counts, _ = np.histogram(faces.weights[:, index], 20, (0, 1))
        assert (counts >= 30).all(), name  # of 100,000
        assert faces.weights[:, index].max() > 0.98, name


def test_small_weights_are_at_least_as_dense_as_large_ones(faces):
    for index, name in enumerate(BLENDSHAPES):
        if name != "tongueOut":  # the jaw must be open for it: it is out, or it is not
            counts, _ = np.histogram(faces.weights[:, index], (0.01, 0.03, 0.05, 0.48, 0.50, 0.93, 0.95))
            assert counts[:2].min() >= max(counts[3], counts[5]), name


def miss(axes: np.ndarray) -> np.ndarray:
    """Least distance (n,) between the lines of sight of both eyes, metres, and whether they meet in front."""
    normal = np.cross(axes[:, 0], axes[:, 1])
    across = EYES[0, 0] - EYES[0, 1]
    return np.abs(normal @ across) / np.maximum(np.linalg.norm(normal, axis=-1), 1e-12)


def test_both_eyes_look_at_one_point_outside_the_component_named_for_the_opposite(faces):
    apart = is_from(faces, "divergent")
    assert 0.005 < apart.mean() < 0.02
    assert miss(faces.gaze[~apart]).max() < 1e-9
    x = faces.gaze[..., 0] / faces.gaze[..., 2]
    assert (x[~apart, 0] < x[~apart, 1]).all()  # in front of the face
    angle = np.degrees(np.arccos(np.clip((faces.gaze[:, 0] * faces.gaze[:, 1]).sum(axis=-1), -1, 1)))
    # a point 0.3 m away, the nearest drawn, turns the eyes towards each other by 12 degrees
    assert angle[~apart].max() < 12
    assert np.median(angle[apart]) > 10


def test_weights_say_where_the_eyes_look(faces):
    turned = axes_from_weights(faces.weights)
    looks = [index for index, name in enumerate(BLENDSHAPES) if name.startswith("eyeLook")]
    within = (faces.weights[:, looks] < 1).all(axis=1)
    assert within.mean() > 0.95
    np.testing.assert_allclose(turned[within], faces.gaze[within], atol=1e-12)


def test_eyes_turn_through_their_whole_range_even_where_people_look_at_near_points():
    near = {"version": 1, "kind": "still", "seed": 7, "people": 1, "gaze": {"distance_m": 0.3}}
    faces = drawn(parse_spec(near | {"expression": {"mixture": {"single": 1}}}, where="test"), 10)
    for name in ("eyeLookOutLeft", "eyeLookInLeft", "eyeLookOutRight", "eyeLookInRight"):
        assert column(faces, name).max() > 0.97, name


def test_wide_looks_fill_all_that_eyes_can_turn_to_and_leave_other_looks_as_they_are():
    def turned(wide: float) -> np.ndarray:
        far = {"wide": wide, "distance_m": 100}
        given = {"version": 1, "kind": "still", "seed": 7, "people": 1, "gaze": far}
        axes = drawn(parse_spec(given | {"expression": {"mixture": {"speech": 1}}}, where="test"), 20).gaze
        return np.degrees(np.stack(angles_from_direction(axes), axis=-1)[:, 0])

    usual, some, all_wide = turned(0.0), turned(0.35), turned(1.0)
    changed = (some != usual).any(axis=-1)
    assert abs(changed.mean() - 0.35) < 0.02
    np.testing.assert_array_equal(some[changed], all_wide[changed])
    reach = np.hypot(*(all_wide / (42, 30)).T)
    # even in area: a quarter of the looks within half the reach, a quarter beyond .87 of it
    np.testing.assert_allclose(np.quantile(reach, (0.25, 0.75)), (0.5, 0.75**0.5), atol=0.02)
    assert 0.99 < reach.max() < 1.01
    assert (all_wide.min(axis=0) < (-40, -28)).all()
    assert (all_wide.max(axis=0) > (40, 28)).all()


def test_blinks_shut_lids_in_their_share_of_faces_and_leave_all_else_as_it_is():
    def of(blinks: float) -> DrawnFaces:
        return drawn(spec(mixture={"lower_face": 1}, resting=0.0, blinks=blinks), 20)

    without, some = of(0.0), of(0.3)
    lids = [BLENDSHAPE_INDEX[name] for name in ("eyeBlinkLeft", "eyeBlinkRight")]
    assert not without.weights[:, lids].any()
    np.testing.assert_array_equal(*some.weights[:, lids].T)
    blink = some.weights[:, lids[0]]
    assert abs((blink > 0).mean() - 0.3) < 0.02
    assert abs((blink == 1).mean() - 0.15) < 0.02
    others = np.delete(np.arange(len(BLENDSHAPES)), lids)
    np.testing.assert_array_equal(some.weights[:, others], without.weights[:, others])


def test_subtle_faces_keep_their_lips_closed():
    faces = drawn(spec(mixture={"rest": 1}, subtle=1.0, resting=0.0), 1)
    assert np.median(column(faces, "jawOpen")) < 0.02
    assert (column(faces, "mouthClose") >= column(faces, "jawOpen")).all()


def test_the_mixture_is_what_the_spec_says(faces):
    shares = np.array(list(asdict(spec().expression.mixture).values()))
    counts = np.bincount(faces.component, minlength=len(UNMIXED) + len(shares))[len(UNMIXED) :]
    expected = shares / shares.sum() * len(faces.component)
    assert (np.abs(counts - expected) <= 4 * np.sqrt(expected)).all()
    some = drawn(spec(mixture={"speech": 3, "single": 1}), 4)
    assert set(some.component) == {COMPONENT_NAMES.index("speech"), COMPONENT_NAMES.index("single")}
    assert is_from(some, "speech").mean() == pytest.approx(0.75, abs=0.03)


def test_a_single_face_is_one_shape_and_what_it_needs():
    faces = drawn(spec(mixture={"single": 1}, subtle=0.0), 5)
    looks = [name.startswith("eyeLook") for name in BLENDSHAPES]
    moving = np.where(looks, 0.0, faces.weights) > CLOSE_BEYOND_JAW
    alone = moving.sum(axis=1) - (moving[:, LEFT] & moving[:, RIGHT]).sum(axis=1)
    needs_jaw = moving[:, BLENDSHAPE_INDEX["mouthClose"]] | moving[:, BLENDSHAPE_INDEX["tongueOut"]]
    assert (alone - needs_jaw <= 1).all()
    assert column(faces, "mouthClose").max() > 0.9


@pytest.mark.parametrize("correlation", [0.0, 0.5, 0.9, 1.0])
def test_left_and_right_correlate_as_the_spec_says(correlation):
    sides = draw_sides(np.random.default_rng(1), 100_000, correlation=correlation)
    shapes = draw_shapes(np.random.default_rng(2), 20_000, correlation=correlation)
    for left, right in (sides.T, (shapes[:, LEFT[3]], shapes[:, RIGHT[3]])):
        assert np.corrcoef(left, right)[0, 1] == pytest.approx(correlation, abs=0.02)
        assert np.histogram(right, 10, (0, 1))[0] == pytest.approx(len(right) / 10, rel=0.08)
    uneven = ("one_sided", "wink")
    others = {name: 1.0 for name, part in COMPONENTS.items() if name not in uneven and part.conjugate}
    faces = drawn(spec(left_right_correlation=correlation, mixture=others), 2)
    apart = np.abs(faces.weights[:, LEFT] - faces.weights[:, RIGHT])
    # lids follow the gaze, and the two eyes turn by angles that differ a little
    allowed, lids = np.zeros_like(apart), []
    for lid, looks, share in (("Blink", "LookDown", LIDS_FOLLOW_DOWN), ("Wide", "LookUp", LIDS_FOLLOW_UP)):
        left, right = (column(faces, f"eye{looks}{side}") for side in ("Left", "Right"))
        lids.append(LEFT.index(BLENDSHAPE_INDEX[f"eye{lid}Left"]))
        allowed[:, lids[-1]] = share * np.abs(left - right) + 1e-12
    same = (apart <= allowed).all(axis=1)
    # which of blink and wide is dropped may then differ as well, where both are as strong
    torn = ~same & (apart[:, lids] > allowed[:, lids]).all(axis=1)
    assert (same | torn).all() and torn.mean() < 0.001 if correlation == 1 else same.mean() < 0.6


@pytest.mark.parametrize("name", ["one_sided", "wink"])
def test_faces_that_are_named_for_it_have_two_sides_whatever_the_correlation(name):
    meaning = spec_schema()["$defs"]["Expression"]["properties"]["left_right_correlation"]["description"]
    assert f"``{name}``" in meaning
    faces = drawn(spec(left_right_correlation=1.0, resting=0.0, mixture={name: 1.0}), 1)
    apart = np.abs(column(faces, "eyeBlinkLeft") - column(faces, "eyeBlinkRight"))
    assert (apart > 0.3).mean() > 0.1


def test_a_spec_says_which_components_are_never_subtle():
    """And that extreme faces are: a third of them have not three shapes at 0.75."""
    said = spec_schema()["$defs"]["Expression"]["properties"]["subtle"]["description"]
    whole = [name for name, part in COMPONENTS.items() if not part.subtle]
    assert f"{', '.join(whole[:-1])} and {whole[-1]} are not" in " ".join(said.split())
    assert "subtle" in COMPONENTS["extreme"].meaning
    faces = drawn(spec(mixture={"extreme": 1.0}, subtle=1.0), 1)
    assert np.mean(faces.weights.max(axis=1) < 0.75) > 0.5


def test_one_sided_faces_move_on_one_side():
    faces = drawn(spec(mixture={"one_sided": 1}, resting=0.0, subtle=0.0), 2)
    left, right = column(faces, "mouthSmileLeft"), column(faces, "mouthSmileRight")
    moving = np.maximum(left, right) > 0.2
    assert (np.minimum(left, right)[moving] < 0.5 * np.maximum(left, right)[moving]).mean() > 0.95
    blink = np.stack([column(faces, "eyeBlinkLeft"), column(faces, "eyeBlinkRight")])
    assert ((blink.max(axis=0) > 0.7) & (blink.min(axis=0) < 0.3)).mean() > 0.05


UPPER = [name.startswith(("brow", "eye", "noseSneer", "cheekSquint")) for name in BLENDSHAPES]


@pytest.mark.parametrize(("name", "resting"), [("upper_face", np.invert(UPPER)), ("lower_face", UPPER)])
def test_faces_of_one_region_leave_the_other_at_rest(name, resting):
    faces = drawn(spec(mixture={name: 1}), 10)
    assert not faces.weights[:, resting].any()
    assert (
        faces.weights[:, np.invert(resting)].max(axis=0) > 0.95
    ).all()  # and every shape of their own moves
    ahead = (faces.gaze == (0.0, 0.0, 1.0)).all(axis=(1, 2))
    assert ahead.all() if name == "lower_face" else not ahead.any()


@pytest.mark.parametrize("subtle", [0.0, 1.0])
def test_combined_faces_open_the_jaw_and_half_close_both_eyes(subtle):
    faces = drawn(spec(mixture={"combined": 1}, subtle=subtle), 5)
    assert (column(faces, "jawOpen") > 0.35).all()
    for name in ("eyeBlinkLeft", "eyeBlinkRight"):
        assert column(faces, name).min() >= 0.3
        assert column(faces, name).max() <= 0.8
        assert np.ptp(column(faces, name)) > 0.45
    assert np.ptp(column(faces, "jawOpen")) > 0.6


def test_no_spec_for_learning_shows_what_the_test_withholds():
    specs = {
        name: load_spec(DATASETS / f"{name}.toml") for name in ("headset", "headset-slip", "headset-test")
    }
    assert (
        specs["headset"].expression.mixture.combined == specs["headset-slip"].expression.mixture.combined == 0
    )
    assert len({one.seed for one in specs.values()}) == 3
    learned, tested = (asdict(specs[name].expression.mixture) for name in ("headset", "headset-test"))
    # winks take from dense, as the test has them among its one-sided faces, and tongues from the lower face
    special = ("combined", "one_sided", "wink", "dense", "tongue", "lower_face")
    assert {name: share for name, share in learned.items() if name not in special} == {
        name: share for name, share in tested.items() if name not in special
    }
    whole = sum(tested.values())
    assert [tested[name] / whole for name in special[:2]] == pytest.approx([0.25, 0.15])


def test_a_component_does_not_depend_on_what_others_draw():
    """Speech faces are the same, in order, whatever makes the others: parts have streams of their own."""
    plain, changed = (block(spec(mixture={"speech": 1, other: 1}), 3) for other in ("sparse", "dense"))
    speech = is_from(plain, "speech")
    np.testing.assert_array_equal(speech, is_from(changed, "speech"))
    np.testing.assert_array_equal(plain.weights[speech], changed.weights[speech])
    assert not np.array_equal(plain.weights[~speech], changed.weights[~speech])


@pytest.mark.parametrize("family", ["action_units", "visemes", "mouth", "eyes"])
def test_templates_are_possible_faces(family):
    table = load_templates(family)
    assert len(set(table.names)) == len(table) > 5
    assert table.weights.min() >= 0
    assert table.weights.max() <= 1
    closed = table.weights.copy()
    closed[:, BLENDSHAPE_INDEX["mouthClose"]] *= closed[:, BLENDSHAPE_INDEX["jawOpen"]]
    # what couplings take away from a template it would never show
    np.testing.assert_allclose(restrain(closed), closed, atol=0.35)


def test_emotions_name_units_that_there_are():
    table = load_emotions()
    assert len(table.names) == 23
    assert not (table.always & table.sometimes).any()
    assert (table.always | table.sometimes).any(axis=0).all()  # no unit without an emotion
    assert table.always.any(axis=1).all()


def test_talk_shows_what_visemes_leave_out():
    speech, talk = (drawn(spec(mixture={name: 1.0}), 5) for name in ("speech", "talk"))
    for name, more in (("eyeSquintLeft", 0.08), ("mouthFrownRight", 0.03), ("mouthStretchRight", 0.03)):
        assert column(talk, name).mean() > column(speech, name).mean() + more
    parted = (column(talk, "jawOpen") < 0.1) & (column(talk, "mouthLowerDownLeft") > 0.15)
    assert parted.mean() > 0.1
    assert np.mean(np.maximum(column(talk, "jawLeft"), column(talk, "jawRight")) > 0.1) > 0.05


def test_tongues_come_beside_open_mouths_without_one():
    faces = drawn(spec(mixture={"tongue": 1.0}, subtle=0.0), 5)
    tongue, jaw = column(faces, "tongueOut"), column(faces, "jawOpen")
    assert 0.25 < np.mean(tongue == 0) < 0.42
    assert 0.25 < np.mean(tongue == 1) < 0.42
    assert jaw.min() > 0.4
    assert jaw[tongue == 0].max() > 0.9
    assert not column(faces, "mouthClose").any()
    assert not column(faces, "browInnerUp").any()
    assert (faces.gaze == (0.0, 0.0, 1.0)).all()


def test_winks_are_alone():
    faces = drawn(spec(mixture={"wink": 1.0}, subtle=0.0), 2)
    left, right = (column(faces, f"eyeBlink{side}") for side in ("Left", "Right"))
    one = np.minimum(left, right) == 0
    assert 0.55 < one.mean() < 0.75
    assert np.mean(np.maximum(left, right) == 1) > 0.45
    others = [
        index
        for index, name in enumerate(BLENDSHAPES)
        if not name.startswith(("eyeBlink", "eyeLook", "eyeWide"))
    ]
    assert not faces.weights[:, others].any()
