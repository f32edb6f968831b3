"""Lists the networks that `regress headset train` trains. A new one is a module and an entry here."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Architecture:
    """A way from the cameras' part codes to weights and gaze.

    Parameters
    ----------
    network
        ``module:class`` of a ``HeadsetNetwork``, imported to train it only: naming it takes no PyTorch.
    help
        For the command line.
    """

    network: str
    help: str


ARCHITECTURES: dict[str, Architecture] = {
    "modular": Architecture(
        network="regress.learning.headset.training.modular:ModularNetwork",
        help="a network per camera, blended per weight",
    ),
    "holistic": Architecture(
        network="regress.learning.headset.training.holistic:HolisticNetwork",
        help="one network that sees all cameras",
    ),
}
