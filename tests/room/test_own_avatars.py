"""An avatar that somebody brings: checked before it is shown, fetched with the key alone, forgotten with its person."""

import asyncio
import hashlib
import io
import struct
from collections.abc import Callable
from contextlib import nullcontext, suppress
from types import SimpleNamespace

import pytest
from hypothesis import given
from hypothesis import strategies as st

from room.avatars import AvatarStore, check_avatar, digest_of
from room.avatars.check import (
    MOST_AVATAR_BYTES,
    MOST_DOCUMENT_BYTES,
    MOST_DRAWN,
    MOST_NODES,
    MOST_TRIANGLES,
)
from room.avatars.pieces import PIECE_BYTES, pack_piece, read_piece
from room.errors import FormatError, NotAllowed
from room.gltf.check import MOST_PICTURES, MOST_SIDE_PIXELS, MOST_TEXTURE_PIXELS
from room.gltf.extensions import HOW
from room.gltf.moved import (
    MOST_BINDS,
    MOST_CHANNELS,
    MOST_COLLISIONS,
    MOST_JOINTS,
    MOST_LIGHTS,
    MOST_SCENES,
    MOST_SPRUNG,
)
from room.gltf.numbers import MOST_NUMBERS
from room.protocol.accounts import Wanted
from room.protocol.answers import Changed, Left, Notice
from room.server import new_keys
from room.server.application import STATIC
from room.server.avatar_checks import AvatarChecks
from room.server.avatar_requests import AvatarRequests
from room.server.avatar_transfer import AvatarTransfer
from room.server.limits import MOST_UPLOADS_A_ROOM, UPLOADS_BURST
from room.server.room_avatars import RoomAvatars
from room.state import Meeting
from tests.room.avatars import BINARY, POINTS, avatar, png, textured
from tests.room.guests import Guest, Place, open_room


def _nodes(count: int):
    return lambda made: made["nodes"].extend({} for _ in range(count))


def _at(*path: object, **values: object):
    """Change a record of the document."""

    def change(made: dict) -> None:
        for key in path:
            made = made[key]
        made.update(values)

    return change


