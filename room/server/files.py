"""Serves the page's files from memory, packed once: those that are there at the start, and no other path."""

import asyncio
import gzip
import hashlib
import mimetypes
from dataclasses import dataclass, field
from pathlib import Path

from aiohttp import web

_TYPES = {".js": "text/javascript", ".wasm": "application/wasm", ".glb": "model/gltf-binary"}
"""What browsers insist on, and systems know differently."""

WORTH_BYTES = 1024
"""Smaller files fit into one packet as they are."""

PACKED = Path(__file__).with_name("packed")
"""What ``make room-face`` packed with Brotli, each called by the SHA-256 of its file: a sixth less than gzip."""


@dataclass
class Held:
    """A file in memory: its bytes, its kind, what tells this version from others, and the bytes as they were packed."""

    content: bytes
    kind: str
    tag: str
    brotli: bytes | None = field(default=None, repr=False)
    packed: asyncio.Future[bytes] | None = field(default=None, repr=False)


class Files:
    """The files below a folder, by the path of their address.

    Parameters
    ----------
    folder
        Read once; a file that comes later is not served, and one that changes stays as it was.
    """

    def __init__(self, folder: Path) -> None:
        self._held = {
            path.relative_to(folder).as_posix(): hold(path.read_bytes(), path.suffix)
            for path in sorted(folder.rglob("*"))
            if path.is_file() and not path.name.startswith(".")
        }

    def names(self, folder: str, suffix: str) -> list[str]:
        """Stems of the files in a folder, sorted."""
        return [
            path.removeprefix(f"{folder}/").removesuffix(suffix)
            for path in self._held
            if path.startswith(f"{folder}/") and path.endswith(suffix)
        ]

    async def answer(self, request: web.Request, path: str) -> web.Response:
        """The file, or nothing where the browser has it already.

        Raises
        ------
        aiohttp.web.HTTPNotFound
            If there is none.
        """
        held = self._held.get(path)
        if held is None:
            raise web.HTTPNotFound(text="no such file\n")
        return await answer(request, held)


async def answer(request: web.Request, held: Held) -> web.Response:
    """A file, or nothing where the browser has it already."""
    headers = {"ETag": held.tag, "Cache-Control": "no-cache", "Vary": "Accept-Encoding"}
    if request.headers.get("If-None-Match") == held.tag:
        return web.Response(status=304, headers=headers)
    body, taken = held.content, _taken(request.headers.get("Accept-Encoding", ""))
    if held.brotli is not None and "br" in taken:
        body = held.brotli
        headers["Content-Encoding"] = "br"
    elif len(body) > WORTH_BYTES and "gzip" in taken:
        if held.packed is None:  # in a thread: WebAssembly takes a second, and nobody who meets waits for it
            held.packed = asyncio.ensure_future(asyncio.to_thread(gzip.compress, body, 6))
        body = await asyncio.shield(held.packed)
        headers["Content-Encoding"] = "gzip"
    return web.Response(body=body, content_type=held.kind, headers=headers)


def _taken(header: str) -> set[str]:
    """Encodings that a browser takes: those of ``Accept-Encoding`` that it does not weigh with nothing."""
    asked = (each.replace(" ", "").lower().partition(";q=") for each in header.split(","))
    return {name for name, _, weight in asked if weight.rstrip("0.") or not weight}


def hold(content: bytes, suffix: str, packed: Path = PACKED) -> Held:
    """Keep bytes in memory, of the kind that a file's suffix says, and as they lie packed in a folder."""
    kind = _TYPES.get(suffix) or mimetypes.guess_type(f"a{suffix}")[0] or "application/octet-stream"
    digest = hashlib.sha256(content).hexdigest()
    brotli = packed / f"{digest}.br"
    return Held(
        content=content,
        kind=kind,
        tag=f'"{digest[:32]}"',
        brotli=brotli.read_bytes() if brotli.is_file() else None,
    )
