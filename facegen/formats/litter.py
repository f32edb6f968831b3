"""Files that systems leave in folders by themselves: no part of a dataset, and no reason to refuse its folder."""

_NAMES = frozenset({".DS_Store", "Thumbs.db", "desktop.ini"})
"""Of macOS' Finder and Windows' Explorer, which write them where somebody looks."""

_BEGINNINGS = ("._", ".nfs")
"""Of macOS on disks of others, and of NFS where a file that is open was removed."""


def is_litter(name: str) -> bool:
    """Whether a system's own files are called so."""
    return name in _NAMES or name.startswith(_BEGINNINGS)
