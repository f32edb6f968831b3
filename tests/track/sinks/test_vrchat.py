"""VRChat's OSC, read by python-osc: names and sums of VRCFaceTracking, bits, eyes, and what is sent again."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.sample import EyeMeasures, Sample
from regress.runtime.stages.retargeting.target_file import read_retargeting
from tests.track.sinks.receivers import ANY_SAMPLE, acted, lost, received, receiver
from tests.track.sinks.test_vmc import messages
from track.sinks.targets import open_sink, parse_target
from track.sinks.vrchat import _COMBINED, FLAGS, VrChat

V2 = "/avatar/parameters/v2/"


def parameters(datagrams: list[bytes], prefix: str = V2) -> dict[str, object]:
    """Values by name, of the addresses that begin so."""
    return {
        each.address.removeprefix(prefix): each.params[0]
        for each in messages(datagrams)
        if each.address.startswith(prefix)
    }


def test_a_receiver_reads_all_of_it():
    sample = acted()
    with receiver() as taken:
        sink = open_sink(parse_target(f"vrchat:127.0.0.1:{taken.getsockname()[1]}"), pytest.fail)
        sink.send(sample)
        datagrams = received(taken, len(VrChat()(sample)))
        sink.close()
    assert max(map(len, datagrams)) < 1500
    got = messages(datagrams)
    assert [each.params for each in got if each.address == "/avatar/parameters/LipTrackingActive"] == [[True]]
    values = parameters(datagrams)
    assert all(type(value) is float for value in values.values())
    weight = {name: sample.weights[index] for name, index in BLENDSHAPE_INDEX.items()}
    assert values["JawOpen"] == pytest.approx(weight["jawOpen"], abs=1e-6)
    assert values["MouthCornerPullLeft"] == pytest.approx(weight["mouthSmileLeft"], abs=1e-6)
    assert values["JawX"] == pytest.approx(weight["jawRight"] - weight["jawLeft"], abs=1e-6)
    lid = 0.75 * (1 - weight["eyeBlinkRight"]) + 0.25 * weight["eyeWideRight"]
    assert values["EyeLidRight"] == pytest.approx(lid, abs=1e-6)
    assert values["EyeLeftX"] == pytest.approx(
        -sample.gaze[0] / (np.pi / 4), abs=1e-6
    )  # to the right is positive
    assert values["EyeRightY"] == pytest.approx(sample.gaze[3] / (np.pi / 4), abs=1e-6)
    assert values["EyeX"] == pytest.approx((values["EyeLeftX"] + values["EyeRightX"]) / 2, abs=1e-6)
    (eyes,) = (each.params for each in got if each.address == "/tracking/eye/LeftRightPitchYaw")
    left_yaw, left_pitch, right_yaw, right_pitch = np.degrees(sample.gaze)
    np.testing.assert_allclose(eyes, [-left_pitch, -left_yaw, -right_pitch, -right_yaw], atol=1e-4)
    (closed,) = (each.params for each in got if each.address == "/tracking/eye/EyesClosedAmount")
    assert closed == [pytest.approx((weight["eyeBlinkLeft"] + weight["eyeBlinkRight"]) / 2, abs=1e-6)]


def test_what_is_no_sum_is_there_as_well():
    """By UnifiedExpressionsParameters.cs and UnifiedSimpleExpressions.cs."""
    weight = {
        "eyeBlinkLeft": 1.0,
        "eyeBlinkRight": 0.5,
        "eyeWideRight": 0.4,
        "eyeSquintLeft": 0.3,
        "mouthSmileLeft": 0.2,
        "mouthFrownLeft": 0.6,
        "mouthStretchLeft": 0.7,
        "mouthStretchRight": 0.1,
    }
    weights = np.zeros(52)
    weights[[BLENDSHAPE_INDEX[name] for name in weight]] = list(weight.values())
    values = parameters(VrChat()(Sample(weights=weights)))
    expected = {
        "EyeOpen": 0.25,
        "EyeClosed": 0.75,
        "EyeClosedLeft": 1.0,
        "EyeLid": (0.75 * 0.5 + 0.25 * 0.4) / 2,
        "EyeWide": 0.4,
        "EyeSquint": 0.3,
        "EyesSquint": 0.3,
        "MouthSadLeft": 0.7,
        "MouthSadRight": 0.1,
        "SmileSadLeft": -0.5,
        "SmileSadRight": -0.1,
        "SmileSad": -0.3,
    }
    assert {name: values[name] for name in expected} == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(
    ("eyes", "parameter", "native"), [("parameters", 1, 0), ("native", 0, 1), ("both", 1, 1)]
)
def test_eyes_go_where_they_are_wanted(eyes, parameter, native):
    """Of a wink VRChat's own eyes shut by half, both of them."""
    told = [each.address for each in messages(VrChat(eyes=eyes)(acted()))]
    for name in ("EyeLidLeft", "EyeOpen", "EyeLeftX"):
        assert told.count(V2 + name) == parameter
    for name in ("EyesClosedAmount", "LeftRightPitchYaw"):
        assert told.count(f"/tracking/eye/{name}") == native
    assert V2 + "JawOpen" in told
    # lids that both move shut twice, so native eyes leave all parameters of eyes out
    assert any(address.startswith(V2 + "Eye") for address in told) == bool(parameter)


