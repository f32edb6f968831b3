"""Damages tables of text, markup, and plain lines of numbers."""

import csv
import io
import re
from random import Random

CELLS = (
    *(
        "",
        " ",
        "nan",
        "inf",
        "-inf",
        "1e400",
        "-1e308",
        "x",
        "1,5",
        "٣",
        "²",
        "0x10",
        "1_000",
        "1e5000",
        "None",
    ),
    *(
        "7" * 5_000,
        "7" * 400,
        "x" * 100_000,
        '"',
        '""',
        "\n",
        "=1+1",
        "\x00",
        "-0",
        "99:99:99:99.999",
        "1e18",
    ),
)


def _rows(data: bytes) -> list[list[str]]:
    return [row for row in csv.reader(io.StringIO(data.decode())) if row]


def _bytes(rows: list[list[str]]) -> bytes:
    text = io.StringIO(newline="")
    csv.writer(text, lineterminator="\n").writerows(rows)
    return text.getvalue().encode("utf-8", "surrogatepass")


def cell(data: bytes, random: Random) -> bytes:
    """Another word in one to three cells, the header's among them."""
    rows = _rows(data)
    for _ in range(random.choice((1, 1, 3))):
        row = random.choice((rows[0], rows[-1], random.choice(rows)))
        row[random.randrange(len(row))] = random.choice(CELLS)
    return _bytes(rows)


def column(data: bytes, random: Random) -> bytes:
    """A column gone, twice, elsewhere or of another word."""
    rows = _rows(data)
    at, other, word = random.randrange(len(rows[0])), random.randrange(len(rows[0])), random.choice(CELLS)
    kind = random.choice(("gone", "twice", "moved", "word", "unnamed"))
    for number, row in enumerate(rows):
        if at >= len(row):
            continue
        if kind == "gone":
            row.pop(at)
        elif kind == "twice":
            row.append(row[at])
        elif kind == "moved":
            row.insert(other, row.pop(at))
        elif kind == "word" and number:
            row[at] = word
        elif kind == "unnamed" and not number:
            row[at] = ""
    return _bytes(rows)


def ragged(data: bytes, random: Random) -> bytes:
    """Rows that are longer, shorter, missing, twice, or a million cells long."""
    rows = _rows(data)
    at = random.randrange(len(rows))
    rows[at : at + 1] = random.choice(
        (
            [rows[at][:-1]],
            [rows[at] + ["1"]],
            [],
            [rows[at], rows[at]],
            [rows[at] * 1_000],
            [[""]],
            [rows[at][::-1]],
            [rows[at]] * 200,
        )
    )
    return _bytes(rows)


CSV = {"cell": cell, "column": column, "ragged": ragged}

_NUMBER = re.compile(rb"-?\d+(?:\.\d+)?(?:[eE][-+]?\d+)?")
_WORDS = tuple(word.encode("utf-8") for word in CELLS)


def token(data: bytes, random: Random) -> bytes:
    """Another word in place of a number."""
    found = list(_NUMBER.finditer(data))
    if not found:
        return data + random.choice(_WORDS)
    place = random.choice((found[0], found[-1], random.choice(found)))
    return data[: place.start()] + random.choice(_WORDS) + data[place.end() :]


def lines(data: bytes, random: Random) -> bytes:
    """Lines gone, twice, exchanged, joined or a thousand times."""
    found = data.splitlines(keepends=True) or [b""]
    at, other = random.randrange(len(found)), random.randrange(len(found))
    kind = random.choice(("gone", "twice", "exchanged", "joined", "many"))
    if kind == "gone":
        found.pop(at)
    elif kind == "twice":
        found.insert(at, found[at])
    elif kind == "exchanged":
        found[at], found[other] = found[other], found[at]
    elif kind == "joined":
        found[at] = found[at].rstrip(b"\r\n")
    else:
        found[at : at + 1] = [found[at]] * 1_000
    return b"".join(found)


LINES = {"token": token, "lines": lines}

_TAG = re.compile(rb"<[^<>]*>")


def tag(data: bytes, random: Random) -> bytes:
    """A tag gone, twice, renamed, or with other attributes."""
    found = list(_TAG.finditer(data))
    place = random.choice(found)
    old = place.group()
    new = random.choice(
        (
            b"",
            old * 2,
            old.replace(b"box", b"bax").replace(b"part", b"pert").replace(b"image", b"imige"),
            re.sub(rb"""=(['"])[^'"]*['"]""", b"=\\1\\1", old, count=1),
            re.sub(rb"\w+=", b"x=", old, count=1),
            re.sub(
                rb"""=(['"])[^'"]*['"]""",
                lambda found: b"=" + found[1] + random.choice(_WORDS[:20]) + found[1],
                old,
            ),
            b"<a>" * 100_000,
            b"<![CDATA[" + old,
            b"&x;",
            b"&#0;",
        )
    )
    return data[: place.start()] + new + data[place.end() :]


def prologue(data: bytes, random: Random) -> bytes:
    """Another declaration: encodings that do not exist, entities that name each other or files."""
    body = re.sub(rb"^\s*<\?xml[^>]*\?>", b"", data)
    bomb = b"".join(
        b'<!ENTITY %c "%s">' % (sign, b"&%c;" % (sign - 1) * 10 if sign > 97 else b"ha" * 10)
        for sign in range(97, 107)
    )
    return random.choice(
        (
            b"<?xml version='1.0' encoding='x-unknown'?>" + body,
            b"<?xml version='1.0' encoding='utf-7'?>" + body,
            b"<?xml version='1.0' encoding='rot13'?>" + body,
            b"<?xml version='1.0' encoding='hex'?>" + body,
            b"<?xml version='1.0' encoding='idna'?>" + body,
            b"<?xml version='1.0' encoding='UTF-16'?>" + body,
            b"<?xml version='9.9'?>" + body,
            b"<!DOCTYPE x [" + bomb + b"]>" + body.replace(b"<images>", b"<images>&j;"),
            b'<!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>'
            + body.replace(b"<images>", b"<images>&e;"),
            b"<?xml-stylesheet href='x'?>" + body,
        )
    )


XML = {"tag": tag, "prologue": prologue, "token": token}
