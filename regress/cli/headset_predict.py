"""``regress headset predict``: the pictures of a headset's cameras in, a table of weights out."""

import dataclasses
from collections.abc import Iterator
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from facegen.console import say
from facegen.conventions import LANDMARK_COUNT
from regress.cli.headset_input import camera_paths, check_stills, read_footage, read_neutrals
from regress.cli.options import (
    AvatarOption,
    BetaOption,
    BlendOption,
    FormatOption,
    MirrorOption,
    OneEuroOption,
    OutOption,
    RetargetOption,
    SmoothOption,
    TrustOption,
)
from regress.cli.results import Format, write_avatar, write_confidence, write_points, write_table
from regress.errors import InputError
from regress.runtime.adjustment import read_adjustments
from regress.runtime.headset.film import check_film_name, write_film
from regress.runtime.headset.footage import Footage
from regress.runtime.headset.orientation import told_orientation
from regress.runtime.headset.performance import ASSUMED_FPS, Performance, perform
from regress.runtime.headset.points import check_points, points_csv
from regress.runtime.headset.predictor import load_headset_predictor
from regress.runtime.headset.temporal import TAPS
from regress.runtime.inputs import Frames
from regress.runtime.predict import Output, Prediction, prediction_csv
from regress.runtime.retargeting import read_retargeting
from regress.runtime.smoothing import OneEuro

GAZE_COLUMNS = ("left_eye_yaw_deg", "left_eye_pitch_deg", "right_eye_yaw_deg", "right_eye_pitch_deg")
"""Of the CSV, behind the weights: yaw to the subject's left, pitch upwards, in the head frame."""

_SAME_RATE = 0.05
"""Relative difference of frame rates that --temporal does not speak of: 29.97 are 30."""


