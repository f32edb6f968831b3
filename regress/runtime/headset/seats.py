"""Whether the headset still sits as it did when the neutral pictures were taken."""

import numpy as np

PATIENCE_S = 0.5
"""How long the running mean must say that the seat has changed: a blink or a shaken head is shorter."""


def seat_change(same_seat: np.ndarray, usable: np.ndarray, *, fps: float) -> int | None:
    """Row from which the seat is no longer that of the neutral pictures; None where it stays.

    A running mean over `PATIENCE_S` that is below one half for as long tells a new seat; it counts from the
    frame at which the mean fell. A take of less than twice as long is judged by the mean of all, from its first frame
    below one half on. A headset that comes back to its old seat exactly does not happen.

    Parameters
    ----------
    same_seat : (n,) float
        Probabilities by the network.
    usable : (n,) bool
        Frames that have pictures to judge by; others are left out.
    fps
        Frames a second.
    """
    rows = np.flatnonzero(usable)
    window = max(1, round(PATIENCE_S * fps))
    if len(rows) < 2 * window:  # too short for a running mean: judged as a whole
        changed = same_seat[rows] < 0.5
        return int(rows[np.argmax(changed)]) if len(rows) and float(np.mean(same_seat[rows])) < 0.5 else None
    sums = np.cumsum(np.concatenate([[0.0], same_seat[rows].astype(np.float64)]))
    mean = (sums[window:] - sums[:-window]) / window
    low = 0
    for place, value in enumerate(mean, start=window - 1):
        low = low + 1 if value < 0.5 else 0
        if low == window:
            began = place - window + 1
            if began > window - 1:
                return int(rows[began])
            # the first whole window is low already: so was what came before it, but for a neutral frame and its like
            return int(rows[np.argmax(same_seat[rows] < 0.5)])
    return None
