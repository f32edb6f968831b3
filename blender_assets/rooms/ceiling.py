"""Hangs lamps and monitors from the ceiling of an operating room."""

import math

from mathutils import Matrix, Vector

from blender_assets.rooms.colours import DARK, GREY, TEAL, WHITE
from blender_assets.rooms.kit import GLOW, Lamp, Room, Screen
from blender_assets.rooms.pictures import scan, vital_signs


def put_operating_lamp(
    room: Room,
    foot: tuple[float, float],
    turn: float,
    at: tuple[float, float, float],
    target: tuple[float, float, float],
    ceiling: float,
    watts: float,
) -> None:
    """Hang a lamp from the ceiling: a mast, two arms with a joint, a fork, and a head that looks at ``target``."""
    room.disc((*foot, ceiling - 0.05), 0.13, 0.05, WHITE)
    room.tube([(*foot, ceiling), (*foot, ceiling - 0.42)], 0.034, WHITE, steps=20)
    elbow = (foot[0] + 0.62 * math.cos(turn), foot[1] + 0.62 * math.sin(turn), ceiling - 0.4)
    room.ball((*foot, ceiling - 0.42), 0.055, WHITE)
    room.tube([(*foot, ceiling - 0.4), elbow], 0.03, WHITE, steps=16)
    room.disc((elbow[0], elbow[1], elbow[2] - 0.09), 0.045, 0.14, GREY)
    joint = (at[0], at[1], at[2] + 0.2)
    room.tube([(elbow[0], elbow[1], elbow[2] - 0.06), joint], 0.026, WHITE, steps=16)
    room.ball(joint, 0.042, GREY)
    room.tube([joint, (at[0], at[1], at[2] + 0.06)], 0.018, GREY, steps=16)
    axis = Vector(target) - Vector(at)
    axis.normalize()
    turned = axis.to_track_quat("Z", "Y").to_matrix().to_4x4()
    # the head: a shallow dome whose opening looks along its axis, with lenses in rings and a handle
    dome = [
        (0, -0.085),
        (0.12, -0.08),
        (0.24, -0.055),
        (0.315, -0.015),
        (0.33, 0.012),
        (0.325, 0.03),
        (0.3, 0.034),
        (0.298, 0.026),
        (0, 0.026),
    ]
    room.lathe(at, dome, WHITE, axis=axis, steps=48)
    for radius, count in ((0.115, 6), (0.225, 12)):
        for k in range(count):
            angle = 2 * math.pi * k / count
            local = Vector((radius * math.cos(angle), radius * math.sin(angle), 0.027))
            centre = (Matrix.Translation(Vector(at)) @ turned) @ local
            room.lathe(
                tuple(centre),
                [(0, 0), (0.043, 0), (0.041, 0.006), (0, 0.01)],
                (1.0, 0.99, 0.95),
                GLOW,
                axis=axis,
                steps=18,
            )
    room.lathe(
        at, [(0, 0.15), (0.018, 0.145), (0.02, 0.04), (0.045, 0.027), (0, 0.027)], TEAL, axis=axis, steps=20
    )
    centre = Vector(at) + 0.06 * axis
    room.lamps.append(
        Lamp(at=tuple(centre), size=(0.5, 0.5), watts=watts, towards=tuple(target), colour=(1.0, 0.97, 0.92))
    )


def put_monitor(
    room: Room,
    name: str,
    at: tuple[float, float, float],
    width: float,
    picture: bytes,
    turn: float,
    tilt: float = 0.0,
    ratio: float = 0.625,
) -> None:
    """Put a flat monitor whose picture looks along ``turn`` (0: along -y)."""
    size = (width, width * ratio)
    turned = Matrix.Translation(Vector(at)) @ Matrix.Rotation(turn, 4, "Z") @ Matrix.Rotation(tilt, 4, "X")
    back = turned @ Vector((0, 0.022, 0))
    room.box(back, (size[0] + 0.03, 0.04, size[1] + 0.03), DARK, bevel=0.008, turn=turn, tilt=tilt)
    hub = turned @ Vector((0, 0.055, 0))
    room.box(hub, (0.16, 0.05, 0.12), GREY, bevel=0.01, turn=turn, tilt=tilt)
    room.screens.append(Screen(name=name, at=at, size=size, picture=picture, turn=turn, tilt=tilt))


def put_boom(
    room: Room, foot: tuple[float, float], ceiling: float, ends: tuple[tuple[float, float, float, float], ...]
) -> None:
    """Hang monitors from the ceiling on arms: each end is x, y, z and the way its picture looks."""
    room.disc((*foot, ceiling - 0.05), 0.15, 0.05, WHITE)
    room.tube([(*foot, ceiling), (*foot, ceiling - 0.5)], 0.04, WHITE, steps=20)
    for index, (x, y, z, turn) in enumerate(ends):
        behind = (x - 0.08 * math.sin(turn), y + 0.08 * math.cos(turn))
        arm = ceiling - 0.36 - 0.12 * index
        room.tube([(*foot, arm), (*behind, arm)], 0.028, WHITE, steps=16)
        room.tube([(*behind, arm), (*behind, z)], 0.02, GREY, steps=16)
        room.disc((*behind, arm - 0.05), 0.04, 0.1, GREY)
        put_monitor(
            room,
            f"monitor.{'signs' if index == 0 else 'scan'}",
            (x, y, z),
            0.62,
            vital_signs() if index == 0 else scan(),
            turn,
            0.06,
            0.625 if index == 0 else 0.5625,
        )
