"""Builds what stands around an operating table: lamps, an anaesthesia machine, monitors, tables, stools."""

import math

import numpy as np
from mathutils import Matrix, Vector

from blender_assets.rooms.kit import GLOW, METAL, Lamp, Named, Room, Screen, curve, rgb
from blender_assets.rooms.pictures import scan, ventilator, vital_signs

STEEL = rgb("c8cecd")
WHITE = rgb("eef2f0")
GREY = rgb("aab4b4")
DARK = rgb("2d3537")
TEAL = rgb("3b8a88")
DRAPE = rgb("5f9fae")
BLUE = rgb("5f8ea8")


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


def put_anaesthesia(room: Room, at: tuple[float, float], turn: float) -> None:
    """Put an anaesthesia machine: drawers, a worktop, vaporizers, bellows, gauges, two screens, hoses to the wall."""
    turned = Matrix.Translation(Vector((*at, 0))) @ Matrix.Rotation(turn, 4, "Z")

    def p(x: float, y: float, z: float) -> tuple[float, float, float]:
        return tuple(turned @ Vector((x, y, z)))

    def box(
        x: float,
        y: float,
        z: float,
        size: tuple[float, float, float],
        colour,
        layer: str = "things",
        bevel: float = 0.008,
    ) -> None:
        room.box(p(x, y, z), size, colour, layer, bevel=bevel, turn=turn)

    for x in (-0.3, 0.3):
        for y in (-0.25, 0.25):
            room.ball(p(x, y, 0.055), 0.055, DARK, scale=(1, 1, 1), steps=16)
    box(0, 0, 0.13, (0.74, 0.62, 0.07), GREY, bevel=0.02)
    box(0, 0.04, 0.47, (0.68, 0.5, 0.62), WHITE, bevel=0.015)
    for k, z in enumerate((0.28, 0.46, 0.64)):
        box(0, -0.215, z, (0.62, 0.02, 0.16), rgb("d9e3e2"))
        room.tube([p(-0.14, -0.245, z + 0.04), p(0.14, -0.245, z + 0.04)], 0.009, STEEL, METAL)
        if k == 0:
            box(0.24, -0.228, z + 0.045, (0.05, 0.004, 0.02), TEAL, bevel=0)
    box(0, -0.05, 0.8, (0.76, 0.66, 0.035), rgb("c3cccb"), bevel=0.012)
    box(0, 0.2, 1.1, (0.68, 0.16, 0.56), WHITE, bevel=0.02)
    for x, colour in ((-0.22, rgb("d8b53a")), (-0.08, rgb("7a5aa0"))):
        box(x, 0.08, 0.98, (0.1, 0.12, 0.2), rgb("d3dad9"), bevel=0.012)
        room.disc(p(x, 0.08, 1.08), 0.045, 0.05, colour)
        box(x, 0.015, 0.95, (0.03, 0.006, 0.09), colour, bevel=0.002)
    # bellows in a clear pot, a flow tube, gauges
    for k in range(7):
        room.disc(p(0.22, 0.02, 0.83 + 0.026 * k), 0.075 if k % 2 == 0 else 0.062, 0.026, rgb("39464a"))
    room.disc(p(0.22, 0.02, 1.015), 0.085, 0.02, rgb("cfdada"))
    for k in range(3):
        box(
            0.1 + 0.05 * k,
            0.115,
            1.22,
            (0.022, 0.02, 0.2),
            (rgb("6fae7e"), rgb("d0d6d6"), rgb("5c87b8"))[k],
            bevel=0.004,
        )
    for x in (-0.24, -0.12):
        room.lathe(
            p(x, 0.118, 1.28),
            [(0, 0), (0.045, 0), (0.045, 0.02), (0, 0.02)],
            WHITE,
            axis=turned.to_3x3() @ Vector((0, -1, 0)),
            steps=24,
        )
        room.lathe(
            p(x, 0.096, 1.28),
            [(0.045, 0), (0.05, 0), (0.05, 0.012), (0.04, 0.012)],
            DARK,
            axis=turned.to_3x3() @ Vector((0, -1, 0)),
            steps=24,
        )
    # shelf with the machine's own screen, and the monitor above it on a swivel arm
    box(0, 0.2, 1.395, (0.72, 0.3, 0.03), rgb("c3cccb"), bevel=0.01)
    put_monitor(room, "monitor.ventilator", p(-0.12, 0.02, 1.585), 0.4, ventilator(), turn, -0.1, 0.75)
    room.tube([p(-0.12, 0.1, 1.4), p(-0.12, 0.1, 1.56)], 0.02, GREY)
    room.disc(p(0.25, 0.16, 1.41), 0.04, 0.18, rgb("e9eeee"))
    box(0.25, 0.1, 1.45, (0.14, 0.1, 0.06), BLUE, bevel=0.01)
    # the breathing circuit's sockets and bag, beside the worktop
    room.tube(
        curve([p(-0.3, -0.2, 0.84), p(-0.34, -0.26, 0.92), p(-0.36, -0.3, 0.86), p(-0.36, -0.3, 0.7)], 6),
        0.016,
        rgb("9fb6ba"),
    )
    room.ball(p(-0.36, -0.3, 0.6), 0.07, rgb("345b66"), scale=(0.75, 0.75, 1.5))
    for k, colour in enumerate((rgb("e8ecec"), rgb("3f6fb0"), rgb("2e2e30"))):
        x = 0.18 + 0.07 * k
        way = [
            p(x, 0.27, 0.9),
            p(x, 0.4, 0.6),
            p(x + 0.05, 0.55, 0.45 + 0.1 * k),
            p(x, 0.72, 1.0),
            p(x, 0.78, 1.38),
        ]
        room.tube(curve(way, 8), 0.011, colour, steps=8)
    room.block("anaesthesia", at, (0.8, 0.7), turn)


