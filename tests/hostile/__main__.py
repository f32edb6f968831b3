"""Runs cases by hand: one alone, many of a reader, or new ones for hours (``make fuzz``).

::

    python -m tests.hostile READER MUTATOR SEED [--keep FOLDER]
    python -m tests.hostile sweep [--readers A,B] [--cases N]
    python -m tests.hostile fuzz [--minutes 60] [--seed N] [--readers A,B]
"""

import argparse
import json
import os
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from tests.hostile.fuzz import Fuzz
from tests.hostile.plan import cases_of
from tests.hostile.readers import READERS
from tests.hostile.running import Server
from tests.hostile.trial import HONEST, Case, clear, mutators_of, try_case
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
    """Try every mutator of the readers some times; print what failed, once a cause."""
    parser = argparse.ArgumentParser(prog="python -m tests.hostile sweep")
    parser.add_argument("--readers")
    parser.add_argument("--cases", type=int, help="of each mutator; without, those that make test tries")
    parser.add_argument("--first", type=int, default=0)
    asked = parser.parse_args(words)
    names = asked.readers.split(",") if asked.readers else list(READERS)
    counts: Counter[str] = Counter()
    causes: dict[tuple[str, str, str], list[str]] = {}
    with tempfile.TemporaryDirectory() as scratch:
        server, workshop = Server(), Workshop(Path(scratch))
        for name in names:
            reader, began, tried = READERS[name], time.monotonic(), 0
            cases = [Case(reader=reader, mutator=HONEST, seed=0)] if reader.kind else []
            for mutator in mutators_of(reader):
                seeds = len(cases_of(reader, mutator)) if asked.cases is None else asked.cases
                cases += [Case(reader=reader, mutator=mutator, seed=asked.first + n) for n in range(seeds)]
            for case in cases:
                folder = Path(scratch) / "case"
                outcome = try_case(case, server, workshop, folder)
                clear(folder)
                tried += 1
                counts[outcome.verdict.kind] += 1
                wrong = not outcome.verdict.good or (
                    case.mutator == HONEST and outcome.verdict.kind != reader.honest
                )
                if wrong:
                    key = (name, outcome.verdict.kind, outcome.verdict.detail)
                    causes.setdefault(key, []).append(f"{case}")
            print(f"# {name}: {tried} cases in {time.monotonic() - began:.1f} s", file=sys.stderr, flush=True)
        server.close()
    for (name, kind, detail), found in sorted(causes.items()):
        print(f"{name}\t{kind}\t{detail}\t{len(found)}x\tpython -m tests.hostile {found[0]}")
    print(f"# {dict(counts)}")
    print(
        "# pairs:",
        json.dumps(sorted({" ".join(case.split()[:2]) for found in causes.values() for case in found})),
    )
    return bool(causes)


if __name__ == "__main__":
    main()
