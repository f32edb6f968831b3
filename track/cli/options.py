"""Options that several commands of track take."""

from pathlib import Path
from typing import Annotated

import typer

CameraOption = Annotated[
    list[str] | None,
    typer.Option(
        "--camera",
        metavar="[NAME=]SOURCE",
        help="A webcam's number or name, a film, a folder of pictures, an address (http://, rtsp://), or - for lines "
        "of 68 points. Of a headset one for each camera, with the camera's name: left_eye=0, or 0#left where one "
        "camera shows both eyes. Behind a webcam its mode: 0,size=640x480,fps=60 (format, exposure, gain as well). "
        "Camera 0 without.",
    ),
]

ModelOption = Annotated[
    str | None,
    typer.Option(
        "--model",
        metavar="NAME|FOLDER",
        help="Ready-made model (`regress models`) or model folder, of landmarks or a headset; by the cameras without.",
    ),
]

DetectorOption = Annotated[
    str | None,
    typer.Option(
        "--detector",
        help="What finds the face: mediapipe, or points for `--camera -`; by the camera without.",
    ),
]

DetectorFileOption = Annotated[
    Path | None,
    typer.Option("--detector-file", help="The detector's model file, where it is not to be fetched."),
]

ProfileOption = Annotated[
    str | None,
    typer.Option(
        "--profile",
        metavar="PERSON|FILE.toml",
        help="Whose neutral face and ranges; `me` without. Made by calibrating.",
    ),
]

FilterOption = Annotated[
    str,
    typer.Option(
        "--filter",
        help="Smoothing: groups (One-Euro: eyes quick, brows slow), none, or a filter of `regress predict`.",
    ),
]

NeutralOption = Annotated[
    str | None,
    typer.Option(
        "--neutral",
        metavar="FILE|auto|none",
        help="Neutral face: frames of points in a file; auto looks for one and says when it is sure; none. Goes before "
        "the profile's.",
    ),
]

PlacementOption = Annotated[
    Path | None,
    typer.Option("--placement", help="Of a headset: where its cameras see the face."),
]

HeadsetOption = Annotated[
    str | None,
    typer.Option(
        "--headset",
        metavar="NAME|FILE.toml|none",
        help="Headset file of facegen: where your cameras are, told to a model of drawn headsets (headset-any). "
        "Calibrating keeps it in the profile; none forgets it.",
    ),
]

FastOption = Annotated[
    bool,
    typer.Option(
        "--fast", help="Every frame of films and folders, as fast as they are read, not at their pace."
    ),
]

LoopOption = Annotated[
    bool,
    typer.Option("--loop", help="Films and folders again and again, until Ctrl-C."),
]

FpsOption = Annotated[
    float,
    typer.Option(
        "--fps", min=1.0, max=1000.0, help="Frames a second of folders, and of lines without times."
    ),
]
