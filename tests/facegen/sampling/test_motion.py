"""Clips of motion: smooth, held to the couplings, decided by their number alone."""

from dataclasses import fields

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, BLOCK
from facegen.expression import load_templates, restrain
from facegen.rigs import eye_centers
from facegen.sampling import COMPONENT_NAMES, draw_samples, plan_dataset
from facegen.sampling.motion import CLIP_KINDS, draw_take, write_script
from facegen.sampling.motion.blinks import CLOSING_S, draw_blinks, lid_closure
from facegen.sampling.motion.continuity import ease
from facegen.sampling.motion.envelopes import memberships
from facegen.sampling.motion.glances import Fixations, gaze_course, saccade_seconds
from facegen.sampling.motion.performances import peak_expressions
from facegen.sampling.motion.speech import LOUDNESS, PASSAGE_S, draw_utterance, speech_course
from facegen.sampling.people import split_of
from facegen.spec import parse_spec
from facegen.spec.spec import Clips

STEEPEST = 1.875
"""Largest slope of `smooth_step`: a change by 1 within T seconds is never faster than 1.875 / T a second."""

EYES = np.array([[0.031, 0.0, 0.0], [-0.031, 0.0, 0.0]])
SHORT = {
    "fps": 60,
    "sessions": 2,
    "neutral": {"count": 1, "seconds": 2.0},
    "peak": {"count": 73, "seconds": 3.0},
    "sentence": {"count": 4, "seconds": 4.0},
    "range_of_motion": {"count": 2, "seconds": 10.0},
    "conversation": {"count": 1, "seconds": 10.0},
}


def spec(seed: int = 7, **change):
    table = {"version": 1, "kind": "sequence", "seed": seed, "people": 3, "sequence": SHORT | change}
    return parse_spec(table, where="test")


def first_of(kind: str) -> int:
    of = spec()
    return int(np.flatnonzero(write_script(of).kind == list(CLIP_KINDS).index(kind))[0])


def columns(*starts: str) -> list[int]:
    return [index for name, index in BLENDSHAPE_INDEX.items() if name.startswith(starts)]


def test_every_kind_has_a_key_in_the_spec_and_no_key_lacks_one():
    assert [f.name for f in fields(spec().sequence) if f.type is Clips] == list(CLIP_KINDS)


@given(
    time=st.lists(st.floats(0, 10), min_size=1, max_size=20),
    gaps=st.lists(st.floats(0.01, 2), max_size=10),
    width=st.floats(0.05, 1),
)
def test_memberships_are_shares(time, gaps, width):
    shares = memberships(np.array(time), np.cumsum(gaps), width)
    assert shares.shape == (len(time), len(gaps) + 1)
    assert shares.min() >= 0
    np.testing.assert_allclose(shares.sum(axis=1), 1)


@settings(max_examples=40, deadline=None)
@given(seed=st.integers(0, 2**32), clip=st.integers(0, 161))
def test_couplings_hold_at_every_frame_and_make_no_jumps(seed, clip):
    of = spec(seed)
    take = draw_take(of, write_script(of), clip, EYES)
    assert take.weights.min() >= 0
    assert take.weights.max() <= 1
    np.testing.assert_array_equal(restrain(take.weights), take.weights)
    step = np.abs(np.diff(take.weights, axis=0)).max(axis=0, initial=0)
    fps = of.sequence.fps
    # lids: the fastest blink, from as wide open as lids get
    lid = STEEPEST / (CLOSING_S[0] * fps) * (1 + take.weights[:, columns("eyeWide")].max())
    assert step[columns("eyeBlink", "eyeWide")].max() <= lid
    # eyes: a saccade through the whole range that the spec allows, while the head turns by up to a degree a frame
    reach = [(d.high - d.low, full) for d, full in ((of.gaze.yaw_deg, 30), (of.gaze.pitch_deg, 25))]
    eye = max((STEEPEST * deg / (saccade_seconds(deg) * fps) + 1) / full for deg, full in reach)
    assert step[columns("eyeLook")].max() <= eye
    # the tongue comes out while the jaw passes a part of its way (0.94 within 1/30 s was recorded)
    assert step[columns("tongueOut")].max() <= 0.5
    # all else: the whole way within the quickest passage of speech
    rest = np.setdiff1d(np.arange(52), columns("eyeBlink", "eyeWide", "eyeLook", "tongueOut"))
    whole = STEEPEST / (PASSAGE_S["closing"] * fps)
    assert step[rest].max() <= whole
    # and no weight turns back at full speed from one frame to the next
    assert np.abs(np.diff(take.weights[:, rest], 2, axis=0)).max(initial=0) <= whole
    assert np.abs(np.diff(take.head_deg, axis=0)).max() <= 4


