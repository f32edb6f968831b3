"""Tells a person of faulty lines of a stream."""

from collections.abc import Callable

from regress.runtime.inputs import Fault


class FaultRuns:
    """Tells of faulty lines run by run, so that a face that is away for a minute is one sentence.

    Parameters
    ----------
    say
        Told of each run when it ends.
    """

    def __init__(self, say: Callable[[str], None]) -> None:
        self._say = say
        self._fault: Fault | None = None
        self._first = 1

    def step(self, number: int, fault: Fault | None) -> None:
        """Take the fault of a line into account; lines are counted from 1."""
        if fault is not self._fault:
            if self._fault is not None:
                lines = (
                    f"line {self._first} has"
                    if number == self._first + 1
                    else (f"lines {self._first}-{number - 1} have")
                )
                self._say(f"{lines} {self._fault.value}")
            self._fault, self._first = fault, number
