"""Defines ``facegen pack``."""

import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import counted, progress
from facegen.errors import InputError


def pack(
    dataset: Annotated[Path, typer.Argument(help="Folder of a dataset.")],
    out: Annotated[Path, typer.Option("--out", help="Folder of the pack; made if it is not there.")],
    name: Annotated[
        str | None,
        typer.Option(
            "--format",
            help="webdataset (default if there are pictures), parquet, keypoints (default if not), arrays (for memory "
            "maps), coco, livelink (one recording a clip) or openface (detected landmarks).",
        ),
    ] = None,
    samples: Annotated[
        str | None, typer.Option("--samples", help="Pack these: 0-99,140. Default: all there are.")
    ] = None,
    split: Annotated[
        str | None, typer.Option("--split", help="Pack one split: train, validation or test.")
    ] = None,
    shard_size: Annotated[int | None, typer.Option("--shard-size", min=1, help="Samples a file.")] = None,
    views: Annotated[str | None, typer.Option("--views", help="Cameras to pack: left_eye,mouth.")] = None,
    columns: Annotated[
        str | None, typer.Option("--columns", help="Columns of keypoints: weights,detected_2d,split.")
    ] = None,
    exr: Annotated[
        bool | None, typer.Option("--exr/--no-exr", help="Pack the EXR files too (webdataset).")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary as JSON.")] = False,
) -> None:
    """Pack a dataset for training, as webdataset (tar shards), parquet, arrays, keypoints, coco, livelink or openface.

    Run it again after a stop and it goes on; equal datasets give equal bytes.

    Example: facegen pack datasets/out/tiny --out packs/tiny --format webdataset --no-exr
    """
    from facegen.packing import Options, plan_pack, write_pack
    from facegen.store import open_dataset

    options = Options(
        samples=samples,
        split=split,
        shard_size=shard_size,
        views=_names(views),
        columns=_names(columns),
        exr=exr,
    )
    opened = open_dataset(dataset)
    if name is None and not opened.folder.rendered():
        name = "keypoints"
        for flag, value in (("--no-exr" if exr is False else "--exr", exr), ("--views", views)):
            if value is not None:
                raise InputError(
                    f"{dataset}: holds no rendered sample, so it is packed as keypoints, and {flag} is about pictures; "
                    f"render some, or leave {flag} out"
                )
    name = name or "webdataset"
    plan = plan_pack(opened, name, options)
    with progress() as show:
        packed = write_pack(plan, out, on_progress=lambda done: show("files packed", done, len(plan.parts)))
    if as_json:
        print(json.dumps({"out": str(out)} | asdict(packed)))
    else:
        samples, written = counted(packed.samples, "sample"), counted(packed.written, "file")
        print(f"{out}: {samples}, {written} written, {packed.found} found")


def _names(text: str | None) -> tuple[str, ...] | None:
    return None if text is None else tuple(name.strip() for name in text.split(",") if name.strip())
