"""What is known of one reader of a file: the command that reaches it, honest input, and what may become of it."""

import shlex
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

from tests.hostile.running import MEMORY_BYTES
from tests.hostile.workshop import Workshop


@dataclass(frozen=True, kw_only=True)
class Reader:
    """One reader and a command that reaches it.

    Parameters
    ----------
    name
        Of the reader, with what it is for where several commands read the same.
    command
        Program and words; the folder it runs in has ``in`` and ``out``. ``{NAME}`` is a thing of the workshop,
        ``{value}`` a value by ``values``.
    make
        Writes the honest input into ``in``.
    target
        The file to damage, below ``in``; a pattern where there are several.
    kind
        Of file: a key of `tests.hostile.mutators.FAMILIES`; empty where only values are tried.
    covers
        Entries of the programs' tables that it stands for, as ``input:pts``.
    values
        Kind of the option's value that is tried, a key of `tests.hostile.mutators.values.VALUES`.
    accepts
        Exit codes with which the command may end well.
    refuses
        Exit codes of a refusal: 1 as well where data that were made are found to be invalid, maybe midway.
    honest
        Verdict on honest input.
    names
        Words that name the input as well, of which a refusal must have one.
    stdin
        File that comes on standard input.
    environment
        Beside the usual.
    reseal
        Makes checksums right again after the damage.
    changes
        Whether the command may write in its input, as `validate --repair` does.
    only
        The mutators that `make test` tries, where all would take too long; `make fuzz` tries all.
    memory_bytes
        Address space that the command may take.
    weight
        Share of the cases of an ordinary reader: less for slow ones.
    """

    name: str
    command: str
    make: Callable[[Path, Workshop], None] = lambda folder, workshop: None
    target: str = ""
    kind: str = ""
    covers: tuple[str, ...] = ()
    values: str = ""
    accepts: tuple[int, ...] = (0,)
    refuses: tuple[int, ...] = (2, 74)
    honest: str = "accepted"
    names: tuple[str, ...] = ()
    stdin: str = ""
    environment: dict[str, str] = field(default_factory=dict)
    reseal: Callable[[Path], None] | None = None
    changes: bool = False
    only: tuple[str, ...] = ()
    memory_bytes: int = MEMORY_BYTES
    weight: float = 1.0

    def words(self, folder: Path, workshop: Workshop, value: str = "") -> list[str]:
        """Program and words of the command line."""
        named = _Named(workshop, value)
        return [word.format_map(named) for word in shlex.split(self.command)]


class _Named(dict):
    def __init__(self, workshop: Workshop, value: str) -> None:
        super().__init__(value=value)
        self._workshop = workshop

    def __missing__(self, name: str) -> Path:
        return getattr(self._workshop, name)
