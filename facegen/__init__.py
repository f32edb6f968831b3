"""Makes synthetic people: labelled face keypoints by the million, and pictures for VR headsets."""

import importlib

from facegen.version import __version__

__all__ = ["__version__", "load_rig", "open_dataset"]

_HOMES = {"load_rig": "facegen.rigs", "open_dataset": "facegen.store"}


def __getattr__(name: str) -> object:
    # on demand: regress and the command line import parts of facegen, and need none of what these bring along
    if name in _HOMES:
        return getattr(importlib.import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'facegen' has no attribute {name!r}")
