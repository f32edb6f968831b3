"""What a detector says of a picture besides its points."""

from enum import Enum


class FaceFault(Enum):
    """What is wrong with the faces in a picture; the value says what it has."""

    OTHERS = "other faces as well, which are ignored"
