"""Damages bytes, whatever they mean: flipped, lost, repeated, in another encoding."""

from random import Random

SOME = (1, 2, 4, 16, 64)


def flip(data: bytes, random: Random) -> bytes:
    """Other bits in one to sixteen places."""
    damaged = bytearray(data or b"\0")
    for _ in range(random.choice((1, 1, 2, 16))):
        damaged[random.randrange(len(damaged))] ^= 1 << random.randrange(8)
    return bytes(damaged)


def overwrite(data: bytes, random: Random) -> bytes:
    """Extreme bytes over others, as a size field may be hit."""
    damaged = bytearray(data or b"\0")
    place, length = random.randrange(len(damaged)), random.choice((1, 2, 4, 8))
    damaged[place : place + length] = bytes([random.choice((0, 0x7F, 0x80, 0xFF))]) * length
    return bytes(damaged)


def cut(data: bytes, random: Random) -> bytes:
    """Only a beginning, as of a copy that was stopped."""
    return data[: random.choice((0, 1, random.randrange(len(data) + 1), max(len(data) - 1, 0)))]


def delete(data: bytes, random: Random) -> bytes:
    """A hole."""
    place = random.randrange(len(data) + 1)
    return data[:place] + data[place + random.choice(SOME) :]


def insert(data: bytes, random: Random) -> bytes:
    """Foreign bytes in between."""
    place = random.randrange(len(data) + 1)
    return data[:place] + random.randbytes(random.choice(SOME)) + data[place:]


def double(data: bytes, random: Random) -> bytes:
    """A piece twice, or the whole."""
    if random.random() < 0.3:
        return data + data
    start = random.randrange(len(data) + 1)
    stop = min(len(data), start + random.choice((1, 16, 256, 4096)))
    return data[:stop] + data[start:stop] + data[stop:]


OCTETS = {
    "flip": flip,
    "overwrite": overwrite,
    "cut": cut,
    "delete": delete,
    "insert": insert,
    "double": double,
}


def encoding(data: bytes, random: Random) -> bytes:
    """Text in another encoding, or with what no text should hold."""
    text = data.decode("utf-8", "replace")
    place = random.randrange(len(text) + 1)
    odd = random.choice(
        ("\0", "\ufeff", "\u2028", "\x1b[31m", "\x85", "\u202e", "²", "٣", "\U0001f600", "\r", "ÿ")
    )
    return random.choice(
        (
            text.encode("utf-16"),
            text.encode("utf-16-be"),
            text.encode("utf-32"),
            b"\xef\xbb\xbf" + data,
            (text[:place] + "é" + text[place:]).encode("latin-1", "replace"),
            data[:place] + b"\xed\xa0\x80" + data[place:],  # half of a surrogate pair
            (text[:place] + odd + text[place:]).encode(),
            (text[:place] + odd * 50_000 + text[place:]).encode(),
            text.replace("\n", "\r").encode(),
            text.replace("\n", "\r\n").encode(),
        )
    )


def blanks(data: bytes, random: Random) -> bytes:
    """Many blanks, tabs, line breaks or other signs in one place: what backtracks takes hours over them."""
    sign = random.choice((b" ", b"\t", b"\n", b"\r\n", b"{", b"[", b"<a>", b".", b",", b"-", b'"', b"9"))
    place = random.choice((0, len(data), data.find(b"\n") + 1, random.randrange(len(data) + 1)))
    # an empty line is a frame of 0.1 ms on standard input, which is honest work
    share = 10 if b"\n" in sign else 1
    return data[:place] + sign * (random.choice((1_000, 100_000, 300_000)) // share) + data[place:]


TEXT = {"encoding": encoding, "blanks": blanks}