def put_instrument_table(room: Room, at: tuple[float, float], turn: float) -> None:
    """Put a draped table with instruments in rows, two bowls and a stack of gauze."""
    turned = Matrix.Translation(Vector((*at, 0))) @ Matrix.Rotation(turn, 4, "Z")

    def p(x: float, y: float, z: float) -> tuple[float, float, float]:
        return tuple(turned @ Vector((x, y, z)))

    for x in (-0.56, 0.56):
        for y in (-0.24, 0.24):
            room.tube([p(x, y, 0.06), p(x, y, 0.9)], 0.014, STEEL, METAL)
            room.ball(p(x, y, 0.035), 0.035, DARK, steps=12)
    room.box(p(0, 0, 0.3), (1.16, 0.5, 0.02), STEEL, METAL, turn=turn)
    room.box(p(0, 0, 0.91), (1.3, 0.62, 0.02), DRAPE, bevel=0.008, turn=turn)
    around = np.linspace(0, 1, 121)
    rim = []
    for t in around:  # once around the table's edge, as cloth hangs
        s = (t * 4) % 4
        k, f = int(s) % 4, s - int(s)
        corner = [(-0.655, -0.315), (0.655, -0.315), (0.655, 0.315), (-0.655, 0.315), (-0.655, -0.315)]
        a, b = corner[k], corner[k + 1]
        rim.append((a[0] + (b[0] - a[0]) * f, a[1] + (b[1] - a[1]) * f))
    rows = []
    for h in np.linspace(0, 1, 7):
        row = []
        for t, (x, y) in zip(around, rim, strict=True):
            out = 1 + 0.035 * h * math.sin(2 * math.pi * 17 * t) + 0.03 * h
            row.append(p(x * out, y * out, 0.918 - 0.38 * h))
        rows.append(row)
    room.sheet(np.array(rows[::-1]), DRAPE, front=None)
    room.box(p(-0.28, -0.02, 0.925), (0.56, 0.42, 0.012), rgb("a9bfbe"), bevel=0.004, turn=turn)
    for k in range(9):
        x = -0.5 + 0.055 * k
        _put_instrument(room, p, x, k)
    for x, y, radius in ((0.2, 0.13, 0.085), (0.42, 0.15, 0.07)):
        bowl = [
            (0.03, 0),
            (0.05, 0.004),
            (radius, 0.06),
            (radius + 0.008, 0.062),
            (radius - 0.006, 0.058),
            (0.045, 0.01),
            (0, 0.01),
        ]
        room.lathe(p(x, y, 0.92), bowl, STEEL, METAL)
    for k in range(4):
        room.box(
            p(0.26, -0.15, 0.935 + 0.022 * k),
            (0.13, 0.13, 0.02),
            rgb("f3f5f2"),
            bevel=0.008,
            turn=turn + 0.03 * k,
        )
    room.box(p(0.47, -0.13, 0.95), (0.16, 0.22, 0.06), BLUE, bevel=0.01, turn=turn)
    room.block("instruments", at, (1.32, 0.64), turn)


