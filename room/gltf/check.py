"""Decides whether browsers can be asked to load somebody's glTF file: bounded, whole, nothing in it that acts."""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from pydantic import ValidationError

from facegen.formats.gltf_container import BIN, Chunks
from facegen.formats.picture_size import picture_size
from facegen.refusals import refusal
from room.errors import FormatError
from room.gltf.document import Accessor, Document, View, named
from room.gltf.extensions import READ, check_extensions
from room.gltf.moved import check_moved
from room.gltf.numbers import COMPONENTS, check_numbers

MOST_PICTURES = 64
"""Textures of one file; VRMs have up to twenty."""

MOST_SIDE_PIXELS = 4096
"""Of a texture: what every graphics card of today takes."""

MOST_TEXTURE_PIXELS = 64 * 1024**2
"""Of all textures together, 16 of 2,048 x 2,048: 350 MB on the graphics card."""

_COMPONENT_BYTES = {5120: 1, 5121: 1, 5122: 2, 5123: 2, 5125: 4, 5126: 4}
_TRIANGLES, _STRIPS = 4, (5, 6)
_PICTURES = (b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"RIFF")
"""How PNG, JPEG and WebP begin. SVG, which can hold scripts, begins as text."""


@dataclass(frozen=True, kw_only=True)
class Bounds:
    """What a kind of file may hold at most.

    Parameters
    ----------
    triangles
        As drawn.
    parts
        Primitives that are drawn one by one.
    nodes
        Of its tree.
    extensions
        That it may require beside `room.gltf.extensions.READ`.
    """

    triangles: int
    parts: int
    nodes: int
    extensions: frozenset[str]


def check_gltf(document: dict[str, Any], chunks: Chunks, *, where: str, bounds: Bounds) -> None:
    """Refuse what no browser should be asked to load.

    Parameters
    ----------
    document
        The file's JSON, within `facegen.formats.gltf_container`'s bounds.
    chunks
        What stands behind it.
    where
        Begins the sentence of an error.
    bounds
        Of this kind of file.

    Raises
    ------
    FormatError
        With one sentence: what was found, what is allowed, what to do.
    """
    try:  # what is raised here begins behind `where`
        extended = _check_everywhere(document)
        told = _told(document)
        used = {*told.extensionsUsed, *extended}
        check_extensions(sorted(used), told.extensionsRequired, read=READ | bounds.extensions)
        binary = next((content for kind, content in chunks if kind == BIN), b"")
        _check_views(told, len(binary))
        _check_accessors(told)
        drawn = _drawn(told, bounds.nodes)
        parts = _check_meshes(told, drawn, bounds)
        check_numbers(told)
        check_moved(told, drawn, parts, most_nodes=bounds.nodes)
        _check_pictures(told, binary)
    except FormatError as error:
        raise FormatError(f"{where} {error}") from None


def _told(document: dict[str, Any]) -> Document:
    try:
        return Document.model_validate(document)
    except ValidationError as error:
        raise FormatError(f"is damaged: {refusal(error, Document)}") from None


def _check_everywhere(document: dict[str, Any]) -> set[str]:
    """Names of all extensions that something has.

    Raises
    ------
    FormatError
        If an address of anything beside the file stands anywhere, also in extensions that nobody knows.
    """
    extended: set[str] = set()
    waiting: list[object] = [document]
    while waiting:
        value = waiting.pop()
        if isinstance(value, dict):
            if value.get("uri") is not None:
                raise FormatError(
                    "names a file or an address beside itself (uri), which browsers are never sent to; "
                    "export it as one .glb with everything in it"
                )
            if isinstance(names := value.get("extensions"), dict):
                extended.update(names)
            waiting += value.values()
        elif isinstance(value, list):
            waiting += value
    return extended


def _check_views(told: Document, binary_bytes: int) -> None:
    if len(told.buffers) > 1 or any(buffer.byteLength > binary_bytes for buffer in told.buffers):
        raise FormatError("is damaged: its binary part is not the one that its document tells of")
    for number, view in enumerate(told.bufferViews):
        buffer = named(told.buffers, view.buffer, "buffer")
        if view.byteOffset + view.byteLength > buffer.byteLength:
            raise FormatError(f"is damaged: its buffer view {number} ends behind the file")


def _check_accessors(told: Document) -> None:
    for place, accessor in enumerate(told.accessors):
        size = _COMPONENT_BYTES.get(accessor.componentType)
        if size is None:
            raise FormatError(f"is damaged: its accessor {place} is of no kind that glTF has")
        components = COMPONENTS[accessor.type]
        if accessor.bufferView is not None:
            _hold(told, place, accessor.bufferView, accessor.byteOffset, accessor.count * components * size)
        if accessor.sparse is not None:
            _check_sparse(told, place, accessor, components * size)


