"""VMC, read by python-osc: addresses, type tags, order, sizes, and what bones and expressions mean."""

import numpy as np
import pytest
from hypothesis import given
from pythonosc.osc_bundle import OscBundle
from pythonosc.osc_message import OscMessage
from pythonosc.osc_message_builder import OscMessageBuilder
from pythonosc.osc_packet import OscPacket

from facegen.conventions import BLENDSHAPES
from facegen.geometry import direction_from_angles, rotation_from_angles
from tests.track.sinks.receivers import ANY_SAMPLE, acted, lost, received, receiver
from tests.track.sinks.test_axes import MIRROR_X, matrix
from track.sinks.osc import bundles, message
from track.sinks.targets import open_sink, parse_target
from track.sinks.vmc import SETS, Vmc

VRM0 = "A I U E O Blink Blink_L Blink_R LookUp LookDown LookLeft LookRight Neutral".split()
EMOTIONS = "Joy Angry Sorrow Fun".split()
"""As UniVRM's enumeration has them; receivers compare letter by letter."""


def messages(datagrams: list[bytes]) -> list[OscMessage]:
    """In the order in which a receiver has them."""
    return [timed.message for each in datagrams for timed in OscPacket(each).messages]


def test_a_receiver_reads_all_of_it():
    sample = acted()
    with receiver() as taken:
        sink = open_sink(parse_target(f"vmc:127.0.0.1:{taken.getsockname()[1]}"), pytest.fail)
        sink.send(sample)
        got = messages(received(taken, 3))
        sink.close()
    assert [each.address for each in got[:3]] == ["/VMC/Ext/OK", "/VMC/Ext/T", "/VMC/Ext/Root/Pos"]
    assert got[0].params == [1, 3, 0, 1]
    assert got[1].params == [1.5]
    assert (got[-1].address, got[-1].params) == ("/VMC/Ext/Blend/Apply", [])
    assert sum(each.address.endswith("Apply") for each in got) == 1
    values = {each.params[0]: each.params[1] for each in got if each.address == "/VMC/Ext/Blend/Val"}
    assert set(values) == {name[0].upper() + name[1:] for name in BLENDSHAPES} | set(VRM0)
    for name, weight in zip(BLENDSHAPES, sample.weights, strict=True):
        assert values[name[0].upper() + name[1:]] == pytest.approx(weight, abs=1e-7)
    assert values["Blink_L"] == pytest.approx(sample.weights[BLENDSHAPES.index("eyeBlinkLeft")], abs=1e-7)


def test_every_number_is_a_float_and_every_datagram_passes_a_router():
    datagrams = Vmc()(acted())
    assert [len(each) for each in datagrams] == sorted([len(each) for each in datagrams], reverse=True)
    assert max(map(len, datagrams)) < 1500
    for each in datagrams:
        bundle = OscBundle(each)  # one after another as they arrive
        for content in bundle:
            tags = content.dgram[content.dgram.index(b",") :].split(b"\0")[0].decode()
            assert (
                tags
                == {
                    "/VMC/Ext/OK": ",iiii",
                    "/VMC/Ext/T": ",f",
                    "/VMC/Ext/Root/Pos": ",sfffffff",
                    "/VMC/Ext/Bone/Pos": ",sfffffff",
                    "/VMC/Ext/Blend/Val": ",sf",
                    "/VMC/Ext/Blend/Apply": ",",
                }[content.address]
            )


@pytest.mark.parametrize("neck", ["on", "off"])
def test_head_and_eyes_turn_as_the_person_does(neck):
    sample = acted(3)
    bones = {
        each.params[0]: np.array(each.params[1:])
        for each in messages(Vmc(neck=neck)(sample))
        if each.address.endswith("Bone/Pos")
    }
    assert set(bones) == {"Head", "LeftEye", "RightEye"} | ({"Neck"} if neck == "on" else set())
    turn = MIRROR_X @ rotation_from_angles(*sample.head[3:]) @ MIRROR_X
    of_neck = matrix(bones["Neck"][3:]) if neck == "on" else np.eye(3)
    np.testing.assert_allclose(of_neck @ matrix(bones["Head"][3:]), turn, atol=1e-6)
    share = np.arccos((np.trace(of_neck) - 1) / 2) / np.arccos((np.trace(turn) - 1) / 2)
    assert share == pytest.approx(1 / 3 if neck == "on" else 0, abs=1e-5)
    for name, (yaw, pitch) in zip(("LeftEye", "RightEye"), sample.gaze.reshape(2, 2), strict=True):
        looks = matrix(bones[name][3:])[:, 2]
        np.testing.assert_allclose(looks, MIRROR_X @ direction_from_angles(yaw, pitch), atol=1e-6)
    assert bones["LeftEye"][0] < 0 < bones["RightEye"][0]  # Unity's left is -x


@pytest.mark.parametrize("names", SETS)
def test_names_of_expressions(names):
    spelled = [m.params[0] for m in messages(Vmc(names)(acted())) if m.address.endswith("Val")]
    assert len(spelled) == len(set(spelled))
    assert len(spelled) == {"both": 65, "perfect-sync": 52, "vrm0": 13, "vrm1": 13}[names]
    assert ("JawOpen" in spelled) == (names in ("both", "perfect-sync"))
    assert set(VRM0) <= set(spelled) or names not in ("both", "vrm0")
    assert ("blinkLeft" in spelled) == (names == "vrm1")


@pytest.mark.parametrize(
    ("names", "emotions"),
    [
        ("both", set(EMOTIONS)),
        ("vrm1", {"happy", "angry", "sad", "relaxed", "surprised"}),
        ("perfect-sync", set()),
    ],
)
def test_emotions_are_sent_where_they_are_asked_for(names, emotions):
    """VRoid's Joy shuts the eyes, whatever the lids do."""

    def sent(**options) -> dict[str, float]:
        told = messages(Vmc(names, **options)(acted()))
        return {each.params[0]: each.params[1] for each in told if each.address.endswith("Val")}

    without, with_them = sent(), sent(emotions="on")
    assert with_them.keys() - without.keys() == emotions
    assert without.items() <= with_them.items()
    assert not {name.casefold() for name in without} & {name.casefold() for name in emotions}


def test_a_lost_face_is_told_and_moves_nothing():
    got = messages(Vmc()(lost()))
    assert [(each.address, each.params) for each in got] == [
        ("/VMC/Ext/OK", [1, 3, 0, 0]),
        ("/VMC/Ext/T", [2.5]),
    ]


@given(sample=ANY_SAMPLE)
def test_whatever_stages_leave_is_a_bundle(sample):
    got = messages(Vmc()(sample))
    assert got[0].address == "/VMC/Ext/OK"
    values = np.array([each.params[1] for each in got if each.address.endswith("Val")])
    assert ((values >= 0) & (values <= 1)).all()


@pytest.mark.parametrize(
    "values", [(), (1,), (0.25,), (True,), ("a", 0.5), ("abc", 1, True, 2.0, False), ("ö",)]
)
def test_messages_are_those_of_python_osc(values):
    builder = OscMessageBuilder("/some/address")
    for value in values:
        builder.add_arg(value)
    built = message("/some/address", *values)
    assert built == builder.build().dgram
    assert [each for bundle in bundles([built] * 3) for each in OscBundle(bundle)][2].dgram == built