def predict(
    model: Annotated[Path, typer.Argument(help="Model folder of `regress headset train`.")],
    dataset: Annotated[
        Path | None,
        typer.Argument(
            help="A facegen dataset: the pictures under its renders/. Otherwise name the cameras' paths."
        ),
    ] = None,
    camera: Annotated[
        list[str] | None,
        typer.Option(
            "--camera", metavar="NAME=PATH", help="A camera's folder of pictures, or film; for each camera."
        ),
    ] = None,
    left_eye: Annotated[
        Path | None, typer.Option("--left-eye", help="Short for --camera left_eye=PATH.")
    ] = None,
    right_eye: Annotated[
        Path | None, typer.Option("--right-eye", help="Short for --camera right_eye=PATH.")
    ] = None,
    mouth: Annotated[Path | None, typer.Option("--mouth", help="Short for --camera mouth=PATH.")] = None,
    from_start: Annotated[
        bool,
        typer.Option(
            "--from-start", help="Match first frames, not numbers: eyes of one take, mouth of another."
        ),
    ] = False,
    bits: Annotated[
        int | None,
        typer.Option(
            "--bits", min=8, max=16, help="How many bits the cameras use, of pictures with 16 bits a pixel."
        ),
    ] = None,
    out: OutOption = None,
    table_format: FormatOption = Format.csv,
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
    smooth: SmoothOption = 1,
    cutoff_hz: OneEuroOption = None,
    beta: BetaOption = OneEuro.beta,
    fps: Annotated[
        float | None, typer.Option("--fps", min=1e-3, help="Frames a second; goes before a film's own.")
    ] = None,
    adjust: Annotated[
        Path | None,
        typer.Option(
            "--adjust",
            "--calibration",
            help="JSON with gain, offset, dead_zone, low and high by shape; a resting face is --neutral's.",
        ),
    ] = None,
    amplify_eyes: Annotated[
        float, typer.Option("--amplify-eyes", min=0, help="Factor on blink, wide and squint of each eye.")
    ] = 1.0,
    left_right_blend: BlendOption = 0.0,
    mirror: MirrorOption = False,
    points: Annotated[
        Path | None,
        typer.Option(
            "--points", help="CSV to write: the points that each camera traces, in pixels of its pictures."
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

    Example: regress headset predict models/headset --left-eye take/left --right-eye take/right --mouth take/mouth
    --neutral 0 --out weights.csv
    """
    predictor = load_headset_predictor(model)
    output = Output(
        smooth=smooth,
        one_euro=None if cutoff_hz is None else OneEuro(cutoff_hz=cutoff_hz, beta=beta),
        adjustments={} if adjust is None else read_adjustments(adjust),
        left_right_blend=left_right_blend,
        mirror=mirror,
        retargeting=None if retarget is None else read_retargeting(retarget),
    )
    _check_tables(table_format, out, gltf, video, retarget)
    if dataset is not None:
        check_stills(
            temporal=temporal, smooth=smooth > 1, one_euro=cutoff_hz is not None, bits=bits is not None
        )
    if trust is not None and not predictor.model.scores:
        raise InputError(f"{model} has no scores on a test split, from which confidence is made")
    if points is not None:
        check_points(predictor)
    if video is not None:
        check_film_name(video)
    short = {"left_eye": left_eye, "right_eye": right_eye, "mouth": mouth}
    paths = camera_paths(
        predictor, camera or [], {name: path for name, path in short.items() if path is not None}
    )
    footage = read_footage(predictor, dataset, paths, from_start=from_start, fps=fps, bits=bits)
    needed = output.one_euro is not None or table_format is Format.livelink or gltf is not None
    if needed and footage.time_s is None:
        raise InputError(f"{footage.source} does not say when its frames were taken; give --fps")
    if strict and not footage.present[:, footage.recorded].all():
        raise InputError(f"{'; '.join(footage.notes)}; without --strict the other cameras' pictures count")
    for note in (*footage.notes, *told_orientation(footage, predictor.typical)):
        say(note)
    neutrals = read_neutrals(predictor, footage, neutral or (), still=dataset is not None, bits=bits)
    performance = perform(
        predictor,
        footage,
        neutrals,
        output=output,
        amplify_eyes=amplify_eyes,
        keep_neutral=keep_neutral,
        temporal=temporal,
    )
    for note in _notes(performance, footage, keep_neutral=keep_neutral):
        say(note)
    if points is not None:
        write_points(points_csv(predictor, footage), points)
    _write(performance, footage, table_format, out, gltf, trust)
    if video is not None:
        rate = fps or (ASSUMED_FPS if footage.time_s is None else _rate(footage.time_s))
        text = prediction_csv(_prediction(performance, footage, gaze=False))
        write_film(video, footage, text, rig=rig, fps=rate)
        say(f"film in {video}")


def _check_tables(
    table_format: Format, out: Path | None, gltf: Path | None, video: Path | None, retarget: Path | None
) -> None:
    if (table_format is Format.livelink or video is not None) and retarget is not None:
        raise InputError("--format livelink and --video take ARKit's shapes: leave out --retarget")
    if table_format is Format.livelink and gltf is not None:
        raise InputError("--format livelink has the app's own columns: leave out --gltf")
    if gltf is not None and out is None:
        raise InputError(f"--gltf {gltf} needs --out for the animated avatar")


def _notes(performance: Performance, footage: Footage, *, keep_neutral: bool) -> Iterator[str]:
    """What a person should know of how the answers came about."""
    worth = "less well calibrated" if keep_neutral else "not calibrated (--keep-neutral for the same person)"
    for row in performance.reseated:
        yield (
            f"frame {footage.numbers[row]}: the headset does not sit as in the neutral pictures; weights are {worth} "
            f"from here on, until a --neutral frame of the new seat"
        )
    taps_fps = performance.taps_fps
    if taps_fps is None or footage.time_s is None or len(footage.time_s) < 2:
        return
    found_fps = _rate(footage.time_s)
    if abs(found_fps / taps_fps - 1) > _SAME_RATE:
        yield (
            f"--temporal: the model's taps are for {taps_fps:g} frames a second and the take has {found_fps:.4g}; they "
            f"reach {1000 * (TAPS - 1) / found_fps:.0f} ms back in place of {1000 * (TAPS - 1) / taps_fps:.0f}"
        )


def _prediction(performance: Performance, footage: Footage, *, gaze: bool) -> Prediction:
    """The performance as the tables take it; there are no landmarks behind it."""
    frames = Frames(
        points=np.full((len(footage.numbers), LANDMARK_COUNT, 2), np.nan),
        labels=tuple(map(str, footage.numbers)),
        time_s=footage.time_s,
        source=footage.source,
    )
    prediction = Prediction(weights=performance.weights, frames=frames, names=performance.names)
    if not gaze:
        return prediction
    columns = np.hstack([performance.weights, np.degrees(performance.gaze)])
    return dataclasses.replace(prediction, weights=columns, names=(*performance.names, *GAZE_COLUMNS))


def _write(
    performance: Performance,
    footage: Footage,
    table_format: Format,
    out: Path | None,
    gltf: Path | None,
    trust: Path | None,
) -> None:
    plain = _prediction(performance, footage, gaze=False)
    if trust is not None:
        write_confidence(plain, performance.confidence, trust)
    if gltf is not None:
        write_avatar(plain, gltf, out)
    elif table_format is Format.livelink:
        write_table(plain, table_format, out, rotations=_rotations(performance.gaze))
    else:
        write_table(_prediction(performance, footage, gaze=True), table_format, out)


def _rotations(gaze: np.ndarray) -> np.ndarray:
    """Live Link's nine angles (n, 9) in radians: none of the head, and the eyes' with the app's signs.

    In its recordings an eye's yaw is -0.60 times lookOut less lookIn of the left eye, and pitch -0.56 times
    lookUp less lookDown (4,030 frames of one take, correlations of .996 and more).
    """
    angles = np.zeros((len(gaze), 9))
    angles[:, [3, 4, 6, 7]] = -gaze
    return angles


def _rate(time_s: np.ndarray) -> float:
    return 1 / float(np.median(np.diff(time_s))) if len(time_s) > 1 else ASSUMED_FPS
