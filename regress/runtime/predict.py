"""Landmarks through the stages: a recording's frames, or frames as they come."""

from collections.abc import Callable, Iterable, Iterator

from regress.runtime.inputs import Frames
from regress.runtime.model import Model
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import Looks
from regress.runtime.stages.head import HeadPose, HeadSettings, HeadSmoothing
from regress.runtime.stages.networks import AutomaticCalibration, LandmarkConfidence, LandmarkNetworks
from regress.runtime.stages.output import Output
from regress.runtime.stages.smoothing import LandmarkSmoothing
from regress.runtime.stages.soundness import Soundness
from regress.runtime.stages.stage import Chain, Stage

PAPER_RECIPE = "paper"
"""Whose weights leave as the paper's networks give them."""


def landmark_chain(
    model: Model,
    output: Output | None = None,
    *,
    confident: bool = False,
    head: HeadSettings | None = None,
    keep_guessed_gaze: bool = False,
    auto: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> Chain:
    """The stages of landmarks, for one take.

    Parameters
    ----------
    model
        Calibrated where a neutral frame is known.
    output
        What happens before and after the networks; nothing by default.
    confident
        Whether each sample gets its confidence.
    head
        What is known for finding the head's pose, and the gaze where irises are seen; None leaves the pose out.
    keep_guessed_gaze
        Whether eyeLook shapes that are guessed from the lids stay where the head is turned or an eye winks; the paper's
        networks' always stay.
    auto
        Whether to look for the neutral face while frames come.
    say
        Told when it is found, and what was found of a take's own blinks.

    Raises
    ------
    InputError
        Where the neutral face is looked for and the model has no calibrated networks.
    """
    output = output or Output()
    fade = not keep_guessed_gaze and model.recipe != PAPER_RECIPE
    networks = LandmarkNetworks(model)
    before: list[Stage] = [AutomaticCalibration(networks, say)] if auto else []
    before.append(HeadPose(head or HeadSettings(wanted=False)))
    if output.one_euro is not None:
        before.append(HeadSmoothing(output.one_euro))
    if confident:
        before.append(LandmarkConfidence(networks))
    if output.smooth_landmarks_hz is not None:
        before.append(LandmarkSmoothing(output.smooth_landmarks_hz, model.features.mean_shape))
    return Chain([*before, networks, Looks(fade=fade), *output.stages(say)])


def predict_frames(
    model: Model,
    frames: Frames,
    *,
    output: Output | None = None,
    confident: bool = False,
    head: HeadSettings | None = None,
    keep_guessed_gaze: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> Prediction:
    """Weights of a recording, finished as asked: each sample as `landmark_chain` steps it.

    Parameters
    ----------
    model, frames
        What to run on what; calibrate the model first where a neutral frame is known.
    output, confident, head, keep_guessed_gaze, say
        As `landmark_chain` takes them.

    Raises
    ------
    InputError
        Where smoothing is asked for and a frame's time is not known, or not in order.
    """
    output = output or Output()
    samples = landmark_chain(
        model, output, confident=confident, head=head, keep_guessed_gaze=keep_guessed_gaze, say=say
    ).run(frames.samples())
    return Prediction(samples=samples, names=output.names, source=frames.source)


def predict_stream(
    samples: Iterable[Sample],
    model: Model,
    output: Output | None = None,
    *,
    head: HeadSettings | None = None,
    keep_guessed_gaze: bool = False,
    auto: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> Iterator[Sample]:
    """Each frame's answer as soon as the frame comes, sound or not.

    Parameters
    ----------
    samples
        With points (68, 2), as ``regress.runtime.inputs.read_lines`` gives them.
    model, output, head, keep_guessed_gaze, auto, say
        As `landmark_chain` takes them.

    Raises
    ------
    InputError
        Where smoothing needs times and there are none.
    """
    output = output or Output()
    soundness = Soundness(needs_times=output.needs_times, live=True, unit="line")
    chain = Chain(
        [
            soundness,
            landmark_chain(model, output, head=head, keep_guessed_gaze=keep_guessed_gaze, auto=auto, say=say),
        ]
    )
    return chain.stream(samples)
