"""Draws shots: what differs from picture to picture beside the scene, kept as a label."""

from dataclasses import dataclass

import numpy as np

from facegen.geometry import direction_from_angles
from facegen.headsets import Headset
from facegen.randomness import stream
from facegen.spec import Spec

ROOMS: dict[str, tuple[float, float]] = {
    "dark": (0.0, 0.0),
    "dim": (0.0, 0.005),
    "flashing_screen": (0.005, 0.03),
    "bright_office": (0.01, 0.05),
}
"""Rooms, and from where to where the radiance of their light lies, W sr-1 m-2, as it comes through a headset's gaps:
up to about three grey levels on the skin of tracking3 (chosen: indoor light has little infra-red, and cameras have
filters)."""
DRAWN_ROOMS = ("dim", "flashing_screen", "bright_office")
"""The three rooms of the second paper, the one with the largest pupils first."""
FLASH = (0.3, 1.5)
"""Radiance of a foreign flash, W sr-1 m-2."""
SCREEN_ON = 0.5
"""Share of the time in which a flashing screen is bright; otherwise it gives a tenth."""


@dataclass(frozen=True, kw_only=True)
class Shot:
    """One picture's circumstances.

    Attributes
    ----------
    exposure_factor
        On the sensor's exposure.
    motion_rad_s
        How fast the face moves in the picture, to its right and down.
    noise
        Factor on shot and read noise.
    noise_seed
        Seed of the noise.
    room
        Where the session took place, a key of `ROOMS`.
    room_radiance, room_direction
        Light that leaks in, W sr-1 m-2, a flash included, and the direction that it comes from (head frame, unit).
    flash
        Whether there was a flash.
    dropped_led
        Name of the LED that stayed dark.
    """

    exposure_factor: float
    motion_rad_s: tuple[float, float]
    noise: float
    noise_seed: int
    room: str
    room_radiance: float
    room_direction: tuple[float, float, float]
    flash: bool
    dropped_led: str | None


def draw_shot(
    spec: Spec, view: str, leds: tuple[str, ...], *, session: int, sample: int, seed: int | None = None
) -> Shot:
    """The shot of one view of a sample.

    Parameters
    ----------
    spec
        Says how much varies.
    view, leds
        Names of the camera and of its LEDs.
    session, sample
        Numbers: the room belongs to the session, all else to the sample.
    seed
        Instead of the spec's.
    """
    seed = spec.seed if seed is None else seed
    rng = stream(seed, f"shot/{view}", sample)
    exposure, right, down = rng.standard_normal(3)
    flashes, screen, drops = rng.random(3)
    flash_radiance, led = rng.uniform(*FLASH), int(rng.integers(max(len(leds), 1)))
    noise_seed = int(rng.integers(2**31))
    room, radiance, direction = _draw_room(spec, seed, session)
    if room == "flashing_screen" and screen > SCREEN_ON:
        radiance *= 0.1
    flash = bool(flashes < spec.sensor.flash)
    speed = np.radians(spec.sensor.motion_deg_s)
    return Shot(
        exposure_factor=float(np.exp(spec.sensor.exposure_percent / 100.0 * exposure)),
        motion_rad_s=(float(speed * right), float(speed * down)),
        noise=spec.sensor.noise,
        noise_seed=noise_seed,
        room=room,
        room_radiance=float(radiance + flash * flash_radiance),
        room_direction=tuple(float(x) for x in direction),
        flash=flash,
        dropped_led=leds[led] if leds and drops < spec.sensor.dropped_led else None,
    )


def draw_shots(spec: Spec, headset: Headset, *, session: int, sample: int) -> dict[str, Shot]:
    """The shots of all views of a sample by camera name, each with its own LEDs."""
    return {
        camera.name: draw_shot(
            spec,
            camera.name,
            tuple(led.name for led in headset.leds if led.camera == camera.name),
            session=session,
            sample=sample,
        )
        for camera in headset.cameras
    }


def _draw_room(spec: Spec, seed: int, session: int) -> tuple[str, float, np.ndarray]:
    """Name, radiance and direction of the light of a session's room."""
    rng = stream(seed, "room", session)
    drawn, share, yaw, pitch = rng.random(4)
    room = spec.sensor.room
    if room == "drawn" and spec.kind == "sequence":
        # as with the pupils, which are largest in the first room
        place = session % spec.sequence.sessions % spec.sequence.rooms
        last = max(spec.sequence.rooms - 1, 1)
        room = DRAWN_ROOMS[round(place * (len(DRAWN_ROOMS) - 1) / last)]
    elif room == "drawn":
        room = DRAWN_ROOMS[int(drawn * len(DRAWN_ROOMS))]
    low, high = ROOMS[room]
    # headsets leak at the nose and below the cheeks
    direction = direction_from_angles(np.radians(120.0 * yaw - 60.0), np.radians(-70.0 + 50.0 * pitch))
    return room, spec.sensor.room_light * (low + share * (high - low)), direction
