"""Lays out the plain meeting room: nine metres by eight, a round table with chairs, a screen, a window, a plant."""

import itertools
import math

import numpy as np

from blender_assets.rooms.kit import METAL, Lamp, Named, Room, Screen, curve, rgb
from blender_assets.rooms.pictures import empty_screen, outside
from blender_assets.rooms.shell import Wall, put_ceiling, put_fill, put_light, put_wall, rectangle

SIZE = (9.0, 8.0)
HEIGHT = 2.9
TABLE_RADIUS = 0.95
TABLE_HEIGHT = 0.74

WALL = rgb("efece5")
OAK = rgb("bf9f7a")
STEEL = rgb("b9bfc0")
DARK = rgb("33393d")
CUSHIONS = (rgb("4d7f86"), rgb("59707f"))


def meeting_room() -> Room:
    """All parts of the meeting room."""
    room = Room(name="meeting")
    _put_shell(room)
    profile = [
        (0, 0),
        (TABLE_RADIUS - 0.03, 0),
        (TABLE_RADIUS, 0.018),
        (TABLE_RADIUS - 0.008, 0.03),
        (0, 0.03),
    ]
    room.lathe((0, 0, TABLE_HEIGHT - 0.03), profile, OAK, steps=72)
    room.lathe(
        (0, 0, 0),
        [(0.36, 0.0), (0.36, 0.02), (0.07, 0.05), (0.06, 0.1), (0.06, 0.71), (0.0, 0.71)],
        DARK,
        steps=36,
    )
    room.block("table", (0, 0), (1.6, 1.6))
    room.block("table45", (0, 0), (1.6, 1.6), math.pi / 4)
    for number in range(6):
        angle = 2 * math.pi * number / 6 - math.pi / 2
        _put_chair(
            room,
            f"{number + 1}",
            (1.12 * math.cos(angle), 1.12 * math.sin(angle)),
            angle + math.pi / 2 + math.pi,
            CUSHIONS[number % 2],
        )
    _put_sideboard(room)
    _put_plant(room, (3.9, 3.35))
    _put_plant(room, (-3.95, -3.4))
    order = (0, 3, 1, 4, 2, 5)
    for number, k in enumerate(order, start=1):
        angle = 2 * math.pi * (k + 0.5) / 6 - math.pi / 2
        _put_place(room, number, 1.75, angle)
    for number, k in enumerate(range(10), start=7):
        _put_place(room, number, 2.7, 2 * math.pi * (k + 0.25) / 10)
    room.named.append(Named(name="walk", at=(0, 0, 0.5), half=(SIZE[0] / 2, SIZE[1] / 2, 0.5)))
    room.named.append(Named(name="door", at=(4.0, -2.2, 0), turn=-math.pi / 2))
    return room


def _put_place(room: Room, number: int, radius: float, angle: float) -> None:
    x, y = radius * math.cos(angle), radius * math.sin(angle)
    room.named.append(Named(name=f"place.{number:02}", at=(x, y, 0), turn=math.atan2(-x, y)))


def _put_shell(room: Room) -> None:
    x, y = SIZE[0] / 2, SIZE[1] / 2
    boards = np.arange(-x, x, 0.18)
    for k, left in enumerate(boards):
        shift = (k * 0.73) % 1.8
        cuts = [-y, *np.arange(-y + shift, y, 1.8), y] if shift > 0.05 else [*np.arange(-y, y, 1.8), y]
        for j, (low, high) in enumerate(itertools.pairwise(cuts)):
            tone = 0.9 + 0.2 * (((k * 13 + j * 7) % 9) / 8)
            colour = tuple(tone * c for c in rgb("b3a18a"))
            right = min(left + 0.18, x)
            rectangle(
                room,
                [
                    (left + 0.001, low + 0.001, 0),
                    (right - 0.001, low + 0.001, 0),
                    (right - 0.001, high - 0.001, 0),
                    (left + 0.001, high - 0.001, 0),
                ],
                colour,
            )
    rectangle(room, [(-x, -y, -0.002), (x, -y, -0.002), (x, y, -0.002), (-x, y, -0.002)], rgb("5b4631"))
    room.lathe(
        (0, 0, 0.0), [(2.4, 0.0), (2.4, 0.008), (2.37, 0.012), (0, 0.012)], rgb("64777c"), "shell", steps=96
    )
    room.lathe((0, 0, 0.0125), [(2.27, 0.0), (2.21, 0.0)], rgb("8c9ea0"), "shell", steps=96)
    put_ceiling(room, SIZE, HEIGHT, rgb("f0ede6"), tile=1.5)
    rows = {"rows": (HEIGHT,), "panel": 9.0}
    far = Wall(start=(x, y), turn=math.pi, length=SIZE[0], colours=(WALL,), **rows)
    near = Wall(start=(-x, -y), turn=0.0, length=SIZE[0], colours=(WALL,), **rows)
    left = Wall(start=(-x, y), turn=-math.pi / 2, length=SIZE[1], colours=(rgb("9fb8b5"),), **rows)
    right = Wall(start=(x, -y), turn=math.pi / 2, length=SIZE[1], colours=(WALL,), **rows)
    for wall in (far, near, left, right):
        put_wall(room, wall, height=HEIGHT, skirting=rgb("f4f1ea"))
    _put_window(room, y)
    _put_door(room, right)
    room.box((-x + 0.02, 0, 1.6), (0.05, 2.74, 1.58), DARK, bevel=0.012)
    room.screens.append(
        Screen(
            name="screen.wall",
            at=(-x + 0.052, 0, 1.6),
            size=(2.6, 1.4625),
            picture=empty_screen(),
            turn=math.pi / 2,
        )
    )
    for at in ((-1.5, 0.0), (1.5, 0.0), (0.0, -2.5)):
        put_light(room, (*at, HEIGHT), (1.2, 1.2) if at[1] == 0 else (2.4, 0.5), 95.0, (1.0, 0.97, 0.93))
    put_fill(room, (8.0, 7.0), 1.9, 150.0)


