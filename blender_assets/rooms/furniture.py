"""Builds what stands along the walls of an operating room: stools, a drip, cupboards, a bucket."""

import math

from blender_assets.rooms.colours import DARK, STEEL, TEAL, WHITE
from blender_assets.rooms.kit import METAL, Named, Room, curve, rgb
from blender_assets.rooms.placing import places


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
    p = places(at, turn)
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