def _check_sparse(told: Document, place: int, accessor: Accessor, element_bytes: int) -> None:
    sparse = accessor.sparse
    assert sparse is not None
    index_bytes = _COMPONENT_BYTES.get(sparse.indices.componentType)
    if index_bytes is None or sparse.count > accessor.count:
        raise FormatError(f"is damaged: its accessor {place} has more sparse values than values")
    _hold(told, place, sparse.indices.bufferView, sparse.indices.byteOffset, sparse.count * index_bytes)
    _hold(told, place, sparse.values.bufferView, sparse.values.byteOffset, sparse.count * element_bytes)


def _hold(told: Document, place: int, view: int, offset: int, length: int) -> None:
    """Refuse an accessor that reads behind its view; strides make it longer, which the page's reader sees."""
    held: View = named(told.bufferViews, view, "buffer view")
    if offset + length > held.byteLength:
        raise FormatError(f"is damaged: its accessor {place} reads behind its buffer view")


def _drawn(told: Document, most_nodes: int) -> Counter[int]:
    """How often each mesh is drawn.

    Raises
    ------
    FormatError
        If nodes are too many, hang on two others, or on themselves: a reader would wait for ever.
    """
    if len(told.nodes) > most_nodes:
        raise FormatError(f"has {len(told.nodes):,} nodes, and at most {most_nodes:,} are loaded; join some")
    above: set[int] = set()
    for node in told.nodes:
        for child in node.children:
            named(told.nodes, child, "node")
            if child in above:
                raise FormatError(f"is damaged: its node {child} hangs on two others")
            above.add(child)
    reached = [number for number in range(len(told.nodes)) if number not in above]
    for number in reached:  # grows while it is gone through
        reached += told.nodes[number].children
    if len(reached) < len(told.nodes):
        raise FormatError("is damaged: some of its nodes hang on themselves")
    return Counter(node.mesh for node in told.nodes if node.mesh is not None)


def _check_meshes(told: Document, drawn: Counter[int], bounds: Bounds) -> int:
    """How many primitives are drawn."""
    triangles = primitives = 0
    for number, times in drawn.items():
        for primitive in named(told.meshes, number, "mesh").primitives:
            vertices = (
                primitive.attributes.get("POSITION") if primitive.indices is None else primitive.indices
            )
            count = 0 if vertices is None else named(told.accessors, vertices, "accessor").count
            primitives += times
            triangles += times * (
                count // 3 if primitive.mode == _TRIANGLES else count * (primitive.mode in _STRIPS)
            )
    if not triangles:
        raise FormatError("holds nothing to look at: no mesh of triangles is in it")
    if triangles > bounds.triangles:
        raise FormatError(
            f"has {triangles:,} triangles, and at most {bounds.triangles:,} are loaded; decimate it"
        )
    if primitives > bounds.parts:
        raise FormatError(
            f"is drawn in {primitives:,} parts, and at most {bounds.parts:,} are; join meshes of one material"
        )
    return primitives


def _check_pictures(told: Document, binary: bytes) -> None:
    if len(told.images) > MOST_PICTURES:
        raise FormatError(f"has {len(told.images):,} textures, and at most {MOST_PICTURES} are loaded")
    pixels = 0
    for number, (width, height) in enumerate(_sizes(told, binary)):
        if max(width, height) > MOST_SIDE_PIXELS:
            raise FormatError(
                f"has a texture ({number}) of {width} x {height} pixels, and at most {MOST_SIDE_PIXELS} a side "
                "are loaded; make it smaller"
            )
        pixels += width * height
    if pixels > MOST_TEXTURE_PIXELS:
        raise FormatError(
            f"has textures of {pixels:,} pixels, and at most {MOST_TEXTURE_PIXELS:,} together are loaded; "
            "make them smaller"
        )


def _sizes(told: Document, binary: bytes) -> Iterator[tuple[int, int]]:
    for number, image in enumerate(told.images):
        view: View = named(told.bufferViews, image.bufferView, "buffer view")
        content = binary[view.byteOffset : view.byteOffset + view.byteLength]
        size = picture_size(content) if content.startswith(_PICTURES) else None
        if size is None:
            raise FormatError(
                f"has a texture ({number}) that is no PNG, JPEG or WebP that can be read; export it as one of these"
            )
        yield size
