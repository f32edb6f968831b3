"""Defines ``facegen headset list | show | preview``."""

import dataclasses
import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from facegen.console import say

if TYPE_CHECKING:
    from facegen.headsets import Headset

headset_app = typer.Typer(
    no_args_is_help=True,
    help="Headsets: cameras, LEDs, sensor and fit. Example: facegen headset show tracking3",
)


@headset_app.command(name="list")
def list_() -> None:
    """Print the headsets that come with facegen, with what each is.

    Example: facegen headset list
    """
    from facegen.headsets import list_headsets, load_headset

    for name in list_headsets():
        typer.echo(f"{name:12} {load_headset(name).description}")


@headset_app.command()
def show(
    name: Annotated[str, typer.Argument(help="Name of a headset, or the path of a .toml file")],
    as_json: Annotated[
        bool, typer.Option("--json", help="As JSON, defaults filled in, for programs")
    ] = False,
) -> None:
    """Check a headset file and print what it says.

    Example: facegen headset show tracking3 --json
    """
    from pydantic import TypeAdapter

    from facegen.headsets import Headset, headset_path, load_headset

    headset = load_headset(name)
    if as_json:
        typer.echo(json.dumps(TypeAdapter(Headset).dump_python(headset, mode="json"), indent=2))
        return
    typer.echo(f"{headset.name}: {headset.description}\n{headset_path(name)}\n")
    wide = max(12, *(len(name) for name in headset.camera_names))
    typer.echo(f"{'camera':{wide}} {'model':8} {'size':>9} {'field':>6}  {'position mm':22} LEDs")
    for camera in headset.cameras:
        leds = [led for led in headset.leds if led.camera == camera.name]
        wavelengths = ", ".join(sorted({f"{led.wavelength_nm:g} nm" for led in leds}))
        light = f"{len(leds)} of {wavelengths}" if leds else "none"
        size = f"{camera.width}x{camera.height}"
        place = ", ".join(f"{value:.1f}" for value in camera.position_mm)
        field = f"{field_of_view_deg(headset, camera.name):.0f}°"
        typer.echo(f"{camera.name:{wide}} {camera.model:8} {size:>9} {field:>6}  {place:22} {light}")
    typer.echo("")
    for occluder in headset.occluders:
        place = ", ".join(f"{value:g}" for value in occluder.position_mm)
        typer.echo(f"{'occluder':12} {occluder.name}, a {occluder.shape} at {place} mm")
    for key, value in dataclasses.asdict(headset.sensor).items():
        typer.echo(f"{'sensor':12} {key} {value:g}")
    typer.echo(f"{'fit':12} nose bridge at {', '.join(f'{v:g}' for v in headset.fit.nose_bridge_mm)} mm")
    for key, value in dataclasses.asdict(headset.tolerances).items():
        spread = ", ".join(f"{v:g}" for v in value) if isinstance(value, tuple) else f"{value:g}"
        typer.echo(f"{'tolerance':12} {key} ±{spread}")


@headset_app.command()
def preview(
    name: Annotated[str, typer.Argument(help="Name of a headset, or the path of a .toml file")],
    out: Annotated[Path, typer.Option("--out", help="PNG file to write")] = Path("headset.png"),
    rig: Annotated[str, typer.Option("--rig", help="Whose mean head wears it")] = "anny",
) -> None:
    """Draw cameras, LEDs and occluders round the mean head, and what each camera sees; without Blender.

    Example: facegen headset preview tracking3 --out tracking3.png
    """
    from facegen.files import refuse_ending, whole_file
    from facegen.headsets import headset_path, load_headset
    from facegen.preview.headsets import draw_headset
    from facegen.preview.wearer import placement_faults, put_on
    from facegen.rigs import load_rig

    refuse_ending(out, ".png", what="a picture")
    headset, wearing = load_headset(name), load_rig(rig)
    figure = draw_headset(headset, wearing)
    with whole_file(out, suffix=".png") as part:
        figure.savefig(part, metadata={"Software": None}, pil_kwargs={"optimize": True})
    for fault in placement_faults(put_on(headset, wearing)):
        say(f"{headset_path(name)}: {fault}")
    typer.echo(out)


def field_of_view_deg(headset: "Headset", camera_name: str) -> float:
    """Horizontal field of view through the middle of the picture, edge to edge."""
    import numpy as np

    from facegen.geometry import unproject

    camera = headset.camera(camera_name).camera
    middle = (camera.height - 1) / 2
    left, right = unproject(camera, np.array([[-0.5, middle], [camera.width - 0.5, middle]]))
    return float(np.degrees(np.arccos(np.clip(left @ right, -1.0, 1.0))))
