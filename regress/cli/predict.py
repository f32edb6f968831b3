"""``regress predict``: landmarks in, a table of weights out."""

from pathlib import Path
from typing import Annotated

import typer

from regress.cli.options import (
    AvatarOption,
    BetaOption,
    BlendOption,
    FocalOption,
    FormatOption,
    FovOption,
    HeadOption,
    KeepGuessOption,
    LandmarkFilterName,
    LandmarkFilterOption,
    MirrorOption,
    ModelOption,
    OneEuroOption,
    OutOption,
    OwnBlinksOption,
    PictureOption,
    RetargetOption,
    SmoothOption,
    TableFormat,
    TrustOption,
)
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.writers.tables import TABLES


def predict(
    arguments: Annotated[
        list[Path],
        typer.Argument(
            metavar="[MODEL] INPUT",
            help="Landmarks: .pts files and folders, .npy and .npz, .csv of OpenFace, py-feat or any other with "
            "columns as x_0, x0 or 0_x, dlib .xml, COCO, OpenPose, mmpose or MediaPipe .json, CK+ folders, or - for "
            "lines of 136 numbers on standard input. Points are 68, maybe with two irises behind them, or 98, 133, "
            "136, 468 or 478 in the orders of their datasets. Before them the model, as --model takes it.",
        ),
    ],
    chosen: ModelOption = None,
    out: OutOption = None,
    table_format: FormatOption = TableFormat.csv,
    retarget: RetargetOption = None,
    gltf: AvatarOption = None,
    trust: TrustOption = None,
    neutral: Annotated[
        str | None,
        typer.Option(
            "--neutral",
            metavar="FRAME|FILE|first|auto|none",
            help="The person's neutral face: a frame of INPUT by its label, frames FIRST-LAST, another "
            "file of landmarks, first, the first frame of each face or folder or the first line with a face, auto, "
            "which looks for it, or none, as without this option.",
        ),
    ] = None,
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail where a frame has no face, or none that can be right.")
    ] = False,
    smooth_landmarks_hz: Annotated[
        float | None,
        typer.Option(
            "--smooth-landmarks",
            metavar="HZ",
            min=1e-3,
            max=1e6,
            help="One-Euro smoothing of the landmarks themselves, with this cutoff at rest; try 1.",
        ),
    ] = None,
    filter_name: LandmarkFilterOption = LandmarkFilterName.auto,
    smooth: SmoothOption = 1,
    cutoff_hz: OneEuroOption = None,
    beta: BetaOption = OneEuro.beta,
    fps: Annotated[
        float | None,
        typer.Option(
            "--fps",
            min=1e-3,
            max=1e6,
            help="Frames a second; goes before times in INPUT. Its column frame counts, where it has one.",
        ),
    ] = None,
    adjust: Annotated[
        Path | None,
        typer.Option("--adjust", help="JSON with gain, offset, dead_zone, low and high by shape."),
    ] = None,
    own_blinks: OwnBlinksOption = None,
    left_right_blend: BlendOption = 0.0,
    mirror: MirrorOption = False,
    head: HeadOption = False,
    picture: PictureOption = None,
    fov_deg: FovOption = None,
    focal_px: FocalOption = None,
    keep_guessed_gaze: KeepGuessOption = False,
    symmetric: Annotated[
        bool,
        typer.Option(
            "--symmetric", help="Average every face's weights with its mirror image's; twice the time."
        ),
    ] = False,
) -> None:
    """Predict the 52 blendshape weights of every frame.

    A frame without a face gets empty cells, and so does one whose points are collapsed or mirrored or whose
    time is out of order; their row numbers are said. A neutral frame makes weights far better on real faces: it
    shows what the person is like, and where the detector puts its points.

    Example: regress predict take.csv --neutral 1 --one-euro 1 --out weights.csv
    """
    from regress.cli.camera import camera_settings
    from regress.cli.landmark_lines import predict_pipe
    from regress.cli.landmark_take import model_and_input, predict_file
    from regress.cli.output import output_of
    from regress.cli.results import STANDARD_OUTPUT, check_targets
    from regress.errors import InputError
    from regress.runtime.model import load_model, symmetrised
    from regress.runtime.predict import PAPER_RECIPE

    model, landmarks = model_and_input(arguments, chosen)
    if own_blinks and str(landmarks) == "-":
        raise InputError(
            "--own-blinks needs a whole take, and lines of standard input are answered as they come: name a file, or "
            "leave it out"
        )
    loaded = symmetrised(load_model(model)) if symmetric else load_model(model)
    output = output_of(
        smooth_landmarks_hz=smooth_landmarks_hz,
        filter_name=filter_name.value,
        smooth=smooth,
        cutoff_hz=cutoff_hz,
        beta=beta,
        own_blinks=bool(own_blinks),
        adjust=adjust,
        left_right_blend=left_right_blend,
        mirror=mirror,
        retarget=retarget,
    )
    smoothed = smooth > 1 or cutoff_hz is not None or smooth_landmarks_hz is not None
    auto_filter = filter_name is LandmarkFilterName.auto and not smoothed and loaded.recipe != PAPER_RECIPE
    check_targets(
        table_format,
        out=out,
        gltf=gltf,
        retargeted=retarget is not None,
        tables={"--confidence": trust},
        sources=(landmarks, adjust, None if neutral is None else Path(neutral)),
    )
    camera = camera_settings(
        wanted=head or TABLES[table_format.value].has_head,
        picture=picture,
        fov_deg=fov_deg,
        focal_px=focal_px,
    )
    if str(landmarks) != "-":
        predict_file(
            loaded,
            landmarks,
            output,
            neutral=neutral,
            auto_filter=auto_filter,
            auto_blinks=own_blinks is None and loaded.recipe != PAPER_RECIPE,
            fps=fps,
            strict=strict,
            trust=trust,
            camera=camera,
            keep_guessed_gaze=keep_guessed_gaze,
            table_format=table_format,
            gltf=gltf,
            out=out,
        )
    elif out in (None, STANDARD_OUTPUT) and gltf is trust is None and table_format is TableFormat.csv:
        predict_pipe(
            loaded,
            neutral or "none",
            output,
            camera=camera,
            keep_guessed_gaze=keep_guessed_gaze,
            auto_filter=auto_filter,
            fps=fps,
            strict=strict,
        )
    else:
        raise InputError("weights of standard input leave as CSV on standard output alone: use > FILE")
