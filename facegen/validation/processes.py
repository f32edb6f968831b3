"""Spreads checks over processes, with findings in order and bounded memory."""

import collections
import concurrent.futures
import multiprocessing
import os
import threading
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Literal

from facegen.children import block_stop_signals, ignore_stops
from facegen.errors import OutputError
from facegen.store import Dataset, open_dataset
from facegen.validation.finding import Finding
from facegen.validation.keypoints import check_shard
from facegen.validation.renders import check_renders

WAITING = 2
"""Batches a process that are handed out ahead: enough that none waits, few enough to bound memory."""
FINDINGS_PER_THING = 20
"""Of one shard or sample; a sample of another spec would otherwise have hundreds."""


@dataclass(frozen=True)
class CheckBatch:
    """Things that one process checks in one go: one shard, or rendered samples of one block."""

    kind: Literal["shard", "renders"]
    numbers: tuple[int, ...]


def check_batch(dataset: Dataset, batch: CheckBatch) -> list[Finding]:
    """Findings in one batch."""
    if batch.kind == "renders":
        return _limited(list(check_renders(dataset, batch.numbers)))
    return _limited([finding for number in batch.numbers for finding in check_shard(dataset, number)])


def check_batches(
    dataset: Dataset, batches: Iterable[CheckBatch], *, workers: int
) -> Iterator[tuple[CheckBatch, list[Finding]]]:
    """Each batch with its findings, in the batches' order.

    Raises
    ------
    OutputError
        If a process died, for want of memory as a rule.
    """
    if workers == 1:
        for batch in batches:
            yield batch, check_batch(dataset, batch)
        return
    # spawned: a process forked from one whose libraries run threads can hang
    pool = concurrent.futures.ProcessPoolExecutor(
        workers,
        mp_context=multiprocessing.get_context("spawn"),
        initializer=_begin,
        initargs=(str(dataset.folder.path),),
    )
    try:
        yield from _in_order(batches, lambda batch: _submit(pool, batch), ahead=workers * WAITING)
    except BrokenProcessPool:
        raise OutputError(
            f"{dataset.folder.path}: a checking process died, most likely for want of memory; "
            f"try fewer --workers than {workers}"
        ) from None
    finally:
        pool.shutdown(wait=True, cancel_futures=True)


def _submit(pool: concurrent.futures.ProcessPoolExecutor, batch: CheckBatch) -> concurrent.futures.Future:
    with block_stop_signals():  # the first call starts the processes
        return pool.submit(_check, batch)


def _in_order(
    batches: Iterable[CheckBatch], submit: Callable[[CheckBatch], concurrent.futures.Future], *, ahead: int
) -> Iterator[tuple[CheckBatch, list[Finding]]]:
    waiting: collections.deque = collections.deque()
    for batch in batches:
        waiting.append((batch, submit(batch)))
        if len(waiting) >= ahead:
            done, future = waiting.popleft()
            yield done, future.result()
    for done, future in waiting:
        yield done, future.result()


def _limited(findings: list[Finding]) -> list[Finding]:
    kept, counts = [], collections.Counter()
    for finding in findings:
        counts[finding.remove] += 1
        if counts[finding.remove] <= FINDINGS_PER_THING:
            kept.append(finding)
    for place, count in counts.items():
        if count > FINDINGS_PER_THING:
            kind = next(finding.kind for finding in findings if finding.remove == place)
            kept.append(Finding(place, f"and {count - FINDINGS_PER_THING} more things wrong", kind, place))
    return kept


_dataset: Dataset | None = None
"""What a checking process has open; the parent's stays None."""


def _begin(path: str) -> None:
    global _dataset
    ignore_stops()
    threading.Thread(target=_end_with_parent, daemon=True).start()
    _dataset = open_dataset(path)


def _end_with_parent() -> None:
    multiprocessing.parent_process().join()
    os._exit(1)


def _check(batch: CheckBatch) -> list[Finding]:
    return check_batch(_dataset, batch)