def _put_window(room: Room, y: float) -> None:
    """Three panes in a frame before a picture of hills; daylight comes in beside it."""
    room.box((0, y - 0.03, 0.82), (3.9, 0.22, 0.05), rgb("f6f4ee"), bevel=0.01)
    for x in (-1.86, -0.62, 0.62, 1.86):
        room.box((x, y - 0.02, 1.6), (0.07, 0.1, 1.56), rgb("f6f4ee"))
    for z in (0.86, 2.36):
        room.box((0, y - 0.02, z), (3.79, 0.1, 0.07), rgb("f6f4ee"))
    room.screens.append(Screen(name="view", at=(0, y - 0.018, 1.61), size=(3.7, 1.46), picture=outside()))
    room.lamps.append(
        Lamp(
            at=(0, y - 0.1, 1.6),
            size=(3.4, 1.3),
            watts=95.0,
            towards=(0, -1.5, 0.4),
            colour=(0.93, 0.97, 1.0),
        )
    )
    for side in (-1, 1):
        folds = np.linspace(0, 1, 61)
        rows = []
        for h in np.linspace(0, 1, 4):
            rows.append(
                [
                    (
                        side * (1.95 + 0.42 * t),
                        y - 0.12 + 0.035 * math.sin(t * 2 * math.pi * 6),
                        2.62 - 2.58 * h,
                    )
                    for t in folds
                ]
            )
        room.sheet(np.array(rows), rgb("c3ccc8"), front=(0, -1, 0))
    room.tube([(-2.5, y - 0.12, 2.63), (2.5, y - 0.12, 2.63)], 0.014, STEEL, METAL)


def _put_door(room: Room, wall: Wall) -> None:
    along, width, top = 1.8, 0.95, 2.1
    frame = rgb("f4f1ea")
    for side in (-1, 1):
        room.box(
            wall.at(along + side * (width / 2 + 0.035), 0.01, top / 2),
            (0.07, 0.07, top),
            frame,
            turn=wall.turn,
        )
    room.box(wall.at(along, 0.01, top + 0.035), (width + 0.14, 0.07, 0.07), frame, turn=wall.turn)
    room.box(wall.at(along, 0.012, top / 2), (width, 0.03, top - 0.01), rgb("9b7448"), turn=wall.turn)
    for low, high in ((0.15, 0.95), (1.1, 1.95)):
        room.box(
            wall.at(along, 0.024, (low + high) / 2),
            (width - 0.24, 0.02, high - low),
            rgb("a67f52"),
            bevel=0.012,
            turn=wall.turn,
        )
    grip = [wall.at(along + 0.38, d, 1.02) for d in (0.03, 0.085)]
    room.tube([*grip, wall.at(along + 0.26, 0.085, 1.02)], 0.011, STEEL, METAL)


