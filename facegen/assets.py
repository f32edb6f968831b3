"""Finds ``blender_assets``, which holds the files of headsets and what rigs are built from."""

from pathlib import Path


def assets_folder() -> Path:
    """The source tree's ``blender_assets``, or the current folder's where there is no source tree.

    A package that was installed by ``pip install .`` has no source tree beside it; it is used in the clone.
    """
    in_source = Path(__file__).resolve().parents[1] / "blender_assets"
    return in_source if in_source.is_dir() else Path("blender_assets")
