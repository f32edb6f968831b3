"""The ``regress`` command. Only this package prints: results to stdout, talk to stderr.

A command imports what it needs when it is called, so that ``--help`` is quick and needs none of the extras.
"""

from facegen.extras import HEADSET, LEARN
from facegen.program import program, run
from regress.cli.bench import bench
from regress.cli.edges import edges
from regress.cli.evaluate import evaluate
from regress.cli.export import export
from regress.cli.headset import headset
from regress.cli.models import models
from regress.cli.predict import predict
from regress.cli.report import report
from regress.cli.train import train

app = program(
    "regress",
    about="68 facial landmarks or a headset's pictures in, 52 blendshape weights out, learnt from synthetic people.",
    libraries=("numpy", "onnxruntime", "scipy"),
)
app.command()(train)
app.command()(evaluate)
app.command()(predict)
app.command()(models)
app.command()(export)
app.command()(report)
app.command()(bench)
app.command()(edges)
app.add_typer(headset)


def main() -> None:
    """Entry point of the console script."""
    run(app, extras=(HEADSET, LEARN))
