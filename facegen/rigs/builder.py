"""Says what a rig that facegen builds is: where it comes from, and the function that builds it."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from facegen.rigs.rig import Rig


@dataclass(frozen=True, kw_only=True)
class RigSources:
    """Where builders find their sources.

    Attributes
    ----------
    path
        Folder that the user named.
    wheel
        Wheel of a Python package that the user named.
    downloads
        Folder for what is downloaded.
    modes
        Identity modes to take of sources that may hold more; None takes as many as the rig does.
    """

    path: Path | None
    wheel: Path | None
    downloads: Path
    modes: int | None = None


@dataclass(frozen=True, kw_only=True)
class RigBuilder:
    """A rig that facegen builds: a module, and a line in `facegen.rigs.building.RIGS` and in `facegen.rigs.versions`.

    Attributes
    ----------
    licence
        Of the shapes.
    origin
        A few words for ``facegen rig list``.
    build
        Builds it; raises `facegen.errors.InputError` where the sources are missing or unusable.
    """

    licence: str
    origin: str
    build: Callable[[RigSources], Rig]
