"""Defines the ranges from which a spec draws headsets: cameras' and LEDs' places, what is seen, how sensors answer."""

from typing import Annotated

from pydantic import Field
from pydantic.dataclasses import dataclass

from facegen.spec.distribution import quantity
from facegen.spec.tables import STRICT, Share, default


@dataclass(frozen=True, kw_only=True, config=STRICT)
class LayoutRanges:
    """Draws a headset of its own for each person: two eye cameras and one of the mouth, with LEDs and sensor.

    ``render.headset`` then says what the drawn ones share: fit, tolerances, noise, housing and the pictures' size. A
    drawn headset is drawn again where a camera or an LED is inside the head, or a camera sees too little.
    """

    count: Annotated[int, Field(ge=0, le=1_000_000)] = 0
    """Different headsets of a rig: person n wears the one of n modulo this; 0 gives everyone their own."""
    eye_distance_mm: quantity(15, 120, "millimetres") = default({"uniform": [25, 60]})
    """From an eye's camera to what its axis meets."""
    eye_azimuth_deg: quantity(-80, 80, "degrees") = default({"uniform": [-20, 60]})
    """Where the eye's camera stands, as the eye sees it: to the temple, from straight ahead."""
    eye_elevation_deg: quantity(-80, 80, "degrees") = default({"uniform": [-50, 25]})
    """The same upwards."""
    eye_width_mm: quantity(15, 200, "millimetres") = default({"uniform": [32, 60]})
    """Width of the part of the face that an eye's picture shows; the field of view follows from the distance."""
    eye_aim_mm: quantity(-30, 30, "millimetres") = default({"normal": [0, 3]})
    """How far the axis passes the eye, across and upwards: what a crop cuts off."""
    eye_roll_deg: quantity(-180, 180, "degrees") = default({"normal": [0, 8], "within": [-24, 24]})
    """Roll of the eye's camera."""
    sides_mm: quantity(-10, 10, "millimetres") = default({"normal": [0, 1]})
    """How far the right camera's place is from the mirror image of the left one's, along x, y and z."""
    mouth_distance_mm: quantity(15, 200, "millimetres") = default({"uniform": [40, 90]})
    """From the mouth's camera to what its axis meets."""
    mouth_azimuth_deg: quantity(-80, 80, "degrees") = default({"normal": [0, 6], "within": [-18, 18]})
    """Where the mouth's camera stands, as the mouth sees it: to the wearer's left."""
    mouth_elevation_deg: quantity(-80, 80, "degrees") = default({"uniform": [-35, 40]})
    """The same upwards."""
    mouth_width_mm: quantity(30, 400, "millimetres") = default({"uniform": [75, 125]})
    """Width of the part of the face that the mouth's picture shows."""
    mouth_aim_mm: quantity(-60, 60, "millimetres") = default({"normal": [0, 5], "within": [-15, 15]})
    """How far the axis passes the mouth, across and upwards."""
    mouth_roll_deg: quantity(-180, 180, "degrees") = default({"normal": [0, 5], "within": [-15, 15]})
    """Roll of the mouth's camera."""
    aspect: quantity(0.5, 2, "ratio") = default({"uniform": [0.8, 1.25]})
    """Width over height of the part of the face that a picture shows, over the picture's own: others are squeezed."""
    fisheye: Share = 0.5
    """Share of cameras with a fisheye lens; the others are pinholes."""
    lens_circle: Share = 0.4
    """Share of cameras that look through a round rim."""
    lens_circle_radius: quantity(0.2, 2, "picture widths") = default({"uniform": [0.48, 0.65]})
    """Radius of that rim."""
    lens_circle_offset: quantity(-0.5, 0.5, "picture widths") = default({"normal": [0, 0.04]})
    """From the picture's middle to the rim's, across and down."""
    vignette: quantity(0, 1, "share") = default({"uniform": [0, 0.5]})
    """Light lost in the corners."""
    blur: quantity(0, 0.1, "picture widths") = default({"uniform": [0, 0.012]})
    """Standard deviation of the blur of a camera that is out of focus."""
    eye_leds: quantity(1, 16, "LEDs") = default({"uniform": [1, 9]})
    """LEDs of each eye; rounded down."""
    mouth_leds: quantity(1, 16, "LEDs") = default({"uniform": [1, 5]})
    """LEDs of the mouth; rounded down."""
    ring: Share = 0.6
    """Share of headsets whose eye LEDs stand in a ring about the eye; the others have a bar beside the camera."""
    ring_radius_mm: quantity(5, 60, "millimetres") = default({"uniform": [12, 26]})
    """Radius of the ring."""
    ring_depth_mm: quantity(15, 100, "millimetres") = default({"uniform": [32, 48]})
    """How far the ring is in front of the eyes' centres."""
    led_diameter_mm: quantity(0.1, 20, "millimetres") = default({"uniform": [0.8, 4]})
    """Size of the eyes' LEDs, and so of their glints."""
    light_stops: quantity(-6, 6, "stops") = default({"normal": [0, 0.7], "within": [-1.5, 2]})
    """Exposure beside that of `render.headset`, in powers of two: skin saturates where it is high."""
    camera_stops: quantity(-6, 6, "stops") = default({"normal": [0, 0.3]})
    """The same of the light of the eyes' LEDs, and of the mouth's."""
    black_level: quantity(0, 200, "grey levels") = default({"uniform": [2, 24]})
    """Grey level of what gives no light."""
    veiling_glare: quantity(0, 0.5, "share") = default({"uniform": [0, 0.2]})
    """Light that the lens spreads over the whole picture."""
    housing: Share = 0.5
    """Share of headsets with the housing of `render.headset`, as far as no camera or LED stands in it."""
