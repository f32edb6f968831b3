"""Levenberg-Marquardt for many small least-squares problems at once."""

from regress.learning.levenberg_marquardt.evidence import (
    EVIDENCE_ROUNDS,
    EVIDENCE_STEPS,
    minimise_with_evidence,
)
from regress.learning.levenberg_marquardt.minimise import Outcome, Result, Settings, minimise
from regress.learning.levenberg_marquardt.problem import LeastSquares, State
from regress.learning.levenberg_marquardt.steps import exact_step, pcg_step

__all__ = [
    "EVIDENCE_ROUNDS",
    "EVIDENCE_STEPS",
    "LeastSquares",
    "Outcome",
    "Result",
    "Settings",
    "State",
    "exact_step",
    "minimise",
    "minimise_with_evidence",
    "pcg_step",
]