def _put_instrument(room: Room, p, x: float, kind: int) -> None:
    """Scissors and clamps with rings, or a scalpel or pincers, lying on the tray."""
    z = 0.937
    if kind % 3 == 2:
        room.tube([p(x, -0.17, z), p(x, 0.02, z)], 0.0045, STEEL, METAL, steps=8)
        room.tube([p(x + 0.012, -0.17, z), p(x + 0.001, 0.06, z)], 0.003, STEEL, METAL, steps=6)
        return
    for side in (-1, 1):
        ring = [
            p(x + side * (0.014 + 0.013 * math.cos(a)), -0.16 + 0.017 * math.sin(a), z)
            for a in (2 * math.pi * k / 12 for k in range(13))
        ]
        room.tube(ring, 0.003, STEEL, METAL, steps=6)
        room.tube(
            [
                p(x + side * 0.012, -0.143, z),
                p(x, -0.02, z),
                p(x - side * 0.004, 0.07 + 0.01 * (kind % 4), z),
            ],
            0.0035,
            STEEL,
            METAL,
            steps=6,
        )


def put_mayo_stand(room: Room, at: tuple[float, float], turn: float) -> None:
    """Put a small tray on a bent foot, which reaches over the patient's legs."""
    turned = Matrix.Translation(Vector((*at, 0))) @ Matrix.Rotation(turn, 4, "Z")

    def p(x: float, y: float, z: float) -> tuple[float, float, float]:
        return tuple(turned @ Vector((x, y, z)))

    room.tube(curve([p(-0.22, -0.3, 0.04), p(0.22, -0.3, 0.04)], 2), 0.02, STEEL, METAL)
    room.tube([p(0, -0.3, 0.04), p(0, 0.1, 0.04)], 0.02, STEEL, METAL)
    room.tube(
        curve([p(0, -0.3, 0.04), p(0, -0.3, 0.7), p(0, -0.3, 1.16), p(0, -0.24, 1.2), p(0, 0.0, 1.2)], 5),
        0.018,
        STEEL,
        METAL,
    )
    room.box(p(0, 0.08, 1.215), (0.62, 0.44, 0.016), STEEL, METAL, bevel=0.005, turn=turn)
    room.box(p(0, 0.08, 1.226), (0.58, 0.4, 0.012), DRAPE, bevel=0.005, turn=turn)
    for k in range(5):
        room.tube(
            [p(-0.2 + 0.07 * k, -0.04, 1.238), p(-0.2 + 0.07 * k, 0.15, 1.238)], 0.005, STEEL, METAL, steps=8
        )
    room.box(p(0.19, 0.1, 1.245), (0.12, 0.16, 0.03), rgb("f3f5f2"), bevel=0.01, turn=turn)


def put_stool(room: Room, name: str, at: tuple[float, float], turn: float) -> None:
    """Put a stool that somebody can sit on, looking along ``turn``."""
    for k in range(5):
        angle = 2 * math.pi * k / 5
        end = (at[0] + 0.24 * math.cos(angle), at[1] + 0.24 * math.sin(angle), 0.06)
        room.tube([(*at, 0.1), end], 0.016, STEEL, METAL, steps=8)
        room.ball((end[0], end[1], 0.03), 0.03, DARK, steps=10)
    room.tube([(*at, 0.08), (*at, 0.46)], 0.024, STEEL, METAL)
    room.lathe(
        (*at, 0.45),
        [(0, 0), (0.17, 0), (0.185, 0.015), (0.185, 0.05), (0.165, 0.07), (0, 0.072)],
        TEAL,
        steps=36,
    )
    room.named.append(Named(name=f"seat.{name}", at=(*at, 0.0), turn=turn))


def put_infusion(room: Room, at: tuple[float, float]) -> None:
    """Put a stand with a bag and a pump."""
    for k in range(5):
        angle = 2 * math.pi * k / 5 + 0.3
        end = (at[0] + 0.26 * math.cos(angle), at[1] + 0.26 * math.sin(angle), 0.05)
        room.tube([(*at, 0.09), end], 0.013, STEEL, METAL, steps=8)
        room.ball((end[0], end[1], 0.026), 0.026, DARK, steps=10)
    room.tube([(*at, 0.08), (*at, 2.0)], 0.013, STEEL, METAL)
    room.tube([(at[0] - 0.12, at[1], 2.0), (at[0] + 0.12, at[1], 2.0)], 0.008, STEEL, METAL)
    room.box((at[0] + 0.11, at[1], 1.84), (0.1, 0.035, 0.22), rgb("dfeaf0"), bevel=0.016)
    room.box((at[0] + 0.11, at[1] - 0.019, 1.85), (0.06, 0.004, 0.09), rgb("4f86ad"), bevel=0)
    room.box((at[0], at[1] - 0.05, 1.25), (0.12, 0.12, 0.2), rgb("e3e8e6"), bevel=0.015)
    room.box((at[0], at[1] - 0.112, 1.29), (0.08, 0.006, 0.05), rgb("57b39b"), bevel=0)
    room.tube(
        curve(
            [
                (at[0] + 0.11, at[1], 1.73),
                (at[0] + 0.1, at[1] - 0.03, 1.5),
                (at[0] + 0.02, at[1] - 0.06, 1.36),
            ],
            6,
        ),
        0.004,
        rgb("e3eef2"),
        steps=6,
    )
    room.block("infusion", at, (0.3, 0.3))


