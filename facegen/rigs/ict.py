"""Builds the rig ``ict`` from a clone of ICT-FaceKit (light, MIT)."""

from pathlib import Path

from facegen.errors import InputError
from facegen.rigs.rig import Rig

VERSION = "ICT-FaceKit light, build 1"


def build_ict(clone: Path) -> Rig:
    """Build the rig from the clone's OBJ files."""
    raise InputError("not yet")
