"""Decides whether others' browsers can be asked to load somebody's file: bounded, whole, nothing in it that acts."""

from collections import Counter
from collections.abc import Iterator, Sequence
from itertools import chain
from typing import Any, TypeVar

from pydantic import ValidationError

from facegen.formats.gltf_container import BIN, parse_glb
from facegen.formats.picture_size import picture_size
from facegen.refusals import refusal
from room.avatars.document import Accessor, Document, View
from room.avatars.extensions import check_extensions
from room.errors import FormatError

MOST_AVATAR_BYTES = 32 * 1024**2
"""Of a file: avatars with textures of 2,048 pixels have 10 to 30 MB, and everybody in the room loads it."""

MOST_DOCUMENT_BYTES = 4 * 1024**2
"""Of its JSON: ours have 0.1 MB, a VRM with many springs has 1; four are parsed in a tenth of a second."""

MOST_TRIANGLES = 200_000
"""As drawn: avatars for social worlds have 10,000 to 70,000, and a room has many of them."""

MOST_DRAWN = 256
"""Primitives that are drawn one by one; ours have 10, and each costs a browser some microseconds a picture."""

MOST_NODES = 4_000
"""Bones with hair and clothes are 100 to 600; each is moved in every picture."""

MOST_NUMBERS = 60_000_000
"""In all that is drawn, zeros that cost the file nothing among them, and each time that it is drawn from: 240 MB on a
graphics card. Ours have 9,000,000, nearly all for 52 shapes; VRMs draw ten parts from the same shapes."""

MOST_PICTURES = 64
"""Textures of one avatar; VRMs have up to twenty."""

MOST_SIDE_PIXELS = 4096
"""Of a texture: what every graphics card of today takes."""

MOST_TEXTURE_PIXELS = 64 * 1024**2
"""Of all textures together, 16 of 2,048 x 2,048: 350 MB on the graphics card."""

_COMPONENT_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
_TRIANGLES, _STRIPS = 4, (5, 6)
_PICTURES = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"RIFF")
"""How PNG, JPEG and WebP begin. SVG, which can hold scripts, begins as text."""

Found = TypeVar("Found")


def check_avatar(content: bytes) -> None:
    """Refuse what is no avatar that others can load.

    Parameters
    ----------
    content
        A .glb or .vrm, whole.

    Raises
    ------
    FormatError
        With one sentence for its owner: what was found, what is allowed, what to do.
    """
    if len(content) > MOST_AVATAR_BYTES:
        raise FormatError(
            f"this avatar has {len(content):,} bytes, and at most {MOST_AVATAR_BYTES:,} are shown to others; "
            "export it with smaller textures"
        )
    document, chunks = parse_glb(content, "this avatar", most_json_bytes=MOST_DOCUMENT_BYTES)
    _check_outside(document)
    try:
        told = Document.model_validate(document)
    except ValidationError as error:
        raise FormatError(f"this avatar is damaged: {refusal(error, Document)}") from None
    check_extensions(told.extensionsUsed, told.extensionsRequired)
    binary = next((chunk for kind, chunk in chunks if kind == BIN), b"")
    _check_views(told, len(binary))
    _check_accessors(told)
    drawn = _drawn(told)
    _check_meshes(told, drawn)
    _check_pictures(told, binary)


def _check_outside(document: dict[str, Any]) -> None:
    """Refuse addresses of anything beside the file, wherever they stand: also in extensions that nobody knows."""
    waiting: list[object] = [document]
    while waiting:
        value = waiting.pop()
        if isinstance(value, dict):
            if value.get("uri") is not None:
                raise FormatError(
                    "this avatar names a file or an address beside itself (uri), which others' browsers never fetch; "
                    "export it as one .glb with everything in it"
                )
            waiting += value.values()
        elif isinstance(value, list):
            waiting += value


def _check_views(told: Document, binary_bytes: int) -> None:
    if len(told.buffers) > 1 or any(buffer.byteLength > binary_bytes for buffer in told.buffers):
        raise FormatError("this avatar is damaged: its binary part is not the one that its document tells of")
    for number, view in enumerate(told.bufferViews):
        buffer = _of(told.buffers, view.buffer, "buffer")
        if view.byteOffset + view.byteLength > buffer.byteLength:
            raise FormatError(f"this avatar is damaged: its buffer view {number} ends behind the file")


def _check_accessors(told: Document) -> None:
    for place, accessor in enumerate(told.accessors):
        size = _COMPONENT_BYTES.get(accessor.componentType)
        if size is None:
            raise FormatError(f"this avatar is damaged: its accessor {place} is of no kind that glTF has")
        components = _COMPONENTS[accessor.type]
        if accessor.bufferView is not None:
            _hold(told, place, accessor.bufferView, accessor.byteOffset, accessor.count * components * size)
        if accessor.sparse is not None:
            _check_sparse(told, place, accessor, components * size)


