"""Builds the operating table, and on it a person under drapes: a form, not a portrait."""

import numpy as np

from blender_assets.rooms.kit import METAL, Room, curve, rgb

TABLE_M = 0.92
"""Height of the mattress: at the elbows of who operates."""
HALF_M = 0.29
"""Half the mattress's width."""

DRAPE = rgb("62a5ad")
STEEL = rgb("c4cac9")
PAD = rgb("2c3334")
SKIN = rgb("c99878")

_BODY = (
    # x along the table from the head, half width, height above the mattress
    (-0.62, 0.10, 0.12),
    (-0.5, 0.22, 0.18),
    (-0.3, 0.235, 0.225),
    (-0.08, 0.2, 0.205),
    (0.1, 0.205, 0.19),
    (0.3, 0.21, 0.175),
    (0.55, 0.17, 0.15),
    (0.75, 0.14, 0.13),
    (0.95, 0.12, 0.1),
    (1.06, 0.12, 0.2),
    (1.12, 0.09, 0.12),
)


def put_table(room: Room) -> None:
    """Put the table: a foot, a column with its sleeve, a frame with rails, a mattress in three parts."""
    room.box((0.05, 0, 0.07), (1.15, 0.5, 0.13), rgb("dfe4e2"), bevel=0.04)
    room.box((0.05, 0, 0.15), (0.72, 0.4, 0.06), rgb("b9c2c1"), bevel=0.02)
    room.box((0.05, 0, 0.42), (0.42, 0.3, 0.56), rgb("e6eae8"), bevel=0.03)
    room.box((0.05, 0, 0.7), (0.34, 0.24, 0.2), STEEL, METAL, bevel=0.01)
    for x, wide in ((-0.62, 0.5), (0.05, 0.78), (0.8, 0.66)):
        room.box((x, 0, 0.835), (wide, 0.5, 0.04), rgb("9aa5a5"), bevel=0.01)
        room.box((x, 0, 0.885), (wide - 0.02, 2 * HALF_M - 0.06, 0.07), PAD, bevel=0.025)
    for side in (-1, 1):
        room.box((0.05, side * 0.285, 0.83), (1.9, 0.012, 0.03), STEEL, METAL, bevel=0.003)
    room.block("table", (0.12, 0), (2.3, 0.62))


def put_patient(room: Room) -> None:
    """Put a person on the table: drapes with an opening, a screen of cloth before the head, cap and mask behind it."""
    _put_drape(room)
    _put_opening(room)
    _put_head(room)


def _height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """How high cloth lies above the mattress at metres along and across the table."""
    table = np.array(_BODY)
    half, high = (np.interp(x, table[:, 0], table[:, k], left=0.03, right=0.03) for k in (1, 2))
    round_ = np.clip(1 - (np.abs(y) / (half + 0.075)) ** 2.4, 0, 1)
    body = high * round_**0.75
    # cloth sags between two legs, and hangs from the toes
    legs = np.interp(x, [0.25, 0.5, 1.0, 1.1], [0, 0.045, 0.05, 0.0])
    return body - legs * np.exp(-((y / 0.05) ** 2)) + 0.012


def _put_drape(room: Room) -> None:
    x = np.linspace(-0.5, 1.16, 84)
    across = np.linspace(-0.78, 0.78, 79)
    points = np.empty((len(x), len(across), 3))
    edge = HALF_M + 0.015
    for i, at in enumerate(x):
        over = np.abs(across) - edge
        y = np.where(over < 0, across, np.sign(across) * edge)
        lies = _height(np.full_like(y, at), y)
        folds = np.sin(at * 19 + np.sign(across) * 0.9) + 0.5 * np.sin(at * 31 + 2 * np.sign(across))
        hang = np.clip(over, 0, None)
        out = 0.03 * (1 - np.exp(-hang / 0.05)) + 0.035 * folds * np.minimum(hang / 0.3, 1.2) * 0.7
        bend = np.where(over < 0, 0, np.clip(hang, 0, None))
        points[i, :, 0] = at
        points[i, :, 1] = y + np.sign(across) * np.where(over < 0, 0, out)
        points[i, :, 2] = (
            TABLE_M + np.where(over < 0, lies, lies - bend) + 0.004 * np.sin(at * 23 + across * 17)
        )
    foot = np.linspace(0.0, 0.42, 15)[1:]
    end = np.repeat(points[-1:], len(foot), axis=0)  # over the end of the table it hangs down
    end[:, :, 0] += 0.02 + 0.02 * np.sin(end[:, :, 1] * 26) * (foot / 0.4)[:, None]
    end[:, :, 2] = np.minimum(end[:, :, 2], np.maximum(end[:, :, 2] - foot[:, None], TABLE_M - 0.5))
    room.sheet(np.concatenate([points, end]), DRAPE)