def put_cabinet(room: Room, at: tuple[float, float], turn: float, width: float) -> None:
    """Put a wall cupboard: drawers below, a worktop, shelves with boxes behind open fronts above."""
    turned = Matrix.Translation(Vector((*at, 0))) @ Matrix.Rotation(turn, 4, "Z")

    def p(x: float, y: float, z: float) -> tuple[float, float, float]:
        return tuple(turned @ Vector((x, y, z)))

    room.box(p(0, 0, 0.05), (width - 0.04, 0.4, 0.1), DARK, turn=turn)
    room.box(p(0, 0, 0.48), (width, 0.45, 0.78), WHITE, bevel=0.008, turn=turn)
    count = round(width / 0.5)
    for k in range(count):
        x = -width / 2 + (k + 0.5) * width / count
        for z, tall in ((0.24, 0.26), (0.51, 0.24), (0.75, 0.2)):
            room.box(
                p(x, -0.232, z), (width / count - 0.02, 0.018, tall), rgb("a8cbc8"), bevel=0.005, turn=turn
            )
            room.tube(
                [p(x - 0.08, -0.258, z + tall * 0.3), p(x + 0.08, -0.258, z + tall * 0.3)],
                0.007,
                STEEL,
                METAL,
                steps=8,
            )
    room.box(p(0, -0.01, 0.89), (width + 0.02, 0.49, 0.035), rgb("dfe5e3"), bevel=0.008, turn=turn)
    room.box(p(0, 0.2, 1.72), (width, 0.03, 0.86), rgb("c4d3d1"), turn=turn)
    for x in (-width / 2 + 0.01, width / 2 - 0.01, 0.0):
        room.box(p(x, 0.06, 1.72), (0.02, 0.3, 0.86), WHITE, turn=turn)
    for z in (1.3, 1.58, 1.86, 2.14):
        room.box(p(0, 0.06, z), (width, 0.3, 0.02), WHITE, bevel=0.003, turn=turn)
    colours = (rgb("e9eeec"), rgb("7fb3c4"), rgb("8fc1a9"), rgb("e3d9b8"), rgb("5f9ea0"), rgb("d7e3e8"))
    for row, z in enumerate((1.31, 1.59, 1.87)):
        x, k = -width / 2 + 0.06, 0
        while x < width / 2 - 0.16:
            wide = 0.1 + 0.05 * ((k * 7 + row * 3) % 3)
            tall = 0.1 + 0.04 * ((k * 5 + row) % 4)
            if abs(x + wide / 2) > wide / 2 + 0.02:
                room.box(
                    p(x + wide / 2, 0.06, z + tall / 2),
                    (wide - 0.01, 0.2, tall),
                    colours[(k + 2 * row) % 6],
                    bevel=0.004,
                    turn=turn,
                )
            x += wide + (0.06 if (k + row) % 4 == 3 else 0.008)
            k += 1
    room.block(f"cabinet{len(room.named)}", at, (width, 0.5), turn)


def put_bucket(room: Room, at: tuple[float, float], colour=STEEL, layer: str = METAL) -> None:
    """Put a bucket on a ring with castors."""
    profile = [(0, 0.08), (0.13, 0.08), (0.165, 0.36), (0.172, 0.362), (0.158, 0.356), (0.125, 0.1), (0, 0.1)]
    room.lathe((*at, 0), profile, colour, layer)
    for k in range(4):
        angle = math.pi * (0.25 + 0.5 * k)
        room.ball(
            (at[0] + 0.14 * math.cos(angle), at[1] + 0.14 * math.sin(angle), 0.03), 0.03, DARK, steps=10
        )
