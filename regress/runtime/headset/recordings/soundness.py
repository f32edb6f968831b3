"""Live cameras' pictures at the network's size, without those that show nothing or are frozen."""

from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from regress.errors import InputError
from regress.runtime.headset.pictures.bars import LOOKED_AT, bars_of
from regress.runtime.headset.pictures.faults import Fault, FrozenWatch
from regress.runtime.headset.pictures.picture_file import FittedPicture, fit_picture, whole_of_shape
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.sample import Sample
from regress.runtime.stages.frame_clock import USUAL_FPS, FrameClock
from regress.runtime.stages.stage import Stage


class PictureSoundness(Stage):
    """Brings pictures to the network's size and takes away those at fault, as ``line_up`` does with a recording's.

    Parameters
    ----------
    sizes
        Width and height of each camera's pictures, as the network takes them.
    placement
        What of a camera's pictures the network is to see; all, of cameras that are left out.
    fps
        Frames a second of samples without times.

    Attributes
    ----------
    whole
        Width and height of the first pictures, of cameras that nobody placed and whose shape is not the network's: all
        of their pictures is seen.
    barred
        Cameras that nobody placed whose first pictures have bars: they are seen with them, as a neutral picture was.
    """

    def __init__(
        self,
        sizes: Mapping[str, tuple[int, int]],
        placement: Mapping[str, CameraPlacement] | None = None,
        *,
        fps: float = USUAL_FPS,
    ) -> None:
        self._sizes = sizes
        self._placement: dict[str, CameraPlacement | None] = dict(placement or {})
        self._watch, self._clock = FrozenWatch(), FrameClock(fps)
        self._last: dict[str, np.ndarray] = {}
        self.whole: dict[str, tuple[int, int]] = {}
        self._first: dict[str, list[np.ndarray]] = {
            name: [] for name in sizes if self._placement.get(name) is None
        }
        self.barred: set[str] = set()

    def step(self, sample: Sample) -> Sample:
        """The sample with sound pictures alone; ``faults`` says what the other cameras have.

        Parameters
        ----------
        sample
            Its pictures are grey (h, w) uint8, of any size; a slow camera's is the same array in several samples.
        """
        held = {name for name, picture in sample.pictures.items() if picture is self._last.get(name)}
        self._last = dict(sample.pictures)
        pictures, faults = {}, {}
        for name in self._sizes:
            if name not in sample.pictures:
                faults[name] = Fault.MISSING
                continue
            self._look_for_bars(name, sample.pictures[name], held=name in held)
            fitted = self._fit(name, sample.pictures[name])
            if fitted.fault is None:
                pictures[name] = fitted.picture
            else:
                faults[name] = fitted.fault
        for name in self._watch.step(self._clock.step(sample.time_s), pictures, held=held):
            faults[name] = Fault.FROZEN
            del pictures[name]
        return replace(sample, pictures=pictures, faults=faults)

    def neutral(self, pictures: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        """Neutral pictures, grey (h, w) uint8 of any size by camera, as the network takes them.

        Raises
        ------
        InputError
            Where one cannot be a neutral picture, or is of a camera that the network does not have.
        """
        fitted = {}
        for name, picture in pictures.items():
            if name not in self._sizes:
                raise InputError(
                    f"a neutral picture is of {name}; the model's cameras are {', '.join(self._sizes)}"
                )
            found = self._fit(name, picture)
            if found.fault is not None:
                raise InputError(f"the neutral picture of {name} cannot be one: it is {found.fault.value}")
            fitted[name] = found.picture.copy()  # programs fill one buffer again and again
        return fitted

    def _look_for_bars(self, name: str, picture: np.ndarray, *, held: bool) -> None:
        """Ask a camera's first pictures for bars, once."""
        first = self._first.get(name)
        if first is None or held or (first and first[0].shape != picture.shape):
            return
        first.append(picture.copy())  # programs fill one buffer again and again
        if len(first) == LOOKED_AT:
            if any(bars_of(np.stack(self._first.pop(name)))):
                self.barred.add(name)

    def _fit(self, name: str, picture: np.ndarray) -> FittedPicture:
        width, height = self._sizes[name]
        size = picture.shape[1], picture.shape[0]
        if name not in self._placement:
            # the first picture settles the shape: later ones of another one show another part of what the camera sees
            self._placement[name] = whole_of_shape(size, (width, height))
            if self._placement[name] is not None:
                self.whole[name] = size
        return fit_picture(picture, width=width, height=height, placement=self._placement[name])
