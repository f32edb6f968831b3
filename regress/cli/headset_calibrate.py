"""``regress headset calibrate``: a guided minute in, a person's own ends of every range out."""

from pathlib import Path
from typing import Annotated

import typer

from regress.cli.headset_faces import (
    BrowsUp,
    Cheeks,
    JawOpen,
    LipsRolled,
    Look,
    Placement,
    Pucker,
    Rest,
    Shut,
    Smile,
    Take,
    Wide,
)
from regress.cli.options import (
    BitsOption,
    FpsOption,
    FromStartOption,
    HeadsetOption,
    LeftEyeOption,
    MouthOption,
    RightEyeOption,
)
from regress.errors import InputError


def calibrate(
    model: Annotated[
        str, typer.Argument(metavar="[MODEL]", help="Model folder, or a ready-made model's name.")
    ] = "",
    out: Annotated[
        Path | None, typer.Option("--out", help="The person's file to write, for `predict --person`.")
    ] = None,
    rest: Rest = None,
    shut: Shut = None,
    wide: Wide = None,
    jaw_open: JawOpen = None,
    lips_rolled: LipsRolled = None,
    smile: Smile = None,
    cheeks: Cheeks = None,
    brows_up: BrowsUp = None,
    pucker: Pucker = None,
    look: Look = None,
    looked_at: Annotated[
        list[str] | None,
        typer.Option(
            "--looked-at",
            metavar="FRAME:YAW:PITCH",
            help="What was looked at in a frame of --look, in degrees to the person's left and upwards. Without any, "
            "the middle of all glances lies ahead.",
        ),
    ] = None,
    distance_m: Annotated[
        float,
        typer.Option(
            "--distance-m", min=0.05, max=1000, help="How far away what was looked at lies; far by default."
        ),
    ] = 1000.0,
    camera: Take = None,
    left_eye: LeftEyeOption = None,
    right_eye: RightEyeOption = None,
    mouth: MouthOption = None,
    from_start: FromStartOption = False,
    fps: FpsOption = None,
    bits: BitsOption = None,
    placement: Placement = None,
    headset: HeadsetOption = None,
) -> None:
    """Find a person's own ends of each range in a guided minute: rest becomes 0, full movements become 1.

    Faces are folders with a film or a folder of pictures for each camera (left_eye, right_eye, mouth), or frames
    FIRST-LAST of one take that is given by --left-eye, --right-eye and --mouth.

    Example: regress headset calibrate --rest minute/rest --shut minute/shut --jaw-open minute/jaw --out anna.json
    """
    from dataclasses import replace

    from facegen.console import say
    from facegen.files import refuse_ending
    from regress.cli.headset_input import told_of
    from regress.cli.headset_minute import read_minute
    from regress.runtime.headset.guided.minute import person_of
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.headset.person.person import seen_as, write_person
    from regress.runtime.ready_made import HEADSET

    if out is None:
        raise InputError("--out is needed: the person's file, as anna.json")
    refuse_ending(out, ".json", what="a person's file")
    predictor = told_of(load_headset_predictor(model or HEADSET), headset)
    minute = read_minute(
        predictor,
        (rest, shut, wide, jaw_open, lips_rolled, smile, cheeks, brows_up, pucker, look),
        camera or [],
        {"left_eye": left_eye, "right_eye": right_eye, "mouth": mouth},
        looked_at=looked_at or [],
        distance_m=distance_m,
        from_start=from_start,
        fps=fps,
        bits=bits,
        placement=placement,
    )
    for note in minute.notes:
        say(note)
    person, notes = person_of(predictor, minute.takes, unlevelled=minute.unlevelled)
    for note in notes:
        say(note)
    write_person(out, replace(person, seen_as=seen_as(minute.places, predictor.graph.told_table)))
    said = ", ".join(f"{name} {value:.2f}" for name, value in person.full.items())
    learned = [f"a full movement reads {said}"] if said else []
    learned += [
        f"gaze of {name} is off its targets by {eye.error_deg:.1f} degrees"
        if looked_at
        else f"gaze of {name} is centred"
        for name, eye in person.eyes.items()
        if eye.direct is not None
    ]
    told = ", ".join(learned) or "only the face at rest was learned from"
    say(f"{out}: {told}; give it to `regress headset predict --person {out}`")
