"""Levenberg-Marquardt for many small least-squares problems at once."""

from regress.levenberg_marquardt.evidence import EVIDENCE_ROUNDS, EVIDENCE_STEPS, minimise_with_evidence
from regress.levenberg_marquardt.minimise import Outcome, Result, Settings, minimise
from regress.levenberg_marquardt.problem import LeastSquares, State
from regress.levenberg_marquardt.steps import exact_step, pcg_step

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
