"""``regress headset check``: whether a headset's frames fit a model, and where in them to look."""

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from regress.cli.options import BitsOption, CameraOption, LeftEyeOption, MouthOption, RightEyeOption
from regress.errors import InputError

if TYPE_CHECKING:
    import numpy as np

    from regress.runtime.headset.fitness.camera_fitness import CameraFitness
    from regress.runtime.headset.network.predictor import HeadsetPredictor


def check(
    model: Annotated[
        str, typer.Argument(metavar="[MODEL]", help="Model folder, or a ready-made model's name.")
    ] = "",
    camera: CameraOption = None,
    left_eye: LeftEyeOption = None,
    right_eye: RightEyeOption = None,
    mouth: MouthOption = None,
    bits: BitsOption = None,
    out: Annotated[
        Path | None, typer.Option("--out", help="Placement to write: TOML for `predict --placement`.")
    ] = None,
    sheet: Annotated[
        Path | None,
        typer.Option("--sheet", help="Picture (PNG) to write: frames, what the network sees and traces."),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Findings and figures for programs.")] = False,
) -> None:
    """Say whether a headset's unlabelled frames are such as the model was trained on, and how to make them so.

    Give 100 to 300 frames in which the person looks around and blinks. Levels, focus, flicker, a lens's rim, exchanged
    and mirrored cameras are judged by the pictures; where the eye lies by the points that the network traces.

    Example: regress headset check --left-eye take/left_eye --right-eye take/right_eye --out placement.toml
    """
    from facegen.console import say
    from facegen.files import refuse_ending, write_whole
    from regress.cli.headset_checked import checked_footage, recorded_aspect
    from regress.cli.headset_input import camera_paths
    from regress.runtime.headset.fitness.fitness import judge
    from regress.runtime.headset.fitness.sheet import fitness_sheet
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.headset.placing.placement_file import Placement, write_placement
    from regress.runtime.ready_made import HEADSET

    if sheet is not None:
        refuse_ending(sheet, ".png", what="a sheet", option="--sheet")
    if out is not None:
        refuse_ending(out, ".toml", what="a placement")
    chosen = model or HEADSET
    predictor = load_headset_predictor(chosen)
    short = {"left_eye": left_eye, "right_eye": right_eye, "mouth": mouth}
    paths = camera_paths(
        predictor, camera or [], {name: path for name, path in short.items() if path is not None}
    )
    if not paths:
        raise InputError(
            f"give the cameras' paths ({', '.join(predictor.sizes)}), as --left-eye take/left_eye"
        )
    _refuse_recorded(paths.values(), {"--sheet": sheet, "--out": out})
    footage = checked_footage(paths, bits=bits)
    judged = judge(predictor, footage)
    for one in judged:
        lines = [finding.sentence for finding in one.findings]
        if not as_json:
            for line in lines or [_fits(one, predictor, footage[one.camera])]:
                typer.echo(line)
    if as_json:
        typer.echo(
            json.dumps(
                {
                    one.camera: {
                        "fits": not one.findings,
                        "findings": [
                            {"misfit": finding.misfit.name.lower(), "sentence": finding.sentence}
                            for finding in one.findings
                        ],
                        "looks": None if one.looks is None else vars(one.looks),
                        "placement": vars(one.placement),
                    }
                    for one in judged
                },
                indent=1,
                allow_nan=False,
            )
        )
    seen = [one for one in judged if one.looks is not None]
    if out is not None:
        cameras = {
            one.camera: replace(one.placement, aspect=recorded_aspect(footage[one.camera])) for one in seen
        }
        found_with = predictor.model
        write_placement(
            out,
            Placement(
                cameras=cameras,
                model=chosen,
                headset=found_with.headset,
                network_sha256=found_with.network_sha256,
            ),
        )
        say(f"placement in {out}{_what_next(predictor, seen, footage, out)}")
    if sheet is not None:
        write_whole(sheet, fitness_sheet(predictor, footage, seen))
        say(f"sheet in {sheet}")


def _fits(one: "CameraFitness", predictor: "HeadsetPredictor", pictures: "np.ndarray") -> str:
    """That nothing is wrong, as far as anybody looked."""
    judged = one.camera in predictor.typical and _is_taken(pictures, predictor.sizes[one.camera])
    if one.found is None and not judged:
        return f"{one.camera}: its light fits; how it lies is not judged, so look at --sheet"
    return f"{one.camera}: its frames fit"


def _is_taken(pictures: "np.ndarray", view: tuple[int, int]) -> bool:
    """Whether `predict` takes pictures (n, h, w) without a placement."""
    from regress.runtime.headset.pictures.picture_file import has_shape_of, whole_of_shape

    size = pictures.shape[2], pictures.shape[1]
    return has_shape_of(size, view) or whole_of_shape(size, view) is not None


def _what_next(
    predictor: "HeadsetPredictor",
    judged: "Sequence[CameraFitness]",
    footage: "Mapping[str, np.ndarray]",
    out: Path,
) -> str:
    """What to do with a placement that was written."""
    from regress.runtime.headset.fitness.misfits import Misfit
    from regress.runtime.headset.pictures.placement import whole_view

    placed = False
    for one in judged:
        pictures, view = footage[one.camera], predictor.sizes[one.camera]
        whole = replace(whole_view((pictures.shape[2], pictures.shape[1]), view), aspect=None)
        placed |= one.placement != whole or not _is_taken(pictures, view)
    if placed:
        return f"; look at --sheet, then give it to `regress headset predict --placement {out}`"
    if any(found.misfit in (Misfit.TURNED, Misfit.LOST) for one in judged for found in one.findings):
        return (
            ": all of each picture, as nothing better was found; mend what is said above, and look at --sheet"
        )
    return ": all of each picture, as without it, so predict needs none; look at --sheet"


def _refuse_recorded(recordings: Iterable[Path], written: dict[str, Path | None]) -> None:
    """Refuse to write over what is read: films, and pictures in folders."""
    from facegen.files import refuse_sources
    from regress.runtime.headset.pictures.halves import whole_of

    paths = [*recordings, *map(whole_of, recordings)]
    read = [file for path in paths for file in (path.iterdir() if path.is_dir() else [path])]
    for option, path in written.items():
        if path is not None:
            refuse_sources(path, read, option=option)
