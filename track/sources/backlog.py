"""Pictures that nobody took yet: they wait in line for a moment, so that a pause of the machine loses none."""

from collections import deque
from collections.abc import Mapping
from itertools import accumulate
from statistics import median

from track.sources.source import Picture

LONGEST_S = 0.05
"""Pictures wait in line for so long at most, and only for a reader who found the line empty no longer ago: a pause is
caught up, and who is always behind gets the newest picture alone, no later than without a line."""

_TOGETHER = 0.75
"""Of the time from one picture to the next, by which pictures of two cameras may differ that go together. More than a
half: two cameras that are half a step apart would else make two samples of each moment."""

_STEPS = 9
"""Whose median is a camera's: some are too long where a picture was lost, or too short behind a pause."""

_GAPS_WITHIN_S, _MOST_GAPS = 3.0, 512
"""Of the latest pictures, whose gaps say how long the next one may take: Wi-Fi holds bursts of them back for up to a
second, and within a burst many come at once."""

_GAP_SHARE = 0.8
"""Of that time, which passed in gaps as long or shorter. By their number the long ones are few: one a burst."""


class Backlog:
    """What one camera gave and nobody took, the oldest first; when it came is by ``time.perf_counter``.

    Parameters
    ----------
    step_s
        From one picture to the next, where it is known before they come.
    """

    def __init__(self, step_s: float | None = None) -> None:
        self._waiting: deque[tuple[float, Picture]] = deque()
        self._steps_s: deque[float] = deque([] if step_s is None else [step_s], maxlen=_STEPS)
        self._gaps_s = deque(self._steps_s, maxlen=_MOST_GAPS)
        self._gap_s: float | None = None
        self._last_s: float | None = None
        self._last_came_s: float | None = None

    def __len__(self) -> int:
        return len(self._waiting)

    @property
    def came_s(self) -> float:
        """When the first picture in line came."""
        return self._waiting[0][0]

    @property
    def time_s(self) -> float:
        """When it was taken, by the camera's clock."""
        return self._waiting[0][1].time_s

    @property
    def step_s(self) -> float:
        """From one picture to the next, lately; infinite where it is not known yet."""
        return median(self._steps_s) if self._steps_s else float("inf")

    @property
    def gap_s(self) -> float:
        """What it lets pass without a picture, lately: its step, or from burst to burst; infinite as `step_s`.

        One stall is no manner of coming: the longest gap does not count.
        """
        gap_s = self._gap_s  # another thread may forget it meanwhile
        if gap_s is None:
            gaps_s = sorted(self._gaps_s)
            gaps_s = gaps_s[:-1] or gaps_s
            enough_s = _GAP_SHARE * sum(gaps_s)
            passed_s = accumulate(gaps_s)
            self._gap_s = gap_s = next(
                (each_s for each_s, until_s in zip(gaps_s, passed_s, strict=True) if until_s >= enough_s),
                float("inf"),
            )
        return gap_s

    @property
    def together_s(self) -> float:
        """By how much a picture of another camera may differ that goes with one of this."""
        return _TOGETHER * self.step_s

    @property
    def due_s(self) -> float:
        """When the next picture should come; at once, where its step is not known yet."""
        if self._last_came_s is None or not self._steps_s:
            return float("-inf")
        return self._last_came_s + self.step_s

    def add(self, picture: Picture, came_s: float) -> None:
        """Put a picture at the end; those that came more than `LONGEST_S` before it go."""
        if self._last_s is not None:
            self._steps_s.append(picture.time_s - self._last_s)
            self._gaps_s.append(self._steps_s[-1])
            while len(self._gaps_s) > 1 and sum(self._gaps_s) > _GAPS_WITHIN_S:
                self._gaps_s.popleft()
            self._gap_s = None
        self._last_s, self._last_came_s = picture.time_s, came_s
        while self._waiting and self.came_s < came_s - LONGEST_S:
            self._waiting.popleft()
        self._waiting.append((came_s, picture))

    def take(self) -> Picture:
        """The first picture in line, once."""
        return self._waiting.popleft()[1]

    def leave_newest(self) -> None:
        """Let all go but the picture that came last."""
        while len(self._waiting) > 1:
            self._waiting.popleft()

    def clear(self) -> None:
        """Let all go: the camera went away."""
        self._waiting.clear()
        self._last_s = self._last_came_s = None


def of_one_moment(backlogs: Mapping[str, Backlog]) -> list[str]:
    """Names of those whose first pictures go together: the earliest one's, and all that were taken or came beside it.

    So a camera that lost a picture is waited for by its next one, and does not run ahead of the others from then on.

    Parameters
    ----------
    backlogs
        By the camera's name; none is empty.
    """
    first = min(backlogs.values(), key=lambda each: each.time_s)
    return [
        name
        for name, each in backlogs.items()
        if min(each.time_s - first.time_s, abs(each.came_s - first.came_s)) <= first.together_s
    ]
