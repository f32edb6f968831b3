"""Places as data: the server's own two are whole, others are checked, and the right room gets the right one."""

import asyncio
import json
from pathlib import Path

import pytest

from facegen.formats.gltf_container import BIN, glb_bytes, open_glb
from room.cli.places import read_places
from room.errors import FormatError, InputError
from room.gltf.check import MOST_PICTURES, MOST_SIDE_PIXELS
from room.places import BUILT_IN, read_place
from room.places.check import MOST_DRAWN, MOST_NODES, MOST_TRIANGLES
from room.places.names import named
from room.places.place import FOLDER, MOST_PLACE_BYTES
from tests.facegen.avatars.validator import complaints
from tests.room.guests import open_room

MOST_OWN_BYTES = 5_000_000
"""Of a place of ours: what somebody waits for who comes in."""

FOUND = {"meeting": {"place": 16, "seat": 6, "screen": 1}, "operating": {"place": 16, "seat": 3, "screen": 1}}


@pytest.mark.parametrize("name", BUILT_IN)
def test_a_place_of_the_server_is_whole_small_free_and_has_its_names(name):
    path = FOLDER / f"{name}.glb"
    assert read_place(name).word == "", "nothing is missing"
    assert path.stat().st_size < MOST_OWN_BYTES
    document, _ = open_glb(path)
    assert {word: len(named(document, word)) for word in FOUND[name]} == FOUND[name]
    assert "CC0" in document["asset"]["copyright"]
    assert document["asset"]["extras"]["license"] == "CC0-1.0"


@pytest.mark.parametrize("name", BUILT_IN)
def test_khronos_validator_finds_no_fault(name):
    found = complaints(FOLDER / f"{name}.glb")
    assert [each for each in found if each["severity"] == 0] == []


def _write(path: Path, **change: object) -> Path:
    """A place of one triangle, changed."""
    document = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0}, {"name": "place.1"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
    }
    path.write_bytes(glb_bytes(document | change, [(BIN, bytes(36))], path))
    return path


def _drawn(count: int) -> dict[str, object]:
    """So many triangles of zeros, which cost the file nothing."""
    return {"accessors": [{"componentType": 5126, "count": 3 * count, "type": "VEC3"}]}


JPEG = b"\xff\xd8\xff\xc0\x00\x11\x08\x20\x00\x20\x00\x03\x01\x22\x00\x02\x11\x01\x03\x11\x01\xff\xd9"
"""As much of a picture of 8,192 x 8,192 as its size needs."""

REFUSED = {
    "an address in a buffer": (
        {"buffers": [{"byteLength": 36, "uri": "https://a.example/x.bin"}]},
        "beside itself",
    ),
    "an address that nobody knows": ({"extensions": {"ANY_thing": {"a": [{"uri": "x"}]}}}, "beside itself"),
    "a script": ({"extensionsUsed": ["KHR_interactivity"]}, "acts by itself"),
    "what multiplies": ({"extensionsUsed": ["EXT_mesh_gpu_instancing"]}, "acts by itself"),
    "what multiplies, and is not declared": (
        {"nodes": [{"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {}}}, {"name": "place.1"}]},
        "acts by itself",
    ),
    "what is not read": ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "does not read"),
    "too many triangles": (_drawn(MOST_TRIANGLES + 1), "decimate it"),
    "nothing to look at": ({"nodes": [{"name": "place.1"}]}, "nothing to look at"),
    "too many nodes": ({"nodes": [{"mesh": 0}] + [{}] * MOST_NODES}, "nodes"),
    "too many parts": ({"nodes": [{"mesh": 0}] * (MOST_DRAWN + 1)}, "parts"),
    "a node below itself": ({"nodes": [{"mesh": 0}, {"children": [1]}]}, "hang on themselves"),
    "a view behind the file": ({"bufferViews": [{"buffer": 0, "byteLength": 37}]}, "ends behind"),
    "an accessor behind its view": (
        {"accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"}]},
        "reads behind",
    ),
    "a mesh that is not there": ({"nodes": [{"mesh": 7}]}, "damaged"),
    "nodes that are none": ({"nodes": [3]}, "damaged"),
    "extensions that are none": ({"extensionsUsed": [3]}, "damaged"),
    "too many pictures": ({"images": [{"bufferView": 0}] * (MOST_PICTURES + 1)}, "textures"),
    "a picture that is none": ({"images": [{"bufferView": 0}]}, "no PNG"),
    "a picture that is not there": ({"images": [{"bufferView": 4}]}, "damaged"),
}


