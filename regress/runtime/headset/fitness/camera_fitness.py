"""How one camera's frames fit: what was measured, where the eye or the mouth lies, and what is wrong."""

from dataclasses import dataclass

from regress.runtime.headset.fitness.misfits import Finding
from regress.runtime.headset.pictures.looks import TakeLooks
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.found_placement import FoundPlacement


@dataclass(frozen=True, kw_only=True)
class CameraFitness:
    """How a camera's frames fit.

    Parameters
    ----------
    camera
        Its name.
    looks
        Of its frames where the network looks, levels as they are; None of too few.
    found
        Where the network finds the eye or the mouth; None where it traces neither, or in too few frames.
    placement
        What `predict` should take, levels included.
    findings
        What is wrong; none where the frames fit.
    """

    camera: str
    looks: TakeLooks | None
    found: FoundPlacement | None
    placement: CameraPlacement
    findings: tuple[Finding, ...]
