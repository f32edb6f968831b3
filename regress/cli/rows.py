"""Rows of a recording that can be used, and word of the others."""

import dataclasses

import numpy as np

from facegen.console import say
from regress.errors import InputError
from regress.runtime.inputs import Frames, fault_sentences
from regress.runtime.stages.soundness import Soundness


def sound_rows(frames: Frames, *, needs_times: bool = False, strict: bool = False) -> Frames:
    """The frames with NaN for those that cannot be used, of which a person is told.

    Parameters
    ----------
    frames
        As read.
    needs_times
        Whether each must have a time of its own, as smoothing needs.
    strict
        Whether one that cannot be used is an error.

    Raises
    ------
    InputError
        Where times are needed and there are none; where ``strict`` and a row is faulty, or where all are.
    """
    if needs_times and frames.time_s is None:
        raise InputError(f"{frames.source} does not say when its frames were taken; give --fps")
    samples = frames.samples()
    for rows in frames.takes().values():
        judged = Soundness(needs_times=needs_times).run([samples[row] for row in rows])
        for row, sample in zip(rows, judged, strict=True):
            samples[row] = sample
    faults = [sample.faults.get("points") for sample in samples]
    sentences = fault_sentences(faults)
    if sentences and strict:
        raise InputError(f"{frames.source}: {'; '.join(sentences)}; without --strict their cells stay empty")
    if None not in faults:
        raise InputError(f"{frames.source} holds no usable frame: {'; '.join(sentences)}")
    for sentence in sentences:
        say(f"{frames.source}: {sentence}")
    return dataclasses.replace(frames, points=np.stack([sample.points for sample in samples]))
