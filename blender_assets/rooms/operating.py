"""Lays out the operating room: eight metres by seven, the table in its middle, the shared screen on the far wall."""

import math

from blender_assets.rooms.anaesthesia import put_anaesthesia
from blender_assets.rooms.ceiling import put_boom, put_operating_lamp
from blender_assets.rooms.furniture import put_bucket, put_cabinet, put_infusion, put_stool
from blender_assets.rooms.instruments import put_instrument_table, put_mayo_stand
from blender_assets.rooms.kit import GLOW, Named, Room, Screen, rgb
from blender_assets.rooms.patient import put_patient, put_table
from blender_assets.rooms.pictures import clock, empty_screen
from blender_assets.rooms.shell import (
    Wall,
    put_ceiling,
    put_fill,
    put_light,
    put_sliding_door,
    put_wall,
    rectangle,
)

SIZE = (8.0, 7.0)
HEIGHT = 3.0

FLOOR = rgb("bcc8c5")
INLAY = rgb("9cbdba")
LOW = rgb("9ec8c4")
MIDDLE = rgb("e2eeeb")
HIGH = rgb("eff4f2")
FEATURE = rgb("5d9b9c")
SKIRTING = rgb("a3b8b4")

STANDING = (
    # x, y and where one looks; across the table from each other first
    ((0.05, -0.78), (0.05, 0.0)),
    ((0.05, 0.78), (0.05, 0.0)),
    ((0.75, -0.78), (0.5, 0.0)),
    ((-1.42, -0.05), (0.0, 0.0)),
    ((-0.65, -0.95), (0.0, 0.0)),
    ((0.8, 0.85), (0.3, 0.0)),
    ((1.63, 0.7), (0.0, 0.0)),
    ((-0.3, -1.75), (0.0, 0.0)),
    ((0.65, -1.75), (0.1, 0.0)),
    ((-1.25, -1.75), (0.0, 0.0)),
    ((1.5, -1.55), (0.1, 0.0)),
    ((-0.3, -2.6), (0.0, 0.0)),
    ((0.7, -2.6), (0.1, 0.0)),
    ((1.7, -2.5), (0.1, 0.0)),
    ((-1.3, -2.6), (0.0, 0.0)),
    ((2.5, 1.2), (0.3, 0.0)),
)


def operating_room() -> Room:
    """All parts of the operating room."""
    room = Room(name="operating")
    _put_shell(room)
    put_table(room)
    put_patient(room)
    target = (0.05, 0.0, 1.1)
    put_operating_lamp(room, (-0.15, 0.55), math.radians(-150), (-0.3, 0.18, 2.05), target, HEIGHT, 46.0)
    put_operating_lamp(room, (0.35, 0.55), math.radians(-40), (0.62, -0.12, 2.14), target, HEIGHT, 46.0)
    put_boom(
        room,
        (1.55, 1.75),
        HEIGHT,
        ((1.15, 1.3, 1.72, math.radians(-18)), (1.85, 1.2, 1.72, math.radians(-40))),
    )
    put_anaesthesia(room, (-2.1, 0.75), math.radians(70))
    put_infusion(room, (-1.15, 0.78))
    put_instrument_table(room, (2.0, -0.35), math.radians(-90))
    put_mayo_stand(room, (0.98, 0.62), math.radians(180))
    put_cabinet(room, (-2.55, -3.24), math.pi, 2.0)
    put_bucket(room, (-0.45, -1.15))
    put_bucket(room, (3.5, -2.9), rgb("d9b440"), "things")
    put_bucket(room, (3.05, -3.0), rgb("e8ecea"), "things")
    put_stool(room, "1", (-1.55, 1.45), math.radians(60))
    put_stool(room, "2", (0.3, 1.6), math.radians(10))
    put_stool(room, "3", (-3.3, 1.9), math.radians(90))
    room.block("bins", (3.45, -3.15), (1.2, 0.8))
    room.named.append(Named(name="walk", at=(0, 0, 0.5), half=(SIZE[0] / 2, SIZE[1] / 2, 0.5)))
    for number, ((x, y), (to_x, to_y)) in enumerate(STANDING, start=1):
        room.named.append(Named(name=f"place.{number:02}", at=(x, y, 0), turn=math.atan2(to_x - x, y - to_y)))
    room.named.append(Named(name="door", at=(3.55, -1.15, 0), turn=-math.pi / 2))
    return room


