"""An avatar (.glb, .vrm) with the answers as an animation of its morph targets, its head and its eyes."""

from pathlib import Path

from facegen.formats.gltf_animation import AnimatedAvatar, animate_avatar
from regress.runtime.prediction import Prediction


def animated_avatar(prediction: Prediction, avatar: Path) -> AnimatedAvatar:
    """The avatar's file with one animation more, named after the source, and the shapes that it lacks.

    Raises
    ------
    InputError, facegen.formats.FormatError
        Where no frame has a time, or the avatar cannot be read.
    """
    title = Path(prediction.source).stem
    head = prediction.head
    time_s = prediction.known_times_s
    return animate_avatar(
        avatar,
        prediction.names,
        prediction.weights,
        time_s - time_s[:1],  # animations begin at 0, and seconds since 1970 are too many for their 32 bits
        title=title,
        head_rad=None if head is None else head[:, 3:],
        gaze_rad=prediction.gaze,
    )
