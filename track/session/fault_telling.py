"""Tells each fault once, in words, when it begins; and holds what is wrong just now, for the page."""

from collections.abc import Callable, Mapping

FORGOTTEN_AFTER_S = 5.0
"""Seconds without a fault after which its return is news; a loose cable comes and goes within one."""


class FaultTelling:
    """Follows faults by what they concern.

    Parameters
    ----------
    tell
        Takes each sentence, once.
    """

    def __init__(self, tell: Callable[[str], None]) -> None:
        self._tell = tell
        self._last_s: dict[str, float] = {}
        self.counts: dict[str, int] = {}
        """How often each sentence was told."""
        self.now: tuple[str, ...] = ()
        """What is wrong just now."""

    def step(self, time_s: float, faults: Mapping[str, str]) -> None:
        """Take a frame's faults: a sentence by what it concerns."""
        self.now = tuple(faults.values())
        for sentence in faults.values():
            if time_s - self._last_s.get(sentence, -float("inf")) > FORGOTTEN_AFTER_S:
                self.counts[sentence] = self.counts.get(sentence, 0) + 1
                self._tell(sentence)
            self._last_s[sentence] = time_s
        for sentence in [
            each for each, last_s in self._last_s.items() if time_s - last_s > FORGOTTEN_AFTER_S
        ]:
            del self._last_s[sentence]
