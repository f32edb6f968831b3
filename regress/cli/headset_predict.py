"""``regress headset predict``: the pictures of a headset's cameras in, a table of weights out."""

from pathlib import Path
from typing import Annotated

import typer

from regress.cli.options import (
    AvatarOption,
    BetaOption,
    BitsOption,
    BlendOption,
    CameraOption,
    FilterName,
    FilterOption,
    FormatOption,
    FpsOption,
    FromStartOption,
    HeadsetOption,
    LeftEyeOption,
    MirrorOption,
    ModelOption,
    MouthOption,
    OneEuroOption,
    OutOption,
    OwnBlinksOption,
    RetargetOption,
    RightEyeOption,
    SmoothOption,
    TableFormat,
    TrustOption,
)
from regress.runtime.stages.one_euro import OneEuro


def predict(
    arguments: Annotated[
        list[Path] | None,
        typer.Argument(
            metavar="[MODEL] [DATASET]",
            help="The model, as --model takes it, and a facegen dataset: the pictures under its renders/. Without a "
            "dataset name the cameras' paths.",
        ),
    ] = None,
    chosen: ModelOption = None,
    camera: CameraOption = None,
    left_eye: LeftEyeOption = None,
    right_eye: RightEyeOption = None,
    mouth: MouthOption = None,
    from_start: FromStartOption = False,
    bits: BitsOption = None,
    placement: Annotated[
        Path | None,
        typer.Option(
            "--placement",
            metavar="FILE|auto",
            help="TOML of `regress headset check`: what of each camera's pictures counts, at which levels; auto looks "
            "for it in the take.",
        ),
    ] = None,
    headset: HeadsetOption = None,
    out: OutOption = None,
    table_format: FormatOption = TableFormat.csv,
    retarget: RetargetOption = None,
    gltf: AvatarOption = None,
    trust: TrustOption = None,
    neutral: Annotated[
        list[str] | None,
        typer.Option(
            "--neutral",
            metavar="FRAME|FOLDER|auto|none",
            help="The person's neutral face: a frame by its number, a folder with CAMERA.png for each camera, or "
            "auto, which looks for it. Again a later frame: it counts from there on, after a new seat.",
        ),
    ] = None,
    person: Annotated[
        Path | None,
        typer.Option(
            "--person",
            help="File of `regress headset calibrate`: neutral pictures, own ends of ranges, lids and gaze; the table "
            "gets openness and pupils too.",
        ),
    ] = None,
    keep_neutral: Annotated[
        bool,
        typer.Option(
            "--keep-neutral",
            help="Stay calibrated after a change of seat: the same person wears the headset.",
        ),
    ] = False,
    temporal: Annotated[
        bool,
        typer.Option(
            "--temporal", help="Let the four frames before count, as `regress headset temporal` found."
        ),
    ] = False,
    strict: Annotated[
        bool, typer.Option("--strict", help="Fail where a given camera has no usable picture in a frame.")
    ] = False,
    filter_name: FilterOption = FilterName.none,
    smooth: SmoothOption = 1,
    cutoff_hz: OneEuroOption = None,
    beta: BetaOption = OneEuro.beta,
    fps: FpsOption = None,
    adjust: Annotated[
        Path | None,
        typer.Option(
            "--adjust",
            "--calibration",
            help="JSON with gain, offset, dead_zone, low and high by shape; a resting face is --neutral's.",
        ),
    ] = None,
    own_blinks: OwnBlinksOption = None,
    amplify_eyes: Annotated[
        float,
        typer.Option("--amplify-eyes", min=0, max=1000, help="Factor on blink, wide and squint of each eye."),
    ] = 1.0,
    left_right_blend: BlendOption = 0.0,
    mirror: MirrorOption = False,
    points: Annotated[
        Path | None,
        typer.Option(
            "--points", help="CSV to write: the points that each camera traces, in pixels of its pictures."
        ),
    ] = None,
    eyes: Annotated[
        Path | None,
        typer.Option(
            "--eyes", help="CSV to write: how far lids are open, and the gaze, by the traced points."
        ),
    ] = None,
    looked_at: Annotated[
        list[str] | None,
        typer.Option(
            "--looked-at",
            metavar="FRAME:YAW:PITCH",
            help="What was looked at in a frame, in degrees to the person's left and upwards, which sets the gaze of "
            "--eyes right. One such frame re-centres it, five or nine decide its scale.",
        ),
    ] = None,
    video: Annotated[
        Path | None, typer.Option("--video", help="Film to write: the cameras' pictures and the avatar.")
    ] = None,
    rig: Annotated[str, typer.Option("--rig", help="Built rig that is the avatar of --video.")] = "anny",
) -> None:
    """Predict the 52 blendshape weights and the gaze of every frame of a headset's cameras.

    A camera may be left out, and a picture that is missing, black, frozen or of another shape leaves its camera out of
    that frame: what that is, and in which frames, is said, and the confidence falls. A frame without any picture has
    empty cells. A neutral frame makes weights far better as long as the headset stays where it sits; the network sees
    when it does not, and goes on without.

    Example: regress headset predict --left-eye take/left_eye --right-eye take/right_eye --mouth take/mouth
    --neutral 0 --out weights.csv
    """
    from facegen.console import say
    from facegen.files import write_whole
    from regress.cli.headset_input import (
        camera_paths,
        check_stills,
        model_and_dataset,
        placement_of,
        read_footage,
        read_neutrals,
        targets_of,
        told_of,
    )
    from regress.cli.headset_notes import (
        check_model,
        level_notes,
        rate_note,
        same_path_notes,
        seat_notes,
        target_notes,
        tell_of,
    )
    from regress.cli.headset_person import neutrals_of, read_own, tell_of_views
    from regress.cli.output import output_of
    from regress.cli.results import check_targets, needs_times, write_prediction
    from regress.errors import InputError
    from regress.runtime.headset.answers.film import check_film_name, write_film
    from regress.runtime.headset.answers.points import points_csv
    from regress.runtime.headset.answers.predict import predict_footage
    from regress.runtime.headset.answers.traced_eyes import eyes_csv, traced_eyes
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.headset.pictures.halves import whole_of
    from regress.runtime.headset.placing.levels import levelled, levels_of_cameras
    from regress.runtime.stages.frame_clock import USUAL_FPS
    from regress.runtime.writers.csv_table import confidence_csv, weights_csv

    cameras = bool(camera or left_eye or right_eye or mouth)
    model, dataset = model_and_dataset(arguments or [], chosen, cameras=cameras)
    predictor = told_of(load_headset_predictor(model), headset)
    output = output_of(
        filter_name=filter_name.value,
        smooth=smooth,
        cutoff_hz=cutoff_hz,
        beta=beta,
        own_blinks=bool(own_blinks),
        amplify_eyes=amplify_eyes,
        adjust=adjust,
        left_right_blend=left_right_blend,
        mirror=mirror,
        retarget=retarget,
    )
    short = {"left_eye": left_eye, "right_eye": right_eye, "mouth": mouth}
    paths = camera_paths(
        predictor, camera or [], {name: path for name, path in short.items() if path is not None}
    )
    check_targets(
        table_format,
        out=out,
        gltf=gltf,
        retargeted=retarget is not None,
        tables={"--confidence": trust, "--points": points, "--eyes": eyes},
        film=video,
        sources=(*paths.values(), *map(whole_of, paths.values()), adjust, person, placement),
    )
    targets = targets_of(looked_at or [])
    if looked_at and eyes is None:
        raise InputError("--looked-at is for the gaze of --eyes; give --eyes too")
    if video is not None and retarget is not None:
        raise InputError("--video takes ARKit's shapes: leave out --retarget")
    if dataset is not None:
        check_stills(
            temporal=temporal,
            filter=filter_name is not FilterName.none,
            smooth=smooth > 1,
            one_euro=cutoff_hz is not None,
            own_blinks=bool(own_blinks),
            bits=bits is not None,
        )
    check_model(predictor, model, trust=trust, points=points)
    own = read_own(predictor, person, still=dataset is not None)
    if video is not None:
        check_film_name(video)
    placed = placement_of(predictor, placement, paths, bits=bits)
    tell_of_views(own, placed, predictor, person)
    footage = read_footage(
        predictor, dataset, paths, from_start=from_start, fps=fps, bits=bits, placement=placed
    )
    if footage.time_s is None and (output.needs_times or needs_times(table_format, gltf)):
        raise InputError(f"{footage.source} does not say when its frames were taken; give --fps")
    film = dataset is None and footage.time_s is not None
    output = output.with_own_blinks(film=own_blinks is None and person is None and film)
    tell_of(footage, predictor, strict=strict)
    # pictures of a dataset are of many people, each with levels of their own
    levels = {} if dataset is not None else levels_of_cameras(footage, predictor.model.looks, placed)
    of_levels = () if dataset is not None else level_notes(footage, predictor, placed)
    for note in (*same_path_notes(paths), *of_levels):
        say(note)
    footage = levelled(footage, levels)
    neutrals = read_neutrals(
        predictor,
        footage,
        neutral or (),
        still=dataset is not None,
        bits=bits,
        placement=placed,
        levels=levels,
    )
    neutrals = neutrals if neutral else neutrals_of(own, predictor, footage, levels)
    # whose file it is needs no proof, and another seat's neutral picture is worth more than none
    keep_neutral = keep_neutral or own is not None
    # first, as it knows whether frames that were looked at are there
    found = None if eyes is None else traced_eyes(predictor, footage, targets)
    prediction, reseated = predict_footage(
        predictor,
        footage,
        neutrals,
        output=output,
        keep_neutral=keep_neutral,
        temporal=temporal,
        person=own,
        still=dataset is not None,
        say=say,
    )
    of_rate = rate_note(predictor.model.temporal.fps, footage.fps) if temporal else ()
    of_seat = seat_notes(reseated, keep_neutral=keep_neutral)
    for note in (*target_notes(found or {}), *of_seat, *of_rate):
        say(note)
    if points is not None:
        write_whole(points, points_csv(predictor, footage))
    if eyes is not None:
        write_whole(eyes, eyes_csv(found, footage.numbers))
    if trust is not None:
        write_whole(trust, confidence_csv(prediction))
    write_prediction(prediction, table_format, out=out, gltf=gltf)
    if video is not None:
        rate = fps or footage.fps or USUAL_FPS
        write_film(video, footage, weights_csv(prediction), rig=rig, fps=rate)
        say(f"film in {video}")