def _put_opening(room: Room) -> None:
    """Skin with a yellow tint in a frame of cloth, over the belly; towels around it."""
    x, y = np.meshgrid(np.linspace(-0.16, 0.16, 17), np.linspace(-0.115, 0.115, 13), indexing="ij")
    skin = np.stack([x + 0.02, y, TABLE_M + _height(x + 0.02, y) + 0.006], axis=-1)
    room.sheet(skin, rgb("cf9a5e"))
    for along, wide, low, high in (("x", 0.055, -0.2, 0.2), ("y", 0.055, -0.15, 0.15)):
        for side in (-1, 1):
            u, v = np.meshgrid(np.linspace(low, high, 19), np.linspace(-wide, wide, 5), indexing="ij")
            swell = 0.012 * (1 - (v / wide) ** 2) + 0.01
            if along == "x":
                px, py = u + 0.02, side * 0.125 + v
            else:
                px, py = side * 0.175 + v + 0.02, u
            room.sheet(np.stack([px, py, TABLE_M + _height(px, py) + swell], axis=-1), rgb("4d8f9c"))


def _put_head(room: Room) -> None:
    head = (-0.86, 0.0, TABLE_M + 0.15)
    room.box((-0.84, 0, TABLE_M + 0.02), (0.34, 0.4, 0.07), rgb("dbe5e3"), bevel=0.03)
    room.ball(head, 0.1, SKIN, scale=(1.12, 0.78, 0.98), steps=32)
    room.ball((head[0] - 0.035, 0, head[2] + 0.004), 0.108, rgb("76b3b0"), scale=(0.95, 0.86, 1.02), steps=32)
    room.tube([(-0.76, 0, TABLE_M + 0.12), (-0.6, 0, TABLE_M + 0.1)], 0.055, SKIN, steps=20)
    # mask over nose and mouth, and the two hoses of the breathing circuit
    room.ball((head[0] + 0.045, 0, head[2] + 0.085), 0.05, rgb("b9d6da"), scale=(1.0, 0.85, 0.7))
    room.lathe(
        (head[0] + 0.045, 0, head[2] + 0.11), [(0.0, 0), (0.022, 0), (0.02, 0.045), (0, 0.045)], rgb("e6f0f2")
    )
    start = (head[0] + 0.045, 0.0, head[2] + 0.15)
    for side in (-1, 1):
        hose = [
            start,
            (head[0] - 0.02, 0.04 + side * 0.02, head[2] + 0.2),
            (-1.2, 0.16 + side * 0.03, 1.1),
            (-1.6, 0.3 + side * 0.035, 0.99),
            (-2.0, 0.42 + side * 0.05, 0.84),
        ]
        room.tube(curve(hose, 8), 0.015, rgb("a9cdd4"), steps=10)
    # cloth before the head, held by a bow
    bow = [
        (-0.56, -0.46, 0.95),
        (-0.56, -0.46, 1.34),
        (-0.56, -0.4, 1.4),
        (-0.56, 0.4, 1.4),
        (-0.56, 0.46, 1.34),
        (-0.56, 0.46, 0.95),
    ]
    room.tube(curve(bow, 4), 0.009, STEEL, METAL)
    y, t = np.meshgrid(np.linspace(-0.5, 0.5, 41), np.linspace(0, 1, 13), indexing="ij")
    lies = TABLE_M + np.where(
        np.abs(y) < 0.3, _height(np.full_like(y, -0.5), y), -0.1 - 0.6 * (np.abs(y) - 0.3)
    )
    z = 1.395 + (lies - 1.395) * t
    x = -0.55 + 0.07 * t**1.5 + 0.012 * np.sin(y * 24) * t
    room.sheet(np.stack([x, y, z], axis=-1), rgb("5b9da6"), front=(1, 0, 0))
    room.sheet(np.stack([x - 0.012 - 0.03 * t, y, z], axis=-1), rgb("5b9da6"), front=(-1, 0, 0))
