"""Writes docs/spec.md, every key of a spec, from the records themselves."""

import json
from typing import Any

from facegen.spec.loading import spec_schema

_HEAD = """# Specs

Every key of a dataset's spec (TOML). The page is written by `facegen spec reference > docs/spec.md` from
[`facegen/spec/spec.py`](../facegen/spec/spec.py). `facegen spec check FILE` says what is wrong with a file,
`facegen spec show FILE` prints it with all defaults, and `facegen spec schema > spec.schema.json` writes a JSON schema:
editors that know TOML schemas use it where a spec's first line is `#:schema spec.schema.json`.

*Distributions* are a number, `{uniform = [low, high]}`, or `{normal = [mean, sd], within = [low, high]}`, a normal
distribution cut at `within` (3 standard deviations without it). Every draw must lie between the bounds that the table
allows. In sequences pupils wander by up to 9 % about the radius that was drawn, also past these bounds.
"""

_UNITS = {"px": "pixels", "widths": "face widths", "fps": "frames/s", "m": "metres", "deg": "degrees"}
"""Units by the last word of a key, where the type does not say one."""


def spec_reference() -> str:
    """The page ``docs/spec.md``: one table of keys for each table of a spec, in the records' order."""
    schema = spec_schema()
    return _HEAD + "".join(_section(schema, schema, (), (), ""))


def _section(schema: dict, record: dict, path: tuple[str, ...], default: Any, meaning: str) -> list[str]:
    """Lines of a record and of the records in it.

    ``default`` is the record's own where it is not its keys', and so is ``meaning``.
    """
    title = f"`[{'.'.join(path)}]`" if path else "Top level"
    about = f"{_flowing(meaning or record['description'])}\n\n" if path else ""
    lines = [f"\n## {title}\n\n{about}"]
    lines.append("| key | unit | allowed | default | meaning |\n|---|---|---|---|---|\n")
    inner = []
    for key, entry in record["properties"].items():
        target = _record_of(schema, entry)
        if target is not None:
            inner += _section(
                schema, target, (*path, key), entry.get("default"), entry.get("description", "")
            )
            continue
        own = default[key] if isinstance(default, dict) and key in default else entry.get("default")
        needed = key in record.get("required", ()) and own is None
        cells = (
            f"`{key}`",
            entry.get("x-unit") or _UNITS.get(key.rsplit("_", 1)[-1], ""),
            _allowed(entry),
            "required" if needed else f"`{_toml(own)}`" if own is not None else "none",
            _flowing(entry.get("description", "")),
        )
        lines.append("| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |\n")
    return lines + inner


def _record_of(schema: dict, entry: dict) -> dict | None:
    """The record that a key holds, if it holds one."""
    options = [entry, *entry.get("anyOf", ())]
    references = [option["$ref"] for option in options if "$ref" in option]
    return schema["$defs"][references[0].rsplit("/", 1)[-1]] if references else None


def _allowed(entry: dict) -> str:
    if "x-unit" in entry and "anyOf" in entry:
        number = entry["anyOf"][0]
        return f"distribution, {number['minimum']:g} to {number['maximum']:g}"
    if "const" in entry or "enum" in entry:
        return ", ".join(f"`{_toml(value)}`" for value in entry.get("enum", [entry.get("const")]))
    if "anyOf" in entry:
        return " or ".join(_allowed(option) for option in entry["anyOf"] if option.get("type") != "null")
    if entry.get("type") == "array":
        items = entry.get("prefixItems") or [entry.get("items") or {}]
        return f"{len(items)} values, each {_allowed(items[0])}" if "prefixItems" in entry else "a list"
    if entry.get("type") == "boolean":
        return "`true`, `false`"
    kind = {"integer": "whole number", "number": "number", "string": "text"}.get(
        entry.get("type", ""), "table"
    )
    bounds = [
        f"{word} {entry[name]:g}" if abs(entry[name]) < 1e5 else f"{word} {entry[name]:,}"
        for name, word in (("minimum", "from"), ("exclusiveMinimum", "above"), ("maximum", "to"))
        if name in entry
    ]
    return " ".join([kind, *bounds])


def _flowing(text: str) -> str:
    """One line, code marked as Markdown does."""
    return " ".join(text.split()).replace("``", "`")


def _toml(value: Any) -> str:
    """A value as TOML writes it."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{key} = {_toml(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list | tuple):
        return "[" + ", ".join(_toml(inner) for inner in value) + "]"
    if isinstance(value, float):
        return f"{value:g}"
    return json.dumps(value)