def _with_zeros(primitive: dict | None = None, *, count: int, type: str = "VEC3", **records: object) -> bytes:
    """An avatar with an accessor (2) that has no view, whatever may read it."""

    def change(made: dict) -> None:
        zeros = {"componentType": 5125 if type == "SCALAR" else 5126, "count": count, "type": type}
        made["accessors"] = [*made["accessors"][:2], zeros]
        made.update(records)
        if primitive:
            made["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}, **primitive})

    return avatar(change)


def _springs(*, joints: int = 1, colliders: int = 1, groups: int = 0, named: list | None = None):
    """Springs of VRM 1: a group of all colliders, and more of none."""
    spring = {"joints": [{"node": 1}] * joints, "colliderGroups": named or [*range(groups + 1)]}
    springs = {
        "specVersion": "1.0",
        "colliders": [{"node": 1, "shape": {"sphere": {}}}] * colliders,
        "colliderGroups": [{"colliders": [*range(colliders)]}, *[{"colliders": []}] * groups],
        "springs": [spring],
    }
    return _at(extensions={"VRMC_springBone": springs})


def _old_springs(*, bones: list = [1], colliders: int = 1, named: list = [0]):  # noqa: B006
    """Springs of VRM 0."""
    group = {"node": 1, "colliders": [{"radius": 0.1}] * colliders}
    springs = {"boneGroups": [{"bones": bones, "colliderGroups": named}], "colliderGroups": [group]}
    return _at(extensions={"VRM": {"secondaryAnimation": springs}})


def _expressions(**binds: list) -> dict:
    return {"VRMC_vrm": {"expressions": {"preset": {"aa": binds}}}}


def _old_expressions(**binds: list) -> dict:
    return {"VRM": {"blendShapeMaster": {"blendShapeGroups": [{"name": "A", **binds}]}}}


def _many_pictures(made: dict) -> None:
    made["images"] *= MOST_PICTURES + 1


def _large_pictures(made: dict) -> None:
    made["images"] *= MOST_TEXTURE_PIXELS // MOST_SIDE_PIXELS**2 + 1


LAMP = {"KHR_lights_punctual": {"light": 0}}

LARGE = png(MOST_SIDE_PIXELS, MOST_SIDE_PIXELS, whole=False)

REFUSED = {
    "nothing": (b"", "is not a binary glTF"),
    "text": (b"{}", "is not a binary glTF"),
    "too large": (bytes(MOST_AVATAR_BYTES + 1), "smaller textures"),
    "cut": (avatar()[:-8], "is cut off"),
    "a document that is too large": (
        avatar(lambda made: made.update(extras="x" * MOST_DOCUMENT_BYTES)),
        "document",
    ),
    "a file beside it": (avatar(_at("images", 0, uri="https://elsewhere.example/skin.png")), "beside itself"),
    "a buffer beside it": (avatar(_at("buffers", 0, uri="body.bin")), "beside itself"),
    "an address in an extension": (
        avatar(lambda made: made.update(extensions={"X": [{"a": {"uri": "javascript:alert(1)"}}]})),
        "beside itself",
    ),
    "behaviour": (avatar(lambda made: made.update(extensionsUsed=["KHR_interactivity"])), "acts by itself"),
    "sound": (avatar(lambda made: made.update(extensionsUsed=["KHR_audio_emitter"])), "acts by itself"),
    "copies": (
        avatar(lambda made: made.update(extensionsUsed=["EXT_mesh_gpu_instancing"])),
        "acts by itself",
    ),
    "copies that nobody declared": (
        avatar(_at("nodes", 0, extensions={"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}})),
        "acts by itself",
    ),
    "many lamps": (
        avatar(lambda made: made["nodes"].extend([{"extensions": LAMP}] * (MOST_LIGHTS + 1))),
        "without lights",
    ),
    "a shape of no mesh": (
        avatar(_at("meshes", 0, "primitives", 0, attributes={}, indices=1)),
        "moves other vertices",
    ),
    "a shape of other directions alone": (
        avatar(_at("meshes", 0, "primitives", 0, targets=[{"NORMAL": 1}])),
        "moves other vertices",
    ),
    "shapes of one vertex": (avatar(_at("accessors", 1, count=1)), "moves other vertices"),
    "shapes that move nothing": (
        _with_zeros(
            {"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}] + [{}] * 2_000}, count=10_000
        ),
        "fewer vertices",
    ),
    "a skin of many joints": (avatar(_at(skins=[{"joints": [0, 1] * MOST_JOINTS}])), "joints in its skins"),
    "a joint that is not there": (avatar(_at(skins=[{"joints": [2]}])), "names node 2"),
    "many scenes": (avatar(_at(scenes=[{}] * (MOST_SCENES + 1))), "scenes"),
    "a scene of one node many times": (avatar(_at(scenes=[{"nodes": [0] * (MOST_NODES + 1)}])), "scenes"),
    "many movements": (
        _with_zeros(
            count=1,
            animations=[
                {"samplers": [{"input": 2, "output": 2}], "channels": [{"sampler": 0}] * (MOST_CHANNELS + 1)}
            ],
        ),
        "without animations",
    ),
    "springs of many joints": (avatar(_springs(joints=MOST_SPRUNG + 1)), "fewer bones springs"),
    "springs of many colliders": (avatar(_springs(colliders=MOST_SPRUNG + 1)), "fewer bones springs"),
    "springs beside many colliders": (
        avatar(_springs(joints=1_000, colliders=MOST_COLLISIONS // 1_000 + 1)),
        "fewer colliders",
    ),
    "springs beside many groups of none": (
        avatar(_springs(joints=1_000, groups=MOST_COLLISIONS // 1_000 + 1)),
        "fewer colliders",
    ),
    "springs of a group by its text": (avatar(_springs(named=["0"])), "no whole number"),
    "old springs of many colliders": (avatar(_old_springs(colliders=MOST_SPRUNG + 1)), "fewer bones springs"),
    "old springs again and again": (avatar(_old_springs(bones=[0] * 3_000)), "fewer bones springs"),
    "old springs beside many colliders": (
        avatar(_old_springs(bones=[0] * 10, colliders=100, named=[0] * 200)),
        "fewer colliders",
    ),
    "old springs of a bone by its text": (avatar(_old_springs(bones=["0"])), "no whole number"),
    "many expressions": (
        avatar(
            _at(
                extensions={
                    "VRMC_vrm": {"expressions": {"custom": {f"a{n}": {} for n in range(MOST_BINDS + 1)}}}
                }
            )
        ),
        "fewer expressions",
    ),
    "an expression of many shapes": (
        avatar(_at(extensions=_expressions(morphTargetBinds=[{"node": 0, "index": 0}] * MOST_BINDS))),
        "fewer expressions",
    ),
    "an old expression of one mesh many times": (
        avatar(
            lambda made: (
                made["nodes"].extend([{"mesh": 0}] * 99),
                _at(extensions=_old_expressions(binds=[{"mesh": 0, "index": 0}] * (MOST_BINDS // 100)))(made),
            )
        ),
        "fewer expressions",
    ),
    "old expressions of many materials": (
        avatar(_at(extensions=_old_expressions(materialValues=[{"materialName": "a"}] * MOST_BINDS))),
        "fewer expressions",
    ),
    "Draco": (
        avatar(lambda made: made.update(extensionsRequired=["KHR_draco_mesh_compression"])),
        HOW["KHR_draco_mesh_compression"],
    ),
    "an extension that nobody knows": (
        avatar(lambda made: made.update(extensionsRequired=["ACME_x"])),
        "ACME_x",
    ),
    "SVG": (
        textured(b"<svg xmlns='http://www.w3.org/2000/svg'><script>alert(1)</script></svg>"),
        "is no PNG",
    ),
    "half a picture": (textured(png(4, 4)[:12]), "is no PNG"),
    "a wide texture": (textured(png(MOST_SIDE_PIXELS + 1, 1, whole=False)), "a side"),
    "many textures": (avatar(_many_pictures), "textures"),
    "large textures": (
        avatar(
            lambda made: (_large_pictures(made), made["bufferViews"][1].update(byteLength=len(LARGE))),
            POINTS + LARGE,
        ),
        "together",
    ),
    "no mesh": (avatar(_at("nodes", 0, mesh=None)), "nothing to look at"),
    "points alone": (avatar(_at("meshes", 0, "primitives", 0, mode=0)), "nothing to look at"),
    "many triangles by zeros": (
        avatar(
            lambda made: (
                _at("accessors", 1, count=3 * MOST_TRIANGLES + 3, type="SCALAR", componentType=5125)(made),
                _at("meshes", 0, "primitives", 0, indices=1, targets=[])(made),
            )
        ),
        "triangles",
    ),
    "one mesh many times": (avatar(lambda made: made["nodes"].extend([{"mesh": 0}] * MOST_DRAWN)), "parts"),
    "a shape of zeros": (
        _with_zeros(
            {"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}], "mode": 0}, count=MOST_NUMBERS // 3
        ),
        "fewer vertices",
    ),
    "one shape again and again": (
        _with_zeros({"attributes": {"POSITION": 2}, "targets": [{"POSITION": 2}] * 2_001}, count=10_000),
        "fewer vertices",
    ),
    "indices of points": (
        _with_zeros({"mode": 0, "indices": 2}, count=2**31, type="SCALAR"),
        "fewer vertices",
    ),
    "indices of lines": (
        _with_zeros({"mode": 1, "indices": 2}, count=2**28, type="SCALAR"),
        "fewer vertices",
    ),
    "a skin of zeros": (_with_zeros(count=2**28, type="MAT4", skins=[{"inverseBindMatrices": 2}]), "bones"),
    "a skin again and again": (
        _with_zeros(count=2**20, type="MAT4", skins=[{"inverseBindMatrices": 2}] * 4),
        "bones",
    ),
    "a movement of zeros": (
        _with_zeros(count=2**30, animations=[{"samplers": [{"input": 2, "output": 2}]}]),
        "without animations",
    ),
    "a movement of many things": (
        _with_zeros(
            count=10**6,
            animations=[{"samplers": [{"input": 2, "output": 2}], "channels": [{"sampler": 0}] * 10}],
        ),
        "without animations",
    ),
    "zeros that nothing names": (_with_zeros(count=2**30), "fewer vertices"),
    "a movement that is not there": (
        _with_zeros(count=3, animations=[{"channels": [{"sampler": 0}]}]),
        "names sampler 0",
    ),
    "many nodes": (avatar(_nodes(MOST_NODES)), "nodes"),
    "a node below itself": (avatar(_at("nodes", 1, children=[0])), "hang on themselves"),
    "a node below two": (avatar(lambda made: made["nodes"].append({"children": [1]})), "hangs on two"),
    "a node that is not there": (avatar(_at("nodes", 1, children=[7])), "names node 7"),
    "a mesh that is not there": (avatar(_at("nodes", 0, mesh=1)), "names mesh 1"),
    "an accessor that is not there": (
        avatar(_at("meshes", 0, "primitives", 0, attributes={"POSITION": 9})),
        "names accessor 9",
    ),
    "a view behind the file": (avatar(_at("bufferViews", 0, byteLength=10**6)), "ends behind"),
    "an accessor behind its view": (avatar(_at("accessors", 0, count=4)), "reads behind"),
    "a buffer without bytes": (avatar(_at("buffers", 0, byteLength=10**6)), "binary part"),
    "two buffers": (avatar(lambda made: made["buffers"].append({"byteLength": 4})), "binary part"),
    "sparse values that are too many": (
        avatar(
            _at(
                "accessors",
                1,
                sparse={
                    "count": 4,
                    "indices": {"bufferView": 0, "componentType": 5121},
                    "values": {"bufferView": 0},
                },
            )
        ),
        "sparse",
    ),
    "a component of no kind": (avatar(_at("accessors", 0, componentType=5130)), "of no kind"),
    "a count of text": (avatar(_at("accessors", 0, count="3")), "accessors[0].count"),
    "a negative offset": (avatar(_at("accessors", 0, byteOffset=-4)), "accessors[0].byteOffset"),
    "chunks without end": (
        avatar()[:8] + struct.pack("<I", 0) + struct.pack("<I4s", 0, b"JSON") * 2000,
        "chunks",
    ),
}


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
    _old_springs(bones=hair, colliders=10, named=[0, 0])(made)
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
    _springs(joints=500, colliders=20)(made)
    made["extensions"] |= {"VRM": old, **_expressions(morphTargetBinds=[{"node": 0, "index": 0}] * 500)}


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
    _old_springs(bones=[1], colliders=56)(made)


def _old_springs_of_no_node(made: dict) -> None:
    _old_springs(bones=[1.0, -1, None], named=[0.0, 1, -1])(made)
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


def test_the_store_keeps_each_avatar_once_and_no_more_than_it_may():
    store = AvatarStore(most_bytes=13)
    digest = store.put(b"abcdef", ("lab", "ada"))
    assert store.put(b"abcdef", ("lab", "ben")) == digest == hashlib.sha256(b"abcdef").hexdigest()
    assert store.kept_bytes == 6
    with pytest.raises(NotAllowed):
        store.put(b"ghijkl", ("lab", "cy"))
    assert store.get(digest, "lab") == b"abcdef"
    assert store.get(digest, "hall") is None, "another room's"
    store.drop(("lab", "ada"))
    assert store.get(digest, "lab") == b"abcdef"
    store.drop(("lab", "ben"))
    assert store.kept_bytes == 0
    assert store.put(b"ghijkl", ("lab", "cy")) != digest


@given(st.lists(st.tuples(st.sampled_from("abc"), st.integers(0, 20), st.integers(1, 40)), max_size=60))
def test_no_room_keeps_others_from_the_store(brought):
    """However three of them fill it, a sixteenth is left for a fourth, and who is refused wears what they wore."""
    store = AvatarStore(most_bytes=160)
    worn: dict[tuple[str, str], bytes] = {}
    for number, (room, person, size) in enumerate(brought):
        wearer, content = (room, str(person)), number.to_bytes(1, "little") * size
        with suppress(NotAllowed):
            store.put(content, wearer)
            worn[wearer] = content
        assert store.kept_bytes == sum(map(len, worn.values())) <= 150
        for (place, _), kept in worn.items():
            assert store.get(digest_of(kept), place) == kept
    store.put(b"x" * 5, ("late", "ada"))


@given(st.lists(st.integers(1, 40), max_size=40))
def test_a_room_alone_has_three_quarters_of_the_store(sizes):
    store = AvatarStore(most_bytes=160)
    for number, size in enumerate(sizes):
        fits = store.kept_bytes + size <= 120
        with nullcontext() if fits else pytest.raises(NotAllowed):
            store.put(number.to_bytes(1, "little") * size, ("lab", str(number)))


def test_who_brings_the_same_or_a_smaller_one_is_never_refused():
    store = AvatarStore(most_bytes=160)
    for number in range(4):
        store.put(bytes([number]) * 30, ("lab", str(number)))
    store.put(b"b" * 20, ("hall", "ben"))
    with pytest.raises(NotAllowed) as told:
        store.put(b"a" * 31, ("lab", "0"))
    assert not told.value.again, "a page would bring 32 MiB twice a minute"
    digest = store.put(bytes([0]) * 30, ("lab", "0"))
    assert store.get(digest, "lab")
    assert store.put(b"c" * 29, ("lab", "0")) != digest
    assert store.get(digest, "lab") is None


def _bearer(place: Place, guest: Guest | None = None, key: str = "") -> dict[str, str]:
    key = key or place.keys.key(place.name, "guest")
    return {"Authorization": f"Bearer {key}" + (f".{guest.secret}" if guest else "")}


async def bring(place: Place, guest: Guest, content: object, **headers: str) -> tuple[int, str]:
    """Upload; the status, and the digest or the sentence."""
    address = f"{place.address}/room/{place.name}/avatar"
    async with place.session.post(address, data=content, headers=_bearer(place, guest) | headers) as answer:
        return answer.status, (await answer.json())["own"] if answer.ok else (await answer.text()).strip()


async def fetch(place: Place, digest: str, key: str = "") -> tuple[int, bytes]:
    address = f"{place.address}/room/{place.name}/avatar/{digest}"
    async with place.session.get(address, headers=_bearer(place, key=key)) as answer:
        return answer.status, await answer.read()


def dressed(guest: Guest, digest: str):
    return guest.told(Changed, lambda answer: answer.person.name == "Ada" and answer.person.own == digest)


def meet(run):
    """Ada and Ben in a room, and a moderator."""

    async def open_and_run() -> None:
        async with open_room() as place:
            ada, ben = await place.guest(), await place.guest(name="Ben")
            await run(place, ada, ben)

    asyncio.run(asyncio.wait_for(open_and_run(), 300))


def test_an_avatar_goes_to_those_with_the_key_and_goes_with_its_person():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        content = avatar()
        status, digest = await bring(place, ada, content)
        assert (status, digest) == (200, hashlib.sha256(content).hexdigest())
        await dressed(ben, digest)
        late = await place.guest(name="Cy")
        assert digest in {person.own for person in late.welcome.people}
        assert await fetch(place, digest) == (200, content)
        assert (await fetch(place, digest, key="k" * 22))[0] == 403
        assert (await fetch(place, "0" * 64))[0] == 404
        assert (await fetch(place, "..%2f..%2froom.html"))[0] == 404
        async with place.session.get(f"{place.address}/metrics") as answer:
            assert f"room_avatar_bytes {len(content)}\n" in await answer.text()
        await ada.say(kind="leave")
        await ben.told(Left)
        assert (await fetch(place, digest))[0] == 404

    meet(run)


def test_one_may_take_it_off_and_a_moderator_may_for_good():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        digest = (await bring(place, ada, avatar()))[1]
        await dressed(ben, digest)
        ben.answers.clear()
        await ada.say(kind="undress")
        await dressed(ben, "")
        assert (await fetch(place, digest))[0] == 404
        assert (await bring(place, ada, avatar()))[1] == digest
        await dressed(ben, digest)
        ben.answers.clear()
        await ben.say(kind="moderate", action="undress", number=ada.number)
        assert "only a moderator" in (await ben.told(Notice)).text
        chair = await place.guest(name="Chair", moderator=True)
        await chair.say(kind="moderate", action="undress", number=ada.number)
        await dressed(ben, "")
        assert (await fetch(place, digest))[0] == 404
        status, sentence = await bring(place, ada, avatar())
        assert status == 403
        assert "a moderator" in sentence
        await ada.say(kind="leave")
        await ben.told(Left)
        again = await place.guest(secret=ada.secret)
        assert (await bring(place, again, avatar()))[0] == 403, "the same person, whom one click brought back"

    meet(run)


def test_who_finds_no_place_for_an_avatar_goes_on_to_wear_the_last_one(monkeypatch):
    monkeypatch.setattr(
        "room.server.application.AvatarStore", lambda: AvatarStore(most_bytes=2 * len(avatar()))
    )

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        digest = (await bring(place, ada, avatar()))[1]
        status, sentence = await bring(place, ada, avatar(_nodes(200)))
        assert status == 507, "of 503 and 429 the page brings it again by itself, 32 MiB twice a minute"
        assert "smaller" in sentence
        assert (await place.guest(name="Cy")).welcome.people[0].own == digest
        assert (await fetch(place, digest))[0] == 200

    meet(run)


def test_avatars_are_checked_by_another_process(monkeypatch):
    """A parser of this one would halt all rooms."""
    monkeypatch.setattr("facegen.formats.gltf_container.parse_json", None)

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        assert (await bring(place, ada, avatar()))[0] == 200
        assert (await bring(place, ada, textured(b"<svg>")))[0] == 422

    meet(run)


def test_one_process_checks_all_and_another_begins_where_it_was_lost(monkeypatch):
    async def run() -> None:
        checks = AvatarChecks()
        await checks.check(avatar())
        first = checks._process
        for fault in ("SVG", "springs of many joints", "nothing"):
            with pytest.raises(FormatError, match=REFUSED[fault][1]):
                await checks.check(REFUSED[fault][0])
        assert checks._process is first
        for gone in (0.0, 0.5):  # its end is noticed, or not yet
            checks._process.kill()
            await asyncio.sleep(gone)
            await checks.check(avatar())  # who comes next has no part in it
        second = checks._process
        asked = asyncio.create_task(checks.check(textured(b"<svg>")))
        await asyncio.sleep(0)
        asked.cancel()
        await asyncio.gather(asked, return_exceptions=True)
        await checks.check(avatar())  # and is not told of the other's fault
        assert second.returncode is not None
        monkeypatch.setattr("room.server.avatar_checks.CHECK_S", 0)
        with pytest.raises(FormatError, match="a simpler one"):
            await checks.check(avatar())
        monkeypatch.undo()
        await checks.check(avatar())
        third = checks._process
        await checks.close()
        assert third.returncode is not None

    asyncio.run(asyncio.wait_for(run(), 300))


def test_refusals_are_sentences_and_change_nothing():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        status, sentence = await bring(place, ada, BINARY)
        assert (status, sentence) == (422, "this avatar is not a binary glTF 2.0 file (.glb or .vrm)")
        status, sentence = await bring(place, ada, io.BytesIO(bytes(MOST_AVATAR_BYTES + 1)))
        assert status == 413
        assert "smaller textures" in sentence

        async def endless():
            for _ in range(MOST_AVATAR_BYTES // 2**20 + 2):
                yield bytes(2**20)

        assert (await bring(place, ada, endless()))[0] == 413, "a body that does not say how long it is"
        assert (await bring(place, ada, avatar(), Origin="https://elsewhere.example"))[0] == 403
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {'k' * 22}.{ada.secret}"))[0] == 403
        key = place.keys.key(place.name, "guest")
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {key}.{'s' * 22}"))[0] == 403, (
            "not there"
        )
        assert (await bring(place, ada, avatar(), Authorization=f"Bearer {key}"))[0] == 403, "of nobody"
        assert not ben.all(Changed) or all(not answer.person.own for answer in ben.all(Changed))

    meet(run)


def test_who_tries_again_and_again_waits():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        found = [await bring(place, ada, b"x") for _ in range(UPLOADS_BURST + 1)]
        assert [status for status, _ in found] == [422] * UPLOADS_BURST + [429]
        assert (await bring(place, ben, avatar()))[0] == 200, "others do not"

    meet(run)


def test_one_who_sends_slowly_keeps_nobody_else_from_it():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        begun, rest = asyncio.Event(), asyncio.Event()

        async def slow():
            yield b"x"
            begun.set()
            await rest.wait()

        first = asyncio.create_task(bring(place, ada, slow()))
        await begun.wait()
        await asyncio.sleep(0.1)  # it is on its way before the next one asks
        for _ in range(MOST_UPLOADS_A_ROOM - 1):
            status, sentence = await bring(place, ada, slow())
            assert (status, "another avatar of yours" in sentence) == (429, True)
        assert (await bring(place, ben, avatar()))[0] == 200
        rest.set()
        assert (await first)[0] == 422

    meet(run)


def test_a_room_whose_people_all_send_slowly_keeps_no_other_room_from_it():
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        rest = asyncio.Event()

        async def slow(begun: asyncio.Event):
            yield b"x"
            begun.set()
            await rest.wait()

        sending = []
        for _ in range(MOST_UPLOADS_A_ROOM):
            begun = asyncio.Event()
            sending.append(asyncio.create_task(bring(place, await place.guest(), slow(begun))))
            await begun.wait()
        await asyncio.sleep(0.1)  # they are on their way before the next one asks
        assert (await bring(place, ada, avatar()))[0] == 503
        other = Place(place.address, place.keys, "other")
        try:
            assert (await bring(other, await other.guest(), avatar()))[0] == 200
        finally:
            await other.session.close()
        rest.set()
        assert {status for status, _ in await asyncio.gather(*sending)} == {422}

    meet(run)


def test_an_avatar_by_which_each_process_ends_is_refused(monkeypatch):
    monkeypatch.setattr("room.server.avatar_checks._BEGIN", "import sys; sys.stdin.buffer.read(4)")

    async def run() -> None:
        checks = AvatarChecks()
        for _ in range(2):
            with pytest.raises(FormatError, match="a simpler one"):
                await checks.check(avatar())
        await checks.close()

    asyncio.run(asyncio.wait_for(run(), 300))


def test_where_no_process_begins_the_avatar_comes_again_later(monkeypatch):
    async def no_more(*_: object, **__: object) -> None:
        raise BlockingIOError

    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        with monkeypatch.context() as full:
            full.setattr("asyncio.create_subprocess_exec", no_more)
            assert (await bring(place, ada, avatar()))[0] == 503
        assert (await bring(place, ada, avatar()))[0] == 200

    meet(run)


def test_an_avatar_that_breaks_off_is_no_fault_of_the_servers(caplog: pytest.LogCaptureFixture):
    async def run(place: Place, ada: Guest, ben: Guest) -> None:
        for _ in range(2):

            async def slow():
                yield b"x"
                await asyncio.Event().wait()

            first = asyncio.create_task(bring(place, ada, slow()))
            await asyncio.sleep(0.2)
            first.cancel()
            await asyncio.sleep(0.2)

    meet(run)
    assert not caplog.records, "each would be a traceback in the operator's log"


def test_an_avatar_comes_in_pieces_and_what_is_none_is_refused():
    digest, whole = "ab" * 32, bytes(range(256)) * 1024 + b"end"
    pieces = [read_piece(pack_piece(digest, whole, at)) for at in range(0, len(whole), PIECE_BYTES)]
    assert b"".join(piece.content for piece in pieces) == whole
    assert {(piece.digest, piece.total) for piece in pieces} == {(digest, len(whole))}
    good = pack_piece(digest, b"four", 0)
    for bad in (
        good[:-4],
        good + b"more",
        b"\x02" + good[1:],
        pack_piece(digest, bytes(MOST_AVATAR_BYTES + 1), 0),
        good[:33] + (5).to_bytes(4, "little") + (2).to_bytes(4, "little") + good[41:],
    ):
        with pytest.raises(FormatError):
            read_piece(bad)


class _Channels:
    """Another server beside this one, which sends what it is asked for."""

    def __init__(self, avatar: bytes) -> None:
        self.process, self.avatar, self.sent = "0" * 16, avatar, 0

    def listen(self, hear: Callable[[bytes], None]) -> None:
        self.hear = hear

    def say(self, _: str, said: bytes) -> None:
        self.sent += 1
        wanted = Wanted.model_validate_json(said)
        asyncio.get_running_loop().call_soon(self.hear, pack_piece(wanted.digest, self.avatar, wanted.at))


def _away(content: bytes, *, most_bytes: int) -> tuple[_Channels, AvatarRequests, str]:
    """A server with somebody of another one who wears an avatar, and its digest."""
    channels, store, keys = _Channels(content), AvatarStore(most_bytes=most_bytes), new_keys()
    meeting = Meeting(most_people=8, process="here")
    seat = meeting.settle(None, 7, "a" * 16)
    seat.home, seat.own = "there", digest_of(content)
    avatars = RoomAvatars("lab", meeting, store, AvatarTransfer(channels, store))
    room = SimpleNamespace(name="lab", avatars=avatars)
    return channels, AvatarRequests(keys, store, lambda _: room, frozenset()), seat.own


def test_of_an_avatar_of_another_server_that_does_not_fit_one_piece_comes():
    content = bytes(4 * PIECE_BYTES)

    async def run() -> None:
        channels, requests, digest = _away(content, most_bytes=len(content))
        room = requests._room_of("lab")
        assert await requests._transferred(digest, room) is None
        assert channels.sent == 1
        assert (
            await _away(content, most_bytes=2 * len(content))[1]._room_of("lab").avatars.transferred(digest)
        )

    asyncio.run(asyncio.wait_for(run(), 300))


def test_what_was_refused_of_another_server_does_not_come_again_soon(monkeypatch):
    async def run() -> None:
        channels, requests, digest = _away(textured(b"<svg>"), most_bytes=2**20)
        for _ in range(3):
            assert await requests._transferred(digest, requests._room_of("lab")) is None
        assert channels.sent == 1
        monkeypatch.setattr("room.server.avatar_requests.REFUSED_S", 0)
        requests._refused.clear()
        for _ in range(2):
            assert await requests._transferred(digest, requests._room_of("lab")) is None
        assert channels.sent == 3
        await requests.close()

    asyncio.run(asyncio.wait_for(run(), 300))


def test_what_is_whole_of_another_server_is_kept():
    async def run() -> None:
        _, requests, digest = _away(avatar(), most_bytes=2**20)
        for _ in range(2):
            assert await requests._transferred(digest, requests._room_of("lab")) == avatar()
        await requests.close()

    asyncio.run(asyncio.wait_for(run(), 300))