@settings(max_examples=40, deadline=None)
@given(ends=arrays(float, (2, 52), elements=st.floats(0, 1)))
def test_couplings_turn_a_smooth_course_into_a_smooth_one(ends):
    share = np.linspace(0, 1, 2001)[:, None]
    course = restrain(ease((1 - share) * ends[0] + share * ends[1]))
    # the steepest coupling is the tongue's, which takes 0.3 of jawOpen: 3.3 times as fast as the jaw
    assert np.abs(np.diff(course, axis=0)).max() <= 4 / 2000


def test_a_range_of_motion_goes_through_all_movements():
    of = spec(range_of_motion={"count": 2, "seconds": 40.0})
    most = draw_take(of, write_script(of), first_of("range_of_motion"), EYES).weights.max(axis=0)
    moved = {name for name, weight in zip(BLENDSHAPES, most, strict=True) if weight > 0.3}
    assert {"jawOpen", "mouthPucker", "cheekPuff", "mouthSmileLeft", "mouthRollUpper", "tongueOut"} <= moved
    assert len(moved & set(BLENDSHAPES[14:41])) >= 20  # of the 27 shapes of jaw and mouth


@settings(max_examples=20, deadline=None)
@given(seed=st.integers(0, 2**32), clip=st.integers(0, 161))
def test_both_eyes_look_at_one_point(seed, clip):
    of = spec(seed)
    axes = draw_take(of, write_script(of), clip, EYES).gaze
    np.testing.assert_allclose(np.linalg.norm(axes, axis=-1), 1, atol=1e-12)
    normal = np.cross(axes[:, 0], axes[:, 1])
    np.testing.assert_allclose(normal @ (EYES[0] - EYES[1]), 0, atol=1e-12)  # in one plane with both eyes
    assert (axes[:, 0, 0] <= axes[:, 1, 0] + 1e-12).all()  # and never outwards


@pytest.mark.parametrize("kind", [kind for kind in CLIP_KINDS if kind != "neutral"])
def test_clips_begin_at_rest(kind):
    of = spec()
    for clip in range(first_of(kind), first_of(kind) + 2):
        first = draw_take(of, write_script(of), clip, EYES).weights[0]
        busy = np.setdiff1d(np.arange(52), columns("eyeLook", "eyeBlink", "eyeWide"))
        assert first[busy].max() <= of.expression.resting + 0.1, BLENDSHAPES[busy[first[busy].argmax()]]


def test_there_are_73_peak_expressions_and_each_is_shown():
    of = spec()
    peaks = peak_expressions()
    assert len(set(peaks)) == len(peaks) == 73
    script, start = write_script(of), first_of("peak")
    for family, name, side in (
        ("mouth", "tongue", "both"),
        ("eyes", "wink", "right"),
        ("all", "stretch", "both"),
    ):
        weights = draw_take(of, script, start + peaks.index((family, name, side)), EYES).weights.max(axis=0)
        shape = {"tongue": "tongueOut", "wink": "eyeBlinkRight", "stretch": "jawOpen"}[name]
        assert weights[BLENDSHAPE_INDEX[shape]] > 0.3, name
    wink = draw_take(of, script, start + peaks.index(("eyes", "wink", "right")), EYES).weights
    assert (
        wink[:, BLENDSHAPE_INDEX["eyeBlinkRight"]] - wink[:, BLENDSHAPE_INDEX["eyeBlinkLeft"]]
    ).max() > 0.5


def test_people_blink_17_times_a_minute_and_close_faster_than_they_open():
    rng = np.random.Generator(np.random.PCG64(1))
    drawn = [draw_blinks(rng, 30.0, rate_per_min=17.0) for _ in range(400)]
    assert 15 < 2 * np.mean([len(blinks.start_s) for blinks in drawn]) < 19
    begun = np.concatenate([draw_blinks(rng, 4.0, rate_per_min=17.0).start_s for _ in range(20_000)])
    counts = np.histogram(begun, bins=[0, 1, 2, 3, 4])[0] / 20_000 * 60
    np.testing.assert_allclose(counts, 17.0, rtol=0.06)  # no second of a clip is more than another
    time_s = np.arange(0, 30, 0.001)
    closure = lid_closure(drawn[0], time_s)
    assert closure.min() >= -1e-12
    assert closure.max() <= 1 + 1e-12
    assert STEEPEST / 0.1 - 0.1 <= np.diff(closure).max() / 0.001 <= STEEPEST / 0.075
    assert -np.diff(closure).min() / 0.001 <= STEEPEST / 0.15
    assert all((np.diff(blinks.start_s) >= 0.6).all() for blinks in drawn)


def test_saccades_keep_to_the_main_sequence():
    zero = np.zeros(2)
    jump = Fixations(
        edges_s=np.array([1.0]), yaw_deg=np.array([-10.0, 10.0]), pitch_deg=zero, distance_m=zero + 1
    )
    time_s = np.arange(0, 2, 0.0005)
    yaw, pitch, distance = gaze_course(jump, time_s)
    moving = time_s[(yaw > -10 + 1e-9) & (yaw < 10 - 1e-9)]
    assert moving[-1] - moving[0] == pytest.approx(0.021 + 0.0022 * 20, abs=0.003)
    assert not pitch.any()
    np.testing.assert_allclose(distance, 1)