def _check_sparse(told: Document, place: int, accessor: Accessor, element_bytes: int) -> None:
    sparse = accessor.sparse
    assert sparse is not None
    index_bytes = _COMPONENT_BYTES.get(sparse.indices.componentType)
    if index_bytes is None or sparse.count > accessor.count:
        raise FormatError(f"this avatar is damaged: its accessor {place} has more sparse values than values")
    _hold(told, place, sparse.indices.bufferView, sparse.indices.byteOffset, sparse.count * index_bytes)
    _hold(told, place, sparse.values.bufferView, sparse.values.byteOffset, sparse.count * element_bytes)


def _hold(told: Document, place: int, view: int, offset: int, length: int) -> None:
    """Refuse an accessor that reads behind its view; strides make it longer, which the page's reader sees."""
    held: View = _of(told.bufferViews, view, "buffer view")
    if offset + length > held.byteLength:
        raise FormatError(f"this avatar is damaged: its accessor {place} reads behind its buffer view")


def _drawn(told: Document) -> Counter[int]:
    """How often each mesh is drawn.

    Raises
    ------
    FormatError
        If nodes are too many, hang on two others, or on themselves: a reader would wait for ever.
    """
    if len(told.nodes) > MOST_NODES:
        raise FormatError(f"this avatar has {len(told.nodes):,} nodes, and at most {MOST_NODES:,} are moved")
    above: set[int] = set()
    for node in told.nodes:
        for child in node.children:
            _of(told.nodes, child, "node")
            if child in above:
                raise FormatError(f"this avatar is damaged: its node {child} hangs on two others")
            above.add(child)
    reached = [number for number in range(len(told.nodes)) if number not in above]
    for number in reached:  # grows while it is gone through
        reached += told.nodes[number].children
    if len(reached) < len(told.nodes):
        raise FormatError("this avatar is damaged: some of its nodes hang on themselves")
    return Counter(node.mesh for node in told.nodes if node.mesh is not None)


def _check_meshes(told: Document, drawn: Counter[int]) -> None:
    triangles = primitives = numbers = 0
    for number, times in drawn.items():
        for primitive in _of(told.meshes, number, "mesh").primitives:
            for index in (
                *primitive.attributes.values(),
                *chain.from_iterable(target.values() for target in primitive.targets),
            ):
                accessor = _of(told.accessors, index, "accessor")
                numbers += accessor.count * _COMPONENTS[accessor.type]
            vertices = (
                primitive.attributes.get("POSITION") if primitive.indices is None else primitive.indices
            )
            count = 0 if vertices is None else _of(told.accessors, vertices, "accessor").count
            primitives += times
            triangles += times * (
                count // 3 if primitive.mode == _TRIANGLES else count * (primitive.mode in _STRIPS)
            )
    if not triangles:
        raise FormatError("this avatar holds nothing to look at: no mesh of triangles is in it")
    if numbers > MOST_NUMBERS:
        raise FormatError(
            f"this avatar's meshes and shapes have {numbers:,} numbers, and at most {MOST_NUMBERS:,} are loaded; "
            "export it with fewer vertices or shapes"
        )
    if triangles > MOST_TRIANGLES:
        raise FormatError(
            f"this avatar has {triangles:,} triangles, and at most {MOST_TRIANGLES:,} are shown to others; decimate it"
        )
    if primitives > MOST_DRAWN:
        raise FormatError(
            f"this avatar is drawn in {primitives:,} parts, and at most {MOST_DRAWN:,} are; join meshes of one material"
        )


def _check_pictures(told: Document, binary: bytes) -> None:
    if len(told.images) > MOST_PICTURES:
        raise FormatError(
            f"this avatar has {len(told.images):,} textures, and at most {MOST_PICTURES} are loaded"
        )
    pixels = 0
    for number, (width, height) in enumerate(_sizes(told, binary)):
        if max(width, height) > MOST_SIDE_PIXELS:
            raise FormatError(
                f"this avatar's texture {number} has {width} x {height} pixels, and at most {MOST_SIDE_PIXELS} a side "
                "are loaded; make it smaller"
            )
        pixels += width * height
    if pixels > MOST_TEXTURE_PIXELS:
        raise FormatError(
            f"this avatar's textures have {pixels:,} pixels, and at most {MOST_TEXTURE_PIXELS:,} together are loaded; "
            "make them smaller"
        )


def _sizes(told: Document, binary: bytes) -> Iterator[tuple[int, int]]:
    for number, image in enumerate(told.images):
        view: View = _of(told.bufferViews, image.bufferView, "buffer view")
        content = binary[view.byteOffset : view.byteOffset + view.byteLength]
        size = picture_size(content) if content.startswith(_PICTURES) else None
        if size is None:
            raise FormatError(
                f"this avatar's texture {number} is no PNG, JPEG or WebP that can be read; export it with one of these"
            )
        yield size


def _of(found: Sequence[Found], index: int, what: str) -> Found:
    if index >= len(found):
        raise FormatError(f"this avatar is damaged: it names {what} {index}, and has {len(found)}")
    return found[index]
