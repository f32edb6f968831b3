"""Damages documents of keys and values, JSON and TOML: types, sizes, numbers, keys and nesting."""

import json
import tomllib
from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import tomli_w

_RAW = "@raw{}@"
"""Stands in a tree for text that no value gives, until it is written."""

DEEP = 100_000
LONG_NUMBER = "7" * 5_000

JSON_RAW = (
    LONG_NUMBER,
    f"-{LONG_NUMBER}.5",
    "1e400",
    "-1e400",
    "NaN",
    "Infinity",
    "[" * DEEP + "]" * DEEP,
    '{"a":' * DEEP + "1" + "}" * DEEP,
    '"\\ud800"',
    '"\\u0000"',
    "1e-400",
    "0." + LONG_NUMBER,
)
TOML_RAW = (
    LONG_NUMBER,
    "nan",
    "inf",
    "-inf",
    "1e400",
    "[" * DEEP + "]" * DEEP,
    "{a=" * 1000 + "1" + "}" * 1000,
    "1979-05-27T07:32:00Z",
    "07:32:00",
    '"\\u0000"',
    "0x" + "f" * 5_000,
)
VALUES = (
    *(None, True, False, 0, 1, -1, 5, 16, 2**31, 2**31 - 1, 2**32, 2**63, -(2**63), 10**18, 10**30),
    *(
        0.5,
        -0.0,
        1e-320,
        1e20,
        1e308,
        -1e308,
        "",
        " ",
        "x",
        "16",
        "nan",
        "../../x",
        "/",
        "\n",
        "a\nb",
        "{{x}}",
        "é",
    ),
    *("x" * 1_000, "x" * 100_000, "\x1b]0;x\x07", [], {}, [None], [[]], [1], ["x"], {"x": 1}, {"": {}}),
    *([1] * 100_000, {str(number): 1 for number in range(20_000)}, [1.5, 2.5, 3.5], "\ud800"),
)


def places(tree: Any, at: tuple = ()) -> Iterator[tuple]:
    """Paths to all values of a tree, the root first; of long lists only the ends."""
    yield at
    if isinstance(tree, dict):
        for key, value in tree.items():
            yield from places(value, (*at, key))
    elif isinstance(tree, list):
        for index in sorted({*range(min(len(tree), 4)), len(tree) - 1} - {-1}):
            yield from places(tree[index], (*at, index))


def _get(tree: Any, at: tuple) -> Any:
    for key in at:
        tree = tree[key]
    return tree


def _change(tree: Any, at: tuple, change: Callable[[Any, Any], None]) -> Any:
    """Apply ``change(container, key)`` at a path; the root is wrapped for it."""
    wrapped = [tree]
    container, keys = wrapped, [0, *at]
    for key in keys[:-1]:
        container = container[key]
    change(container, keys[-1])
    return wrapped[0] if wrapped else None


def _pick(tree: Any, random: Random) -> tuple:
    """A path: each depth as likely as the next, so that no long list hides the keys above it."""
    found = list(places(tree))
    depth = random.choice(sorted({len(at) for at in found}))
    return random.choice([at for at in found if len(at) == depth])


