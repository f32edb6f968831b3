"""Random streams keyed by what they are for, never by the order in which they are asked for."""

import hashlib

import numpy as np


def stream(seed: int, component: str, block: int) -> np.random.Generator:
    """Generator of one component's draws in one block.

    Adding a component leaves the draws of all others unchanged, and no draw depends on which worker made it.

    Parameters
    ----------
    seed
        The spec's seed, 0 or more.
    component
        Name of what is drawn, for example ``"identity"``.
    block
        Index of the block of samples (or people, for what belongs to a person).
    """
    digest = hashlib.sha256(component.encode()).digest()
    words = np.frombuffer(digest[:16], dtype="<u4")
    sequence = np.random.SeedSequence(entropy=seed, spawn_key=(*(int(word) for word in words), block))
    return np.random.Generator(np.random.PCG64(sequence))
