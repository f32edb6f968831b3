"""``regress headset adapt``: a model whose last layers know one person, where frames suffice."""

from pathlib import Path
from typing import Annotated

import typer

from regress.cli.headset_faces import (
    BrowsUp,
    Cheeks,
    JawOpen,
    LipsRolled,
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


def adapt(
    model: Annotated[
        str, typer.Argument(metavar="[MODEL]", help="Model folder, or a ready-made model's name.")
    ] = "",
    out: Annotated[Path | None, typer.Option("--out", help="Model folder to write.")] = None,
    rest: Rest = None,
    shut: Shut = None,
    wide: Wide = None,
    jaw_open: JawOpen = None,
    lips_rolled: LipsRolled = None,
    smile: Smile = None,
    cheeks: Cheeks = None,
    brows_up: BrowsUp = None,
    pucker: Pucker = None,
    weights: Annotated[
        Path | None,
        typer.Option(
            "--weights",
            help="CSV with true weights of frames of the take, as `predict` writes them: of a person who follows an "
            "avatar whose weights are known.",
        ),
    ] = None,
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
    """Adapt a model's last layers to a person, where frames that were held out get better by it; refuse to else.

    Faces are named as `regress headset calibrate` takes them; each is held out in turn. With --weights frames of the
    take count too, held out in eight stretches. Calibrate again with the model that is written.

    Example: regress headset adapt headset-tracking3 --rest minute/rest --shut minute/shut --out models/anna
    """
    from dataclasses import replace

    import numpy as np

    from facegen.console import say
    from facegen.files import refuse_sources
    from facegen.headsets import told_cameras
    from regress.cli.headset_minute import read_minute
    from regress.learning.headset.adaptation import LEAST_GAIN, adapted_graph, changes, judge, read_heads
    from regress.learning.headset.known_frames import known_frames
    from regress.runtime.headset.network.folder import save_headset_model
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.model import HEADSET as KIND
    from regress.runtime.model import check_place
    from regress.runtime.ready_made import HEADSET, model_folder

    if out is None:
        raise InputError("--out is needed: a folder for the person's model")
    check_place(out, KIND)
    predictor = load_headset_predictor(model or HEADSET)
    terms = None if headset is None else told_cameras(headset, predictor.sizes)
    predictor = predictor if terms is None else predictor.told(terms)
    folder = model_folder(model or HEADSET)
    refuse_sources(out / "model.json", [folder / "model.json"])
    minute = read_minute(
        predictor,
        (rest, shut, wide, jaw_open, lips_rolled, smile, cheeks, brows_up, pucker),
        camera or [],
        {"left_eye": left_eye, "right_eye": right_eye, "mouth": mouth},
        from_start=from_start,
        fps=fps,
        bits=bits,
        placement=placement,
        labels=weights,
    )
    for note in minute.notes:
        say(note)
    pictures, neutral, frames = known_frames(predictor, minute.takes, minute.labels)
    graph = (folder / "network.onnx").read_bytes()
    heads = read_heads(graph, predictor.model, pictures, neutral, terms=terms)
    held = judge(heads, frames)
    said = f"known weights of held-out frames err by {held.before:.4f}, and by {held.after:.4f} when adapted"
    if not held.better:
        raise InputError(
            f"{said}: not {100 * LEAST_GAIN:g} % better, so nothing is written; more frames with --weights may help"
        )
    change = changes(heads, frames, np.arange(len(frames.fold)), pull=held.pull)
    trained, parent = predictor.model.training, predictor.model.network_sha256
    training = replace(trained, began_as=parent, adapted_from=(*trained.adapted_from, parent))
    adapted = replace(predictor.model, training=training)
    save_headset_model(adapted, adapted_graph(graph, heads, change), out, data=folder)
    say(f"{out}: {said}; `regress headset calibrate {out}` comes next")
