"""Counts verdicts over all hostile tests, for the end of a run."""

from collections import Counter
from collections.abc import Iterable, Iterator

from tests.hostile.verdict import FAILURES, GOOD


def verdicts(reports: Iterable[object]) -> list[tuple[str, str]]:
    """Reader and verdict of each case, of the reports of a run: a test's end has what its call has, and counts once."""
    calls = [report for report in reports if getattr(report, "when", None) == "call"]
    properties = [pair for report in calls for pair in report.user_properties]
    return [tuple(verdict) for name, found in properties if name == "hostile" for verdict in found]


def lines(verdicts: Iterable[tuple[str, str]]) -> Iterator[str]:
    """A table of readers by verdict, of what was seen, and its totals.

    Parameters
    ----------
    verdicts
        Reader and verdict of each case.
    """
    counts: dict[str, Counter[str]] = {}
    for reader, kind in verdicts:
        counts.setdefault(reader, Counter())[kind] += 1
    if not counts:
        return
    totals = sum(counts.values(), Counter())
    kinds = [*GOOD, *(kind for kind in FAILURES if totals[kind])]
    wide = max(map(len, counts))
    yield f"{'reader':{wide}} " + " ".join(f"{kind:>10}" for kind in kinds)
    for reader, found in [*sorted(counts.items()), ("all", totals)]:
        yield f"{reader:{wide}} " + " ".join(f"{found[kind]:10d}" for kind in kinds)
    failed = sum(totals[kind] for kind in FAILURES)
    yield (
        f"{sum(totals.values())} hostile cases: {totals['accepted']} accepted, {totals['refused']} refused, "
        f"{totals['traceback'] + totals['internal']} tracebacks, {totals['memory'] + totals['time']} over limits of "
        f"time or memory, {failed} failures in all"
    )
