"""Keeps what once failed: damaged files, made small, and cases that are no file; `make test` replays all of it.

``corpus/READER/NAME`` stands for the reader's damaged file; a line of ``corpus/cases.txt`` is ``READER MUTATOR SEED``.
"""

from collections.abc import Callable, Iterator
from pathlib import Path

from tests.hostile.readers import READERS
from tests.hostile.trial import Case, Outcome

FOLDER = Path(__file__).parent / "corpus"
CASES = "cases.txt"

MOST_BYTES = 20_000
"""Of a file that is kept; of larger ones the case is written down."""

MOST_TRIES = 120
"""Of making a file smaller."""

REPLAY = "replay"
"""Mutator of a case whose damaged file is kept."""


def kept_files() -> Iterator[tuple[Case, Path]]:
    """Cases with their damaged files."""
    for path in sorted(FOLDER.glob("*/*")):
        yield Case(reader=READERS[path.parent.name], mutator=REPLAY, seed=0), path


def kept_cases() -> Iterator[Case]:
    """Cases that are made anew."""
    path = FOLDER / CASES
    for line in path.read_text().splitlines() if path.is_file() else ():
        reader, mutator, seed = line.split()
        yield Case(reader=READERS[reader], mutator=mutator, seed=int(seed))


def keep(outcome: Outcome, content: bytes | None, again: Callable[[bytes], Outcome]) -> str:
    """Keep a failure; returns where.

    Parameters
    ----------
    outcome
        What failed.
    content
        Of the damaged file; None where the case is none.
    again
        Tries the case with another content.
    """
    case = outcome.case
    if content is not None:
        small = _shrunk(content, lambda data: again(data).verdict == outcome.verdict)
        if len(small) <= MOST_BYTES:
            path = FOLDER / case.reader.name / f"{case.mutator}-{case.seed}"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(small)
            return str(path)
    FOLDER.mkdir(exist_ok=True)
    with open(FOLDER / CASES, "a") as file:
        file.write(f"{case}\n")
    return f"{FOLDER / CASES}: {case}"


def _shrunk(content: bytes, fails: Callable[[bytes], bool]) -> bytes:
    """A shorter content that fails in the same way: halves, quarters, eighths ... are left out while it does."""
    tries, size = 0, max(1, len(content) // 2)
    if not fails(content):  # it was not the file alone
        return content
    while size >= 1 and tries < MOST_TRIES:
        start, gone = 0, False
        while start < len(content) and tries < MOST_TRIES:
            shorter = content[:start] + content[start + size :]
            tries += 1
            if fails(shorter):
                content, gone = shorter, True
            else:
                start += size
        size = size if gone and size < len(content) else size // 2
    return content
