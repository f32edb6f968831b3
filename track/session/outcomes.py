"""Says what a face that calibration took changes in a person's profile."""

from collections.abc import Mapping

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from track.profile.neutral import NeutralFace
from track.profile.profile import SMALLEST_RANGE, Profile
from track.session.pipeline import Pipeline
from track.session.ranges import middle_of
from track.session.showing import Outcome


def neutral_shown(outcome: Outcome, profile: Profile, pipeline: Pipeline) -> NeutralFace | None:
    """The neutral face that calibration took; None where it took another face.

    A camera that gave no picture keeps that of before, as another seat's is worth more than none.
    """
    if outcome.ranges is not None:
        return None
    neutral = pipeline.neutral_of(outcome.samples)
    if neutral.pictures and profile.neutral and profile.model == pipeline.mark:
        return neutral.model_copy(update={"pictures": {**profile.neutral.pictures, **neutral.pictures}})
    return neutral


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
    same = profile.neutral and profile.model == pipeline.mark
    kept = profile.ranges if same else {}
    rests = {
        name: rest
        for name, rest in profile.rests.items()
        if same and np.isnan(outcome.samples[0].weights[BLENDSHAPE_INDEX[name]])  # no camera saw it
    }
    return {
        "neutral": neutral,
        "ranges": kept,
        "rests": {**rests, **pipeline.rests_of(outcome.samples)},
        "blinks": {},
        "eyes": pipeline.eyes_with(profile.eyes, outcome.name, outcome.samples),
        "model": pipeline.mark,
        "gaze": None,
    }