@pytest.mark.parametrize(("change", "word"), REFUSED.values(), ids=REFUSED.keys())
def test_what_a_page_should_not_load_is_refused_in_a_sentence(change, word, tmp_path):
    with pytest.raises(FormatError, match=word) as caught:
        read_place(str(_write(tmp_path / "bad.glb", **change)))
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


def test_a_picture_that_is_too_large_is_refused(tmp_path):
    path = _write(tmp_path / "large.glb")
    document, _ = open_glb(path)
    document |= {
        "images": [{"bufferView": 1, "mimeType": "image/jpeg"}],
        "bufferViews": [*document["bufferViews"], {"buffer": 0, "byteOffset": 36, "byteLength": len(JPEG)}],
        "buffers": [{"byteLength": 36 + len(JPEG)}],
    }
    path.write_bytes(glb_bytes(document, [(BIN, bytes(36) + JPEG)], path))
    with pytest.raises(FormatError, match=f"8192 x 8192 pixels, and at most {MOST_SIDE_PIXELS}"):
        read_place(str(path))


def test_what_is_no_file_of_this_kind_is_refused(tmp_path):
    (tmp_path / "text.glb").write_text("solid")
    with (tmp_path / "huge.glb").open("wb") as huge:
        huge.truncate(MOST_PLACE_BYTES + 1)
    for wish, kind in (("text.glb", FormatError), ("huge.glb", InputError), ("none.glb", InputError)):
        with pytest.raises(kind):
            read_place(str(tmp_path / wish))
    with pytest.raises(InputError, match="meeting or operating"):
        read_place("theatre")


def test_its_maker_is_told_what_people_will_miss(tmp_path):
    assert "no walk" in read_place(str(_write(tmp_path / "a.glb"))).word
    assert "no screen" in read_place(str(_write(tmp_path / "b.glb"))).word
    every = [{"mesh": 0}, {"name": "place.1"}, {"name": "walk"}, {"name": "screen.1"}]
    assert read_place(str(_write(tmp_path / "c.glb", nodes=every))).word == ""


def test_each_room_gets_its_place(tmp_path):
    own = _write(tmp_path / "own=1.glb")
    places = read_places(["operating", f"lab={own}"])
    assert set(places) == {"", "lab"}
    with pytest.raises(InputError, match="two places"):
        read_places(["meeting", "operating"])

    async def fetched() -> dict[str, bytes]:
        answers = {}
        async with open_room(places=places) as place, open_room() as plain:
            for server, room in ((place, "lab"), (place, "other"), (plain, "other")):
                async with server.session.get(f"{server.address}/room/{room}/place.glb") as answer:
                    assert answer.content_type == "model/gltf-binary"
                    answers[f"{server is plain} {room}"] = await answer.read()
        return answers

    found = asyncio.run(fetched())
    assert found["False lab"] == own.read_bytes()
    assert found["False other"] == (FOLDER / "operating.glb").read_bytes()
    assert found["True other"] == (FOLDER / "meeting.glb").read_bytes()


def test_names_are_those_that_the_page_reads():
    source = (Path(__file__).parents[2] / "web" / "room" / "scene" / "layout.ts").read_text()
    for word in ("place", "seat", "block", "walk"):
        assert f"named({json.dumps(word)})" in source
