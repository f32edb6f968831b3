"""Tries readers one after the other, and prints each cause of failure as soon as it is met."""

import sys
import time
from collections import Counter
from pathlib import Path

from tests.hostile.plan import cases_of, pairs
from tests.hostile.readers import Reader
from tests.hostile.running import Server
from tests.hostile.trial import HONEST, Case, clear, mutators_of, try_case
from tests.hostile.workshop import Workshop


def sweep(readers: list[Reader], scratch: Path, *, seeds: range | None) -> int:
    """Try all mutators of the readers; returns the number of causes of failure.

    Parameters
    ----------
    readers
        In their order.
    scratch
        Folder for cases.
    seeds
        Of every mutator; without, what `make test` tries.
    """
    server, workshop, causes = Server(), Workshop(scratch), set()
    for reader in readers:
        counts: Counter[str] = Counter()
        began, processor_s = time.monotonic(), 0.0
        for case in _cases(reader, seeds):
            outcome = try_case(case, server, workshop, scratch / "case")
            clear(scratch / "case")
            processor_s += outcome.cpu_s
            verdict = outcome.verdict
            counts[verdict.kind] += 1
            if not verdict.good or (case.mutator == HONEST and verdict.kind != reader.honest):
                cause = (reader.name, case.mutator, verdict)
                if cause not in causes:
                    print(f"{verdict.kind}\t{verdict.detail}\t{case.command}", flush=True)
                causes.add(cause)
        taken = f"{time.monotonic() - began:.1f} s, {processor_s:.1f} s of processor time"
        print(f"# {reader.name}: {dict(counts)} in {taken}", file=sys.stderr, flush=True)
    server.close()
    return len(causes)


def _cases(reader: Reader, seeds: range | None) -> list[Case]:
    """The honest input, where there is one, and all mutators."""
    cases = [Case(reader=reader, mutator=HONEST, seed=0)] if reader.kind else []
    if seeds is None:
        return cases + [case for pair in pairs({reader.name: reader}) for case in cases_of(*pair)]
    return cases + [
        Case(reader=reader, mutator=mutator, seed=seed) for mutator in mutators_of(reader) for seed in seeds
    ]
