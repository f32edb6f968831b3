"""Scales values to SVG units and sets ticks, for the report's charts."""

import math
from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True, kw_only=True)
class Scale:
    """A stretch of a line that stands for a range of values.

    Parameters
    ----------
    low, high : float
        Values at the ends; both positive where ``logarithmic``.
    start, stop : float
        Where the ends lie, in SVG units.
    logarithmic : bool
    """

    low: float
    high: float
    start: float
    stop: float
    logarithmic: bool = False

    def __call__(self, value):
        """Place of a value (or of an array of them); values beyond the ends stay at the ends."""
        value = np.clip(value, self.low, self.high)
        if self.logarithmic:
            part = np.log(value / self.low) / math.log(self.high / self.low)
        else:
            part = (value - self.low) / (self.high - self.low)
        return self.start + part * (self.stop - self.start)

    def ticks(self, count: int = 5) -> list[float]:
        """Round values inside the range, about ``count`` of them."""
        return _log_ticks(self.low, self.high) if self.logarithmic else _ticks(self.low, self.high, count)


def _ticks(low: float, high: float, count: int) -> list[float]:
    rough = (high - low) / count
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(factor * power for factor in (1, 2, 2.5, 5, 10) if factor * power >= rough * 0.999)
    first = math.ceil(low / step - 1e-9)
    last = math.floor(high / step + 1e-9)
    return [round(index * step, 12) for index in range(first, last + 1)]


def _log_ticks(low: float, high: float) -> list[float]:
    decades = math.log10(high / low)
    if decades < 0.5:  # so short that equal steps look nearly even
        return _ticks(low, high, 5)
    factors = (1,) if decades > 3 else (1, 2, 5)
    powers = range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)
    values = [factor * 10.0**power for power in powers for factor in factors]
    return [value for value in values if low * 0.9999 <= value <= high * 1.0001]


def label(value: float) -> str:
    """A tick's text: as many digits as it has, a true minus sign."""
    return f"{value:.6g}".replace("-", "\N{MINUS SIGN}")


def figure(value: float) -> str:
    """A score with three decimals, an en dash where there is none, and no minus before zeros."""
    if math.isnan(value):
        return "\N{EN DASH}"
    text = f"{value:.3f}"
    return "0.000" if text == "-0.000" else text.replace("-", "\N{MINUS SIGN}")
