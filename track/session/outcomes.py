"""Says what a face that calibration took changes in a person's profile."""

from collections.abc import Mapping

from track.profile.neutral import NeutralFace
from track.profile.profile import SMALLEST_RANGE, Profile
from track.session.calibration import Outcome
from track.session.pipeline import Pipeline
from track.session.ranges import middle_of


def neutral_shown(outcome: Outcome, pipeline: Pipeline) -> NeutralFace | None:
    """The neutral face that calibration took; None where it took another face."""
    return pipeline.neutral_of(outcome.samples) if outcome.ranges is None else None


def learnt(
    outcome: Outcome, profile: Profile, pipeline: Pipeline, *, neutral: NeutralFace | None = None
) -> Mapping[str, object]:
    """Fields of ``profile`` that become otherwise.

    Parameters
    ----------
    neutral
        What `neutral_shown` says; the pipeline has to use it by then, as what weights read at rest is read behind it.
    """
    if neutral is not None:
        return _by_neutral(outcome, profile, pipeline, neutral)
    if outcome.name == "look_around":
        return {"gaze": middle_of([sample.gaze for sample in outcome.samples]), "model": pipeline.mark}
    readings = {name: min(max(reading, SMALLEST_RANGE), 1.0) for name, reading in outcome.ranges.items()}
    return {
        "ranges": {**profile.ranges, **readings},
        "eyes": pipeline.eyes_with(profile.eyes, outcome.name, outcome.samples),
        "model": pipeline.mark,
    }


def found_alone(
    neutral: NeutralFace | None, profile: Profile, pipeline: Pipeline, *, first: bool
) -> Mapping[str, object]:
    """Fields of ``profile`` that become otherwise with a neutral face that the pipeline found by itself, or put away.

    Parameters
    ----------
    first
        Whether there was none before it: ranges are then of weights that were compared with nothing.
    """
    return {
        "neutral": neutral,
        "ranges": {} if first else profile.ranges,
        "rests": {},
        "blinks": {},
        "model": pipeline.mark,
    }


def _by_neutral(
    outcome: Outcome, profile: Profile, pipeline: Pipeline, neutral: NeutralFace
) -> Mapping[str, object]:
    # beside another neutral face of the same person they are a little off, and without them movements are too small
    kept = profile.ranges if profile.neutral and profile.model == pipeline.mark else {}
    return {
        "neutral": neutral,
        "ranges": kept,
        "rests": pipeline.rests_of(outcome.samples),
        "blinks": {},
        "eyes": pipeline.eyes_with(profile.eyes, outcome.name, outcome.samples),
        "model": pipeline.mark,
        "gaze": None,
    }
