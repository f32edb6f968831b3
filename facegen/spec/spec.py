"""Defines the spec of a dataset: a frozen record, read from TOML, which decides everything with a sample's number."""

from typing import Annotated, Literal

from pydantic import ConfigDict, Field
from pydantic.dataclasses import dataclass

from facegen.expression import COMPONENTS
from facegen.spec.distribution import quantity
from facegen.spec.layout_ranges import LayoutRanges
from facegen.spec.rigs import Rigs
from facegen.spec.tables import STRICT, Share, default

Words = Annotated[str, Field(max_length=300)]
Count = Annotated[int, Field(ge=1)]
Weight = Annotated[float, Field(ge=0, le=1000, json_schema_extra={"x-unit": "share"})]


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Still:
    """``kind = "still"``: in each session every person shows some neutral faces, then some expressions."""

    sessions: Annotated[int, Field(ge=1, le=1000)] = 1
    """Sessions of each person: the headset is put on anew, its unit and the room are others."""
    neutral: Annotated[int, Field(ge=0, le=10_000_000)] = 1
    """Neutral faces of each session; they come first."""
    faces: Annotated[int, Field(ge=0, le=10_000_000)] = 9
    """Faces with an expression in each session, after the neutral ones."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Playback:
    """``kind = "playback"``: everyone plays one recording (a Live Link Face CSV), in one pose before one camera."""

    recording: str
    """Path of the CSV, relative to the spec."""
    fps: Annotated[float, Field(gt=0, le=1000)]
    """Frames a second; frame n is shown at n / fps."""
    first_frame: Annotated[int, Field(ge=0)] = 0
    """First frame of the recording that is played."""
    frames: Count | None = None
    """Frames that are played; none means to the end."""
    credit: Words = ""
    """Whose recording it is, and who recorded it; the dataset's card says so, or that it is unknown."""
    licence: Words = ""
    """Licence of the recording; likewise."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Clips:
    """Clips of one kind in each session."""

    count: Annotated[int, Field(ge=0, le=1000)]
    """Clips of this kind."""
    seconds: Annotated[float, Field(ge=2, le=120)]
    """Length of each; a clip is drawn whole for every block of 1,000 samples that it touches."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Sequence:
    """``kind = "sequence"``: every person is recorded in sessions, each of them the same list of clips."""

    fps: Literal[30, 60] = 30
    """Frames a second."""
    sessions: Annotated[int, Field(ge=1, le=1000)] = 1
    """Sessions of each person: the headset is put on anew, the camera and the room are others."""
    rooms: Annotated[int, Field(ge=1, le=100)] = 3
    """Rooms; session n of a person is in room n modulo this, and pupils are smaller from room to room. A sequence with
    fewer sessions never comes to the last ones."""
    neutral: Clips = Clips(count=1, seconds=2.0)
    """A neutral face, held; these frames are labelled neutral and come first."""
    peak: Clips = Clips(count=0, seconds=3.0)
    """One expression from onset over apex to offset, the next one of 73 in each clip."""
    sentence: Clips = Clips(count=4, seconds=4.0)
    """Speech-like motion with glances, blinks and brows."""
    range_of_motion: Clips = Clips(count=0, seconds=20.0)
    """Voluntary movements one after the other: mouth and jaw in even clips, brows, lids and gaze in odd ones."""
    conversation: Clips = Clips(count=0, seconds=30.0)
    """Turns of talking and listening."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Identity:
    """Who the people are, as far as the rig knows such traits."""

    female: Share = 0.5
    """Share of women."""
    age_years: quantity(18, 90, "years") = default({"uniform": [18, 80]})
    """Age; the rig changes between 25 and 90."""
    ancestry_concentration: Annotated[float, Field(gt=0, le=100)] = 0.7
    """Of the Dirichlet distribution of African, Asian and Caucasian ancestry: small values give unmixed people."""
    spread: Annotated[float, Field(ge=0, le=2)] = 1.0
    """Factor on how much people differ beyond sex, age and ancestry; 0 gives one face for each of these."""


_MIXTURE = """How often each component of the expression model makes a still face, as weights whose sum counts as 1.

    Where the table stands in a spec, components that it does not name are left out.
    """
_MIXTURE_KEYS = {
    name: Annotated[Weight, Field(description=component.meaning)] for name, component in COMPONENTS.items()
}
_MIXTURE_NAMESPACE = {"__doc__": _MIXTURE, "__module__": __name__, "__annotations__": _MIXTURE_KEYS}
Mixture = dataclass(frozen=True, kw_only=True, config=ConfigDict(extra="forbid", strict=True))(
    type("Mixture", (), _MIXTURE_NAMESPACE | dict.fromkeys(COMPONENTS, 0.0))
)
"""Its keys are those of `facegen.expression.COMPONENTS`."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Expression:
    """How faces move: a mixture of named components, held to what a face can do."""

    model: Literal[1] = 1
    """Version of the expression model."""
    left_right_correlation: Share = 0.9
    """Correlation of the strengths of left and right; 1 gives symmetric faces but for ``one_sided``, ``wink``, peaks on
    one side, a jaw or mouth that goes sideways, and lids that follow the gaze."""
    subtle: Share = 0.3
    """Share of still faces that are scaled down, log-uniformly to between 2 and 100 %; combined, wink and tongue are
    not, extreme is."""
    resting: Share = 0.2
    """Largest weight that each shape has at rest: in rest, emotion, speech, movement, one_sided and talk faces, and in
    clips."""
    blinks: Share = 0.0
    """Share of still faces in the middle of a blink, whatever else they do; half of these have shut both eyes."""
    mixture: Mixture = Mixture(**{name: component.share for name, component in COMPONENTS.items()})


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Gaze:
    """Where both eyes look; they look at one point, ``distance_m`` away."""

    yaw_deg: quantity(-35, 35, "degrees") = default({"normal": [0, 12], "within": [-30, 30]})
    """To the subject's left."""
    pitch_deg: quantity(-30, 30, "degrees") = default({"normal": [-3, 11], "within": [-25, 25]})
    """Upwards."""
    distance_m: quantity(0.1, 100, "metres") = default({"uniform": [0.3, 3.0]})
    """Distance of the point that is looked at; near ones turn the eyes inwards."""
    wide: Share = 0.0
    """Share of the looks of still faces that go anywhere within 42 degrees sideways and 30 up or down, evenly."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Head:
    """How the head is turned before the keypoint camera."""

    yaw_deg: quantity(-60, 60, "degrees") = default({"normal": [0, 6], "within": [-20, 20]})
    """To the subject's left."""
    pitch_deg: quantity(-45, 45, "degrees") = default({"normal": [0, 6], "within": [-20, 20]})
    """Upwards."""
    roll_deg: quantity(-90, 90, "degrees") = default({"normal": [0, 5], "within": [-20, 20]})
    """Towards the subject's left shoulder."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class KeypointCamera:
    """The camera that sees the keypoints, a pinhole before the face; rendered pictures are those of a headset."""

    width_px: Annotated[int, Field(ge=16, le=16384)] = 640
    """Width of the picture."""
    height_px: Annotated[int, Field(ge=16, le=16384)] = 480
    """Height of the picture."""
    fov_deg: quantity(5, 120, "degrees") = default(60)
    """Horizontal field of view."""
    distance_m: quantity(0.2, 10, "metres") = default({"uniform": [0.5, 0.9]})
    """From the camera to the head, along its axis."""
    offset_px: quantity(-8192, 8192, "pixels") = default({"normal": [0, 20], "within": [-60, 60]})
    """Of the head from the middle of the picture, in x and in y."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Landmarks:
    """What a detector would say: the exact points plus noise, as a share of the face's width in the picture."""

    noise_face_widths: Annotated[float, Field(ge=0, le=0.1)] = 0.001
    """Standard deviation of the noise in x and in y, drawn anew for every frame."""
    bias: Annotated[float, Field(ge=0, le=3)] = 0.0
    """Of what stays the same on a person: 1 displaces points as far as two detectors disagree about them."""
    outliers: Annotated[float, Field(ge=0, le=0.2)] = 0.0
    """Share of frames, for each part of the face, in which the whole part is found a long way off."""
    dropped: Annotated[float, Field(ge=0, le=0.5)] = 0.0
    """Share of frames in which no face is found (NaN); in clips they come in runs."""
    sliding_contour: bool = False
    """Whether there are ``contour_2d`` and ``contour_3d`` too: the 17 jaw points, slid to the outline where hidden."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Eyes:
    """Size of the pupils."""

    pupil_radius_mm: quantity(0.8, 4.5, "millimetres") = default(
        {"normal": [1.88, 0.5], "within": [1.05, 3.1]}
    )
    """Radius of both pupils."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Looks:
    """What people wear in rendered pictures beside the headset; keypoints do not depend on it."""

    beard: Share = 0.35
    """Share of men with stubble, a moustache, a goatee or a full beard; its length is a session's."""
    glasses: Share = 0.1
    """Share of people with glasses under the headset."""
    make_up: Share = 0.2
    """Share of women with mascara, eyeliner and lipstick; how much is a session's."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Sensor:
    """What else differs from picture to picture; the headset's file says how much at a factor of 1."""

    tolerances: Annotated[float, Field(ge=0, le=10)] = 1.0
    """Factor on the headset's tolerances of mounts, focal lengths, LEDs and sensor; each session has its own unit."""
    noise: Annotated[float, Field(ge=0, le=10)] = 1.0
    """Factor on shot and read noise."""
    exposure_percent: Annotated[float, Field(ge=0, le=50)] = 1.0
    """Standard deviation of the exposure from picture to picture."""
    motion_deg_s: Annotated[float, Field(ge=0, le=2000)] = 15.0
    """Standard deviation, across and along, of how fast the face moves in the picture while it is exposed."""
    slip: Annotated[float, Field(ge=0, le=10)] = 1.0
    """Factor on how far the headset slips within a session."""
    room: Literal["drawn", "dark", "dim", "bright_office", "flashing_screen"] = "drawn"
    """Room whose light leaks in; drawn means one for each session, in sequences the same as the pupils' rooms."""
    room_light: Annotated[float, Field(ge=0, le=100)] = 1.0
    """Factor on the light that leaks in."""
    flash: Share = 0.002
    """Share of pictures with a flash of foreign light."""
    dropped_led: Share = 0.002
    """Share of pictures in which one of the camera's LEDs stays dark."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Render:
    """Which samples are rendered, by which headset, and how."""

    headset: str = "tracking3"
    """Name of a headset that comes with facegen, or path of a TOML file relative to the spec; see `[layout]` too."""
    samples: str = ""
    """Samples that are rendered, for example "0-99,140,200-240:10"."""
    size_px: Annotated[int, Field(ge=16, le=4096)] = 256
    """Width of each picture; its height follows from the shape of the camera's own."""
    samples_per_pixel: Annotated[int, Field(ge=1, le=65536)] = 8
    """Light paths per pixel."""
    denoise: bool = True
    """Whether the renderer's denoiser is used."""
    subsurface: bool = True
    """Whether skin scatters light below its surface; without, shadows are harder."""
    truth: bool = True
    """Whether an EXR file with radiance, depth, normals and parts stands beside each picture."""


