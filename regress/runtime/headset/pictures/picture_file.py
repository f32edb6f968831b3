"""Reads one picture in grey and brings it to the size that a network takes."""

from dataclasses import dataclass, replace
from pathlib import Path

import cv2
import numpy as np

from facegen.documents import read_bytes
from facegen.formats import FormatError
from facegen.formats.picture_size import MOST_PIXELS, picture_size
from regress.errors import InputError
from regress.runtime.headset.pictures.faults import DARK, Fault, picture_fault
from regress.runtime.headset.pictures.halves import half_of
from regress.runtime.headset.pictures.placement import NO_CUT, CameraPlacement, whole_view

PICTURES = (".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".pgm", ".ppm", ".webp")

ASPECT = 0.02
"""Relative difference of aspect ratios up to which a picture is only scaled: 400 x 400 for 96 x 96, not 640 x 400."""

STRANGE_ASPECT = 1.9
"""Ratio of aspect ratios above which a picture is no view of one eye or a mouth: 1280 x 640 show two eyes side by side,
and 640 x 360 are 1.78."""

MOST_PICTURE_BYTES = 256 * 1024**2
"""Of a picture's file: the most pixels that are read, with 16 bits and two channels, not compressed."""


_GLINTS = 0.01
"""Share of a picture's pixels from which levels that its bits do not hold are no glints."""


_DEPTHS = (8, 10, 12, 14, 16)
"""Bits of cameras."""


@dataclass(frozen=True, kw_only=True, eq=False)
class FittedPicture:
    """A picture at the network's size.

    Parameters
    ----------
    picture : (h, w) uint8
        0 where it is at fault.
    fault
        What is wrong with it.
    scaled_from
        Its own width and height, where it was scaled.
    """

    picture: np.ndarray
    fault: Fault | None
    scaled_from: tuple[int, int] | None


def read_picture(
    path: Path,
    *,
    width: int,
    height: int,
    bits: int | None = None,
    placement: CameraPlacement | None = None,
    half: str = "",
) -> FittedPicture:
    """Read a picture in grey and bring it to a size; a file that is no picture is a fault of it.

    Parameters
    ----------
    half
        Which half of it counts, as ``half_of`` takes it.
    bits
        How many of its 16 bits the camera uses, where the picture has so many: files do not say.
    placement
        What of it the network is to see.

    Raises
    ------
    InputError
        Where a picture has 16 bits and ``bits`` is not given, or a level that they do not hold; where it has numbers of
        another kind.
    """
    grey = decoded(path)
    if isinstance(grey, Fault):
        return FittedPicture(picture=np.zeros((height, width), dtype=np.uint8), fault=grey, scaled_from=None)
    if grey.dtype != np.uint8:
        grey = eight_bits(grey, path, bits)
    return fit_picture(half_of(grey, half), width=width, height=height, placement=placement)


def decoded(path: Path) -> np.ndarray | Fault:
    """Grey levels (h, w) of a picture's file, or what is wrong with it."""
    try:
        if not path.is_file():  # a pipe would never end
            return Fault.UNREADABLE
        content = read_bytes(path, most_bytes=MOST_PICTURE_BYTES)
    except FormatError:
        return Fault.LARGE
    except (OSError, InputError):
        return Fault.UNREADABLE
    size = picture_size(content)
    if size is not None and size[0] * size[1] > MOST_PIXELS:
        return Fault.LARGE
    try:
        data = np.frombuffer(content, dtype=np.uint8)
        grey = None if size is None else cv2.imdecode(data, cv2.IMREAD_GRAYSCALE | cv2.IMREAD_ANYDEPTH)
    except cv2.error:
        grey = None
    return Fault.UNREADABLE if grey is None else grey


def eight_bits(grey: np.ndarray, path: Path, bits: int | None) -> np.ndarray:
    """Grey levels of 16 bits, of which a camera uses so many, as uint8.

    Raises
    ------
    InputError
        As ``read_picture`` does.
    """
    if grey.dtype != np.uint16:
        raise InputError(f"{path} has pixels of type {grey.dtype}; pictures of 8 or 16 bits can be read")
    if bits is None:
        raise InputError(
            f"{path} has 16 bits a pixel, and the brightest is {grey.max()}; --bits says how many of them the camera "
            f"uses (10 for levels to 1023)"
        )
    # a glint or a broken pixel may have more
    if np.count_nonzero(grey >= 1 << bits) >= _GLINTS * grey.size:
        raise InputError(
            f"{path} has the level {grey.max()}, and --bits {bits} holds levels to {(1 << bits) - 1}; give more, or 16 "
            f"where the camera's bits are the upper ones"
        )
    return (np.minimum(grey, (1 << bits) - 1) >> (bits - 8)).astype(np.uint8)


def bits_note(path: Path, bits: int | None) -> str:
    """That a black picture of 16 bits a pixel is one of a camera of fewer bits, in words; empty where it is none."""
    grey = decoded(path)
    if bits is None or isinstance(grey, Fault) or grey.dtype != np.uint16:
        return ""
    used = int(np.percentile(grey, 100 * (1 - _GLINTS))).bit_length()
    needed = next(depth for depth in _DEPTHS if used <= depth)
    if needed >= bits or int(grey.max()) < DARK:
        return ""
    return f"its brightest level is {grey.max()}; give --bits {needed}"


def has_shape_of(picture: tuple[int, int], view: tuple[float, float]) -> bool:
    """Whether a picture only needs scaling to become a view; both are (width, height)."""
    return abs(picture[0] * view[1] / (picture[1] * view[0]) - 1) <= ASPECT


def whole_of_shape(
    picture: tuple[int, int], view: tuple[int, int], cut: tuple[float, ...] = NO_CUT
) -> CameraPlacement | None:
    """What nobody placed: all that a cut leaves of pictures of another shape than a view's; both are (width, height).

    None for pictures that only need scaling, and for those that are so much wider or higher than the view that they
    show something else.
    """
    left, top, right, bottom = CameraPlacement(cut=cut).kept(picture)
    kept = right - left, bottom - top
    ratio = kept[0] * view[1] / (kept[1] * view[0])
    if max(ratio, 1 / ratio) > STRANGE_ASPECT or (has_shape_of(kept, view) and not any(cut)):
        return None
    return replace(whole_view(kept, view), cut=cut, aspect=picture[0] / picture[1])


def fit_picture(
    grey: np.ndarray, *, width: int, height: int, placement: CameraPlacement | None = None
) -> FittedPicture:
    """Bring a grey picture to a size: what a placement says of it, or all of it if only the size differs."""
    view, size = (width, height), (grey.shape[1], grey.shape[0])
    shape = view if placement is None else (placement.aspect or size[0] / size[1], 1)
    if not has_shape_of(size, shape):
        return FittedPicture(
            picture=np.zeros(view[::-1], dtype=np.uint8), fault=Fault.SHAPE, scaled_from=None
        )
    scaled_from = size
    if placement is not None:
        grey = placement.view(grey, width=width, height=height)
    elif size == view:
        scaled_from = None
    else:
        grey = cv2.resize(grey, view, interpolation=cv2.INTER_AREA)
    fault = picture_fault(grey)
    picture = np.zeros(view[::-1], dtype=np.uint8) if fault else grey
    return FittedPicture(picture=picture, fault=fault, scaled_from=scaled_from)
