"""Pictures of one camera, one after the other, at the size that a network takes."""

import numpy as np

from regress.runtime.headset.pictures.faults import Fault
from regress.runtime.headset.pictures.picture_file import FittedPicture


class PictureStack:
    """Pictures of one size, in memory that is taken once.

    Parameters
    ----------
    count
        How many are expected; there may be fewer or more.
    size
        Width and height.
    """

    def __init__(self, count: int, size: tuple[int, int]) -> None:
        width, height = size
        self._size = size
        self._pictures = np.empty((max(1, count), height, width), dtype=np.uint8)
        self._scaled_from: list[tuple[int, int] | None] = []
        self._faults: list[Fault | None] = []

    def __len__(self) -> int:
        return len(self._faults)

    def add(self, one: FittedPicture) -> None:
        """Put a picture behind the others."""
        if len(self) == len(self._pictures):
            self._pictures = np.concatenate([self._pictures, np.empty_like(self._pictures)])
        self._pictures[len(self)] = one.picture
        self._faults.append(one.fault)
        self._scaled_from.append(one.scaled_from)

    @property
    def fields(self) -> dict[str, object]:
        """What a `Recording` has of them."""
        scaled = any(self._scaled_from)
        return {
            "pictures": self._pictures[: len(self)],
            "faults": tuple(self._faults),
            "scaled_from": np.array([one or self._size for one in self._scaled_from]) if scaled else None,
        }