def test_a_head_turns_and_goes_as_vrcfacetracking_has_it():
    """By UnifiedData.cs: yaw to the right, pitch down, roll to the left, 90 degrees are 1; half a metre from where it
    was first is 1, in Unity's frame."""
    vrchat = VrChat(clock=lambda: 0.0)
    first = Sample(weights=np.zeros(52), head=np.array([0.1, -0.05, 0.6, 0.3, 0.2, 0.1]))
    head = {name: value for name, value in parameters(vrchat(first)).items() if name.startswith("Head/")}
    quarter = np.pi / 2
    expected = {
        "Yaw": -0.3 / quarter,
        "Pitch": -0.2 / quarter,
        "Roll": 0.1 / quarter,
        "PosX": 0,
        "PosY": 0,
        "PosZ": 0,
    }
    assert head == pytest.approx({f"Head/{name}": value for name, value in expected.items()}, abs=1e-6)
    # to the picture's right, which is the person's left, up in the picture, and nearer
    moved = parameters(vrchat(replace(first, head=first.head + np.array([0.1, -0.05, -0.2, 0, 0, 0]))))
    assert moved == pytest.approx({"Head/PosX": -0.2, "Head/PosY": 0.1, "Head/PosZ": 0.4}, abs=1e-6)
    assert not any("Head" in name for name in parameters(VrChat()(Sample(weights=np.zeros(52)))))


def test_pupils_and_their_dilation_go_where_they_are_known():
    def sent(left: float, right: float) -> dict[str, object]:
        eyes = EyeMeasures(openness_mm=np.ones(2), openness=np.ones(2), pupil=np.array([left, right]))
        return parameters(VrChat()(replace(acted(), eyes=eyes)))

    said = sent(0.65, np.nan)
    assert said["PupilDilation"] == 1.0
    # of an iris of 11.7 mm; VRCFaceTracking: millimetres times 0.1
    assert said["PupilDiameterLeft"] == said["PupilDiameter"] == pytest.approx(0.65 * 11.7 * 0.1, abs=0.006)
    assert "PupilDiameterRight" not in said
    assert sent(0.2, 0.4)["PupilDiameter"] == pytest.approx(0.3 * 11.7 * 0.1, abs=0.006)
    assert sent(0.2, 0.65)["PupilDilation"] == 0.5
    assert "PupilDilation" not in sent(np.nan, np.nan)
    assert "PupilDilation" not in parameters(VrChat()(acted()))


def test_sums_are_those_of_the_unified_expressions_that_they_are_made_of():
    base, combined = (
        read_retargeting("unified_expressions"),
        read_retargeting(str(_COMBINED)),
    )
    column = {name: base.factors[:, index] for index, name in enumerate(base.names)}
    sums = {
        "BrowUpLeft": column["BrowOuterUpLeft"] * 0.6 + column["BrowInnerUpLeft"] * 0.4,
        "BrowDownRight": column["BrowLowererRight"] * 0.75 + column["BrowPinchRight"] * 0.25,
        "MouthSmileLeft": column["MouthCornerPullLeft"] * 0.8 + column["MouthCornerSlantLeft"] * 0.2,
        "CheekPuffSuckLeft": column["CheekPuffLeft"] - column["CheekSuckLeft"],
        "JawZ": column["JawForward"] - column["JawBackward"],
        "MouthX": (
            column["MouthUpperRight"]
            + column["MouthLowerRight"]
            - column["MouthUpperLeft"]
            - column["MouthLowerLeft"]
        )
        / 2,
        "LipSuckFunnelUpper": (
            column["LipSuckUpperRight"]
            + column["LipSuckUpperLeft"]
            - column["LipFunnelUpperRight"]
            - column["LipFunnelUpperLeft"]
        )
        / 2,
        "MouthOpen": 0.25
        * sum(
            column[f"Mouth{part}{side}"] for part in ("UpperUp", "LowerDown") for side in ("Left", "Right")
        ),
        "SmileFrownRight": column["MouthCornerPullRight"] * 0.8
        + column["MouthCornerSlantRight"] * 0.2
        - column["MouthFrownRight"],
        "MouthTightenerStretchLeft": column["MouthTightenerLeft"] - column["MouthStretchLeft"],
    }
    for name, expected in sums.items():
        np.testing.assert_allclose(combined.factors[:, combined.names.index(name)], expected, err_msg=name)
    lowest = np.minimum(combined.factors, 0).sum(axis=0)
    np.testing.assert_array_equal(combined.low, np.where(lowest < 0, -1, 0))
    assert not set(base.names) & set(combined.names)


