"""What `check_avatar` refuses of avatars that people bring, and what it takes."""

from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.avatars import check_avatar
from room.errors import FormatError
from room.server.application import STATIC
from tests.room.avatars import avatar
from tests.room.refused_avatars import LAMP, REFUSED, expressions, old_springs, springs


@pytest.mark.parametrize("fault", sorted(REFUSED))
def test_what_others_cannot_load_is_refused_in_one_sentence(fault):
    content, word = REFUSED[fault]
    with pytest.raises(FormatError) as told:
        check_avatar(content)
    assert word in str(told.value)
    assert "\n" not in str(told.value)
    assert len(str(told.value)) < 400


def test_whole_avatars_are_taken():
    check_avatar(avatar())
    ready = sorted((STATIC / "avatars").glob("*.glb"))
    assert ready
    for path in ready:
        check_avatar(path.read_bytes())


def _usual(made: dict) -> None:
    """As much of everything as rich VRMs of both versions have."""
    made["nodes"] += [{} for _ in range(600)]
    made["nodes"][1]["children"] = [*range(2, 602)]
    made["meshes"][0]["primitives"] *= 10
    made["skins"] = [{"joints": [*range(300)]}] * 40
    made["scenes"] = [{"nodes": [0]}]
    hair = [*range(2, 302)]
    old_springs(bones=hair, colliders=10, named=[0, 0])(made)
    old = made["extensions"]["VRM"]
    old["blendShapeMaster"] = {
        "blendShapeGroups": [
            {
                "name": f"A{number}",
                "binds": [{"mesh": 0, "index": 0, "weight": 100}] * 10,
                "materialValues": [{"materialName": "a"}] * 4,
            }
            for number in range(70)
        ]
    }
    springs(joints=500, colliders=20)(made)
    made["extensions"] |= {"VRM": old, **expressions(morphTargetBinds=[{"node": 0, "index": 0}] * 500)}


@pytest.mark.parametrize("declared", ["extensionsUsed", "extensionsRequired"])
def test_an_avatar_with_a_modellers_lamps_is_taken(declared):
    """Blender's export has the lamp of every new scene; the page keeps it dark."""

    def lit(made: dict) -> None:
        made["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "point"}]}}
        made[declared] = ["KHR_lights_punctual"]
        made["nodes"].extend([{"extensions": LAMP}] * 10)

    check_avatar(avatar(lit))


def _many_springs_of_0(made: dict) -> None:
    """Hair and clothes of VRM 0: all below a bone springs with it, beside colliders of the whole body."""
    made["nodes"] += [{} for _ in range(899)]
    made["nodes"][1]["children"] = [*range(2, 901)]
    old_springs(bones=[1], colliders=56)(made)


def _old_springs_of_no_node(made: dict) -> None:
    old_springs(bones=[1.0, -1, None], named=[0.0, 1, -1])(made)
    springs = made["extensions"]["VRM"]["secondaryAnimation"]
    springs["colliderGroups"] += [{"node": -1, "colliders": [{}]}, {"colliders": [{}]}, {"node": 1.0}]


def _shapes_with_tangents(made: dict) -> None:
    made["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": 1, "TANGENT": 1}]


@pytest.mark.parametrize("usual", [_many_springs_of_0, _old_springs_of_no_node, _shapes_with_tangents])
def test_what_exporters_write_is_taken(usual):
    check_avatar(avatar(usual))


def test_rich_avatars_are_taken():
    check_avatar(avatar(_usual))


@given(st.integers(0, len(avatar()) - 1), st.integers(0, 255))
def test_any_byte_may_be_another(place, byte):
    content = bytearray(avatar())
    content[place] = byte
    with suppress(FormatError):
        check_avatar(bytes(content))
