"""Lists and checks all settings of a headset network's training."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass
from typing import Annotated, Any, ClassVar, Literal

from annotated_types import Ge, Interval

from regress.learning.headset.architectures import ARCHITECTURES
from regress.runtime.documents import checked

WITHHOLDINGS = ("none", "combined", "regions")
"""What training may leave out: ``combined`` drops frames with an open jaw (> .25) and closed lids (> .2);
``regions`` keeps only frames in which one region moves (neutral, upper_face, lower_face)."""

_DETAIL = 1.5
"""Side of squares as a multiple of ``input_size``: more would alias when they are sampled linearly."""


PLAIN_DISPLACEMENT = 0.4
"""Displacement of plain frames over that of the others: of .06, .12 and 8 degrees it leaves about the .03, .04 and 3
degrees by which a headset that is rendered true to life differs from itself."""


Count = Annotated[int, Ge(1)]
CountOrNone = Annotated[int, Ge(0)]
Share = Annotated[float, Interval(ge=0, le=1)]
Size = Annotated[float, Ge(0)]


@dataclass(frozen=True, kw_only=True)
class HeadsetRecipe:
    """How a headset network is built and trained; `recipe_of` checks the values.

    Parameters
    ----------
    architecture
        One of ``ARCHITECTURES``.
    seed, epochs, batch, learning_rate, weight_decay
        Cosine schedule; this learning rate is AdamW's, for biases, scales and what reads the codes.
    matrix_learning_rate
        Of orthogonalised steps (Muon), for convolutions and what makes the codes; 0 leaves them to AdamW, which
        learned half as fast.
    input_size
        Side in pixels to which encoders reduce the squares that they see; irises they look at again in the squares.
    blocks
        Residual blocks behind each convolution but the first. Networks of drawn headsets err as much on their training
        people as on others: they lack depth, not people.
    code, hidden
        Numbers of each half of a camera's part code; hidden units of the holistic network.
    modulation
        Factor on a camera's share of shapes outside its part (the paper's eq. 6); modular only.
    skip
        Numbers that each camera's code hands to the others' heads (the paper's skips between modules), which then
        answer with what they have not seen themselves; modular only.
    part_loss, part_loss_elsewhere
        Weight of each camera's own error on the shapes of its part and on all others (eq. 4), of weights and of
        geometry as below; modular only.
    geometry_loss
        Weight of the face's squared displacement error beside the weights' own; 0 leaves it out.
    points_loss
        Weight of the errors of traced points (lids, pupils, brows, lips), on which weights are then read; 0 leaves
        the tracing out.
    second_look
        Whether irises that are traced are looked at again in all pixels of the square.
    gaze_loss
        How much a gaze angle's squared error counts against a weight's.
    camera_dropout
        Probability that a camera is absent from a training frame.
    calibration, calibration_dropout
        Whether neutral pictures are a second input, and the probability that a training frame has none.
    other_seat, jitter_neutral
        Of calibrated training frames, shares whose neutral pictures come from the other seat of the headset, and
        from the same seat but displaced as if it were another.
    shut_eyes
        How many times an epoch shows frames again in which an eye is more than half shut: they are few, and networks
        that see each once take a shut lid for a lowered one.
    mirror
        Train on frames and their mirror images, where the headset is symmetric.
    shift, scale, rotation_deg
        Standard deviations of the random affine of each camera's pictures: of their width; of 1; degrees.
    randomise
        Strength of photometric randomisation (gamma, gain, ramp, vignette, blur, noise, glints, saturation); 0 leaves
        it out. With wide ``shift``, ``scale`` and ``rotation_deg`` it decided on films of real eyes, where no synthetic
        figure shows a difference (docs/measurements/headset-networks.md).
    patches
        Standard deviation, in logarithms, of light and dark patches on randomised pictures; 0 draws none. They help a
        network of one headset in others, and cost looks far to the side; networks of drawn headsets lose 3 % by them
        (the same page).
    plain
        Share of training frames that are displaced little (`PLAIN_DISPLACEMENT`) and not randomised: what a wide
        ``shift`` and ``randomise`` cost on the headset's own pictures is less with them.
    camera_terms
        Whether what is told of each camera (``CAMERA_TERMS``) is an input: for networks of drawn headsets.
    terms_dropout
        Probability that nothing is told of a training frame's cameras.
    terms_noise
        Standard deviation of the noise on what is told: nobody knows a camera's place to the millimetre.
    withhold
        One of ``WITHHOLDINGS``.
    people
        Train on the first so many people only (learning curve); 0 means all.
    """

    architecture: Literal[tuple(ARCHITECTURES)] = "modular"
    seed: CountOrNone = 0
    epochs: Count = 30
    batch: Count = 32
    learning_rate: Size = 1.5e-3
    matrix_learning_rate: Size = 0.02
    weight_decay: Size = 0.3
    input_size: Count = 64
    blocks: CountOrNone = 0
    code: Count = 96
    hidden: Count = 192
    modulation: Share = 0.3
    skip: CountOrNone = 24
    part_loss: Size = 1.0
    part_loss_elsewhere: Size = 0.05
    geometry_loss: Size = 0.5
    points_loss: Size = 10.0
    second_look: bool = True
    gaze_loss: Size = 3.0
    camera_dropout: Share = 0.2
    calibration: bool = True
    calibration_dropout: Share = 0.4
    other_seat: Share = 0.15
    jitter_neutral: Share = 0.1
    shut_eyes: CountOrNone = 1
    mirror: bool = True
    shift: Size = 0.06
    scale: Size = 0.12
    rotation_deg: Size = 8.0
    randomise: Size = 1.0
    patches: Size = 0.0
    plain: Share = 0.5
    camera_terms: bool = False
    terms_dropout: Share = 0.4
    terms_noise: Size = 0.03
    withhold: Literal[WITHHOLDINGS] = "none"
    people: CountOrNone = 0

    __pydantic_config__: ClassVar[Mapping[str, str]] = {"extra": "forbid"}

    def __post_init__(self) -> None:
        """Refuse shares of training frames that are more than all."""
        if self.other_seat + self.jitter_neutral > 1:
            raise ValueError(
                f"other_seat and jitter_neutral are {self.other_seat} and {self.jitter_neutral}; "
                "together they may be 1 at most"
            )

    @property
    def square_size(self) -> int:
        """Side in pixels of the squares that encoders see."""
        return round(_DETAIL * self.input_size)

    def settings(self) -> dict[str, Any]:
        """The fields as JSON data."""
        return asdict(self)


DRAWN_SETTINGS: Mapping[str, Any] = {"camera_terms": True}
"""What is another default where the arrays' headsets are drawn: the network is told of each."""


_SIZES = ("architecture", "input_size", "blocks", "code", "hidden", "skip", "second_look", "camera_terms")
"""Settings in which a network is as the one that it begins as, unless others are asked for."""


def sizes_of(settings: Mapping[str, Any]) -> dict[str, Any]:
    """Of a trained network's settings, those that one takes over which begins as it; of former versions some lack."""
    return {name: settings[name] for name in _SIZES if name in settings}


def recipe_of(settings: Mapping[str, Any]) -> HeadsetRecipe:
    """The recipe of settings, numbers as text among them; others have their defaults.

    Raises
    ------
    InputError
        Names each refused setting, its value and what is allowed.
    """
    return checked(HeadsetRecipe, settings)
