"""docs/operators.md says what the code does: limits, exit codes, named tests, and what no module may do."""

import ast
import importlib
import re
from pathlib import Path

import pytest

from facegen.errors import ExitCode

ROOT = Path(__file__).resolve().parents[1]
PAGE = (ROOT / "docs" / "operators.md").read_text(encoding="utf-8")
MODULES = sorted(
    path for program in ("facegen", "regress", "track", "room") for path in (ROOT / program).rglob("*.py")
)

WITHIN = {
    "facegen.refusals.MOST_ENTRIES",
    "facegen.refusals.MOST_CHARACTERS",
    "facegen.preview.statistics.MOST_ROWS",
    "facegen.rigs.anny.MOST_COMPONENTS",
    "facegen.rigs.ict.MOST_COMPONENTS",
    "facegen.console.MOST_CHARACTERS",
    "facegen.validation.agreement.MOST_DIMENSIONS",
    "facegen.avatars.glb.MOST_BONES",
}
"""Constants of this kind of name that bound no input: how much is shown, drawn or taken of what was read."""

FORBIDDEN = (
    "pickle",
    "marshal",
    "shelve",
    "ssl",
    "urllib.request",
    "http",
    "requests",
    "ftplib",
    "smtplib",
    "xmlrpc",
    "asyncio",
    "socket",
)
SPARED = {
    "facegen/machine.py": {"socket"},  # asks for this machine's own name, which opens no connection
    "room/server/": {"asyncio", "socket", "ssl"},  # listens for those who meet, by https where it is told to
    "track/comparison/phone.py": {
        "socket"
    },  # listens for a phone while `track compare` runs, and sends nothing
    "track/page/": {"asyncio"},  # listens for browsers, on this machine unless told otherwise
    "track/sinks/room.py": {"asyncio"},  # speaks to the room whose link stands behind --to
    "track/sinks/udp.py": {
        "socket"
    },  # sends to who stands behind --to, on this machine unless named otherwise
}
"""What files, or all below a folder, may import of it nevertheless, and what for."""


def _rows(heading: str) -> list[list[str]]:
    section = PAGE.split(f"## {heading}\n")[1].split("\n## ")[0]
    rows = [line.strip("| \n").split(" | ") for line in section.splitlines() if line.startswith("|")]
    return rows[2:]


def _said(name: str, value: float) -> str:
    if name.endswith("_BYTES"):
        for unit, size in (("GiB", 2**30), ("MiB", 2**20), ("KiB", 2**10)):
            if value >= size and value % size == 0:
                return f"{value // size} {unit}"
    if name.endswith("_S"):
        return f"{value / 3600:g} hours"
    return f"{value:,g}" if value >= 1e9 else f"{value:,}"


def _constants() -> dict[str, object]:
    found = {}
    for path in MODULES:
        names = re.findall(r"^(MOST_[A-Z_]+) *(?::[^=\n]*)?=", path.read_text(encoding="utf-8"), re.MULTILINE)
        module = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
        for name in names:
            found[f"{module}.{name}"] = getattr(importlib.import_module(module), name)
    return found


def test_every_limit_is_in_the_table_as_the_code_has_it():
    told = {place.strip("`"): said for _, said, place in _rows("Limits of sizes")}
    held = {place: _said(place, value) for place, value in _constants().items() if place not in WITHIN}
    assert told == held, "docs/operators.md lists every MOST_... of both programs, but those in WITHIN"


PDF_LIMITS = {
    "MOST_BYTES": ("64 * MIB", "64 MiB"),
    "MOST_PAGES": ("2000", "2,000"),
    "MOST_PIXELS": ("1920", "1,920"),
    "MOST_PICTURE_PIXELS": ("2 ** 25", f"{2**25:,}"),
    "PATIENCE_MS": ("20_000", "20 s"),
}
"""Constants of the room's page, and what its operators read."""


def test_the_limits_of_pdfs_are_in_their_table_as_the_page_has_them():
    page = (ROOT / "docs/room-operators.md").read_text(encoding="utf-8")
    code = (ROOT / "web/room/sharing/paper.ts").read_text(encoding="utf-8")
    held = dict(re.findall(r"^const ((?:MOST|PATIENCE)_\w+) = (.+);", code, re.MULTILINE))
    told = {name: said for said, name in re.findall(r"\| ([^|]+) \| `((?:MOST|PATIENCE)_\w+)` \|", page)}
    assert held == {name: value for name, (value, _) in PDF_LIMITS.items()}
    assert told == {name: said for name, (_, said) in PDF_LIMITS.items()}


def test_every_exit_code_is_in_the_table():
    assert [int(row[0]) for row in _rows("Exit codes")] == sorted(int(code) for code in ExitCode)


def test_every_test_that_is_named_is_there():
    named = re.findall(r"`(tests/[\w/.]+)`", PAGE)
    assert named
    assert [name for name in named if not (ROOT / name).exists()] == []


def _imports(tree: ast.AST) -> set[str]:
    """Modules that a file imports, with all packages that they are in."""
    names = set()
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.level == 0:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return {".".join(name.split(".")[:depth]) for name in names for depth in range(1, name.count(".") + 2)}


def _keywords(tree: ast.AST) -> dict[str, list[tuple[str, object]]]:
    calls = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.Call):
            name = node.func.attr if isinstance(node.func, ast.Attribute) else getattr(node.func, "id", "")
            words = [(word.arg, getattr(word.value, "value", None)) for word in node.keywords]
            calls.setdefault(name, []).extend(words or [("", None)])
    return calls


@pytest.mark.parametrize("path", MODULES, ids=lambda path: path.relative_to(ROOT).as_posix())
def test_nothing_is_unpickled_evaluated_given_to_a_shell_or_sent(path):
    tree = ast.parse(path.read_text(encoding="utf-8"))
    name = path.relative_to(ROOT).as_posix()
    spared = set().union(*(modules for place, modules in SPARED.items() if name.startswith(place)))
    assert not _imports(tree) & ({*FORBIDDEN} - spared)
    bare = {
        node.func.id
        for node in ast.walk(tree)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert not bare & {"eval", "exec", "compile", "__import__"}
    calls = _keywords(tree)
    assert not {"system", "popen"} & set(calls)
    words = [word for found in calls.values() for word in found]
    assert not {("shell", True), ("allow_pickle", True), ("weights_only", False)} & set(words)


def test_the_checkpoints_of_pytorch_are_read_as_numbers():
    texts = [path.read_text(encoding="utf-8") for path in MODULES]
    reads = [call for text in texts for call in re.findall(r"torch\.load\([^)]*\)", text)]
    assert reads
    assert all("weights_only=True" in call for call in reads)
