"""Prints what a command did: a line for each key, or JSON for programs."""

import json


def print_table(table: dict[str, object], *, as_json: bool) -> None:
    """Print a table to standard output; lists and tables in it take one line each, and what is empty is ``none``."""
    if as_json:
        print(json.dumps(table))
        return
    for key, value in table.items():
        print(f"{key.replace('_', ' ')}: {_line(value) or 'none'}")


def _line(value: object) -> str:
    if isinstance(value, dict):
        return ", ".join(f"{name} {number}" for name, number in value.items())
    if isinstance(value, list | tuple):
        return ", ".join(map(str, value))
    return "" if value is None else str(value)
