"""What is kept of one camera from one opening to the next."""

from collections.abc import Callable
from dataclasses import dataclass, field

from track.sources.camera_mode import CameraMode
from track.sources.video_nodes import Identity


@dataclass(kw_only=True)
class CameraMemory:
    """One camera's mode, and what was told of it; a camera that comes back is another source with the same memory.

    Parameters
    ----------
    mode
        What is asked of it at each opening.
    say
        Takes sentences for a person; nothing is said without.
    opened
        Whether it was open before.
    identity
        Which camera that was, where the system tells.
    twins
        Whether another camera had the same name.
    """

    mode: CameraMode = field(default_factory=CameraMode)
    say: Callable[[str], None] | None = None
    opened: bool = False
    identity: Identity | None = None
    twins: bool = False
    _told: set[str] = field(default_factory=set)

    def tell(self, kind: str, sentence: str) -> None:
        """Say a sentence, the first one of its kind alone: a loose cable is opened again and again."""
        if self.say is not None and kind not in self._told:
            self._told.add(kind)
            self.say(sentence)
