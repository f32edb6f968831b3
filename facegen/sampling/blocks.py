"""Picks people and sessions out of the blocks of 1,000 that they are drawn in."""

import numpy as np

from facegen.conventions import BLOCK


def blocks_of(number: np.ndarray) -> tuple[list[int], np.ndarray]:
    """Blocks to draw whole for people or sessions by number (n,), and each one's row (n,) in these blocks, joined."""
    blocks = np.unique(number // BLOCK)
    return blocks.tolist(), np.searchsorted(blocks, number // BLOCK) * BLOCK + number % BLOCK
