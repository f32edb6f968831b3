"""Gives people their numbers, which stand before each of their states and choose the colours of their clothes."""

import itertools
from collections.abc import Container

NUMBERS = 65536
"""Of people: two bytes before each state."""

COLOURS = 12
"""Of people's clothes (``CLOTHES`` in ``web/room/figure/colours.ts``): pages take them by the number."""


def free_number(wish: int, *, taken: Container[int], first: int) -> int:
    """A number whose colour nobody has, while there is one; the colour of ``wish`` where that is free.

    A person's wish follows from their id, so they come back in the same colour. Numbers begin near ``first``, but
    with the same colour at every process.
    """
    first -= first % COLOURS
    steps = (row * COLOURS + (wish + step) % COLOURS for row in itertools.count() for step in range(COLOURS))
    return next(number for step in steps if (number := (first + step) % NUMBERS) not in taken)
