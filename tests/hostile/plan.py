"""Which cases `make test` tries: a few seeds of every mutator of every reader, the same each time.

`make fuzz` draws others, for as long as it is told to.
"""

from tests.hostile.mutators.octets import OCTETS, TEXT
from tests.hostile.readers.reader import Reader
from tests.hostile.trial import Case, mutators_of

SEEDS = 2
"""Of a mutator that knows the reader's format."""

BLIND_SEEDS = 1
"""Of one that knows nothing, and of other kinds of files and names."""

VALUES = 4
"""Of an option, whose values are all that is tried."""

_BLIND = {*OCTETS, *TEXT, "kind", "name"}


def cases_of(reader: Reader, mutator: str) -> list[Case]:
    """Seeded cases of one mutator: fewer of what is slow."""
    seeds = VALUES if mutator == "value" else BLIND_SEEDS if mutator in _BLIND else SEEDS
    count = max(1, round(seeds * reader.weight))
    return [Case(reader=reader, mutator=mutator, seed=seed) for seed in range(count)]


def pairs(readers: dict[str, Reader]) -> list[tuple[Reader, str]]:
    """Every reader with every mutator that fits it, or with those that it chooses."""
    return [
        (reader, mutator) for reader in readers.values() for mutator in reader.only or mutators_of(reader)
    ]
