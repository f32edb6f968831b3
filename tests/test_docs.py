"""What README and docs say is there: files and headings that links name, commands and options that lines call."""

import re
import shlex
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path

import pytest
from PIL import Image
from typer.main import get_command

from tests.options_page import PAGE as OPTIONS
from tests.options_page import options_page

ROOT = Path(__file__).parents[1]
PAGES = [
    ROOT / "README.md",
    ROOT / "CHANGELOG.md",
    ROOT / "CONTRIBUTING.md",
    ROOT / "SECURITY.md",
    *sorted((ROOT / "docs").glob("**/*.md")),
]
NAMES = [page.relative_to(ROOT).as_posix() for page in PAGES]
PROGRAMS = ("facegen", "regress", "track", "room")

LINK = re.compile(r"\[[^\]]*\]\(([^)\s]+)\)")
NAMED = re.compile(
    r"`((?:tests|benchmarks|docs|datasets|facegen|regress|track|room)/[\w./-]+\.(?:py|toml|md))`"
)
"""Files of the clone that a page names between quotes of code."""
FENCE = re.compile(r"^```.*?^```", re.M | re.S)


def _text(page: Path) -> str:
    return page.read_text(encoding="utf-8")


MOST_BYTES = {"still": 400_000, "moving": 500_000}
"""Of a picture: a page of four opens in a second by a slow line."""


def test_pictures_are_small_and_shown():
    shown = {
        (page.parent / link.partition("#")[0]).resolve()
        for page in PAGES
        for link in LINK.findall(_text(page))
    }
    pictures = [path for path in (ROOT / "docs" / "pictures").iterdir() if path.suffix != ".txt"]
    assert len(pictures) > 30
    for path in pictures:
        with Image.open(path) as picture:
            kind = "moving" if getattr(picture, "n_frames", 1) > 1 else "still"
        assert path.stat().st_size <= MOST_BYTES[kind], f"{path.name} is larger than {MOST_BYTES[kind]} bytes"
        assert path in shown, f"no page shows {path.name}"


MOST_WORDS = 1500
"""Of a page that is read from its start to its end; reference and measurements are looked into."""


def test_each_page_stands_once_in_the_table_of_all_and_is_short_where_it_is_read_through():
    listed: dict[str, str] = {}
    head, _, *rows = re.findall(r"^\|(.*)\|$", _text(ROOT / "docs" / "README.md"), re.M)
    kinds = [cell.strip() for cell in head.split("|")]
    assert kinds[1:] == ["tutorial", "how-to", "reference", "measurements"]
    for row in rows:
        for kind, cell in zip(kinds, row.split("|"), strict=True):
            for page in LINK.findall(cell):
                assert page not in listed, f"docs/README.md has {page} twice"
                listed[page] = kind
    pages = {path.relative_to(ROOT / "docs").as_posix() for path in (ROOT / "docs").glob("**/*.md")}
    assert set(listed) == pages - {"README.md", "samples/README.md"}
    for page, kind in listed.items():
        words = len(_text(ROOT / "docs" / page).split())
        assert kind in ("reference", "measurements") or words <= MOST_WORDS, (
            f"docs/{page} has {words:,} words"
        )
    assert len(_text(ROOT / "README.md").split()) <= 900


