"""The camera that saw the landmarks: what a person says of it, and what is taken where nothing is said."""

import math
from dataclasses import dataclass

import numpy as np

from regress.errors import InputError
from regress.runtime.heads.shape import HeadShape

TYPICAL_FOV_DEG = 60.0
"""Angle of view along a picture's longer side: webcams and phones' front cameras have 55 to 75. 30 % off in the focal
length costs head pose .1 to .8 degrees (docs/head-pose.md)."""

TYPICAL_DISTANCE_M = 0.6
"""From a screen's camera to the head before it, where nothing is known of the picture."""


@dataclass(frozen=True, kw_only=True)
class FaceCamera:
    """A pinhole without distortion.

    Parameters
    ----------
    focal_px
        Focal length.
    centre_px
        Principal point, x and y; (0, 0) is the centre of the top-left pixel.
    """

    focal_px: float
    centre_px: tuple[float, float]


def typical_camera(width: int, height: int) -> FaceCamera:
    """The camera that pictures of this size are taken to come from, where nothing is known of it.

    A picture that stands upright is of a camera on its side: along its longer side it sees as much.
    """
    focal_px = max(width, height) / 2 / math.tan(math.radians(TYPICAL_FOV_DEG) / 2)
    return FaceCamera(focal_px=focal_px, centre_px=((width - 1) / 2, (height - 1) / 2))


@dataclass(frozen=True, kw_only=True)
class CameraSettings:
    """What a person says of the camera.

    Parameters
    ----------
    picture_px
        Width and height of the pictures in which the landmarks were found.
    fov_deg
        Angle of view across the picture's width.
    focal_px
        Focal length; goes before ``fov_deg``.

    Raises
    ------
    InputError
        Where an angle of view is given without a picture.
    """

    picture_px: tuple[int, int] | None = None
    fov_deg: float | None = None
    focal_px: float | None = None

    def __post_init__(self) -> None:
        if self.fov_deg is not None and self.picture_px is None:
            raise InputError(
                f"an angle of view of {self.fov_deg:g} degrees needs the picture's size, WIDTHxHEIGHT in pixels"
            )

    def camera(self, face: np.ndarray, shape: HeadShape) -> FaceCamera:
        """The camera, with what is missing taken from the take's first face (68, 2).

        A camera whose picture is not known looks straight at that face; one whose focal length is not known either has
        it at `TYPICAL_DISTANCE_M`.
        """
        focal_px = self.focal_px
        if self.picture_px is not None:
            width, height = self.picture_px
            if focal_px is None:
                if self.fov_deg is None:
                    return typical_camera(width, height)
                focal_px = width / 2 / math.tan(math.radians(self.fov_deg) / 2)
            return FaceCamera(focal_px=focal_px, centre_px=((width - 1) / 2, (height - 1) / 2))
        middle, scale = shape.laid_upon(face[None])
        if focal_px is None:
            focal_px = float(abs(scale[0])) * TYPICAL_DISTANCE_M
        return FaceCamera(focal_px=focal_px, centre_px=(float(middle[0].real), float(middle[0].imag)))
