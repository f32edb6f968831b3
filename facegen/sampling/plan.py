"""Plans a dataset: which person, session, clip and frame each sample is."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES, BLOCK, RECORDED_WEIGHTS
from facegen.errors import InputError
from facegen.formats import read_live_link
from facegen.sampling.motion import Script, write_script
from facegen.spec import Playback, Spec, format_ranges


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """A spec with its recording read: enough to say what every sample is.

    Attributes
    ----------
    spec
        The checked spec.
    frames
        Samples of one person; sample ``i`` belongs to person ``i // frames``.
    recording
        (frames, 52) weights that everyone plays, for ``kind = "playback"``; None otherwise.
    script
        Clips of every session, for ``kind = "sequence"``; None otherwise.
    """

    spec: Spec
    frames: int
    recording: np.ndarray | None = None
    script: Script | None = None

    @property
    def samples(self) -> int:
        """Number of samples of the dataset."""
        return self.spec.people * self.frames

    @property
    def blocks(self) -> int:
        """Number of blocks that hold all samples, the last one perhaps cut."""
        return -(-self.samples // BLOCK)


@dataclass(frozen=True, kw_only=True, eq=False)
class Positions:
    """Where samples stand in people → sessions → clips → frames; all arrays (n,)."""

    sample: np.ndarray
    person: np.ndarray
    session: np.ndarray
    clip: np.ndarray
    frame: np.ndarray
    time_s: np.ndarray
    neutral: np.ndarray


def plan_dataset(spec: Spec) -> Plan:
    """Plan of a spec; reads the recording of a playback.

    Raises
    ------
    InputError
        If the recording cannot be read, has not the frames asked for, or shows no face or impossible weights there.
    """
    if spec.kind == "still":
        return Plan(spec=spec, frames=spec.still.sessions * (spec.still.neutral + spec.still.faces))
    if spec.kind == "sequence":
        script = write_script(spec)
        return Plan(spec=spec, frames=spec.sequence.sessions * script.session_frames, script=script)
    playback = spec.playback
    weights = read_live_link(playback.recording).weights
    last = len(weights) if playback.frames is None else playback.first_frame + playback.frames
    if not playback.first_frame < last <= len(weights):
        raise InputError(
            f"playback: frames {playback.first_frame}-{last - 1} were asked for, but {playback.recording} has "
            f"frames 0-{len(weights) - 1}"
        )
    recording = weights[playback.first_frame : last]
    _check_recording(recording, playback)
    return Plan(spec=spec, frames=len(recording), recording=recording)


def _check_recording(weights: np.ndarray, playback: Playback) -> None:
    """Refuse frames (n, 52) that no face can play."""
    empty = np.isnan(weights).any(axis=1)
    if empty.any():
        raise InputError(
            f"{playback.recording}: {_frames(empty, playback)} without a face (empty cells); fill them in, or choose "
            "frames between them with playback.first_frame and playback.frames"
        )
    low, high = RECORDED_WEIGHTS
    outside = (weights < low) | (weights > high)
    if outside.any():
        frame, shape = np.argwhere(outside)[0]
        raise InputError(
            f"{playback.recording}: {_frames(outside.any(axis=1), playback)} with weights outside {low:g} to {high:g} "
            f"(the first is {BLENDSHAPES[shape]} = {weights[frame, shape]:g}); 1 is a whole movement: scale them, or "
            "choose other frames with playback.first_frame and playback.frames"
        )


def _frames(wrong: np.ndarray, playback: Playback) -> str:
    """How many frames (n,) of those played are wrong, and which; numbered as in the recording."""
    numbers = playback.first_frame + np.flatnonzero(wrong)
    ranges = format_ranges(numbers.tolist()).split(",")
    more = ",..." if len(ranges) > 5 else ""
    return (
        f"has {len(numbers)} frame{'s' * (len(numbers) > 1)} ({','.join(ranges[:5])}{more}; frame 0 is row 2)"
    )


def block_positions(plan: Plan, block: int) -> Positions:
    """Positions of the 1,000 samples of a block; the last block reaches past the dataset's end and is cut later."""
    sample = np.arange(block * BLOCK, (block + 1) * BLOCK, dtype=np.int64)
    person, within = np.divmod(sample, plan.frames)
    nothing = np.zeros_like(sample)
    if plan.script is not None:
        return _sequence_positions(plan, plan.script, sample, person)
    if plan.spec.kind == "playback":
        return Positions(
            sample=sample,
            person=person,
            session=person,
            clip=person,
            frame=within,
            time_s=within / plan.spec.playback.fps,
            neutral=np.zeros(BLOCK, bool),
        )
    # a still is a clip of one frame
    session, face = np.divmod(sample, plan.frames // plan.spec.still.sessions)
    return Positions(
        sample=sample,
        person=person,
        session=session,
        clip=sample,
        frame=nothing,
        time_s=np.zeros(BLOCK),
        neutral=face < plan.spec.still.neutral,
    )


def _sequence_positions(plan: Plan, script: Script, sample: np.ndarray, person: np.ndarray) -> Positions:
    session, within = np.divmod(sample, script.session_frames)
    place = np.searchsorted(script.first, within, side="right") - 1
    frame = within - script.first[place]
    return Positions(
        sample=sample,
        person=person,
        session=session,
        clip=session * len(script.kind) + place,
        frame=frame,
        time_s=frame / plan.spec.sequence.fps,
        neutral=script.neutral[place],
    )
