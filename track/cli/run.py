"""``track run``: a camera's face on an avatar, until it is stopped."""

import dataclasses
import json
from pathlib import Path
from typing import Annotated

import typer

from track.cli.options import (
    CameraOption,
    DetectorFileOption,
    DetectorOption,
    FastOption,
    FilterOption,
    FpsOption,
    HeadsetOption,
    LoopOption,
    ModelOption,
    NeutralOption,
    PlacementOption,
    ProfileOption,
)

PORT = 8190
"""Of the page; above those that need rights, and none that avatar programs use."""


def run(
    camera: CameraOption = None,
    model: ModelOption = None,
    detector: DetectorOption = None,
    detector_file: DetectorFileOption = None,
    profile: ProfileOption = None,
    to: Annotated[
        list[str] | None,
        typer.Option(
            "--to",
            metavar="NAME[:HOST:PORT|:FILE]",
            help="Where answers go, again for several: vmc, livelink, ifacialmocap, vrchat, csv:FILE and others.",
        ),
    ] = None,
    record: Annotated[
        list[Path] | None,
        typer.Option(
            "--record", help="Recording to write, again for several: .csv, or .glb and .vrma of an animation."
        ),
    ] = None,
    neutral: NeutralOption = None,
    filter_name: FilterOption = "groups",
    mirror: Annotated[
        bool | None,
        typer.Option("--mirror/--no-mirror", help="Left and right exchanged; as the profile says without."),
    ] = None,
    own_blinks: Annotated[
        bool,
        typer.Option(
            "--own-blinks/--no-own-blinks",
            help="Stretch blinks until your fullest ones shut the avatar's eyes; a calibrated profile goes before.",
        ),
    ] = True,
    retarget: Annotated[
        str | None,
        typer.Option(
            "--retarget", metavar="NAME|FILE.toml", help="Another avatar's shapes in .csv recordings."
        ),
    ] = None,
    page: Annotated[bool, typer.Option("--page/--no-page", help="The page in the browser.")] = True,
    browser: Annotated[bool, typer.Option("--browser/--no-browser", help="Open the page at once.")] = True,
    avatar: Annotated[
        Path | None, typer.Option("--avatar", help="Your .glb or .vrm on the page; ours without.")
    ] = None,
    host: Annotated[
        str, typer.Option("--host", help="Where the page is served; another than 127.0.0.1 asks for a token.")
    ] = "127.0.0.1",
    port: Annotated[
        int, typer.Option("--port", min=0, max=65535, help="Of the page; 0 for any free one.")
    ] = PORT,
    placement: PlacementOption = None,
    headset: HeadsetOption = None,
    fast: FastOption = False,
    loop: LoopOption = False,
    fps: FpsOption = 30.0,
    seconds: Annotated[
        float | None, typer.Option("--seconds", min=0.0, max=1e7, help="Stop by itself after so long.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="How it went, for programs, at the end.")] = False,
) -> None:
    """Move an avatar with your face: on the page, in VSeeFace, Unreal, VRChat and others.

    Pictures never leave this machine, unless --host shows the page to others. Ctrl-C ends it, and recordings are then
    written whole.

    Example: track --camera 0 --to vmc
    """
    from facegen.console import say
    from track.cli.opening import Wishes
    from track.cli.running import RunOptions, run_session

    wishes = Wishes(
        cameras=camera or (),
        model=model,
        detector=detector,
        detector_file=detector_file,
        profile=profile,
        filter_name=filter_name,
        neutral=neutral,
        placement=placement,
        headset=headset,
        fast=fast,
        loop=loop,
        fps=fps,
    )
    summary = run_session(
        wishes,
        RunOptions(
            to=to or (),
            record=record or (),
            retarget=retarget,
            mirror=mirror,
            own_blinks=own_blinks,
            page=page,
            browser=browser,
            avatar=avatar,
            host=host,
            port=port,
            seconds=seconds,
        ),
        say,
    )
    if as_json:
        typer.echo(json.dumps(dataclasses.asdict(summary), allow_nan=False))
