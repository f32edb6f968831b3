"""Turns a thing's own places into those of the room that it stands in."""

from collections.abc import Callable

from mathutils import Matrix, Vector


def places(
    at: tuple[float, float], turn: float
) -> Callable[[float, float, float], tuple[float, float, float]]:
    """A function from a thing's own metres, x to its right and z up, to the room's.

    Parameters
    ----------
    at
        Where the thing's middle stands on the floor, in metres.
    turn
        About z, in radians; 0 looks along -y.
    """
    turned = Matrix.Translation(Vector((*at, 0))) @ Matrix.Rotation(turn, 4, "Z")

    def place(x: float, y: float, z: float) -> tuple[float, float, float]:
        return tuple(turned @ Vector((x, y, z)))

    return place
