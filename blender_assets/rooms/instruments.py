"""Builds tables of instruments: a draped one, and a tray over the patient."""

import math

import numpy as np

from blender_assets.rooms.colours import BLUE, DARK, DRAPE, STEEL
from blender_assets.rooms.kit import METAL, Room, curve, rgb
from blender_assets.rooms.placing import places


def put_instrument_table(room: Room, at: tuple[float, float], turn: float) -> None:
    """Put a draped table with instruments in rows, two bowls and a stack of gauze."""
    p = places(at, turn)
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
    p = places(at, turn)
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
