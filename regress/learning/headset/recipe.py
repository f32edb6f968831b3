"""All settings of a headset network's training, in one place."""

from dataclasses import dataclass, fields
from typing import Any

from regress.errors import InputError
from regress.learning.headset.architectures import ARCHITECTURES

WITHHOLDINGS = ("none", "combined", "regions")
"""What training may leave out: ``combined`` drops frames with an open jaw (> .25) and closed lids (> .2);
``regions`` keeps only frames in which one region moves (neutral, upper_face, lower_face)."""

_DETAIL = 1.5
"""Side of squares as a multiple of ``input_size``: more would alias when they are sampled linearly."""


@dataclass(frozen=True, kw_only=True)
class HeadsetRecipe:
    """How a headset network is built and trained.

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
        Strength of photometric randomisation (gamma, gain, ramp, vignette, blur, noise); 0 leaves it out.
    withhold
        One of ``WITHHOLDINGS``.
    people
        Train on the first so many people only (learning curve); 0 means all.
    """

    architecture: str = "modular"
    seed: int = 0
    epochs: int = 30
    batch: int = 32
    learning_rate: float = 1.5e-3
    matrix_learning_rate: float = 0.02
    weight_decay: float = 0.3
    input_size: int = 64
    code: int = 96
    hidden: int = 192
    modulation: float = 0.3
    skip: int = 24
    part_loss: float = 1.0
    part_loss_elsewhere: float = 0.05
    geometry_loss: float = 0.5
    points_loss: float = 10.0
    second_look: bool = True
    gaze_loss: float = 3.0
    camera_dropout: float = 0.2
    calibration: bool = True
    calibration_dropout: float = 0.4
    other_seat: float = 0.15
    jitter_neutral: float = 0.1
    shut_eyes: int = 1
    mirror: bool = True
    shift: float = 0.03
    scale: float = 0.04
    rotation_deg: float = 3.0
    randomise: float = 0.0
    withhold: str = "none"
    people: int = 0

    def __post_init__(self) -> None:
        """Refuse what cannot be trained.

        Raises
        ------
        InputError
            Names the setting, its value and what is allowed.
        """
        for name, allowed in (("architecture", ARCHITECTURES), ("withhold", WITHHOLDINGS)):
            value = getattr(self, name)
            if value not in allowed:
                raise InputError(f"{name} is {value!r}; {', '.join(allowed)} are allowed")
        for name in ("epochs", "batch", "input_size", "code", "hidden"):
            if getattr(self, name) < 1:
                raise InputError(f"{name} is {getattr(self, name)}; 1 or more is allowed")
        for name in ("camera_dropout", "calibration_dropout", "other_seat", "jitter_neutral", "modulation"):
            if not 0 <= getattr(self, name) <= 1:
                raise InputError(f"{name} is {getattr(self, name)}; 0 to 1 is allowed")
        if self.other_seat + self.jitter_neutral > 1:
            raise InputError(
                f"other_seat and jitter_neutral are {self.other_seat} and {self.jitter_neutral}; "
                "together they may be 1 at most"
            )
        unsigned = (
            "seed",
            "learning_rate",
            "matrix_learning_rate",
            "weight_decay",
            "part_loss",
            "part_loss_elsewhere",
            "geometry_loss",
            "points_loss",
            "gaze_loss",
            "skip",
            "shut_eyes",
        )
        for name in (*unsigned, "shift", "scale", "rotation_deg", "randomise", "people"):
            if getattr(self, name) < 0:
                raise InputError(f"{name} is {getattr(self, name)}; 0 or more is allowed")

    @property
    def square_size(self) -> int:
        """Side in pixels of the squares that encoders see."""
        return round(_DETAIL * self.input_size)

    def settings(self) -> dict[str, Any]:
        """The fields as JSON data."""
        return {field.name: getattr(self, field.name) for field in fields(self)}
