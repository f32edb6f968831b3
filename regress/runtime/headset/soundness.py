"""Live cameras' pictures at the network's size, without those that show nothing or are frozen."""

from collections.abc import Mapping
from dataclasses import replace

from regress.runtime.headset.faults import Fault, FrozenWatch
from regress.runtime.headset.pictures import fit_picture
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage


class PictureSoundness(Stage):
    """Brings pictures to the network's size and takes away those at fault, as ``line_up`` does with a recording's.

    Parameters
    ----------
    sizes
        Width and height of each camera's pictures, as the network takes them.
    placement
        What of a camera's pictures the network is to see; all, of cameras that are left out.
    """

    def __init__(
        self,
        sizes: Mapping[str, tuple[int, int]],
        placement: Mapping[str, CameraPlacement] | None = None,
    ) -> None:
        self._sizes, self._placement = sizes, placement or {}
        self._watch = FrozenWatch()

    def step(self, sample: Sample) -> Sample:
        """The sample with sound pictures alone; ``faults`` says what the other cameras have.

        Parameters
        ----------
        sample
            Its pictures are grey (h, w) uint8, of any size.
        """
        pictures, faults = {}, {}
        for name, (width, height) in self._sizes.items():
            if name not in sample.pictures:
                faults[name] = Fault.MISSING
                continue
            fitted = fit_picture(
                sample.pictures[name], width=width, height=height, placement=self._placement.get(name)
            )
            if fitted.fault is None:
                pictures[name] = fitted.picture
            else:
                faults[name] = fitted.fault
        for name in self._watch.step(pictures):
            faults[name] = Fault.FROZEN
            del pictures[name]
        return replace(sample, pictures=pictures, faults=faults)
