"""Is a dataset what its spec says? Checks that compute labels anew and look at pixels."""

from collections.abc import Callable
from dataclasses import dataclass

from facegen.store import Dataset
from facegen.validation.finding import Finding
from facegen.validation.keypoints import check_shard
from facegen.validation.renders import check_render

__all__ = ["Finding", "Verdict", "check_render", "check_shard", "things_to_check", "validate"]


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was checked, what is missing of the spec, and what is wrong."""

    shards: int
    renders: int
    missing_shards: int
    missing_renders: int
    findings: tuple[Finding, ...]


def things_to_check(dataset: Dataset) -> int:
    """Number of shards and rendered samples on disk."""
    return len(dataset.folder.shards()) + len(dataset.folder.rendered())


def validate(dataset: Dataset, *, on_progress: Callable[[int], None] = lambda done: None) -> Verdict:
    """Check everything that is there of a dataset; ``on_progress`` takes the number of things checked."""
    shards = [number for number in range(dataset.shards) if dataset.folder.shard(number).is_file()]
    renders = dataset.folder.rendered()
    findings: list[Finding] = []
    for done, number in enumerate(shards):
        findings.extend(check_shard(dataset, number))
        on_progress(done + 1)
    for done, number in enumerate(renders, start=len(shards)):
        findings.extend(check_render(dataset, number))
        on_progress(done + 1)
    return Verdict(
        shards=len(shards),
        renders=len(renders),
        missing_shards=dataset.shards - len(shards),
        missing_renders=len(set(dataset.samples_to_render()) - set(renders)),
        findings=tuple(findings),
    )
