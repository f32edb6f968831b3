"""All sub-commands of a program, and how to call each."""

from collections.abc import Iterator
from pathlib import Path

from typer import Typer
from typer.main import get_command

ROOT = Path(__file__).resolve().parents[3]


def sub_commands(app: Typer) -> list[tuple[str, ...]]:
    """Words of every command and group of commands, ``("farm", "submit")``; the first is the program itself."""
    return [words for words, _ in _walk(get_command(app))]


def calls(app: Typer, folder: Path) -> dict[tuple[str, ...], list[str]]:
    """Arguments for every sub-command: all that it requires, with `folder` for what should be a dataset."""
    return {
        words: [
            text
            for parameter in command.params
            if parameter.required or (words, parameter.name) == (("preview",), "dataset")
            for text in _argument(parameter, folder)
        ]
        for words, command in _walk(get_command(app))
        if not hasattr(command, "commands")
    }


def _walk(command: object, words: tuple[str, ...] = ()) -> Iterator[tuple[tuple[str, ...], object]]:
    yield words, command
    for name, inner in getattr(command, "commands", {}).items():
        yield from _walk(inner, (*words, name))


def _argument(parameter: object, folder: Path) -> list[str]:
    values = {"spec": str(ROOT / "datasets" / "tiny.toml"), "name": "tracking3", "sample": "0"}
    value = values.get(parameter.name, str(folder))
    return [parameter.opts[0], value] if parameter.opts[0].startswith("-") else [value]
