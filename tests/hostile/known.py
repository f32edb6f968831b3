"""Lists readers and mutators of which some case fails today; it must become empty, and stay so.

An entry that fails no more turns the tests red, as a strict xfail does.
"""

KNOWN: frozenset[str] = frozenset()
"""``READER MUTATOR``."""
