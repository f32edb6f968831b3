"""Levenberg-Marquardt for many small least-squares problems at once, without ever forming a Jacobian."""

from regress.levenberg_marquardt.minimise import Outcome, Result, Settings, minimise
from regress.levenberg_marquardt.problem import LeastSquares, State
from regress.levenberg_marquardt.steps import dual_step, pcg_step

__all__ = ["LeastSquares", "Outcome", "Result", "Settings", "State", "dual_step", "minimise", "pcg_step"]
