"""Retargeting matrices: those that ship, and those that people write."""

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, MIRRORED_BLENDSHAPES, mirrored_name
from regress.errors import InputError
from regress.runtime.stages.retargeting.shipped import shipped_targets
from regress.runtime.stages.retargeting.target_file import read_retargeting

COUNTS = {"mixamo50": 50, "perfect_sync": 52, "unified_expressions": 102, "vrm0": 17, "vrm1": 18}
"""How many shapes a target has."""

_LIPS = {
    "mouthLowerDownLeft": 0.25,
    "mouthLowerDownRight": 0.25,
    "mouthUpperUpLeft": 0.25,
    "mouthUpperUpRight": 0.25,
}
DRIVERS: dict[str, dict[str, dict[str, float]]] = {
    "mixamo50": {
        "BrowsUp_Left": {"browInnerUp": 0.5, "browOuterUpLeft": 0.5},
        "BrowsOuterLower_Left": {},
        "Blink_Right": {"eyeBlinkRight": 1},
        "CheekPuff_Left": {"cheekPuff": 1},
        "NoseScrunch_Right": {"noseSneerRight": 0.75},
        "JawBackward": {},
        "JawForeward": {"jawForward": 1},
        "Jaw_Up": {"mouthShrugLower": 1},
        "Jaw_Down": {},
        "Jaw_Left": {"jawLeft": 1},
        "Smile_Left": {"mouthSmileLeft": 1, "mouthDimpleLeft": 0.25},
        "Frown_Right": {"mouthFrownRight": 1},
        "UpperLipUp_Left": {"mouthUpperUpLeft": 0.7, "mouthShrugUpper": 0.5},
        "LowerLipIn": {"mouthRollLower": 1},
        "UpperLipIn": {"mouthRollUpper": 1},
        "MouthOpen": {"jawOpen": 0.7},
        "MouthNarrow_Right": {"mouthPucker": 1, "mouthFunnel": 1},
        "MouthWhistle_NarrowAdjust_Left": {"mouthFunnel": 0.5},
    },
    "perfect_sync": {f"{name[0].upper()}{name[1:]}": {name: 1} for name in BLENDSHAPES},
    "unified_expressions": {
        "EyeClosedRight": {"eyeBlinkRight": 1},
        "EyeLookInLeft": {"eyeLookInLeft": 1},
        "EyeLookDownRight": {"eyeLookDownRight": 1},
        "EyeDilationLeft": {},
        "BrowPinchLeft": {"browDownLeft": 1},
        "BrowInnerUpRight": {"browInnerUp": 1},
        "CheekSuckLeft": {},
        "CheekPuffLeft": {"cheekPuff": 1},
        "JawOpen": {"jawOpen": 1},
        "JawForward": {"jawForward": 1},
        "JawBackward": {},
        "MouthClosed": {"mouthClose": 1},
        "LipSuckUpperRight": {"mouthRollUpper": 1},
        "LipFunnelLowerLeft": {"mouthFunnel": 1},
        "LipPuckerUpperRight": {"mouthPucker": 1},
        "MouthLowerLeft": {"mouthLeft": 1},
        "MouthCornerPullRight": {"mouthSmileRight": 1},
        "MouthRaiserUpper": {"mouthShrugUpper": 1},
        "MouthRaiserLower": {"mouthShrugLower": 1},
        "TongueOut": {"tongueOut": 1},
        "TongueUp": {},
    },
    "vrm0": {
        "joy": {"mouthSmileLeft": 0.5, "mouthSmileRight": 0.5},
        "sorrow": {"mouthFrownLeft": 0.5, "mouthFrownRight": 0.5},
        "fun": {},
        "a": {"jawOpen": 1},
        "i": _LIPS,
        "u": {"mouthPucker": 1},
        "e": {"mouthStretchLeft": 0.5, "mouthStretchRight": 0.5},
        "o": {"mouthFunnel": 1},
        "blink": {},
        "blink_l": {"eyeBlinkLeft": 1},
        "lookup": {"eyeLookUpLeft": 0.5, "eyeLookUpRight": 0.5},
        "lookleft": {"eyeLookOutLeft": 0.5, "eyeLookInRight": 0.5},
    },
    "vrm1": {
        "happy": {"mouthSmileLeft": 0.5, "mouthSmileRight": 0.5},
        "sad": {"mouthFrownLeft": 0.5, "mouthFrownRight": 0.5},
        "relaxed": {},
        "surprised": {"browInnerUp": 0.5, "eyeWideLeft": 0.25, "eyeWideRight": 0.25},
        "aa": {"jawOpen": 1},
        "ih": _LIPS,
        "ou": {"mouthPucker": 1},
        "ee": {"mouthStretchLeft": 0.5, "mouthStretchRight": 0.5},
        "oh": {"mouthFunnel": 1},
        "blink": {},
        "blinkRight": {"eyeBlinkRight": 1},
        "lookDown": {"eyeLookDownLeft": 0.5, "eyeLookDownRight": 0.5},
        "lookRight": {"eyeLookInLeft": 0.5, "eyeLookOutRight": 0.5},
    },
}
"""What drives some shapes of a target, by the documents that its file names: an avatar moves wrongly by another."""

