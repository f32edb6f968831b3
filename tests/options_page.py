"""Writes docs/options.md: every command of facegen, regress, track and room with its options, as `--help` has them.

python -m tests.options_page
"""

from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from typer.main import get_command

PAGE = Path(__file__).resolve().parents[1] / "docs" / "options.md"
PROGRAMS = ("facegen", "regress", "track", "room")

HEAD = """# Commands and options

Every command of the four programs, with what `--help` says of each option. The page is written by
`python -m tests.options_page`; a test holds it to the programs. `track` alone is `track run`. `--help` of a command
has the defaults too. What a command is for stands on [the pages of tasks](README.md).
"""


def main() -> None:
    """Write the page."""
    PAGE.write_text(options_page(), encoding="utf-8")


def options_page() -> str:
    """The text of the page: a section a program, a table a command."""
    parts = [HEAD]
    for program in PROGRAMS:
        parts.append(f"\n## {program}\n")
        for words, command in _commands(get_command(import_module(f"{program}.cli").app), (program,)):
            parts.append(_section(words, command))
    return "".join(parts)


def _commands(command: Any, words: tuple[str, ...]) -> Iterator[tuple[tuple[str, ...], Any]]:
    inner = getattr(command, "commands", {})
    if not inner:
        yield words, command
    for name, each in inner.items():
        yield from _commands(each, (*words, name))


def _section(words: tuple[str, ...], command: Any) -> str:
    what = " ".join((command.help or "").split("\n\n")[0].split())
    rows = [row for parameter in command.params for row in _row(parameter)]
    table = "".join(f"| {name} | {text} |\n" for name, text in rows)
    return f"\n**`{' '.join(words)}`** {_plain(what)}\n\n" + (f"| | |\n|---|---|\n{table}" if rows else "")


def _row(parameter: Any) -> Iterator[tuple[str, str]]:
    text = _plain(getattr(parameter, "help", None) or "")
    if parameter.param_type_name == "argument":
        yield f"*{parameter.name.replace('_', ' ')}*", text
    elif "--help" not in parameter.opts and not getattr(parameter, "hidden", False):
        yield ", ".join(f"`{name}`" for name in (*parameter.opts, *parameter.secondary_opts)), text


def _plain(text: str) -> str:
    """One cell's text: no line break, no bar, no mark of the terminal's."""
    return " ".join(text.replace("|", "\\|").replace("\\[", "[").split())


if __name__ == "__main__":
    main()
