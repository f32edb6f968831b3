"""Names the filters over time of what the networks say, which the command line needs before NumPy."""

from dataclasses import dataclass

from regress.runtime.stages.one_euro import OneEuro


@dataclass(frozen=True, kw_only=True)
class Mean:
    """Mean of a frame and its neighbours.

    Parameters
    ----------
    behind, ahead
        How many frames before and after it count.
    """

    behind: int
    ahead: int = 0


@dataclass(frozen=True, kw_only=True)
class Kalman:
    """Kalman filter of a weight that wanders, with the noise that it measures itself.

    Parameters
    ----------
    ahead_s
        Seconds of later frames that a frame waits for, where they are no further apart.
    lids_ahead_s
        Of these, seconds by which shapes of the lids are corrected; all of them by default. A blink is over in 0.2 s,
        and what is averaged with its opening loses height.
    """

    ahead_s: float
    lids_ahead_s: float | None = None


@dataclass(frozen=True, kw_only=True)
class Filter:
    """One entry of the table.

    Parameters
    ----------
    settings
        What it does.
    lag_ms
        Milliseconds by which a live stream's step from 0 to 1 comes to half its height later, waiting included: at 30
        and at 60 frames a second. Measured by ``benchmarks/bench_filters.py``; a test holds each entry to it.
    """

    settings: Mean | OneEuro | Kalman
    lag_ms: tuple[int, int]

    @property
    def needs_times(self) -> bool:
        """Whether every frame must have a time."""
        return not isinstance(self.settings, Mean)


FILTERS: dict[str, Filter] = {
    "mean4": Filter(settings=Mean(behind=3), lag_ms=(50, 25)),
    "mean7": Filter(settings=Mean(behind=3, ahead=3), lag_ms=(100, 50)),
    "one-euro": Filter(settings=OneEuro(), lag_ms=(7, 6)),
    "kalman-0": Filter(settings=Kalman(ahead_s=0.0), lag_ms=(0, 0)),
    "kalman-33": Filter(settings=Kalman(ahead_s=1 / 30), lag_ms=(33, 33)),
    "kalman-50": Filter(settings=Kalman(ahead_s=0.05), lag_ms=(33, 50)),
    "kalman-200": Filter(settings=Kalman(ahead_s=0.2, lids_ahead_s=1 / 30), lag_ms=(200, 200)),
}
"""By the name that ``--filter`` takes."""

DEFAULT_FILTER = "kalman-33"
"""The best of those that lag by 33 ms or less, at 30 and 60 frames a second (docs/measurements/real-recordings.md)."""

FILM_FILTER = "kalman-200"
"""Of a recording, which has no delay to save: r rises by up to 0.02 at 30 frames a second, and blinks stay as high."""
