"""What a dataset is: one frozen record, read from TOML, that together with a sample's number decides everything."""

from dataclasses import field
from typing import Annotated, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from facegen.spec.distribution import Distribution, parse, quantity

_STRICT = ConfigDict(extra="forbid", strict=True)

Share = Annotated[float, Field(ge=0, le=1)]
Count = Annotated[int, Field(ge=1)]


def _default(value: object) -> Distribution:
    return field(default_factory=lambda: parse(value))


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Still:
    """``kind = "still"``: every person shows some neutral faces, then some expressions."""

    neutral: Annotated[int, Field(ge=0)] = 1
    faces: Annotated[int, Field(ge=0)] = 9


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Playback:
    """``kind = "playback"``: every person plays the same recording (a Live Link Face CSV), frame by frame."""

    recording: str
    fps: Annotated[float, Field(gt=0, le=1000)]
    first_frame: Annotated[int, Field(ge=0)] = 0
    frames: Count | None = None


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Identity:
    """Who the people are, as far as the rig knows such traits."""

    female: Share = 0.5
    age_years: quantity(18, 90, "years") = _default({"uniform": [18, 80]})
    ancestry_concentration: Annotated[float, Field(gt=0, le=100)] = 0.7
    spread: Annotated[float, Field(ge=0, le=2)] = 1.0


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Expression:
    """How faces move: a mixture of sparse faces (few shapes, whole range) and dense ones (many shapes, weaker)."""

    sparse: Share = 0.5
    sparse_shapes: tuple[Count, Count] = (1, 6)
    dense_active: Share = 0.35
    dense_scale: Share = 0.7
    symmetric: Share = 0.6


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Gaze:
    """Where both eyes look; they look at one point, ``distance_m`` away."""

    yaw_deg: quantity(-35, 35, "degrees") = _default({"normal": [0, 10], "within": [-30, 30]})
    pitch_deg: quantity(-30, 30, "degrees") = _default({"normal": [0, 8], "within": [-25, 25]})
    distance_m: quantity(0.1, 100, "metres") = _default({"uniform": [0.3, 3.0]})


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Head:
    """How the head is turned before the keypoint camera."""

    yaw_deg: quantity(-60, 60, "degrees") = _default({"normal": [0, 6], "within": [-20, 20]})
    pitch_deg: quantity(-45, 45, "degrees") = _default({"normal": [0, 6], "within": [-20, 20]})
    roll_deg: quantity(-90, 90, "degrees") = _default({"normal": [0, 5], "within": [-20, 20]})


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class KeypointCamera:
    """The camera that sees the keypoints: a pinhole before the face."""

    width_px: Annotated[int, Field(ge=16, le=16384)] = 640
    height_px: Annotated[int, Field(ge=16, le=16384)] = 480
    fov_deg: quantity(5, 120, "degrees") = _default(60)
    distance_m: quantity(0.2, 10, "metres") = _default({"uniform": [0.5, 0.9]})
    offset_px: quantity(-8192, 8192, "pixels") = _default({"normal": [0, 20], "within": [-60, 60]})


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Landmarks:
    """What a detector would say: the exact points plus noise, as a share of the face's width in the picture."""

    noise_face_widths: Annotated[float, Field(ge=0, le=0.1)] = 0.001


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Eyes:
    """Size of the pupils."""

    pupil_radius_mm: quantity(0.8, 4.5, "millimetres") = _default({"uniform": [1.3, 3.2]})


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Render:
    """Which samples are rendered, by which headset, and how."""

    headset: str = "tracking3"
    samples: str = ""
    size_px: Annotated[int, Field(ge=16, le=4096)] = 256
    samples_per_pixel: Annotated[int, Field(ge=1, le=65536)] = 8
    denoise: bool = True


@dataclass(frozen=True, kw_only=True, config=_STRICT)
class Spec:
    """A dataset. ``(Spec, sample number)`` decides every label and every pixel of a sample."""

    version: Literal[1]
    kind: Literal["still", "playback"]
    seed: Annotated[int, Field(ge=0)]
    people: Annotated[int, Field(ge=1, le=100_000_000)]
    rig: str = "anny"
    split: Literal["person"] = "person"
    split_shares: tuple[Share, Share, Share] = (0.70, 0.15, 0.15)
    still: Still = Still()
    playback: Playback | None = None
    identity: Identity = Identity()
    expression: Expression = Expression()
    gaze: Gaze = Gaze()
    head: Head = Head()
    camera: KeypointCamera = KeypointCamera()
    landmarks: Landmarks = Landmarks()
    eyes: Eyes = Eyes()
    render: Render = Render()
