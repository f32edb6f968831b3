"""Options that every ``predict`` takes: where weights go, in which form, and what happens to them on the way."""

from enum import Enum
from pathlib import Path
from typing import Annotated

import typer

from regress.runtime.stages.filters import DEFAULT_FILTER, FILM_FILTER, FILTERS
from regress.runtime.stages.retargeting.shipped import shipped_targets
from regress.runtime.writers.tables import TABLES

TableFormat = Enum("TableFormat", {name: name for name in TABLES}, type=str)
"""Tables that ``--format`` knows."""

ModelOption = Annotated[
    str | None,
    typer.Option(
        "--model", metavar="NAME|FOLDER", help="Ready-made model (`regress models`) or model folder."
    ),
]

OutOption = Annotated[
    Path | None,
    typer.Option("--out", help="File to write, with --gltf the animated .glb; - or none is standard output."),
]

FormatOption = Annotated[
    TableFormat, typer.Option("--format", help="csv, or livelink for the columns of the Live Link Face app.")
]

RetargetOption = Annotated[
    str | None,
    typer.Option(
        "--retarget",
        metavar="|".join((*shipped_targets(), "FILE.toml")),
        help="Weights of another avatar's shapes in place of ARKit's.",
    ),
]

AvatarOption = Annotated[
    Path | None,
    typer.Option(help="Avatar (.glb, .vrm) to which an animation of its morph targets is added."),
]

TrustOption = Annotated[
    Path | None,
    typer.Option("--confidence", help="CSV to write with the trust in each ARKit weight, 0 to 1."),
]

FilterName = Enum("FilterName", {name: name for name in ("none", *FILTERS)}, type=str)
"""Filters that ``--filter`` knows."""

LandmarkFilterName = Enum("LandmarkFilterName", {name: name for name in ("auto", "none", *FILTERS)}, type=str)
"""Filters that ``--filter`` knows where frames are landmarks."""

_LAGS = ", ".join(f"{name} {entry.lag_ms[0]}/{entry.lag_ms[1]}" for name, entry in FILTERS.items())
_FILTER_HELP = f"Filter of weights over time. What comes is late, at 30/60 frames a second, by ms: {_LAGS}."

FilterOption = Annotated[FilterName, typer.Option("--filter", help=_FILTER_HELP)]

LandmarkFilterOption = Annotated[
    LandmarkFilterName,
    typer.Option(
        "--filter",
        help=f"{_FILTER_HELP} auto is {FILM_FILTER} where a recording has times or --fps, {DEFAULT_FILTER} where lines "
        "have, and none with another smoothing or a model of the paper's recipe.",
    ),
]

SmoothOption = Annotated[
    int, typer.Option("--smooth", min=1, max=10_000, help="Frames of a moving average over time.")
]

OneEuroOption = Annotated[
    float | None,
    typer.Option(
        "--one-euro", min=1e-3, max=1e6, help="One-Euro smoothing with this cutoff in Hz at rest; try 1."
    ),
]

BetaOption = Annotated[
    float, typer.Option("--beta", min=0, max=1e6, help="One-Euro: Hz more for each unit of weight a second.")
]

BlendOption = Annotated[
    float,
    typer.Option("--left-right-blend", min=0, max=1, help="0 leaves left and right, 1 averages them."),
]

OwnBlinksOption = Annotated[
    bool | None,
    typer.Option(
        "--own-blinks/--no-own-blinks",
        help="Stretch blinks by the full ones of the take, which then shut the eyes. Films of eight blinks or more "
        "are stretched of themselves, unless lids are changed otherwise; landmarks with a neutral face alone.",
    ),
]

MirrorOption = Annotated[bool, typer.Option("--mirror", help="Exchange left and right.")]

HeadOption = Annotated[
    bool,
    typer.Option("--head", help="The head's position and turn as well; livelink always has the turn."),
]

PictureOption = Annotated[
    str | None,
    typer.Option(
        "--picture",
        metavar="WIDTHxHEIGHT",
        help="Size in pixels of the pictures of INPUT, for --head and for points between 0 and 1; without it the "
        "camera looks at the first face.",
    ),
]

FovOption = Annotated[
    float | None,
    typer.Option(
        "--fov-deg",
        min=5,
        max=150,
        help="Angle of view across the width of --picture; 60 if nothing is said.",
    ),
]

FocalOption = Annotated[
    float | None,
    typer.Option("--focal-px", min=1, max=1e6, help="Focal length of the camera, in place of --fov-deg."),
]

KeepGuessOption = Annotated[
    bool,
    typer.Option(
        "--keep-guessed-gaze",
        help="Leave the eyeLook shapes as lids let the networks guess them, where the head is turned or an eye winks.",
    ),
]

CameraOption = Annotated[
    list[str] | None,
    typer.Option(
        "--camera", metavar="NAME=PATH", help="A camera's folder of pictures, or film; for each camera."
    ),
]

LeftEyeOption = Annotated[Path | None, typer.Option("--left-eye", help="Short for --camera left_eye=PATH.")]

RightEyeOption = Annotated[
    Path | None, typer.Option("--right-eye", help="Short for --camera right_eye=PATH.")
]

MouthOption = Annotated[Path | None, typer.Option("--mouth", help="Short for --camera mouth=PATH.")]

HeadsetOption = Annotated[
    str | None,
    typer.Option(
        "--headset",
        metavar="NAME|FILE.toml",
        help="Headset file of facegen: where the cameras are, told to a model of drawn headsets (headset-any).",
    ),
]

FromStartOption = Annotated[
    bool,
    typer.Option("--from-start", help="Match first frames, not numbers: eyes of one take, mouth of another."),
]
FpsOption = Annotated[
    float | None,
    typer.Option("--fps", min=1e-3, max=1e6, help="Frames a second; goes before a film's own."),
]
BitsOption = Annotated[
    int | None,
    typer.Option(
        "--bits", min=8, max=16, help="How many bits the cameras use, of pictures with 16 bits a pixel."
    ),
]