FACTORS = {
    **{"mixamo50": (43, 35.5), "perfect_sync": (52, 52.0), "unified_expressions": (68, 68.0)},
    **{"vrm0": (25, 14.0), "vrm1": (28, 15.0)},
}
"""Numbers of all factors above 0, and their sum."""


@pytest.mark.parametrize("name", shipped_targets())
def test_shipped_targets_are_sound(name: str):
    target = read_retargeting(name)
    assert target.source
    assert len(target.names) == len(set(target.names)) == COUNTS[name]
    assert np.isfinite(target.factors).all()
    assert (target.factors >= 0).all()
    assert (target.low == 0).all()
    assert (target.high == 1).all()
    assert (target.apply(np.zeros((1, 52))) == 0).all()
    assert target.apply(np.ones((1, 52))).max() == 1


@pytest.mark.parametrize("name", shipped_targets())
def test_shapes_are_driven_by_what_the_documents_say(name: str):
    target = read_retargeting(name)
    rows = dict(zip(target.names, target.factors.T, strict=True))
    found = {
        shape: {BLENDSHAPES[index]: rows[shape][index] for index in np.flatnonzero(rows[shape])}
        for shape in DRIVERS[name]
    }
    assert found == DRIVERS[name]
    assert (np.count_nonzero(target.factors), target.factors.sum()) == pytest.approx(FACTORS[name])


@pytest.mark.parametrize("name", shipped_targets())
def test_shipped_targets_treat_both_sides_alike(name: str):
    """What drives X...Left drives X...Right with sides exchanged, whatever a target's spelling of sides."""
    target = read_retargeting(name)
    rows = dict(zip(target.names, target.factors.T, strict=True))
    spellings = (("Left", "Right"), ("left", "right"), ("_l", "_r"))
    sided = 0
    for shape, factors in rows.items():
        for left, right in spellings:
            if shape.endswith(left):
                np.testing.assert_array_equal(
                    factors, rows[shape.removesuffix(left) + right][list(MIRRORED_BLENDSHAPES)]
                )
                sided += 1
    assert sided >= 2


def test_perfect_sync_is_arkit_with_a_capital():
    target = read_retargeting("perfect_sync")
    weights = np.random.default_rng(0).uniform(size=(3, 52))
    np.testing.assert_array_equal(target.apply(weights), weights)
    assert tuple(name[0].lower() + name[1:] for name in target.names) == BLENDSHAPES
    assert all(mirrored_name(name) in target.names for name in target.names)


def test_a_file_of_ones_own_mixes_limits_and_leaves_empty_rows(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(
        "[shapes]\nJawSide = { jawRight = 1.0, jawLeft = -1.0 }\nGrin = { mouthSmileLeft = 2 }\nEar = {}\n"
        "[limits]\nJawSide = [-1, 1]\n"
    )
    target = read_retargeting(str(path))
    weights = np.zeros((3, 52))
    weights[0, BLENDSHAPE_INDEX["jawLeft"]] = 0.4
    weights[0, BLENDSHAPE_INDEX["mouthSmileLeft"]] = 0.7
    weights[1] = np.nan
    np.testing.assert_allclose(target.apply(weights), [[-0.4, 1.0, 0.0], [np.nan] * 3, [0, 0, 0]])
    assert target.names == ("JawSide", "Grin", "Ear")


@pytest.mark.parametrize(
    ("content", "said"),
    [
        ("[shapes", "is not valid TOML"),
        ("", "key 'shapes' is missing"),
        ("[shapes]", "shapes = {}: "),
        ("shapes = 3", "shapes = 3: must be a"),
        ("[shape]\nA = {}", "unknown key 'shape'; did you mean 'shapes'? Known keys here: title, source"),
        ("[shapes]\nA = 1", "shapes.A = 1: must be a"),
        ("[shapes]\nA = { jawOpened = 1 }", "is not one of the 52 ARKit names"),
        ("[shapes]\nA = { jawOpen = nan }", "must be a finite number"),
        ("[shapes]\nA = { jawOpen = true }", "shapes.A.jawOpen = true: must be a number"),
        ("[shapes]\nA = {}\n[limits]\nB = [0, 1]", "limits.B is not among the shapes"),
        (
            "[shapes]\nA = {}\n[limits]\nA = [0.1, 1]",
            "limits.A = [0.1, 1]: must be two numbers [low, high] about 0",
        ),
        ("[shapes]\nA = {}\n[limits]\nA = [0]", "limits.A"),
        ("[shapes]\nA = {}\n[limits]\nA = [-inf, inf]", "must be a finite number"),
        ("[shapes]\nA = { jawOpen = 1e300 }", "must be less than or equal to 1000"),
        ("[shapes]\n'' = {}", "must"),
        ("[shapes]\n" + "\n".join(f"A{number} = {{}}" for number in range(3000)), "at most 2000"),
        ("a" + ".a" * 20_000 + " = 1", "parts between dots"),
    ],
)
def test_a_bad_file_is_refused(content: str, said: str, tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(content)
    with pytest.raises(InputError) as caught:
        read_retargeting(str(path))
    assert said in str(caught.value)


def test_an_unknown_target_names_the_known_ones():
    with pytest.raises(InputError, match=r"mixamo50, perfect_sync, .* or give a \.toml file"):
        read_retargeting("mixamo")
