"""Lists the clips of a session, in order."""

from dataclasses import dataclass

import numpy as np

from facegen.sampling.motion.kinds import CLIP_KINDS
from facegen.spec import Spec


@dataclass(frozen=True, kw_only=True, eq=False)
class Script:
    """Clips of every session of a ``kind = "sequence"``; all arrays (clips,).

    Attributes
    ----------
    kind
        Index into the names of `facegen.sampling.motion.CLIP_KINDS`.
    index
        Number of the clip among those of its kind: which expression, which range of motion.
    frames
        Frames of the clip.
    first
        Its first frame in the session.
    """

    kind: np.ndarray
    index: np.ndarray
    frames: np.ndarray
    first: np.ndarray

    @property
    def neutral(self) -> np.ndarray:
        """(clips,) bool: clips of a neutral face."""
        return np.array([kind.neutral for kind in CLIP_KINDS.values()])[self.kind]

    @property
    def session_frames(self) -> int:
        """Frames of a session."""
        return int(self.frames.sum())


def write_script(spec: Spec) -> Script:
    """Script of a spec's ``[sequence]``: neutral first, then kind by kind."""
    kind, index, frames = [], [], []
    for number, name in enumerate(CLIP_KINDS):
        clips = getattr(spec.sequence, name)
        kind += [number] * clips.count
        index += range(clips.count)
        frames += [round(clips.seconds * spec.sequence.fps)] * clips.count
    length = np.array(frames, np.int64)
    return Script(
        kind=np.array(kind, np.int64),
        index=np.array(index, np.int64),
        frames=length,
        first=np.cumsum(length) - length,
    )
