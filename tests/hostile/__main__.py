"""Runs cases by hand: one alone, many of a reader, or new ones for hours (``make fuzz``).

::

    python -m tests.hostile READER MUTATOR SEED [--keep FOLDER]
    python -m tests.hostile sweep [--readers A,B] [--cases N]
    python -m tests.hostile fuzz [--minutes 60] [--seed N] [--readers A,B]
"""

import argparse
import os
import sys
import tempfile
import time
from pathlib import Path

from tests.hostile.fuzz import Fuzz
from tests.hostile.readers import READERS
from tests.hostile.running import Server
from tests.hostile.sweep import sweep
from tests.hostile.trial import Case, clear, try_case
from tests.hostile.workshop import Workshop


def main() -> None:
    """Read the command line and run what it asks for."""
    if len(sys.argv) > 1 and sys.argv[1] == "sweep":
        sys.exit(_sweep(sys.argv[2:]))
    if len(sys.argv) > 1 and sys.argv[1] == "fuzz":
        sys.exit(_fuzz(sys.argv[2:]))
    parser = argparse.ArgumentParser(prog="python -m tests.hostile")
    parser.add_argument("reader", choices=sorted(READERS))
    parser.add_argument("mutator")
    parser.add_argument("seed", type=int)
    parser.add_argument("--keep", type=Path, help="folder to leave input, output and what was said in")
    asked = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = asked.keep or Path(scratch) / "case"
        server = Server()
        case = Case(reader=READERS[asked.reader], mutator=asked.mutator, seed=asked.seed)
        outcome = try_case(case, server, Workshop(Path(scratch)), folder.resolve())
        server.close()
        print(" ".join(word if len(word) < 200 else f"{word[:200]}..." for word in outcome.words))
        print(outcome.stderr[-6000:])
        print(f"{outcome.verdict.kind}: {outcome.verdict.detail} ({outcome.cpu_s:.2f} s)")
        if not asked.keep:
            clear(folder)
    sys.exit(not outcome.verdict.good)


def _fuzz(words: list[str]) -> int:
    """New cases for a time; a failure is kept in the corpus."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile fuzz")
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, help="without one of the clock")
    parser.add_argument("--workers", type=int, default=len(os.sched_getaffinity(0)))
    parser.add_argument("--readers")
    asked = parser.parse_args(words)
    seed = int(time.time()) % 10**6 * 10**6 if asked.seed is None else asked.seed
    print(f"fuzz: seed {seed}", file=sys.stderr)
    names = asked.readers.split(",") if asked.readers else list(READERS)
    with tempfile.TemporaryDirectory() as scratch:
        fuzz = Fuzz(seed=seed, scratch=Path(scratch), readers=names)
        return bool(fuzz.run(minutes=asked.minutes, workers=asked.workers))


def _sweep(words: list[str]) -> int:
    """Every mutator of the readers, some times; what fails is printed once a cause."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile sweep")
    parser.add_argument("--readers")
    parser.add_argument("--cases", type=int, help="of each mutator; without, those that make test tries")
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args(words)
    seeds = None if asked.cases is None else range(asked.first, asked.first + asked.cases)
    names = asked.readers.split(",") if asked.readers else list(READERS)
    with tempfile.TemporaryDirectory() as scratch:
        return bool(sweep([READERS[name] for name in names], Path(scratch), seeds=seeds))


if __name__ == "__main__":
    main()
