"""Decides whether others' browsers can be asked to load a place: bounded, whole, nothing in it that acts."""

from collections.abc import Iterator
from typing import Any

from facegen.formats.gltf_container import BIN, Chunks
from facegen.formats.picture_size import picture_size
from room.errors import FormatError

MOST_TRIANGLES = 500_000
"""As drawn: the operating room has 60,000; a telephone draws half a million at some frames a second."""

MOST_PICTURES = 64
"""Textures of one place."""

MOST_SIDE_PIXELS = 4096
"""Of a texture: what every graphics card of today takes."""

MOST_NODES = 10_000
"""Of one place; the page goes through all of them once."""

READ = frozenset(
    "KHR_materials_unlit KHR_materials_emissive_strength KHR_materials_specular KHR_materials_ior KHR_lights_punctual "
    "KHR_mesh_quantization KHR_texture_transform EXT_texture_webp".split()
)
"""What a file may require: the page's reader knows it, and it needs nothing from outside."""

ACTING = ("interactivity", "behavior", "script", "audio", "event", "link", "hubs", "gpu_instancing")
"""Words in names of extensions by which a file does something, asks for something, or multiplies what it draws."""

_TRIANGLES = 4


def check_place(document: dict[str, Any], chunks: Chunks, *, where: str) -> None:
    """Refuse what no page should load.

    Parameters
    ----------
    document
        The file's JSON, within `facegen.formats.gltf_container`'s bounds.
    chunks
        What stands behind it.
    where
        Begins the sentence of an error.

    Raises
    ------
    FormatError
        With one sentence: what was found, what is allowed, what to do.
    """
    try:
        _check_outside(document, where)
        _check_extensions(document, where)
        _check_meshes(document, where)
        binary = next((content for kind, content in chunks if kind == BIN), b"")
        _check_pictures(document, binary, where)
    except (LookupError, TypeError, AttributeError, ValueError) as error:  # by where the damage lies
        raise FormatError(f"{where} is damaged: its document is not as glTF 2.0 has it ({error!r})") from None


def _check_outside(document: dict[str, Any], where: str) -> None:
    waiting: list[object] = [document]
    while waiting:
        value = waiting.pop()
        if isinstance(value, dict):
            if value.get("uri") is not None:
                raise FormatError(
                    f"{where} names a file or an address beside itself (uri), which browsers are not sent to; "
                    "export it as one .glb with everything in it"
                )
            waiting += value.values()
        elif isinstance(value, list):
            waiting += value


def _check_extensions(document: dict[str, Any], where: str) -> None:
    required = list(document.get("extensionsRequired", []))
    for name in (*document.get("extensionsUsed", []), *required):
        if any(word in name.lower() for word in ACTING):
            raise FormatError(f"{where} has {name[:60]}, by which a file acts by itself; export it without")
    for name in required:
        if name not in READ:
            raise FormatError(
                f"{where} requires {name[:60]}, which the page does not read; export it without"
            )


def _check_meshes(document: dict[str, Any], where: str) -> None:
    nodes, meshes, accessors = (document.get(kind, []) for kind in ("nodes", "meshes", "accessors"))
    if len(nodes) > MOST_NODES:
        raise FormatError(
            f"{where} has {len(nodes):,} nodes, and at most {MOST_NODES:,} are loaded; join some"
        )
    triangles = 0
    for node in nodes:
        for primitive in meshes[node["mesh"]]["primitives"] if "mesh" in node else ():
            if primitive.get("mode", _TRIANGLES) != _TRIANGLES:
                continue
            corners = primitive["indices"] if "indices" in primitive else primitive["attributes"]["POSITION"]
            triangles += accessors[corners]["count"] // 3
    if not triangles:
        raise FormatError(f"{where} holds nothing to look at: no mesh of triangles is in it")
    if triangles > MOST_TRIANGLES:
        raise FormatError(
            f"{where} has {triangles:,} triangles, and at most {MOST_TRIANGLES:,} are loaded; decimate it"
        )


def _check_pictures(document: dict[str, Any], binary: bytes, where: str) -> None:
    images = document.get("images", [])
    if len(images) > MOST_PICTURES:
        raise FormatError(f"{where} has {len(images):,} textures, and at most {MOST_PICTURES} are loaded")
    for number, size in enumerate(_sizes(document, binary)):
        if size is None:
            raise FormatError(
                f"{where}: its texture {number} is no PNG, JPEG or WebP; export it with one of these"
            )
        if max(size) > MOST_SIDE_PIXELS:
            raise FormatError(
                f"{where}: its texture {number} has {size[0]} x {size[1]} pixels, and at most {MOST_SIDE_PIXELS} a "
                "side are loaded; make it smaller"
            )


def _sizes(document: dict[str, Any], binary: bytes) -> Iterator[tuple[int, int] | None]:
    for image in document.get("images", []):
        view = document["bufferViews"][image["bufferView"]]
        start = view.get("byteOffset", 0)
        content = binary[start : start + view["byteLength"]]
        # SVG, which can hold scripts, begins as text
        known = content.startswith((b"\x89PNG\r\n\x1a\n", b"\xff\xd8\xff", b"RIFF"))
        yield picture_size(content) if known else None
