"""The tables of docs/track-sinks.md are what is sent, and its list of sinks is the code's."""

import re
from pathlib import Path

import pytest

from tests.track.sinks.golden import tables
from track.sinks.targets import SINKS

PAGE = Path(__file__).resolve().parents[3] / "docs" / "track-sinks.md"
_MARKED = re.compile(r"(<!-- golden -->\n).*(<!-- /golden -->)", re.DOTALL)


def test_the_page_has_what_is_sent(request: pytest.FixtureRequest):
    text = PAGE.read_text(encoding="utf-8")
    made = _MARKED.sub(lambda match: f"{match[1]}{tables()}\n{match[2]}", text)
    if request.config.getoption("--update-golden"):
        PAGE.write_text(made, encoding="utf-8")
        text = made
    assert made == text, "look at what is sent now, and write the page with --update-golden"


def test_the_page_lists_every_sink_with_its_port_and_options():
    first = PAGE.read_text(encoding="utf-8").split("## What to click")[0]
    rows = {
        row[0].strip(" `"): row[1:]
        for row in (line.split("|")[1:-1] for line in first.splitlines())
        if len(row) == 4 and row[0].strip(" `") in SINKS
    }
    assert sorted(rows) == sorted(SINKS)
    for name, (_, port, options) in rows.items():
        kind = SINKS[name]
        assert (f"UDP {kind.port}" in port) == (kind.port is not None)
        for option, values in kind.options.items():
            assert f"{option}=" in options
            assert all(value in options for value in values if not value.isdigit())
