"""Every entry of the programs' tables has its hostile reader: a new format brings one along."""

import pytest

from facegen.farm import ENGINES
from facegen.packing import PACK_FORMATS
from regress.runtime.inputs import READERS as INPUTS
from regress.runtime.model import HEADSET, KEYPOINTS
from regress.runtime.writers.tables import TABLES
from tests.hostile.known import KNOWN
from tests.hostile.mutators import FAMILIES
from tests.hostile.mutators.values import VALUES
from tests.hostile.plan import pairs
from tests.hostile.readers import READERS

COVERED = {word for reader in READERS.values() for word in reader.covers}
TABLES_OF_THE_PROGRAMS = {
    "input": INPUTS,
    "pack": PACK_FORMATS,
    "table": [name for name in TABLES if name != "csv"],  # what every predict writes
    "engine": ENGINES,
    "model": [KEYPOINTS.name, HEADSET.name],
}


@pytest.mark.parametrize("table", TABLES_OF_THE_PROGRAMS)
def test_every_entry_is_covered(table):
    missing = [name for name in TABLES_OF_THE_PROGRAMS[table] if f"{table}:{name}" not in COVERED]
    assert not missing, f"tests/hostile/readers has nothing that covers {missing}"


def test_the_table_covers_nothing_that_is_not_there():
    entries = {f"{table}:{name}" for table, names in TABLES_OF_THE_PROGRAMS.items() for name in names}
    assert {word for word in COVERED if ":" in word} <= entries


def test_readers_are_tried_with_what_there_is():
    for reader in READERS.values():
        assert reader.kind in FAMILIES or reader.values in VALUES, reader.name


def test_known_failures_are_of_readers_that_there_are():
    assert KNOWN <= {f"{reader.name} {mutator}" for reader, mutator in pairs(READERS)}
