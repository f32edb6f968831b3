"""Reads and checks a spec from TOML, and hashes all that decides a dataset."""

import dataclasses
import hashlib
import json
import operator
import os
from collections.abc import Iterator
from functools import reduce
from pathlib import Path
from typing import Any, get_args

from pydantic import TypeAdapter, ValidationError
from pydantic.dataclasses import is_pydantic_dataclass

from facegen.documents import load_toml
from facegen.errors import InputError
from facegen.expression import COMPONENTS
from facegen.number_ranges import parse_ranges
from facegen.refusals import refusal
from facegen.spec.distribution import as_data
from facegen.spec.spec import Clips, Spec

LABEL_VERSION = 7
"""Raised with every change that alters labels or pixels for the same spec; part of every hash (see CHANGELOG.md)."""

_LATE_KEYS: dict[str, Any] = {
    "still.sessions": 1,
    "landmarks.sliding_contour": False,
    **{f"looks.{name}": 0.0 for name in ("beard", "glasses", "make_up")},
    "sensor.slip": 1.0,
    "render.subsurface": True,
    "render.truth": True,
    "layout": None,
    "gaze.wide": 0.0,
    "expression.blinks": 0.0,
    **{f"expression.mixture.{name}": 0.0 for name, component in COMPONENTS.items() if not component.first},
}
"""Keys that are younger than some datasets, and values that change nothing: with these they stay out of the hash."""

_SPLIT_SESSIONS = 100_000_000
"""Most sessions of all people that are split one by one: as many as there may be people."""

_ADAPTER = TypeAdapter(Spec)


def load_spec(path: str | Path) -> Spec:
    """Read and check a spec.

    Raises
    ------
    InputError
        If the file cannot be read, is not TOML, or a key or value is not allowed; says which, and what is.
    """
    path = Path(path)
    if not os.path.lexists(path):
        raise InputError(
            f"{path}: there is no such spec; the ones that come with facegen are datasets/*.toml"
        )
    if os.path.isdir(path):
        raise InputError(
            f"{path} is a folder; name a spec's file, for example a dataset's {path / 'spec.toml'}"
        )
    spec = parse_spec(load_toml(path), where=str(path))
    if spec.playback is not None:
        recording = _beside(path, "playback.recording", spec.playback.recording)
        spec = dataclasses.replace(spec, playback=dataclasses.replace(spec.playback, recording=recording))
    if spec.render.headset.endswith(".toml"):
        headset = _beside(path, "render.headset", spec.render.headset)
        spec = dataclasses.replace(spec, render=dataclasses.replace(spec.render, headset=headset))
    return spec


def _beside(spec: Path, key: str, name: str) -> str:
    """Absolute path of a file that a spec names, relative to the spec."""
    path = spec.parent / name
    if not os.path.isfile(path):  # False for names that no file can have, too
        raise InputError(f"{spec}: {key} = {name!r}: there is no file {path}")
    return str(path.resolve())


def parse_spec(table: dict[str, Any], *, where: str) -> Spec:
    """Check a table of a spec's keys and values; ``where`` names its origin in error messages."""
    try:
        # through JSON, whose strict mode takes tables as records and lists as tuples
        spec = _ADAPTER.validate_json(json.dumps(table, default=str))
    except ValidationError as error:
        raise InputError(f"{where}: {refusal(error, Spec)}") from None
    except (ValueError, OverflowError):
        raise InputError(f"{where}: a number has too many digits") from None
    if abs(sum(spec.split_shares) - 1) > 1e-9:
        raise InputError(
            f"{where}: split_shares = {list(spec.split_shares)} must add up to 1 (train, validation, test)"
        )
    if not any(dataclasses.astuple(spec.expression.mixture)):
        names = ", ".join(f.name for f in dataclasses.fields(spec.expression.mixture))
        raise InputError(
            f"{where}: expression.mixture gives no component a weight above 0; there are {names}"
        )
    if spec.kind == "playback" and spec.playback is None:
        raise InputError(f'{where}: kind = "playback" needs a [playback] table with recording and fps')
    if spec.kind == "sequence" and not any(
        clips.count for clips in vars(spec.sequence).values() if isinstance(clips, Clips)
    ):
        raise InputError(f"{where}: sequence has no clips; at least one kind needs a count above 0")
    if spec.kind == "still" and spec.still.neutral + spec.still.faces == 0:
        raise InputError(
            f"{where}: still.neutral and still.faces are both 0; at least one face a person is needed"
        )
    if spec.split == "session" and spec.kind != "playback":
        sessions = getattr(spec, spec.kind).sessions
        if spec.people * sessions > _SPLIT_SESSIONS:
            raise InputError(
                f"{where}: people = {spec.people} with {spec.kind}.sessions = {sessions} are {spec.people * sessions} "
                f'sessions; split = "session" takes up to {_SPLIT_SESSIONS}, so make fewer or split = "person"'
            )
    parse_ranges(spec.render.samples, where=f"{where}: render.samples")
    return spec


def spec_table(spec: Spec) -> dict[str, Any]:
    """The resolved spec as plain data, defaults filled in; `parse_spec` takes it back."""
    return _ADAPTER.dump_python(spec, mode="json")


def spec_schema() -> dict[str, Any]:
    """JSON schema (2020-12) of a spec with all defaults, for editors and for `facegen.spec.spec_reference`."""
    schema = _ADAPTER.json_schema()
    for record in _records(Spec):
        properties = (schema if record is Spec else schema["$defs"][record.__name__])["properties"]
        for field in dataclasses.fields(record):
            if field.default_factory is not dataclasses.MISSING:  # pydantic leaves these out
                properties[field.name]["default"] = as_data(field.default_factory())
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def spec_hash(spec: Spec, *, asset_sha256: dict[str, str]) -> str:
    """SHA-256 of all that decides a dataset: the resolved spec, the assets it uses, and the label version.

    Which samples are rendered does not matter to any one of them and stays out, so a dataset can grow pictures.
    """
    table = _without_late_keys(spec_table(spec))
    table["render"].pop("samples")
    table["render"].pop("headset")  # what it says is among the assets; where it lies does not matter
    if spec.playback is not None:
        for key in ("recording", "credit", "licence"):  # likewise, and words change no sample
            table["playback"].pop(key)
    content = {"spec": table, "assets": asset_sha256, "label_version": LABEL_VERSION}
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()


def _without_late_keys(table: dict[str, Any]) -> dict[str, Any]:
    for path, default in _LATE_KEYS.items():
        *outer, key = path.split(".")
        inner = reduce(operator.getitem, outer, table)
        if inner[key] == default:
            del inner[key]
            if not inner:  # a table of late keys alone
                del table[outer[0]]
    return table


def _records(record: Any) -> Iterator[Any]:
    """A record of a spec and all records in it."""
    yield record
    for field in dataclasses.fields(record):
        for inner in _records_of(field):
            yield from _records(inner)


def _records_of(field: dataclasses.Field) -> list[Any]:
    return [kind for kind in (field.type, *get_args(field.type)) if is_pydantic_dataclass(kind)]
