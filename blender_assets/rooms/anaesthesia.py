"""Builds an anaesthesia machine."""

from mathutils import Matrix, Vector

from blender_assets.rooms.ceiling import put_monitor
from blender_assets.rooms.colours import BLUE, DARK, GREY, STEEL, TEAL, WHITE
from blender_assets.rooms.kit import METAL, Room, curve, rgb
from blender_assets.rooms.pictures import ventilator
from blender_assets.rooms.placing import places


def put_anaesthesia(room: Room, at: tuple[float, float], turn: float) -> None:
    """Put an anaesthesia machine: drawers, a worktop, vaporizers, bellows, gauges, two screens, hoses to the wall."""
    p = places(at, turn)
    front = Matrix.Rotation(turn, 3, "Z") @ Vector((0, -1, 0))

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
            axis=front,
            steps=24,
        )
        room.lathe(
            p(x, 0.096, 1.28),
            [(0.045, 0), (0.05, 0), (0.05, 0.012), (0.04, 0.012)],
            DARK,
            axis=front,
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
