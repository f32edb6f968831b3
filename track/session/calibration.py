"""Asks a person for faces, one after another, and judges what came: a state machine of times in and steps out.

::

    countdown ─► recording ─► done ─► countdown of the next face … ─► finished
                     └─► again (why) ─► countdown of the same face; after `TRIES` the face is left as it was

Nothing here knows cameras, models or pages; the first second of anything is never taken for a neutral face.
"""

from collections.abc import Sequence

import numpy as np

from regress.runtime.sample import Sample
from track.messages import Step
from track.session.faces import FACES
from track.session.showing import FEWEST_FRAMES, LONGEST_S, SEEN_SHARE, Frame, Outcome, Showing

FIRST_COUNTDOWN_S, COUNTDOWN_S = 3.0, 2.0
"""Before the first face, and before others: who has just read a sentence needs less."""

RECORDING_S = {"neutral": 2.0, "look_around": 5.0}
OTHERS_RECORDING_S = 1.5
"""Of the neutral face 60 frames, whose median is good to a tenth of the noise; to look all around takes five seconds,
and grimaces are hard to hold."""

TOLD_S, TOLD_AGAIN_S = 0.7, 2.0
"""How long a result stays, and a reason, which must be read."""

TRIES = 3
"""Of one face."""


class Calibration:
    """Goes through faces as time passes.

    Parameters
    ----------
    names
        Keys of `FACES`.
    least
        Movement of a signature that counts, in the signature's unit (`steadiness`).
    """

    def __init__(self, names: Sequence[str], *, least: float) -> None:
        self._names, self._least = tuple(names), least
        self._number, self._tries, self._over = 0, 0, False
        self._state, self._until_s, self._text, self._last_reason = "", 0.0, "", ""
        self._frames: list[Frame] = []
        self._missed, self._began_s, self._slow = 0, 0.0, False
        self._outcomes: list[Outcome] = []
        self.kept: list[str] = []
        """Names of faces that gave something."""

    @property
    def finished(self) -> bool:
        """Whether there is no face left to ask for."""
        return self._over

    @property
    def name(self) -> str:
        """Of the face that is asked for; of the last one at the end."""
        return self._names[self._number]

    def outcomes(self) -> list[Outcome]:
        """What has been found since this was last asked."""
        found, self._outcomes = self._outcomes, []
        return found

    def cancel(self) -> Step:
        """End it; what was found before stays."""
        self._over = True
        return Step(
            name=self.name, state="cancelled", text="Stopped; what was calibrated before stays as it was"
        )

    def step(self, time_s: float, sample: Sample, signature: np.ndarray | None) -> Step:
        """Where it is at a frame's time.

        Parameters
        ----------
        sample
            Before the person's ranges; without weights where no picture came, as slow cameras have it between two. NaN
            are weights that no camera saw; ``faults`` names the cameras that gave nothing.
        signature : (k,) float64 or None
            What of the frame must keep still; None where there is no face.
        """
        if not self._state:
            self._count_down(time_s, FIRST_COUNTDOWN_S)
        if self._state == "recording":
            if sample.weights is not None:
                self._record(sample, signature)
            self._wait_for_slow_pictures(time_s)
        if time_s >= self._until_s:
            self._go_on(time_s)
        left = max(0.0, self._until_s - time_s)
        return Step(name=self.name, state=self._state, seconds_left=left, text=self._text)

    def _record(self, sample: Sample, signature: np.ndarray | None) -> None:
        if signature is None or np.isnan(sample.weights).all():
            self._missed += 1
        else:
            self._frames.append((sample, signature))

    def _wait_for_slow_pictures(self, time_s: float) -> None:
        """Go on where too few have come, unless they came without a face; end as soon as there are enough."""
        count, came = len(self._frames), len(self._frames) + self._missed
        wanted = count < FEWEST_FRAMES and SEEN_SHARE * came < FEWEST_FRAMES
        if self._slow and not wanted:
            self._until_s = time_s
        elif wanted and time_s >= self._until_s:
            each_s = (time_s - self._began_s) / max(1, came)
            until_s = min(time_s + each_s * (FEWEST_FRAMES - count), self._began_s + LONGEST_S)
            self._slow, self._until_s = True, until_s
            self._text = f"{FACES[self.name].text}, a little longer: pictures come slowly"

    def _count_down(self, time_s: float, seconds: float) -> None:
        self._state, self._until_s, self._text = "countdown", time_s + seconds, FACES[self.name].text

    def _go_on(self, time_s: float) -> None:
        if self._state == "countdown":
            self._state, self._text = "recording", FACES[self.name].text
            self._until_s = time_s + RECORDING_S.get(self.name, OTHERS_RECORDING_S)
            self._frames, self._missed, self._began_s, self._slow = [], 0, time_s, False
        elif self._state == "recording":
            self._judge(time_s)
        elif self._state == "again" and self._tries < TRIES:
            self._count_down(time_s, COUNTDOWN_S)
        elif self._number + 1 < len(self._names) and not (self._state == "again" and self.name == "neutral"):
            self._number, self._tries = self._number + 1, 0
            self._count_down(time_s, COUNTDOWN_S)
        else:
            self._end()

    def _end(self) -> None:
        self._over = True
        if self.kept:
            self._state, self._text = "done", "All done" if len(self._names) > 1 else "Done"
        else:
            self._state = "failed"
            self._text = f"{self._last_reason}, so nothing was calibrated; everything stays as it was"

    def _judge(self, time_s: float) -> None:
        self._tries += 1
        shown = Showing(self.name, self._frames, missed=self._missed)
        reason = shown.reason(self._least)
        if reason is None:
            self._state, self._until_s = "done", time_s + TOLD_S
            self._text = f"Good, without {shown.missing}" if shown.missing else "Good"
            self._outcomes.append(shown.outcome())
            self.kept.append(self.name)
            return
        if shown.unseen:
            self._tries = TRIES  # to show it again does not help
        self._state, self._until_s, self._last_reason = "again", time_s + TOLD_AGAIN_S, reason
        last = self._tries >= TRIES
        self._text = f"{reason}; it stays as it was" if last else f"{reason}; once more"
