"""``regress headset``: networks that see the pictures of a headset's cameras."""

import typer

from regress.cli.headset_adapt import adapt
from regress.cli.headset_calibrate import calibrate
from regress.cli.headset_check import check
from regress.cli.headset_compass import compass
from regress.cli.headset_evaluate import evaluate
from regress.cli.headset_export import export
from regress.cli.headset_predict import predict
from regress.cli.headset_report import report
from regress.cli.headset_temporal import temporal
from regress.cli.headset_train import train

headset = typer.Typer(
    name="headset",
    help="The pictures of a headset's cameras in, 52 avatar blendshape weights and the gaze out.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"]},
)
headset.command()(train)
headset.command()(evaluate)
headset.command()(temporal)
headset.command()(predict)
headset.command()(check)
headset.command()(calibrate)
headset.command()(adapt)
headset.command()(report)
headset.command()(export)
headset.command()(compass)