@example(value=1.0, bits=4)
@example(value=-1.0, bits=1)
@given(value=st.floats(-1, 1), bits=st.integers(1, 8))
def test_bits_are_the_number_that_vrcfacetracking_makes(value, bits):
    weights = np.zeros(52)
    weights[BLENDSHAPE_INDEX["jawRight" if value > 0 else "jawLeft"]] = abs(value)
    values = parameters(VrChat(bits=bits)(Sample(weights=weights)))
    assert values["JawX"] == pytest.approx(value, abs=1e-6)  # avatars have floats as well
    assert all(
        type(each) is bool for name, each in values.items() if name[-1].isdigit() or "Negative" in name
    )
    number = sum(2**bit for bit in range(bits) if values[f"JawX{2**bit}"])
    assert f"JawX{2**bits}" not in values
    whole = 2**bits - 1 if abs(value) > 0.99999 else int(abs(value) * 2**bits)
    assert number == whole
    assert values["JawXNegative"] == (value < 0)


@pytest.mark.parametrize("prefix", ["FT/v2", "/FT/v2/", "/avatar/parameters/FT/v2/"])
def test_a_prefix_of_the_avatar_s(prefix):
    assert "JawOpen" in parameters(VrChat(prefix=prefix)(acted()), "/avatar/parameters/FT/v2/")


def test_an_avatar_without_a_prefix():
    assert "JawOpen" in parameters(VrChat(prefix="")(acted()), "/avatar/parameters/")


@pytest.mark.parametrize(
    ("prefix", "befores"), [("", [""]), ("v2", [""]), ("FT/v2", ["", "FT/"]), ("a/b/v2", ["", "a/b/"])]
)
def test_flags_stand_before_the_version_as_well(prefix, befores):
    """VRCFaceTracking takes them under any prefix, but none of a version."""
    vrchat = VrChat(prefix=prefix)
    for sample, seen in ((acted(), True), (lost(), False)):
        told = parameters(vrchat(sample), "/avatar/parameters/")
        flags = {name: value for name, value in told.items() if name.endswith("TrackingActive")}
        assert flags == {f"{before}{name}": seen for before in befores for name in FLAGS}


def test_what_did_not_change_is_sent_again_each_second_alone():
    sample = acted()
    for fps in (5, 30, 120):
        times = iter(np.arange(2 * fps + 1) / fps)
        vrchat = VrChat(clock=lambda times=times: next(times))
        sizes = [len(parameters(vrchat(sample))) for _ in range(2 * fps)]
        whole = sizes[0]
        assert whole > 100
        assert sizes == ([whole] + [0] * (fps - 1)) * 2
    vrchat = VrChat(clock=lambda: 0.0)
    moved = Sample(weights=sample.weights.copy(), gaze=sample.gaze)
    vrchat(sample)
    moved.weights[BLENDSHAPE_INDEX["jawOpen"]] = 0.125
    assert parameters(vrchat(moved)) == {"JawOpen": 0.125}


def test_a_lost_face_is_told_and_moves_nothing():
    vrchat = VrChat()
    vrchat(acted())
    got = messages(vrchat(lost()))
    assert [(each.address.split("/")[-1], each.params) for each in got] == [
        (name, [False]) for name in ("EyeTrackingActive", "ExpressionTrackingActive", "LipTrackingActive")
    ]
    assert vrchat(lost()) == []


@given(sample=ANY_SAMPLE)
def test_whatever_stages_leave_is_within_range(sample):
    values = np.array([float(value) for value in parameters(VrChat()(sample)).values()])
    assert ((values >= -1) & (values <= 1)).all()
