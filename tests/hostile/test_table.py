"""Every entry of the programs' tables has its hostile reader, or a test that is named here: a new one needs one."""

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any, get_args, get_type_hints

import pytest
from typer.main import get_command

from facegen.farm import ENGINES
from facegen.packing import PACK_FORMATS
from facegen.rigs.building import RIGS
from regress.runtime.inputs import READERS as INPUTS
from regress.runtime.model import HEADSET, KEYPOINTS
from regress.runtime.stages.retargeting.shipped import shipped_targets
from regress.runtime.writers.tables import TABLES
from tests.hostile.known import KNOWN
from tests.hostile.mutators import FAMILIES
from tests.hostile.mutators.values import VALUES
from tests.hostile.plan import pairs
from tests.hostile.readers import READERS
from track.detectors.detectors import DETECTORS
from track.sinks.targets import SINKS
from track.sources.sources import SOURCES

ROOT = Path(__file__).parents[2]
COVERED = {word for reader in READERS.values() for word in reader.covers}


def _takes_a_path(annotation: Any) -> bool:
    return annotation is Path or any(map(_takes_a_path, get_args(annotation)))


def _files(command: Any) -> Iterator[str]:
    """Names of arguments and options of a program's commands that take a file or a folder."""
    for below in getattr(command, "commands", {}).values():
        yield from _files(below)
    if not hasattr(command, "commands"):
        hints = get_type_hints(command.callback, include_extras=True)
        yield from (name for name, annotation in hints.items() if _takes_a_path(annotation))


FILES = {
    program: sorted({*_files(get_command(import_module(f"{program}.cli").app))})
    for program in ("track", "room")
}
"""Of facegen and regress, `READERS` themselves are the list."""
TABLES_OF_THE_PROGRAMS = {
    "input": INPUTS,
    "pack": PACK_FORMATS,
    "table": [name for name in TABLES if name != "csv"],  # what every predict writes
    "engine": ENGINES,
    "model": [KEYPOINTS.name, HEADSET.name],
    "rig": RIGS,
    "target": shipped_targets(),
    "source": SOURCES,
    "detector": DETECTORS,
    "sink": SINKS,
    "track": FILES["track"],
    "room": FILES["room"],
}

WRITTEN = {
    *(f"sink:{name}" for name in ("vmc", "livelink", "vrchat", "csv", "livelink-csv")),
    *(f"track:{name}" for name in ("folder", "keep", "pictures", "record")),
    *("room:out", "room:record"),
}
"""Entries that read nothing of a stranger's."""

OURS = {f"target:{name}" for name in shipped_targets()}
"""Entries that come along, held by tests/regress/test_retargeting.py; a stranger's is the reader ``retarget``."""

_LINES = "tests/track/test_capture.py::test_what_is_wrong_with_lines_comes_out_of_the_thread"
_COMMANDS = "tests/room/test_commands.py::test_what_cannot_be_used_is_refused_in_a_sentence"
_WORDS = "tests/track/cli/test_bad_input.py::test_one_sentence"
ELSEWHERE = {
    "rig:anny": "tests/facegen/rigs/test_rig_files.py::test_unknown_and_unusable_sources_are_refused",
    "source:lines": _LINES,
    "source:address": "tests/track/test_sources.py::test_servers_of_any_manners_are_read",
    "source:folder": "tests/track/test_folders.py::test_a_file_that_is_no_picture_costs_no_more_than_itself",
    "source:film": "tests/track/test_sources.py::test_what_cannot_be_opened_is_one_sentence",
    "source:webcam": (
        "tests/track/test_capture.py::test_what_a_camera_does_wrong_is_told_once_and_its_pictures_do_not_count"
    ),
    "detector:mediapipe": "tests/track/test_detectors.py::test_a_file_that_is_no_model_is_refused",
    "detector:points": _LINES,
    "sink:ifacialmocap": (
        "tests/track/sinks/test_ifacialmocap.py::test_a_greeting_is_answered_in_the_version_that_it_asks_for"
    ),
    "sink:room": "tests/track/sinks/test_room.py::test_what_is_no_word_of_a_room_ends_no_thread",
    "sink:gltf": _WORDS,
    "sink:vrma": _WORDS,
    "track:detector_file": "tests/track/test_detectors.py::test_a_file_that_is_no_model_is_refused",
    "track:avatar": _WORDS,
    **{f"room:{name}": _COMMANDS for name in ("cert", "key", "keys", "turn_secret")},
    "room:janus_secret": (
        "tests/room/test_commands.py::test_engines_that_cannot_be_used_are_refused_before_anything_is_written"
    ),
    "room:recording": "tests/room/test_recording_files.py::test_what_is_no_recording_is_refused_with_its_line",
}
"""What the harness does not reach, as it runs facegen and regress alone, and the test that gives it what is wrong."""


@pytest.mark.parametrize("table", TABLES_OF_THE_PROGRAMS)
def test_every_entry_is_covered(table):
    known = COVERED | WRITTEN | OURS | ELSEWHERE.keys()
    missing = [name for name in TABLES_OF_THE_PROGRAMS[table] if f"{table}:{name}" not in known]
    assert not missing, f"tests/hostile/readers has nothing that covers {missing}, and no test is named here"


def test_the_table_covers_nothing_that_is_not_there():
    entries = {f"{table}:{name}" for table, names in TABLES_OF_THE_PROGRAMS.items() for name in names}
    assert {word for word in COVERED if ":" in word} | WRITTEN | OURS | ELSEWHERE.keys() <= entries


@pytest.mark.parametrize("test", sorted(set(ELSEWHERE.values())))
def test_tests_of_other_folders_are_there(test):
    path, _, function = test.partition("::")
    tree = ast.parse((ROOT / path).read_text(encoding="utf-8"))
    assert function in {
        node.name for node in ast.walk(tree) if isinstance(node, ast.FunctionDef | ast.AsyncFunctionDef)
    }


def test_readers_are_tried_with_what_there_is():
    for reader in READERS.values():
        assert reader.kind in FAMILIES or reader.values in VALUES, reader.name


def test_known_failures_are_of_readers_that_there_are():
    assert KNOWN <= {f"{reader.name} {mutator}" for reader, mutator in pairs(READERS)}
