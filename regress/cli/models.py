"""``regress models``: the trained models that come with the package."""

import dataclasses
import json
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say


def models(
    as_json: Annotated[bool, typer.Option("--json", help="All of it for programs.")] = False,
    against: Annotated[
        list[str] | None,
        typer.Option(
            "--against",
            metavar="NAME=FOLDER",
            help="Say whether a model trained here has the same weights as the ready-made one of this name; exit "
            "code 1 where it has not.",
        ),
    ] = None,
    adopt: Annotated[
        bool, typer.Option("--adopt", help="Put the models of --against in the place of ready-made ones.")
    ] = False,
) -> None:
    """List the ready-made models: what they see, how good they are, their licence, size and place.

    Example: regress predict take.csv --model landmarks-default
    """
    from regress.errors import InputError
    from regress.model_card import describe_model
    from regress.runtime.ready_made import ready_made_models

    if against:
        differ = [not _same(*_pair(pair), adopt=adopt) for pair in against]
        raise typer.Exit(int(any(differ) and not adopt))
    if adopt:
        raise InputError("--adopt needs --against NAME=FOLDER, which says what to adopt")
    cards = [describe_model(name, folder) for name, folder in ready_made_models().items()]
    if as_json:
        typer.echo(json.dumps([{**dataclasses.asdict(card), "folder": str(card.folder)} for card in cards]))
        return
    for card in cards:
        typer.echo(
            f"{card.name}\n  sees      {card.sees}\n  figures   {card.figures}\n  licence   {card.licence}"
        )
        typer.echo(f"  size      {card.size_bytes / 1e6:.1f} MB\n  folder    {card.folder} (CARD.md)\n")


def _pair(text: str) -> tuple[str, Path]:
    from regress.errors import InputError

    name, sign, folder = text.partition("=")
    if not (sign and name and folder):
        raise InputError(f"--against {text!r} is not NAME=FOLDER, as landmarks-default=models/default")
    return name, Path(folder)


def _same(name: str, folder: Path, *, adopt: bool) -> bool:
    """Whether the weights are the ready-made model's, byte for byte; of which a line is printed."""
    from facegen.files import write_whole
    from regress.model_card import card_markdown, describe_model
    from regress.runtime.model import HEADSET
    from regress.runtime.ready_made import FOLDER, ready_made_models

    trained = describe_model(name, folder)
    shipped = ready_made_models().get(name)
    old = None if shipped is None else describe_model(name, shipped)
    same = old is not None and old.sha256 == trained.sha256
    described = same and (folder / "model.json").read_bytes() == (shipped / "model.json").read_bytes()
    notes = "" if described else "; model.json, which holds figures and versions too, differs" if same else ""
    typer.echo(f"{name}: {folder} has {'the same' if same else 'other'} weights ({trained.sha256}){notes}")
    if not same and old is not None:
        typer.echo(f"  ready-made ({old.sha256}): {old.figures}\n  trained here: {trained.figures}")
    if adopt and not described:
        numbers = "network.onnx" if trained.kind == HEADSET.name else "weights.npz"
        place = FOLDER / name
        place.mkdir(parents=True, exist_ok=True)
        for file in (numbers, "model.json"):
            write_whole(place / file, (folder / file).read_bytes())
        say(f"{name}: taken from {folder}")
    if adopt:
        write_whole(FOLDER / name / "CARD.md", card_markdown(name, FOLDER / name))
    return same