@dataclass(frozen=True, kw_only=True, config=STRICT)
class Spec:
    """A dataset. ``(Spec, sample number)`` decides every label and every pixel of a sample."""

    version: Literal[1]
    """Version of the spec's keys."""
    kind: Literal["still", "sequence", "playback"]
    """Single faces, clips of motion, or a recording played by every person."""
    seed: Annotated[int, Field(ge=0)]
    """Everything drawn follows from it."""
    people: Annotated[int, Field(ge=1, le=100_000_000)]
    """Number of people."""
    rig: Rigs = "anny"
    """Name of a rig in blender_assets/build, or several with shares of the people: ``{anny = 0.5, ict = 0.5}``."""
    split: Literal["person", "session"] = "person"
    """What stays together in the split; by session, a person can be in all three."""
    split_shares: tuple[Share, Share, Share] = (0.70, 0.15, 0.15)
    """Shares of training, validation and test; they add up to 1."""
    still: Still = Still()
    sequence: Sequence = Sequence()
    playback: Playback | None = None
    identity: Identity = Identity()
    expression: Expression = Expression()
    gaze: Gaze = Gaze()
    head: Head = Head()
    camera: KeypointCamera = KeypointCamera()
    landmarks: Landmarks = Landmarks()
    eyes: Eyes = Eyes()
    looks: Looks = Looks()
    sensor: Sensor = Sensor()
    render: Render = Render()
    layout: LayoutRanges | None = None
