"""Damages NumPy files: other shapes, types and values, headers that lie, objects that would be unpickled."""

import io
import re
import struct
import zipfile
from random import Random

import numpy as np

_SHAPE = re.compile(rb"'shape': \([^)]*\)")
_TYPE = re.compile(rb"'descr': '[^']*'")

SHAPES = (
    *(
        b"()",
        b"(0,)",
        b"(1,)",
        b"(1000000000,)",
        b"(1000000000, 68, 2)",
        b"(-1,)",
        b"(1, 68, 2)",
        b"(3.5,)",
        b"'x'",
    ),
    *(
        b"(9223372036854775807,)",
        b"(4294967296, 4294967296)",
        b"(" + b"1," * 70 + b")",
        b"(True,)",
        b"(0, 68, 2)",
    ),
)
TYPES = (
    b"|O",
    b"<f2",
    b"<f8",
    b"<f4",
    b"<i8",
    b"|b1",
    b"<U9",
    b"|S9",
    b"<c16",
    b"<M8[s]",
    b"|V8",
    b"x",
    b"<f16",
    b">f8",
)


def header(data: bytes, random: Random) -> bytes:
    """A header that claims another shape or type, or is no header."""
    length = struct.unpack("<H", data[8:10])[0]
    old, body = data[10 : 10 + length], data[10 + length :]
    kind = random.random()
    if kind < 0.5:
        new = _SHAPE.sub(lambda _: b"'shape': " + random.choice(SHAPES), old)
    elif kind < 0.8:
        new = _TYPE.sub(lambda _: b"'descr': '" + random.choice(TYPES) + b"'", old)
    else:
        new = random.choice(
            (
                b"(" * 5_000 + b")" * 5_000,
                b"9" * 6_000,
                b"{}",
                b"__import__('os').getpid()",
                b"{'descr': [('a', '<f8')], 'fortran_order': False, 'shape': (3,)}",
                old.replace(b"False", b"True"),
                old.replace(b"'shape'", b"'shapes'"),
            )
        )
    version = random.choice((b"\1\0", b"\1\0", b"\1\0", b"\2\0", b"\3\0", b"\7\0"))
    size = struct.pack("<H", len(new)) if version in (b"\1\0", b"\7\0") else struct.pack("<I", len(new))
    return data[:6] + version + size + new + body


def _npy(array: np.ndarray) -> bytes:
    stream = io.BytesIO()
    np.lib.format.write_array(stream, array, allow_pickle=True)
    return stream.getvalue()


def changed(array: np.ndarray, random: Random) -> np.ndarray:
    """An array of another shape, type or content."""
    flat = array.reshape(-1)
    some = np.array(array, copy=True)
    if some.size and some.dtype.kind in "fiu":
        extremes = (
            (np.nan, np.inf, -np.inf, 1e300, -1e300) if some.dtype.kind == "f" else (-1, 99, 2**31 - 1, 0)
        )
        place = random.randrange(some.size)
        with np.errstate(all="ignore"):
            some.reshape(-1)[place : place + random.choice((1, 1, some.size))] = np.array(
                random.choice(extremes)
            ).astype(some.dtype)
    with np.errstate(all="ignore"):
        return random.choice(
            (
                lambda: some,
                lambda: some,
                lambda: array[:0],
                lambda: array[:-1] if array.ndim else array,
                lambda: array[..., :1] if array.ndim else array[None],
                lambda: array[None],
                lambda: flat,
                lambda: array.T,
                lambda: np.zeros(()),
                lambda: array.astype(np.complex128) if array.dtype.kind in "fiu" else array,
                lambda: array.astype(str) if array.size < 5_000 else flat[:10].astype(str),
                lambda: array.astype(bool),
                lambda: array.astype(np.float16),
                lambda: np.array([None, {}], dtype=object),
                lambda: np.concatenate([array, array]) if array.ndim else array,
                lambda: np.asfortranarray(array),
                lambda: array.astype(array.dtype.newbyteorder(">")),
                lambda: np.full_like(array, 0),
                lambda: np.zeros((10_000_000,), np.uint8),
            )
        )()


def content(data: bytes, random: Random) -> bytes:
    """A sound file of something else."""
    return _npy(changed(np.load(io.BytesIO(data), allow_pickle=False), random))


NPY = {"header": header, "content": content}


def _entries(data: bytes) -> dict[str, bytes]:
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def _zip(entries: list[tuple[str, bytes]], *, compressed: bool = False) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED if compressed else zipfile.ZIP_STORED) as archive:
        for name, content in entries:
            archive.writestr(zipfile.ZipInfo(name), content, compress_type=archive.compression)
    return stream.getvalue()


def entry(data: bytes, random: Random) -> bytes:
    """One array of another shape, type or content, or its header damaged."""
    entries = _entries(data)
    name = random.choice(sorted(entries))
    entries[name] = random.choice((content, content, header))(entries[name], random)
    return _zip(list(entries.items()))


def names(data: bytes, random: Random) -> bytes:
    """An array gone, twice, renamed, exchanged with another, or one too many."""
    entries = list(_entries(data).items())
    at, other = random.randrange(len(entries)), random.randrange(len(entries))
    (name, body), kind = entries[at], random.choice(("gone", "twice", "renamed", "exchanged", "more", "odd"))
    if kind == "gone":
        entries.pop(at)
    elif kind == "twice":
        return _zip_twice(entries, at)
    elif kind == "renamed":
        entries[at] = random.choice(("x.npy", "../x.npy", "x" * 60_000 + ".npy", name.upper(), "é.npy")), body
    elif kind == "exchanged":
        entries[at], entries[other] = (name, entries[other][1]), (entries[other][0], body)
    elif kind == "more":
        entries += [(f"more{number}.npy", body) for number in range(20)]
    else:
        entries[at] = (name.removesuffix(".npy"), random.choice((b"", b"text", body)))
    return _zip(entries)


def _zip_twice(entries: list[tuple[str, bytes]], at: int) -> bytes:
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, body in entries:
            archive.writestr(zipfile.ZipInfo(name), body)
        name, body = entries[at]
        copy = zipfile.ZipInfo("\x00" + name[1:])
        copy.filename = name[:-1] + "Z"
        archive.writestr(copy, body)
    return stream.getvalue().replace(name[:-1].encode() + b"Z", name.encode())


def bomb(data: bytes, random: Random) -> bytes:
    """Few bytes that expand to gigabytes, or a directory that lies of sizes."""
    entries = _entries(data)
    name = random.choice(sorted(entries))
    if random.random() < 0.5:
        stream = io.BytesIO()
        with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as archive:
            for other, body in entries.items():
                if other != name:
                    archive.writestr(zipfile.ZipInfo(other), body)
            with archive.open(zipfile.ZipInfo(name), "w") as sink:
                shape = random.choice(("(40000000,)", "(40000000, 1)"))
                text = f"{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}".ljust(117) + "\n"
                sink.write(b"\x93NUMPY\1\0" + struct.pack("<H", len(text)) + text.encode())
                for _ in range(40):
                    sink.write(bytes(8_000_000))
        return stream.getvalue()
    damaged = bytearray(_zip(list(entries.items())))
    central = damaged.find(b"PK\1\2")
    struct.pack_into(
        "<II", damaged, central + 20, *random.choice(((2**32 - 1, 2**32 - 1), (0, 0), (7, 2**31)))
    )
    return bytes(damaged)


def packed(data: bytes, random: Random) -> bytes:
    """The same arrays, deflated: no fault."""
    return _zip(list(_entries(data).items()), compressed=True)


NPZ = {"entry": entry, "names": names, "bomb": bomb, "packed": packed}
