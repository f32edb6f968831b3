"""Headset files: finding them by name, reading them, and saying in one sentence what is wrong with one."""

import tomllib
from pathlib import Path

from pydantic import TypeAdapter, ValidationError

from facegen.errors import FormatError, InputError, MissingAsset
from facegen.headsets.headset import Headset

HEADSET_FOLDER = Path(__file__).resolve().parents[2] / "blender_assets" / "headsets"
"""Folder of the headsets that come with the project; a new one is a new file there, or a path."""

_ADAPTER = TypeAdapter(Headset)


def list_headsets() -> tuple[str, ...]:
    """Names of the headsets that come with the project, sorted."""
    return tuple(sorted(path.stem for path in HEADSET_FOLDER.glob("*.toml")))


def load_headset(name_or_path: str | Path) -> Headset:
    """The headset of that name, or of the TOML file at that path.

    Raises
    ------
    MissingAsset
        Where there is no such headset.
    FormatError
        Where the file is not TOML.
    InputError
        Where a key is unknown or missing, or a value impossible; the message names the key's path.
    """
    path = headset_path(name_or_path)
    try:
        content = tomllib.loads(path.read_text(encoding="utf-8"))
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise FormatError(f"{path} is not TOML: {error}") from error
    return parse_headset(content, source=path.name)


def parse_headset(content: dict, *, source: str) -> Headset:
    """A headset from the content of a TOML file; ``source`` names it in errors."""
    try:
        return _ADAPTER.validate_python(content)
    except ValidationError as error:
        raise InputError(f"{source}: {_sentence(error)}") from None


def headset_path(name_or_path: str | Path) -> Path:
    """Where the headset's file is: names are looked up in `HEADSET_FOLDER`, what ends in .toml is a path."""
    path = Path(name_or_path)
    if path.suffix != ".toml":
        path = HEADSET_FOLDER / f"{name_or_path}.toml"
    if not path.is_file():
        known = ", ".join(list_headsets()) or "none"
        raise MissingAsset(
            f"there is no headset {str(name_or_path)!r}; known are {known}, or give the path of a .toml file"
        )
    return path


def _sentence(error: ValidationError) -> str:
    """All refusals of a file: key path, value found, what is allowed."""
    sentences = []
    for entry in error.errors(include_url=False):
        key = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in entry["loc"]).lstrip(
            "."
        )
        match entry["type"]:
            case "unexpected_keyword_argument":
                sentences.append(f"{key} is not a known key{_known_keys(entry['loc'])}")
            case "missing" | "missing_keyword_only_argument":
                sentences.append(f"{key} is missing")
            case _:
                message = entry["msg"].removeprefix("Value error, ")
                message = message[:1].lower() + message[1:] if message.startswith("Input") else message
                found = (
                    f" is {entry['input']!r}" if isinstance(entry["input"], str | int | float | list) else ""
                )
                sentences.append(f"{key}{found}: {message}" if key else message)
    return "; ".join(sentences)


def _known_keys(loc: tuple) -> str:
    """``; known are ...`` for the table in which an unknown key stands."""
    fields = Headset.__pydantic_fields__
    for part in loc[:-1]:
        if isinstance(part, int):
            continue
        kind = fields[part].annotation
        kind = next((a for a in getattr(kind, "__args__", ()) if hasattr(a, "__pydantic_fields__")), kind)
        fields = kind.__pydantic_fields__
    return f"; known are {', '.join(fields)}"
