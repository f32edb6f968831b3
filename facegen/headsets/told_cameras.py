"""Says where a headset's cameras are, in the numbers that a network may be told of them."""

from collections.abc import Collection
from pathlib import Path

import numpy as np

from facegen.errors import InputError
from facegen.geometry import camera_terms
from facegen.headsets.loading import load_headset


def told_cameras(name_or_path: str | Path, cameras: Collection[str]) -> dict[str, np.ndarray]:
    """(14,) `facegen.conventions.CAMERA_TERMS` by camera, of those of a headset that a model has as well.

    Parameters
    ----------
    name_or_path
        As `load_headset` takes it.
    cameras
        Names of the model's.

    Raises
    ------
    MissingAsset, FormatError, InputError
        Where there is no such headset, its file is wrong, or it has none of these cameras.
    """
    described = load_headset(name_or_path)
    terms = {
        camera.name: camera_terms(camera.camera, camera.headset_from_camera)
        for camera in described.cameras
        if camera.name in cameras
    }
    if not terms:
        raise InputError(
            f"--headset {name_or_path} has the cameras {', '.join(described.camera_names)}; the model has "
            f"{', '.join(cameras)}: call those of the file so"
        )
    return terms