def _put_chair(room: Room, name: str, at: tuple[float, float], turn: float, colour) -> None:
    """A chair with a shell and a cushion; who sits looks along ``turn`` (0: along -y)."""
    cos, sin = math.cos(turn), math.sin(turn)

    def p(x: float, y: float, z: float) -> tuple[float, float, float]:
        return (at[0] + x * cos - y * sin, at[1] + x * sin + y * cos, z)

    for x in (-0.2, 0.2):
        room.tube([p(x * 1.15, -0.24, 0.01), p(x, -0.16, 0.43)], 0.012, STEEL, METAL)
        room.tube([p(x * 1.15, 0.27, 0.01), p(x, 0.17, 0.43)], 0.012, STEEL, METAL)
    u = np.linspace(-1, 1, 13)
    way = np.array(
        curve(
            [
                (-0.25, 0.435),
                (-0.21, 0.445),
                (0.0, 0.43),
                (0.16, 0.44),
                (0.225, 0.52),
                (0.26, 0.7),
                (0.29, 0.86),
            ],
            4,
        )
    )
    shell = np.array(
        [
            [
                p(
                    0.235 * a * (1 - 0.12 * (z > 0.6)),
                    y - 0.03 * a * a * (z > 0.5),
                    z + 0.02 * a * a * (z < 0.5),
                )
                for a in u
            ]
            for y, z in way
        ]
    )
    room.sheet(shell, colour)
    room.sheet(shell[::-1] - [0, 0, 0.012], tuple(0.8 * c for c in colour), front=(0, 0, -1))
    room.box(p(0, -0.02, 0.455), (0.4, 0.4, 0.035), tuple(1.15 * c for c in colour), bevel=0.016, turn=turn)
    room.named.append(Named(name=f"seat.{name}", at=(*at, 0.0), turn=turn))


def _put_sideboard(room: Room) -> None:
    y = -SIZE[1] / 2 + 0.26
    room.box((-1.4, y, 0.4), (2.2, 0.42, 0.58), OAK, bevel=0.01)
    room.box((-1.4, y, 0.055), (2.0, 0.36, 0.1), DARK)
    for k in range(4):
        room.box(
            (-2.22 + 0.546 * k, y + 0.215, 0.4),
            (0.53, 0.018, 0.54),
            tuple((0.95 + 0.04 * (k % 2)) * c for c in OAK),
            bevel=0.005,
        )
    for k, colour in enumerate((rgb("3f6f74"), rgb("b0563f"), rgb("d8c9a4"), rgb("566b7d"), rgb("efe9da"))):
        room.box(
            (-2.2 + 0.062 * k, y, 0.69 + 0.13 - 0.012 * (k % 3)),
            (0.045, 0.18, 0.26 - 0.02 * (k % 3)),
            colour,
            bevel=0.004,
        )
    room.lathe(
        (-0.75, y, 0.69),
        [
            (0.05, 0),
            (0.085, 0.05),
            (0.09, 0.12),
            (0.045, 0.2),
            (0.055, 0.24),
            (0.045, 0.24),
            (0.035, 0.2),
            (0, 0.2),
        ],
        rgb("d9d3c6"),
    )
    # two pictures on the wall above: bands of colour in a frame
    for x, colours in ((-2.0, ("d7c7a7", "86a7a3", "3f6f74")), (-0.85, ("e7d9bd", "c98f62", "6f7f86"))):
        room.box((x, -SIZE[1] / 2 + 0.02, 1.65), (0.9, 0.035, 0.7), rgb("ece7dc"), bevel=0.008)
        for k, colour in enumerate(colours):
            room.box((x, -SIZE[1] / 2 + 0.04, 1.84 - 0.19 * k), (0.74, 0.01, 0.18), rgb(colour), bevel=0)
    room.block("sideboard", (-1.4, y), (2.2, 0.46))


def _put_plant(room: Room, at: tuple[float, float]) -> None:
    """A pot with arching leaves."""
    room.lathe(
        (*at, 0),
        [(0, 0), (0.15, 0), (0.2, 0.36), (0.205, 0.38), (0.185, 0.38), (0.18, 0.33), (0, 0.33)],
        rgb("d9d4c8"),
    )
    for k in range(22):
        turn, reach, rise = 2.399963 * k, 0.2 + 0.02 * (k % 7), 0.95 - 0.018 * k
        side = (-math.sin(turn), math.cos(turn))
        rows = []
        for t in np.linspace(0, 1, 9):
            out, z = reach * 1.6 * t**1.4, 0.34 + rise * math.sin(2.2 * t) * 0.9
            wide = 0.045 * math.sin(math.pi * min(1, 0.06 + 0.94 * t)) ** 0.8
            x, y = at[0] + out * math.cos(turn), at[1] + out * math.sin(turn)
            rows.append(
                [(x + side[0] * wide * a, y + side[1] * wide * a, z - 0.012 * abs(a)) for a in (-1, 0, 1)]
            )
        room.sheet(np.array(rows), tuple((0.8 + 0.05 * (k % 5)) * c for c in rgb("4f7f4c")))
    room.block(f"plant{len(room.named)}", at, (0.4, 0.4))
