"""Checks a whole dataset and sums up what was checked, what is missing, what is wrong."""

from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from facegen.conventions import BLOCK
from facegen.spec import format_runs, without
from facegen.store import Dataset
from facegen.validation.finding import Finding
from facegen.validation.listing import Listing, list_dataset
from facegen.validation.processes import CheckBatch, check_batches

BATCH = 20
"""Rendered samples that a process checks in one go: seconds of work, against milliseconds to hand it out."""
FINDINGS_KEPT = 100_000
"""Findings that a verdict holds, about 40 MB; more are counted, and their places kept for ``--repair``."""


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was found.

    Attributes
    ----------
    shards, renders
        How many were checked.
    missing_shards, missing_renders
        Numbers of what the spec asks for and is not there, as ``"0-99,140"``; it may still be made.
    missing
        How many these are.
    wrong
        Number of findings, by `facegen.validation.finding.FindingKind`.
    findings
        The findings, the first `FINDINGS_KEPT` of them.
    invalid
        What ``--repair`` would remove, below the dataset's folder.
    """

    shards: int
    renders: int
    missing_shards: str
    missing_renders: str
    missing: int
    wrong: dict[str, int]
    findings: tuple[Finding, ...]
    invalid: tuple[str, ...]


def validate(
    dataset: Dataset,
    *,
    workers: int = 1,
    listing: Listing | None = None,
    on_progress: Callable[[int], None] = lambda done: None,
) -> Verdict:
    """Check everything that is there of a dataset.

    Parameters
    ----------
    dataset
        From `facegen.store.open_dataset`.
    workers
        Processes; 1 checks in this one.
    listing
        What `list_dataset` gave, if it was asked already.
    on_progress
        Takes the number of shards and rendered samples checked.
    """
    listing = listing or list_dataset(dataset)
    batches = list(_batches(listing))
    counts, removable = Counter(), set()
    findings: list[Finding] = []

    def take(batch_findings: tuple[Finding, ...] | list[Finding]) -> None:
        counts.update(finding.kind for finding in batch_findings)
        removable.update(finding.remove for finding in batch_findings)
        findings.extend(batch_findings[: FINDINGS_KEPT - len(findings)])

    take(listing.extras)
    done = 0
    for batch, batch_findings in check_batches(dataset, batches, workers=max(1, min(workers, len(batches)))):
        take(batch_findings)
        done += len(batch.numbers)
        on_progress(done)
    missing_shards = without(range(dataset.shards), listing.shards)
    missing_renders = without(dataset.samples_to_render(), listing.renders)
    return Verdict(
        shards=len(listing.shards),
        renders=len(listing.renders),
        missing_shards=format_runs(missing_shards),
        missing_renders=format_runs(missing_renders),
        missing=sum(map(len, (*missing_shards, *missing_renders))),
        wrong=dict(sorted(counts.items())),
        findings=tuple(findings),
        invalid=tuple(sorted(removable)),
    )


def _batches(listing: Listing) -> Iterator[CheckBatch]:
    for number in listing.shards:
        yield CheckBatch("shard", (number,))
    batch: list[int] = []
    for number in listing.renders:
        if batch and (len(batch) == BATCH or number // BLOCK != batch[0] // BLOCK):
            yield CheckBatch("renders", tuple(batch))
            batch = []
        batch.append(number)
    if batch:
        yield CheckBatch("renders", tuple(batch))
