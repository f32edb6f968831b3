"""Reads the width and height that a picture's header claims: a decoder allocates that much before it looks further.

PNG, JPEG, BMP, TIFF, WebP and the PNM family (PBM, PGM, PPM), told apart by their first bytes.

References
----------
.. [1] PNG, https://www.w3.org/TR/png-3 (11.2.1). JPEG, ITU T.81 (B.2.2). BMP, BITMAPCOREHEADER and BITMAPINFOHEADER.
   TIFF 6.0, section 2, and BigTIFF. WebP, RFC 9649. https://netpbm.sourceforge.net/doc/pgm.html.
"""

import re
import struct
from collections.abc import Iterator

MOST_PIXELS = 64_000_000
"""Of a picture or of a film's frame, 8,000 x 8,000: decoding one takes up to 0.5 GB (16 bits, four channels)."""

Size = tuple[int, int]

_PNM = re.compile(rb"P[1-6]\s+(?:#[^\n\r]*\s+)*(\d{1,9})\s+(?:#[^\n\r]*\s+)*(\d{1,9})\s")
_TIFF_NUMBERS = {1: "B", 3: "H", 4: "I", 16: "Q"}
_TIFF_SIZES = {256: 0, 257: 1, 322: 0, 323: 1}
"""Width, height, and those of a tile, which is decoded whole: to which of the two a tag belongs."""


def picture_size(content: bytes) -> Size | None:
    """Width and height in pixels; None where the header is none of these formats', or is cut.

    Parameters
    ----------
    content
        The file's bytes, all of them: JPEG and TIFF have their size anywhere.
    """
    try:
        return next((size for size in (read(content) for read in _READERS) if size is not None), None)
    # the header ends before its numbers do, or points far beyond its end
    except (struct.error, OverflowError):
        return None


def _png(content: bytes) -> Size | None:
    if not content.startswith(b"\x89PNG\r\n\x1a\n"):
        return None
    return struct.unpack_from(">II", content, 16)


def _jpeg(content: bytes) -> Size | None:
    if not content.startswith(b"\xff\xd8"):
        return None
    place = 2
    while (place := content.find(b"\xff", place)) >= 0:
        while content[place : place + 1] == b"\xff":  # any number of them may stand before a marker
            place += 1
        (marker,) = struct.unpack_from("B", content, place)
        place += 1
        # start of frame; the three left out are tables
        if 0xC0 <= marker <= 0xCF and marker not in (0xC4, 0xC8, 0xCC):
            height, width = struct.unpack_from(">HH", content, place + 3)
            return width, height
        if marker not in (0x00, 0x01) and not 0xD0 <= marker <= 0xD8:  # these have no length
            place += max(struct.unpack_from(">H", content, place)[0], 2)
    return None


def _bmp(content: bytes) -> Size | None:
    if not content.startswith(b"BM"):
        return None
    (header,) = struct.unpack_from("<I", content, 14)
    width, height = struct.unpack_from("<HH" if header == 12 else "<ii", content, 18)
    return abs(width), abs(height)  # a negative height means from top to bottom


def _webp(content: bytes) -> Size | None:
    if content[:4] != b"RIFF" or content[8:12] != b"WEBP":
        return None
    kind = content[12:16]
    if kind == b"VP8 ":
        width, height = struct.unpack_from("<HH", content, 26)
        return width & 0x3FFF, height & 0x3FFF
    if kind == b"VP8L":
        (bits,) = struct.unpack_from("<I", content, 21)
        return (bits & 0x3FFF) + 1, (bits >> 14 & 0x3FFF) + 1
    if kind == b"VP8X":
        low, middle, high = struct.unpack_from("<HHH", content, 24)
        return (low | (middle & 0xFF) << 16) + 1, (middle >> 8 | high << 8) + 1
    return None


def _pnm(content: bytes) -> Size | None:
    match = _PNM.match(content)
    return None if match is None else (int(match[1]), int(match[2]))


def _tiff(content: bytes) -> Size | None:
    order = {b"II": "<", b"MM": ">"}.get(content[:2])
    if order is None:
        return None
    found = [0, 0]
    for tag, value in _tiff_numbers(content, order):
        if tag in _TIFF_SIZES:
            found[_TIFF_SIZES[tag]] = max(found[_TIFF_SIZES[tag]], value)
    return tuple(found) if all(found) else None


def _tiff_numbers(content: bytes, order: str) -> Iterator[tuple[int, int]]:
    """Tags of the first picture with their first value, as far as that stands in the tag itself."""
    (version,) = struct.unpack_from(f"{order}H", content, 2)
    if version not in (42, 43):
        return
    big = version == 43
    (start,) = struct.unpack_from(f"{order}Q" if big else f"{order}I", content, 8 if big else 4)
    (count,) = struct.unpack_from(f"{order}Q" if big else f"{order}H", content, start)
    head, step, value_at = (8, 20, 12) if big else (2, 12, 8)
    for entry in range(min(count, 65_536)):
        place = start + head + step * entry
        tag, kind = struct.unpack_from(f"{order}HH", content, place)
        if kind in _TIFF_NUMBERS and (big or kind != 16):
            yield tag, struct.unpack_from(order + _TIFF_NUMBERS[kind], content, place + value_at)[0]


_READERS = (_png, _jpeg, _bmp, _webp, _pnm, _tiff)
