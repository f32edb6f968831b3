"""The order in which people number things: ``frame_2`` before ``frame_10``."""

import re

NaturalOrder = tuple[list[tuple[int, str]], str]


def natural_order(name: str) -> NaturalOrder:
    """Key that sorts names by the numbers in them; texts before numbers, and other names have other keys."""
    pieces = re.split(r"(\d+)", name)
    return [(int(piece), "") if piece.isdecimal() else (-1, piece) for piece in pieces], name
