"""Does what a person asks for while frames come: calibration, mirror, gains and the gaze's centre, used and kept."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from regress.runtime.sample import Sample
from regress.runtime.stages.own_blinks import Ends, OwnBlinks
from track.messages import Command, Step
from track.profile.neutral import NeutralFace
from track.profile.profile import LARGEST_GAIN, Profile
from track.session.calibration import Calibration
from track.session.faces import faces_of
from track.session.outcomes import found_alone, learnt, neutral_shown
from track.session.person import Person, centre_of, other_side
from track.session.pipeline import Pipeline
from track.session.ranges import blinks_of, ends_of
from track.session.showing import Outcome

CENTRE_S = 0.5
"""Seconds of one look, whose median gaze is taken for straight ahead: a blink is shorter."""

BLINK_CHANGE = 0.02
"""Of a reading: blinks that differ by less from those of the profile's file are not worth writing it anew."""


class Adjusting:
    """A profile in use, and all that changes it.

    Parameters
    ----------
    pipeline
        From pictures to weights; told of the profile.
    profile
        Of the person and camera, as it is used.
    kept
        What the profile's file holds, where options go before that; `keep` is given each new one of it.
    keep
        Stores a profile that has changed, and returns at once: it is called between two frames.
    mirror
        Goes before the profile's.
    own_blinks
        Whether blinks are stretched by the person's own ones, where the profile says nothing of them.
    keep_found
        Whether the profile's file is given what nobody asked for: blinks, and the neutral face that a pipeline finds by
        itself. A film's are not kept: it gives the same answers each time.
    say
        Told what a person should know, a sentence each.
    say_end
        Told how calibration ended, which its `step` says as well.

    Attributes
    ----------
    profile
        As it is used now.
    person
        Makes the pipeline's answers this person's.
    step
        Where calibration is; None where there was none.
    """

    def __init__(
        self,
        pipeline: Pipeline,
        profile: Profile,
        *,
        kept: Profile | None,
        keep: Callable[[Profile], None],
        mirror: bool | None,
        own_blinks: bool,
        keep_found: bool,
        say: Callable[[str], None],
        say_end: Callable[[str], None],
    ) -> None:
        self.profile = profile
        self.step: Step | None = None
        self._blinks = OwnBlinks(say, before=ends_of(profile)) if own_blinks else None
        self._keeps_found = keep_found
        self.person = Person(
            profile, mirrored=profile.mirror if mirror is None else mirror, blinks=self._blinks
        )
        self._pipeline, self._say, self._say_end, self._keep = pipeline, say, say_end, keep
        self._kept = profile if kept is None else kept
        self._own_neutral: NeutralFace | None = None
        self._kept_neutral: NeutralFace | None = None
        """Of those that a pipeline found by itself, what it uses and what the profile's file has."""
        self.has_kept = False
        """Whether anything that calibration found was kept."""
        self._calibration: Calibration | None = None
        self._looks: list[tuple[np.ndarray, np.ndarray]] | None = None
        self._looks_since_s = 0.0
        if profile.told_cameras and pipeline.listens:
            pipeline.use_cameras(profile.told_cameras)
        if profile.placement:
            pipeline.use_placement(profile.placement)
        pipeline.use_eyes(profile.eyes)
        pipeline.use_straight_ahead(centre_of(profile.gaze))
        self._use_known_neutral()

    @property
    def gains_shown(self) -> dict[str, float]:
        """Gains by the shapes that they are seen in, which a mirror exchanges."""
        return {self._side_of(shape): gain for shape, gain in self.profile.gains.items()}

    def _side_of(self, shape: str) -> str:
        """A shape of the person behind one that is seen, and the other way round."""
        return other_side(shape) if self.person.mirrored else shape

    @property
    def calibrating(self) -> bool:
        """Whether a calibration is under way."""
        return self._calibration is not None

    def do(self, command: Command) -> None:
        """Obey a command; one that means something else is left to others.

        Raises
        ------
        InputError
            Where calibration is asked for a face that there is not.
        """
        verb, value = command.verb, command.value
        if verb == "calibrate":
            self._begin("all" if value is None or value is True else str(value))
        elif verb == "cancel" and self._calibration is not None:
            self.step, self._calibration = self._calibration.cancel(), None
            self._use_known_neutral()
        elif verb == "mirror":
            self.person.mirrored = bool(value)
            self._change(mirror=self.person.mirrored)
        elif verb == "gain" and command.shape is not None and isinstance(value, (int, float)):
            gain = float(np.clip(value, 0.0, LARGEST_GAIN))
            self._change(gains={**self.profile.gains, self._side_of(command.shape): gain})
        elif verb == "recentre":
            self._looks = []

    def watch(self, sample: Sample) -> None:
        """Take from the pipeline's answer to a frame what was asked for, and what it found by itself."""
        if self._pipeline.own_neutral is not self._own_neutral:
            self._use_own_neutral()
        if self._calibration is not None:
            self._calibrate(sample)
        if self._looks is not None:
            gaze = self._pipeline.calibrated_by(sample).gaze
            look = (_whole(gaze, 4), _whole(None if sample.head is None else sample.head[3:], 3))
            if any(np.isfinite(part).all() for part in look):
                self._looks_since_s = sample.time_s if not self._looks else self._looks_since_s
                self._looks.append(look)
            if self._looks and sample.time_s >= self._looks_since_s + CENTRE_S:
                self._centre(*(np.array(parts) for parts in zip(*self._looks, strict=True)))
        if self._keeps_found and self._blinks is not None:
            self._keep_blinks(self._blinks.ends)

    def _begin(self, faces: str) -> None:
        names = faces_of(faces, self._pipeline.faces)
        if self._calibration is not None:  # it ends here, and may have put the neutral face away
            self._use_known_neutral()
        self._calibration = Calibration(names, least=self._pipeline.least_movement)
        if "neutral" in names:
            self._pipeline.forget_neutral()

    def _calibrate(self, sample: Sample) -> None:
        calibration = self._calibration
        self.step = calibration.step(
            sample.time_s, self._pipeline.calibrated_by(sample), self._pipeline.signature(sample)
        )
        for outcome in calibration.outcomes():
            self.take(outcome)
        if calibration.finished:
            self._calibration = None
            if calibration.name == "neutral" and not calibration.kept:
                self._use_known_neutral()
            self._say_end(f"calibration: {self.step.text.lower()}")

    def take(self, outcome: Outcome) -> None:
        """Use what calibration found from the next frame on, and keep it beside all that it was found with."""
        kept = outcome.ranges is None or self._neutral_is_kept
        neutral = neutral_shown(outcome, self.profile, self._pipeline)
        if neutral is not None:
            self._use_neutral(neutral)
        self._use(learnt(outcome, self.profile, self._pipeline, neutral=neutral))
        if kept:
            self.has_kept = True
            self._kept = self.profile
            self._keep(self._kept)
        else:
            self._say(f"{outcome.name} is not kept: it was read without the neutral face of the profile")

    def _centre(self, gazes: np.ndarray, turns: np.ndarray) -> None:
        """Take looks (n, 4) and turns of the head (n, 3) for straight ahead; NaN where one is not known."""
        self._looks = None
        found = {}
        for name, rows in (("gaze", gazes), ("head", turns)):
            known = rows[np.isfinite(rows).all(axis=1)]
            if len(known):
                found[name] = tuple(np.median(known, axis=0).tolist())
        if self._neutral_is_kept:
            self._change(**found)
        else:
            self._use(found)
        what = " and ".join({"gaze": "the eyes", "head": "the head"}[name] for name in found)
        self._say(f"{what} are centred on where they looked" if "gaze" in found else f"{what} is centred")

    def _keep_blinks(self, ends: Sequence[Ends]) -> None:
        """Keep how the person's blinks read, where the profile's file is of this model and this neutral face."""
        if not (self._neutral_is_kept and self._kept.model in (None, self._pipeline.mark)):
            return
        pairs = zip(ends, ends_of(self.profile), strict=True)
        if any(
            max(abs(own.open - known.open), abs(own.full - known.full)) > BLINK_CHANGE for own, known in pairs
        ):
            self._change(blinks=blinks_of(ends), model=self._pipeline.mark)

    def _use_known_neutral(self) -> None:
        """What is known without a calibration that gives a neutral face."""
        if self.profile.neutral is not None and self.profile.neutral is not self._own_neutral:
            self._use_neutral(self.profile.neutral)

    def _use_neutral(self, neutral: NeutralFace) -> None:
        self._pipeline.use_neutral(neutral)
        self._own_neutral = self._pipeline.own_neutral

    def _use_own_neutral(self) -> None:
        """Go by the neutral face that the pipeline found, or put it away with it; the file's own one is left alone."""
        first = self._own_neutral is None and self._kept_neutral is None
        self._own_neutral = self._pipeline.own_neutral
        changes = found_alone(self._own_neutral, self.profile, self._pipeline, first=first)
        self._use(changes)
        if (
            self._own_neutral is None
            or not self._keeps_found
            or self._kept.model not in (None, self._pipeline.mark)
        ):
            return
        if self._kept.neutral is self._kept_neutral:
            self._kept_neutral = self._own_neutral
            self._kept = self._kept.model_copy(update=changes)
            self._keep(self._kept)

    @property
    def _neutral_is_kept(self) -> bool:
        """Whether what is read now is read beside the neutral face that the profile's file has."""
        return self.profile.neutral == self._kept.neutral

    def _change(self, **changes: object) -> None:
        """Use other values from the next frame on, and keep them; of the file nothing else changes."""
        self._use(changes)
        self._kept = self._kept.model_copy(update=changes)
        self._keep(self._kept)

    def _use(self, changes: Mapping[str, object]) -> None:
        self.profile = self.profile.model_copy(update=changes)
        self.person.use(self.profile)
        self._pipeline.use_eyes(self.profile.eyes)
        self._pipeline.use_straight_ahead(centre_of(self.profile.gaze))


def _whole(values: np.ndarray | None, count: int) -> np.ndarray:
    """Numbers as they are; NaN where they are not known."""
    return np.full(count, np.nan) if values is None else values
