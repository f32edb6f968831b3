"""Defines how trainings report their progress, and joins the stages of one training into one."""

import threading
from collections.abc import Callable, Mapping

Progress = Callable[[str, int, int], None]
"""Called with the stage's name, steps done and steps at most; from any thread."""

PARTS = 100
"""A joined progress counts them: per cent."""


def joined(
    progress: Progress | None, work: Mapping[str, float], *, name: str = "training"
) -> Progress | None:
    """One progress of all stages, in per cent of the whole work; it never goes back.

    Parameters
    ----------
    progress
        Is told of `PARTS`; None stays None.
    work
        How much each stage has to do, in any unit: what is told of time left rests on it. A stage that ends early is
        done.
    name
        What the whole is called.
    """
    if progress is None:
        return None
    whole, shares, told, lock = sum(work.values()), dict.fromkeys(work, 0.0), [-1], threading.Lock()

    def tell(stage: str, done: int, total: int) -> None:
        with lock:
            shares[stage] = work[stage] * done / total
            part = int(PARTS * sum(shares.values()) / whole + 1e-9)
            if part > told[0]:
                told[0] = part
                progress(name, part, PARTS)

    return tell