def replace(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """Another value in place of one, of another kind or size."""
    at = _pick(tree, random)
    value = random.choice(VALUES)
    return _change(tree, at, lambda container, key: container.__setitem__(key, value))


def extreme(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """What no writer writes: 5,000 digits, NaN, nesting 100,000 deep."""
    at = _pick(tree, random)
    raw.append(random.choice(allowed))
    return _change(tree, at, lambda container, key: container.__setitem__(key, _RAW.format(len(raw) - 1)))


def remove(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """One key or entry gone."""
    at = _pick(tree, random)
    return _change(tree, at, lambda container, key: container.__delitem__(key)) if at else {}


def rename(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """One key under another name."""
    keyed = [at for at in places(tree) if at and isinstance(at[-1], str)]
    if not keyed:
        return tree
    at = random.choice(keyed)
    name = random.choice(
        ("", "x", at[-1] + "s", at[-1].upper(), "x" * 100_000, "a.b", "__class__", "é", "a\nb")
    )

    def renamed(container: Any, key: Any) -> None:
        container[name] = container.pop(key)

    return _change(tree, at, renamed)


def exchange(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """One value in the place of another."""
    one, other = _pick(tree, random), _pick(tree, random)
    value = json.loads(json.dumps(_get(tree, other)))
    return _change(tree, one, lambda container, key: container.__setitem__(key, value))


def resize(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """A list longer, shorter, or turned round."""
    lists = [at for at in places(tree) if isinstance(_get(tree, at), list)]
    if not lists:
        return replace(tree, random, raw, allowed)
    at = random.choice(lists)
    old = _get(tree, at)
    new = random.choice(
        (old[:-1], old[1:], old[:1], old + old, old[::-1], old + old[:1], old * 50, [old], old[:2])
    )
    return _change(tree, at, lambda container, key: container.__setitem__(key, new))


def number(tree: Any, random: Random, raw: list[str], allowed: tuple[str, ...]) -> Any:
    """Another number in place of one: negative, huge, halved, as text."""
    numbers = [
        at
        for at in places(tree)
        if isinstance(_get(tree, at), int | float) and not isinstance(_get(tree, at), bool)
    ]
    if not numbers:
        return replace(tree, random, raw, allowed)
    at = random.choice(numbers)
    old = _get(tree, at)
    new = random.choice(
        (
            -old,
            old + 1,
            old - 1,
            old * 2,
            old * 1000,
            old + 0.5,
            0,
            -1,
            99,
            65_536,
            10**6,
            10**9,
            10**12,
            2**63,
            1e300,
        )
    )
    return _change(tree, at, lambda container, key: container.__setitem__(key, new))


TREES = {
    "replace": replace,
    "extreme": extreme,
    "remove": remove,
    "rename": rename,
    "exchange": exchange,
    "resize": resize,
    "number": number,
}


def json_of(change: Callable) -> Callable[[bytes, Random], bytes]:
    """A change of a tree as one of JSON's bytes."""

    def damage(data: bytes, random: Random) -> bytes:
        raw: list[str] = []
        text = json.dumps(change(json.loads(data), random, raw, JSON_RAW))
        for index, token in enumerate(raw):
            text = text.replace(json.dumps(_RAW.format(index)), token)
        return text.encode("utf-8", "surrogatepass")

    return damage


def repeat_key(data: bytes, random: Random) -> bytes:
    """The same key twice."""
    text = data.decode()
    starts = [place for place, sign in enumerate(text) if sign == "{"]
    if not starts:
        return data
    place = random.choice(starts) + 1
    key = text[place:].split(":", 1)[0].strip() or '"a"'
    return f"{text[:place]}{key}: {random.choice(('1', 'null', '[]'))}, {text[place:]}".encode()


JSON = {name: json_of(change) for name, change in TREES.items()} | {"repeat_key": repeat_key}


def toml_of(change: Callable) -> Callable[[bytes, Random], bytes]:
    """A change of a tree as one of TOML's bytes."""

    def damage(data: bytes, random: Random) -> bytes:
        raw: list[str] = []
        tree = change(tomllib.loads(data.decode()), random, raw, TOML_RAW)
        text = tomli_w.dumps(_writable(tree if isinstance(tree, dict) else {"x": tree}))
        for index, token in enumerate(raw):
            text = text.replace(json.dumps(_RAW.format(index)), token)
        return text.encode("utf-8", "surrogatepass")

    return damage


def _writable(tree: Any) -> Any:
    if isinstance(tree, dict):
        return {key: _writable(value) for key, value in tree.items()}
    if isinstance(tree, list):
        return [_writable(value) for value in tree]
    return "null" if tree is None else tree


def dots(data: bytes, random: Random) -> bytes:
    """A key of 100,000 parts."""
    line = ".".join(["a"] * random.choice((1_000, 100_000)))
    return random.choice((f"{line} = 1\n", f"[{line}]\n", f"[[{line}]]\n")).encode() + data


def repeat_line(data: bytes, random: Random) -> bytes:
    """A line twice: a key or a table that is there already."""
    lines = data.splitlines(keepends=True)
    line = random.choice(lines)
    lines.insert(random.randrange(len(lines) + 1), line)
    return b"".join(lines)


TOML = {name: toml_of(change) for name, change in TREES.items()} | {"dots": dots, "repeat_line": repeat_line}
