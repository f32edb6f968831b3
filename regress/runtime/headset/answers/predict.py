"""A headset's pictures through the stages: a recording's frames, or frames as cameras give them."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.networks import HeadsetNetworks, TemporalConvolution
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.person.neutral import Neutral
from regress.runtime.headset.person.person import Person
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.levels import Levels
from regress.runtime.headset.recordings.footage import Footage
from regress.runtime.headset.recordings.soundness import PictureSoundness
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import USUAL_FPS
from regress.runtime.stages.output import Output
from regress.runtime.stages.stage import Chain, Stage


class HeadsetStream(Stage):
    """The stages of a headset's live cameras, from their pictures to finished weights and gaze.

    Parameters
    ----------
    predictor
        The model.
    output
        What happens after the network; nothing by default. Smoothing of landmarks has no meaning here.
    fps
        Frames a second of samples without times.
    keep_neutral
        Stay calibrated after a change of seat (``HeadsetNetworks``).
    temporal
        Let the frames before count, as the model's taps say.
    placement
        What of each camera's pictures the network is to see, and at which levels
        (``regress.runtime.headset.placing.placement_file`` reads it); without, all of them, levelled by themselves.
    person
        Whose own ends count; samples then have ``eyes`` as well. Neutral pictures are given apart.
    say
        Told what was found of blinks, where they are stretched.

    Raises
    ------
    InputError
        Where the model has no taps and they are asked for.
    """

    def __init__(
        self,
        predictor: HeadsetPredictor,
        output: Output | None = None,
        *,
        fps: float = USUAL_FPS,
        keep_neutral: bool = False,
        temporal: bool = False,
        placement: Mapping[str, CameraPlacement] | None = None,
        person: Person | None = None,
        say: Callable[[str], None] = lambda message: None,
    ) -> None:
        self.soundness = PictureSoundness(predictor.sizes, placement, fps=fps)
        self.networks = HeadsetNetworks(
            predictor,
            fps=fps,
            keep_neutral=keep_neutral,
            levels=Levels(predictor.model.looks, placement),
            reader=None if person is None else EyeReader(predictor, person),
            person=person,
        )
        self.after = _after_networks(predictor, output or Output(), say, temporal=temporal)

    def use_neutral(self, pictures: Mapping[str, np.ndarray] | None) -> None:
        """Compare frames with these neutral pictures from now on; None: with none.

        Parameters
        ----------
        pictures
            Grey (h, w) uint8 by camera, as the cameras give them.

        Raises
        ------
        InputError
            Where one shows nothing, or is of a camera that the model does not have.
        """
        self.networks.use_neutral(None if pictures is None else self.soundness.neutral(pictures))

    def step(self, sample: Sample) -> Sample:
        """Weights, gaze and confidence of the next frame's pictures, grey (h, w) uint8 by camera."""
        return self.after.step(self.networks.step(self.soundness.step(sample)))

    def feed(self, sample: Sample) -> list[Sample]:
        """Those of the frames that are ready, where a filter looks ahead."""
        return self.after.feed(self.networks.step(self.soundness.step(sample)))

    def finish(self) -> list[Sample]:
        """Those of the last frames."""
        return self.after.finish()


def predict_footage(
    predictor: HeadsetPredictor,
    footage: Footage,
    neutrals: Sequence[Neutral] = (),
    *,
    output: Output | None = None,
    keep_neutral: bool = False,
    temporal: bool = False,
    person: Person | None = None,
    still: bool = False,
    say: Callable[[str], None] = lambda message: None,
) -> tuple[Prediction, tuple[str, ...]]:
    """Weights, gaze and confidence of a recording: each frame as `HeadsetStream` steps it, but for two things.

    Pictures are taken as they are: `regress.runtime.headset.placing.levels.levelled` levels a take as a whole. Whether
    the network or traced points lead in the gaze is learnt of all frames before it counts in the first.

    Parameters
    ----------
    footage
        Its pictures are at the network's size, and those at fault are marked.
    neutrals
        Each counts from its row to the next one's; the first from the beginning, wherever it was taken.
    output, keep_neutral, temporal, person, say
        As `HeadsetStream` takes them.
    still
        Whether frames are of many people, as a dataset's are.

    Returns
    -------
    prediction
    reseated
        Labels of frames from which neutral pictures were no longer of the headset's seat.

    Raises
    ------
    InputError
        Where the model has no taps and they are asked for; where One-Euro smoothing is, and times are not known.
    """
    output = output or Output()
    networks = HeadsetNetworks(
        predictor,
        keep_neutral=keep_neutral,
        reader=None if person is None else EyeReader(predictor, person),
        still=still,
        person=person,
        take=not still,
    )
    after = _after_networks(predictor, output, say, temporal=temporal)
    starts = {neutral.row: neutral.pictures for neutral in neutrals[1:]}
    if neutrals:
        starts[0] = neutrals[0].pictures
    answers = []
    for row, sample in enumerate(footage.samples()):
        if row in starts:
            networks.use_neutral(starts[row])
        answers.append(networks.step(sample))
    samples = [ready for answer in networks.led_take(answers) for ready in after.feed(answer)]
    samples += after.finish()
    prediction = Prediction(samples=samples, names=output.names, source=footage.source)
    return prediction, tuple(networks.reseated)


def _after_networks(
    predictor: HeadsetPredictor, output: Output, say: Callable[[str], None], *, temporal: bool
) -> Chain:
    """What happens to weights and gaze."""
    taps = [TemporalConvolution(predictor)] if temporal else []
    return Chain([*taps, *output.stages(say)])
