"""Settings of One-Euro smoothing, which the command line needs before NumPy."""

from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class OneEuro:
    """Settings of a One-Euro filter (G. Casiez, N. Roussel, D. Vogel, CHI 2012).

    Parameters
    ----------
    cutoff_hz
        Of a weight at rest: lower is calmer.
    beta
        Hz more for each unit of weight a second: higher follows quick moves sooner.
    speed_cutoff_hz
        Of the speed's own low pass.
    """

    cutoff_hz: float = 1.0
    beta: float = 2.0
    speed_cutoff_hz: float = 1.0