@cache
def _anchors(page: Path) -> set[str]:
    """Names that GitHub gives a page's headings."""
    headings = re.findall(r"^#+ (.*)$", FENCE.sub("", _text(page)), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


@pytest.mark.parametrize("page", PAGES, ids=NAMES)
def test_links_lead_somewhere(page: Path):
    for link in LINK.findall(FENCE.sub("", _text(page))):
        if "://" in link or link.startswith("mailto:"):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        assert target.exists(), f"{page.name} links to {link}, which is not there"
        if anchor and target.suffix == ".md":
            assert anchor in _anchors(target), f"{page.name} links to {link}; there is no such heading"


def _lines(page: Path) -> Iterator[str]:
    """Lines of code blocks, those that go on put together, without comments."""
    blocks = [
        block.split("\n", 1)[1][:-3] for block in FENCE.findall(_text(page)) if "python" not in block[:12]
    ]
    blocks.append("\n".join(line[4:] for line in _text(page).splitlines() if line.startswith("    ")))
    blocks += re.findall(r"`([^`\n]+)`", FENCE.sub("", _text(page)))
    for block in blocks:
        for line in block.replace("\\\n", " ").splitlines():
            yield re.split(r"\s#\s|\s\|\s|&&|;|>", line.strip())[0].strip()
            yield from (part.strip() for part in re.split(r"&&|;|\s\|\s", line)[1:])


def _calls(page: Path) -> Iterator[list[str]]:
    """Calls of the programs, in words."""
    for line in _lines(page):
        words = re.sub(r"^\S*bin/", "", re.sub(r"^(\$ |srun |sudo )", "", line)).split(" ", 1)
        if words[0] in PROGRAMS and len(words) == 2 and ":" not in words[1][:1]:
            try:
                yield shlex.split(f"{words[0]} {words[1]}", comments=True)
            except ValueError:  # half of a quotation that goes on
                continue


def _refused(call: list[str]) -> str | None:
    """What a program does not know of a call: its command, or an option."""
    program, *words = call
    command = get_command(import_module(f"{program}.cli").app)
    while words and hasattr(command, "commands") and not words[0].startswith("-"):
        name = words.pop(0)
        if name not in command.commands:
            return None if program == "track" and name == "run" else f"there is no command {name!r}"
        command = command.commands[name]
    if program == "track" and hasattr(command, "commands") and "run" in command.commands:
        command = command.commands["run"]  # the default
    known = {
        option for parameter in command.params for option in (*parameter.opts, *parameter.secondary_opts)
    }
    known |= {"--help", "-h", "--version"}
    unknown = [word.partition("=")[0] for word in words if re.match(r"--?[a-z]", word)]
    unknown = [word for word in unknown if word not in known]
    return f"there is no option {unknown[0]!r}" if unknown else None


@pytest.mark.parametrize("page", [*PAGES[:1], *PAGES[2:]], ids=[*NAMES[:1], *NAMES[2:]])
def test_commands_and_options_are_there(page: Path):
    refused = {" ".join(call): _refused(call) for call in _calls(page)}
    assert {call: why for call, why in refused.items() if why} == {}


def test_the_page_of_options_is_what_the_programs_say():
    assert _text(OPTIONS) == options_page(), "run: python -m tests.options_page"


@pytest.mark.parametrize("page", [*PAGES[:1], *PAGES[2:]], ids=[*NAMES[:1], *NAMES[2:]])
def test_files_that_words_name_are_there(page: Path):
    for path in NAMED.findall(_text(page)):
        assert "NAME" in path or (ROOT / path).is_file(), f"{page.name} names {path}, which is not there"


def test_calls_are_found_and_wrong_ones_are_refused():
    calls = [call for page in PAGES for call in _calls(page)]
    assert len(calls) > 150
    assert {call[0] for call in calls} >= {"facegen", "regress"}
    assert _refused(["facegen", "generat", "x"]) == "there is no command 'generat'"
    assert _refused(["facegen", "generate", "x", "--ouT", "y"]) == "there is no option '--ouT'"
    assert _refused(["facegen", "farm", "submit", "x", "--engine=slurm"]) is None


def test_what_contributing_names_is_there():
    rows = [line for line in _text(ROOT / "CONTRIBUTING.md").splitlines() if line.startswith("| a")]
    assert len(rows) > 8
    for row in rows:
        for table, path in re.findall(r"`([A-Z_]+)` in `([^`]+)`", row):
            assert re.search(rf"^{table}\b", _text(ROOT / path), re.M), f"{path} has no {table}"


OWN_PATH = re.compile(
    r"`((?:facegen|regress|track|room|tests|blender_assets|benchmarks|web|containers|docs)/[^`\s]+)`"
)


@pytest.mark.parametrize("page", [*PAGES[:1], *PAGES[2:]], ids=[*NAMES[:1], *NAMES[2:]])
def test_files_that_pages_name_are_there(page: Path):
    """But in the changelog, which tells of files that are no more."""
    paths = OWN_PATH.findall(FENCE.sub("", _text(page)))
    there = {path: next(ROOT.glob(path.rstrip("/")), None) for path in paths if "NAME" not in path}
    assert [path for path, found in there.items() if found is None] == []
    for path in paths:
        # where the reader's own name stands in its place, its folder is there, and its kind of file is
        assert "NAME" not in path or next(ROOT.glob(path.replace("NAME", "*")), None), path


def test_pages_name_files():
    """The pattern that finds them finds some."""
    assert len({path for page in PAGES for path in OWN_PATH.findall(_text(page))}) > 100
