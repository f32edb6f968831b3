"""Defines ``facegen validate``."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import counted, progress, say
from facegen.errors import ExitCode

if TYPE_CHECKING:
    from facegen.validation import Repair, Verdict


def validate(
    dataset: Annotated[Path, typer.Argument(help="Folder of a dataset.")],
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, help="Processes; default: one per processor.")
    ] = None,
    repair: Annotated[
        bool, typer.Option("--repair", help="Remove what is invalid or extra; generate then makes it again.")
    ] = False,
    partial: Annotated[
        bool,
        typer.Option("--partial", help="End with 0 also where something is only missing, as in a slice."),
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the verdict as JSON.")] = False,
) -> None:
    """Check a dataset: checksums, pictures, labels against pixels, and all labels against the spec.

    Ends with 0 if all is there and right, 1 if something is wrong, 75 if something is only missing.

    Example: facegen validate datasets/out/tiny
    """
    from facegen.store import open_dataset
    from facegen.validation import list_dataset
    from facegen.validation import repair as remove
    from facegen.validation import validate as check
    from facegen.work import available_cpus, side_by_side

    opened = open_dataset(dataset)
    listing = list_dataset(opened)
    total = len(listing.shards) + len(listing.renders)
    with progress() as show:
        verdict = check(
            opened,
            workers=side_by_side(workers or available_cpus()),
            listing=listing,
            on_progress=lambda done: show("shards and rendered samples checked", done, total),
        )
    if not as_json:
        for finding in verdict.findings:
            print(finding)
    repaired = remove(opened, verdict) if repair and verdict.invalid else None
    if as_json:
        print(json.dumps(asdict(verdict) | {"repair": None if repaired is None else asdict(repaired)}))
    else:
        for name in repaired.removed if repaired else ():
            print(f"removed {name}")
        shards, renders = counted(verdict.shards, "shard"), counted(verdict.renders, "rendered sample")
        faults = counted(sum(verdict.wrong.values()), "thing")
        print(f"{shards} and {renders} checked, {faults} wrong")
        if verdict.renders and not opened.spec.render.truth:
            say(
                f"facegen: {dataset} has no EXR files (render.truth = false), so no label was held against depths"
            )
    if verdict.wrong and repaired is None:
        raise typer.Exit(ExitCode.INVALID)
    removed = repaired is not None and not _only_extras(verdict)
    if verdict.missing or removed:
        say(f"facegen: {_missing(verdict, repaired)}; facegen generate goes on with them")
        raise typer.Exit(ExitCode.OK if partial and not removed else ExitCode.DRAINED)


def _only_extras(verdict: "Verdict") -> bool:
    """Whether all that is wrong is in excess, so that nothing is missing once it is removed."""
    return all(kind.startswith("extra-") for kind in verdict.wrong)


def _missing(verdict: "Verdict", repaired: "Repair | None") -> str:
    """What generate has to make, and why."""
    reasons = []
    if verdict.missing_shards:
        reasons.append(f"keypoint shards {_short(verdict.missing_shards)} are missing")
    if verdict.missing_renders:
        reasons.append(f"rendered samples {_short(verdict.missing_renders)} are missing")
    if repaired is not None and repaired.samples:
        reasons.append(f"rendered samples were removed (generate --samples {_short(repaired.samples)})")
    if repaired is not None and any(place.startswith("keypoints/shard-") for place in repaired.removed):
        reasons.append("keypoint shards were removed")
    return ", ".join(reasons)


def _short(ranges: str) -> str:
    pieces = ranges.split(",")
    return ranges if len(pieces) <= 8 else ",".join(pieces[:8]) + f",... ({len(pieces)} ranges)"