def _put_shell(room: Room) -> None:
    x, y = SIZE[0] / 2, SIZE[1] / 2
    rectangle(room, [(-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)], FLOOR)
    for radius, height, colour in ((1.95, 0.002, rgb("aebfbc")), (1.87, 0.003, INLAY)):
        room.lathe((0, 0, height), [(radius, 0), (0, 0)], colour, "shell", steps=96)
    put_ceiling(room, SIZE, HEIGHT, rgb("eef2f0"))
    rows, plain = (1.15, 2.2, HEIGHT), (LOW, MIDDLE, HIGH)
    far = Wall(
        start=(x, y),
        turn=math.pi,
        length=SIZE[0],
        colours=(LOW, FEATURE, HIGH),
        rows=(0.95, 2.6, HEIGHT),
        panel=1.34,
    )
    near = Wall(start=(-x, -y), turn=0.0, length=SIZE[0], colours=plain, rows=rows, openings=())
    left = Wall(start=(-x, y), turn=-math.pi / 2, length=SIZE[1], colours=plain, rows=rows)
    right = Wall(
        start=(x, -y),
        turn=math.pi / 2,
        length=SIZE[1],
        colours=plain,
        rows=rows,
        openings=((1.6, 3.1, 2.15),),
    )
    for wall in (far, near, left, right):
        put_wall(room, wall, height=HEIGHT, skirting=SKIRTING)
    put_sliding_door(room, right, 1.6, 3.1, 2.15, rgb("b7d2cd"))
    # the shared screen in its frame; sockets of the medical gases; a clock
    room.box((-0.35, y - 0.02, 1.72), (2.62, 0.05, 1.52), rgb("20292b"), bevel=0.012)
    room.screens.append(
        Screen(name="screen.wall", at=(-0.35, y - 0.052, 1.72), size=(2.5, 1.40625), picture=empty_screen())
    )
    room.box((-x + 0.03, 0.95, 1.42), (0.05, 0.7, 0.2), rgb("e8ecea"), bevel=0.01)
    for k, colour in enumerate((rgb("f4f6f6"), rgb("3f6fb0"), rgb("2e2e30"), rgb("d8c23a"))):
        room.lathe(
            (-x + 0.05, 0.72 + 0.15 * k, 1.42),
            [(0, 0), (0.032, 0), (0.028, 0.03), (0, 0.03)],
            colour,
            axis=(1, 0, 0),
            steps=20,
        )
    room.box((2.6, y - 0.01, 2.3), (0.35, 0.04, 0.35), rgb("5b686a"), bevel=0.01)
    room.screens.append(Screen(name="clock", at=(2.6, y - 0.032, 2.3), size=(0.31, 0.31), picture=clock()))
    # a light box and a panel of switches beside the screen
    room.box((2.35, y - 0.025, 1.5), (0.9, 0.05, 0.62), rgb("d6dcda"), bevel=0.012)
    room.box((2.35, y - 0.045, 1.52), (0.8, 0.03, 0.48), (0.86, 0.95, 1.0), GLOW, bevel=0.003)
    room.box((x - 0.03, 0.05, 1.25), (0.03, 0.16, 0.24), rgb("f0f3f2"), bevel=0.008)
    for at in ((-2.2, -1.6), (2.2, -1.6), (-2.2, 1.9), (2.75, 1.9), (0.0, -1.6), (0.0, 2.35)):
        put_light(room, (*at, HEIGHT), (1.15, 0.3), 62.0)
    put_fill(room, (7.0, 6.0), 1.9, 150.0)