def test_lips_meet_for_every_p_b_and_m_and_syllables_come_at_their_rate():
    visemes = load_templates("visemes")
    closing, jaw = BLENDSHAPE_INDEX["mouthClose"], BLENDSHAPE_INDEX["jawOpen"]
    spoken = draw_utterance(np.random.Generator(np.random.PCG64(3)), [(0.5, 59.5)], syllables_per_s=4.5)
    begin, end = spoken.edges_s[:-1], spoken.edges_s[1:]
    labial = spoken.viseme[1:-1] == visemes.names.index("PP")
    assert labial.sum() > 20
    course = speech_course(spoken, visemes.weights, ((begin + end) / 2)[labial])
    assert course[:, closing].min() > 0.8
    vowels = np.isin(spoken.viseme, [visemes.names.index(name) for name in ("aa", "E", "ih", "oh", "ou")])
    assert 3.0 < vowels.sum() / 59 < 5.0  # pauses included
    open_vowel = spoken.viseme[1:-1] == visemes.names.index("aa")
    assert np.median(speech_course(spoken, visemes.weights, ((begin + end) / 2)[open_vowel])[:, jaw]) > 0.2
    course = speech_course(spoken, LOUDNESS[1] * visemes.weights, np.arange(0, 60, 0.01))[:, jaw]
    assert 0.1 < 0.04 * np.abs(np.diff(course)).max() / 0.01 < 0.2  # m/s: jawOpen = 1 is 40 mm


def test_a_clip_across_two_blocks_is_the_clip_drawn_alone(anny):
    plan = plan_dataset(spec(neutral={"count": 0, "seconds": 2.0}, peak={"count": 7, "seconds": 2.5}))
    first, second = draw_samples(plan, anny, 0), draw_samples(plan, anny, 1)
    clip = first.clip[-1]
    assert clip == second.clip[0]
    take = draw_take(plan.spec, plan.script, int(clip), eye_centers(anny, first.identity[-1:])[0])
    here, there = first.clip == clip, second.clip == clip
    for name in ("weights", "gaze", "slip"):
        both = np.concatenate([getattr(first, name)[here], getattr(second, name)[there]])
        np.testing.assert_array_equal(both, getattr(take, name))
    np.testing.assert_array_equal(first.frame[here], np.arange(here.sum()))
    assert second.frame[there][-1] == plan.script.frames[clip % len(plan.script.kind)] - 1


def test_sessions_keep_camera_and_donning_people_keep_themselves(anny):
    change = {"peak": {"count": 0, "seconds": 2.0}, "sentence": {"count": 1, "seconds": 2.0}}
    change |= {"range_of_motion": {"count": 0, "seconds": 2.0}, "conversation": {"count": 1, "seconds": 2.0}}
    plan = plan_dataset(spec(**change))  # 360 frames a session, 720 a person
    samples = draw_samples(plan, anny, 0)
    assert plan.frames == 720
    assert (samples.session[[0, 359, 360, 719, 720]] == [0, 0, 1, 1, 2]).all()
    assert (samples.person[[0, 719, 720]] == [0, 0, 1]).all()
    for name in ("intrinsics", "donning"):
        values = getattr(samples, name)
        assert (values[:360] == values[0]).all()
    assert not np.array_equal(samples.donning[0], samples.donning[360])
    assert np.ptp(samples.camera_from_head[:360, :3, 3], axis=0).max() < 0.05  # metres that a head sways
    np.testing.assert_array_equal(samples.identity[0], samples.identity[719])
    radius = samples.pupil_radius_m[:, 0]
    assert radius[:360].mean() > radius[360:720].mean()  # the first room is the darker one
    assert samples.neutral[:120].all()
    assert not samples.neutral[120:360].any()
    assert not samples.weights[samples.neutral].any()
    names = np.array(COMPONENT_NAMES)[samples.component]
    assert names[[0, 120, 240]].tolist() == ["neutral", "sentence", "conversation"]
    assert samples.time_s[121] == pytest.approx(1 / 60)


def test_a_split_by_session_keeps_sessions_whole(anny):
    of = parse_spec(
        {"version": 1, "kind": "sequence", "seed": 1, "people": 100, "split": "session", "sequence": SHORT},
        where="test",
    )
    assert np.bincount(split_of(of, np.arange(200))).tolist() == [140, 30, 30]
    samples = draw_samples(plan_dataset(of), anny, 20)
    assert len(set(zip(samples.session, samples.split, strict=True))) == len(set(samples.session))
    assert len(samples.sample) == BLOCK
