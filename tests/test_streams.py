"""Draw and build are apart: only ``draw_*`` functions take a random stream, and no stream is made of nothing."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
PACKAGES = ("facegen", "regress", "track", "room")
NAMES = {"rng", "random", "generator", "stream"}
"""What parameters are called that are streams, where nothing says what they are: lambdas have no annotations."""
MAKERS = {"default_rng", "Generator", "PCG64", "RandomState", "SeedSequence"}

Function = ast.FunctionDef | ast.AsyncFunctionDef | ast.Lambda


def _draws(function: Function) -> bool:
    name = getattr(function, "name", "")
    return name == "draw" or name.startswith(("draw_", "_draw_"))


def _is_stream(parameter: ast.arg) -> bool:
    if parameter.annotation is None:
        return parameter.arg.strip("_") in NAMES
    return ast.unparse(parameter.annotation).strip("'\"").split(" | ")[0].endswith("random.Generator")


def _functions(node: ast.AST) -> Iterator[Function]:
    """All functions outside ``draw_*`` functions: what stands within one is a part of it."""
    for child in ast.iter_child_nodes(node):
        if isinstance(child, Function):
            if _draws(child):
                continue
            yield child
        yield from _functions(child)


def takers(source: str) -> list[str]:
    """Functions that take a stream and do not say by their names that they draw."""
    found = []
    for function in _functions(ast.parse(source)):
        taken = function.args
        parameters = [*taken.posonlyargs, *taken.args, *taken.kwonlyargs]
        if any(_is_stream(parameter) for parameter in parameters):
            found.append(f"{getattr(function, 'name', 'lambda')} (line {function.lineno})")
    return found


def keyless(source: str) -> list[int]:
    """Lines that make a stream of no key: another one in every process."""
    return [
        node.lineno
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call)
        and ast.unparse(node.func).rpartition(".")[2] in MAKERS
        and not (node.args or node.keywords)
    ]


def _over_packages(check) -> dict[str, list]:
    files = [path for package in PACKAGES for path in sorted((ROOT / package).rglob("*.py"))]
    found = {str(path.relative_to(ROOT)): check(path.read_text(encoding="utf-8")) for path in files}
    assert len(found) > 500
    return {file: faults for file, faults in found.items() if faults}


def test_only_draw_functions_take_a_stream():
    assert _over_packages(takers) == {}, "split what draws from what builds, or say draw_ in the name"


def test_every_stream_has_a_key():
    assert _over_packages(keyless) == {}


@pytest.mark.parametrize(
    ("source", "names"),
    [
        ("def hair(style, rng: np.random.Generator): ...", ["hair (line 1)"]),
        ("def hair(*, dice: numpy.random.Generator | None): ...", ["hair (line 1)"]),
        ("def hair(rng): ...", ["hair (line 1)"]),
        ("class Hair:\n    def comb(self, _rng): ...", ["comb (line 2)"]),
        ("comb = lambda random: random.normal()", ["lambda (line 1)"]),
        ("def hair(seed):\n    def lock(rng): ...", ["lock (line 2)"]),
        ("def draw_hair(rng):\n    def lock(rng): ...\n    return lambda rng: 1", []),
        ("def _draw_hair(rng): ...", []),
        ("def drawn(rng): ...", ["drawn (line 1)"]),
        ("def read(stream: BinaryIO, random: bool): ...", []),
    ],
)
def test_takers_are_found(source: str, names: list[str]):
    assert takers(source) == names


@pytest.mark.parametrize(
    ("source", "lines"),
    [
        ("np.random.default_rng()", [1]),
        ("\nnp.random.Generator(np.random.PCG64())", [2]),
        ("np.random.default_rng(0)", []),
        ("np.random.Generator(np.random.PCG64([seed, 3]))", []),
    ],
)
def test_keyless_streams_are_found(source: str, lines: list[int]):
    assert keyless(source) == lines
