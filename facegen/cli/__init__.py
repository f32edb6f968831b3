"""Defines the ``facegen`` command. Only this package prints: results to stdout, talk to stderr.

A command imports what it needs when it is called, so that ``--help`` is quick and needs none of the extras.
"""

from facegen.cli.blend import blend
from facegen.cli.develop import develop
from facegen.cli.farm import farm_app
from facegen.cli.generate import generate
from facegen.cli.headset import headset_app
from facegen.cli.merge import merge
from facegen.cli.pack import pack
from facegen.cli.preview import preview
from facegen.cli.rig import rig_app
from facegen.cli.spec import spec_app
from facegen.cli.validate import validate
from facegen.extras import FACTORY
from facegen.program import program, run

app = program(
    "facegen",
    about="Synthetic people with exact labels: face keypoints by the million, and what cameras in a VR headset see.",
    libraries=("bpy", "numpy", "pyarrow"),
)
app.add_typer(rig_app, name="rig")
app.add_typer(headset_app, name="headset")
app.add_typer(spec_app, name="spec")
app.add_typer(farm_app, name="farm")
app.command()(generate)
app.command()(validate)
app.command()(preview)
app.command()(pack)
app.command()(merge)
app.command()(develop)
app.command()(blend)


def main() -> None:
    """Entry point of the console script."""
    run(app, extras=(FACTORY,))
