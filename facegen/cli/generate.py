"""Defines ``facegen generate``."""

from pathlib import Path
from typing import Annotated, Literal

import typer

from facegen.children import answer_stops, ignore_stops
from facegen.cli.tables import print_table
from facegen.console import counted, progress, say
from facegen.errors import ExitCode


def generate(
    spec: Annotated[Path, typer.Argument(help="What to make, for example datasets/tiny.toml.")],
    out: Annotated[Path, typer.Option("--out", help="Folder of the dataset; made if it is not there.")],
    samples: Annotated[
        str | None, typer.Option("--samples", help="Render these instead of the spec's: 0-99,140,200-300:10.")
    ] = None,
    shards: Annotated[
        str | None,
        typer.Option(
            "--shards", help="Make these keypoint shards (0-9, or none); without --samples no pictures."
        ),
    ] = None,
    workers: Annotated[
        int | None, typer.Option("--workers", min=1, help="Processes; default: one per processor.")
    ] = None,
    grace: Annotated[
        float, typer.Option("--grace", min=0, help="Seconds that running work gets to end after Ctrl-C.")
    ] = 30.0,
    retry_quarantined: Annotated[
        bool, typer.Option("--retry-quarantined", help="Try again what failed three times in an earlier run.")
    ] = False,
    hang_limit: Annotated[
        float,
        typer.Option(
            "--hang-limit", min=1, help="Seconds after which a worker without a sign of life is replaced."
        ),
    ] = 300.0,
    view_limit: Annotated[
        float,
        typer.Option(
            "--view-limit", min=1, help="Seconds that one picture may take; then it counts as failed."
        ),
    ] = 3600.0,
    progress_style: Annotated[
        Literal["auto", "openjd"],
        typer.Option(
            "--progress", help="auto (a bar or lines on stderr), or openjd (lines that a render farm reads)."
        ),
    ] = "auto",
    dry_run: Annotated[
        bool, typer.Option("--dry-run", help="Say what would be made, and make nothing.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Make what a dataset is missing: keypoints of all, pictures of some. Run it again and it goes on.

    Example: facegen generate datasets/tiny.toml --out datasets/out/tiny
    """
    from facegen.spec import idle_note, load_spec
    from facegen.store import begin, check_folder_is_free, resolve
    from facegen.work import Limits, check_versions, crew_note, plan_work
    from facegen.work import generate as make

    dataset = resolve(load_spec(spec), out)
    if note := idle_note(dataset.spec):
        say(f"facegen: {spec}: {note}")
    if dry_run:
        check_folder_is_free(dataset)  # else `begin` does
    shards = "" if shards == "none" else shards
    work = plan_work(dataset, samples, shards=shards, retry_quarantined=retry_quarantined)
    if dry_run:
        print_table(
            {
                "out": str(out),
                "spec_hash": dataset.hash,
                "missing_shards": work.left("shard"),
                "missing_renders": work.left("sample"),
                "found": work.done,
                "quarantined": len(work.quarantined),
            },
            as_json=as_json,
        )
        return
    missing = len(work.missing)
    for note in filter(None, (check_versions(dataset, work), crew_note(work, workers))):
        say(f"facegen: {note}")
    begin(dataset)
    answer_stops(_stop_early)  # a terminal gets its cursor back
    with progress(style=progress_style) as show:

        def show_done(done: int) -> None:
            show("shards and rendered samples", done, missing)

        show_done(0)
        summary = make(
            dataset,
            samples,
            shards=shards,
            workers=workers,
            grace_s=grace,
            limits=Limits(silence_s=hang_limit, phase_s=view_limit),
            retry_quarantined=retry_quarantined,
            on_progress=show_done,
        )
    ignore_stops()  # what they asked for is done
    names = [task.name for task in summary.quarantined]
    print_table(
        {
            "out": str(out),
            "spec_hash": dataset.hash,
            "made": summary.made,
            "found": summary.found,
            "quarantined": names,
            "left": summary.left,
        },
        as_json=as_json,
    )
    if summary.left:
        say(f"facegen: stopped with {counted(summary.left, 'thing')} left; run the same command to go on")
        raise typer.Exit(ExitCode.DRAINED)
    if names:
        say(f"facegen: {len(names)} failed three times; their logs are in {out}/quarantine")
        raise typer.Exit(ExitCode.INVALID)


def _stop_early(_signal: int, _frame: object) -> None:
    """End between the first file and the first worker, whose supervisor answers stops itself."""
    raise KeyboardInterrupt
