"""``facegen validate``."""

import json
import sys
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from facegen.cli.progress import progress
from facegen.conventions import ExitCode


def validate(
    dataset: Annotated[Path, typer.Argument(help="Folder of a dataset.")],
    as_json: Annotated[bool, typer.Option("--json", help="Print the verdict as JSON.")] = False,
) -> None:
    """Check a dataset: checksums, pictures, labels against pixels, and all labels against the spec they come from.

    Example: facegen validate datasets/out/tiny
    """
    from facegen.store import open_dataset
    from facegen.validation import things_to_check
    from facegen.validation import validate as check

    opened = open_dataset(dataset)
    with progress("shards and rendered samples checked", things_to_check(opened)) as update:
        verdict = check(opened, on_progress=update)
    if as_json:
        print(json.dumps(asdict(verdict)))
    else:
        for finding in verdict.findings:
            print(finding)
        print(f"{verdict.shards} shards and {verdict.renders} rendered samples checked, {len(verdict.findings)} things wrong")
    if verdict.findings:
        raise typer.Exit(ExitCode.INVALID)
    if verdict.missing_shards or verdict.missing_renders:
        print(
            f"facegen: {verdict.missing_shards} shards and {verdict.missing_renders} rendered samples are still missing; "
            "facegen generate goes on with them",
            file=sys.stderr,
        )
        raise typer.Exit(ExitCode.DRAINED)
