"""From the pictures of a headset's cameras to weights."""

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPES
from regress.runtime.even_rows import even_rows
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.networks import HeadsetNetworks
from regress.runtime.headset.answers.partly import seen_shapes
from regress.runtime.headset.network.parts import is_of_one_eye, part_of, side_of
from regress.runtime.headset.network.predictor import load_headset_predictor
from regress.runtime.headset.person.person import (
    HIGHEST_REST,
    OwnEye,
    Person,
    kept_openness,
    unpacked_picture,
)
from regress.runtime.headset.pictures.faults import RESHAPE, Fault
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.levels import Levels
from regress.runtime.headset.placing.placement_file import Placement, read_placement
from regress.runtime.sample import Sample
from track.errors import InputError
from track.profile.neutral import NeutralFace, base64_of
from track.profile.profile import ModelMark
from track.session.exchange import ExchangeWatch, counted_pictures
from track.session.faces import FACES
from track.session.pictures import Grey, Soundness
from track.session.pipeline import Pipeline, filter_of
from track.session.upright import UprightWatch

LEAST_MOVEMENT = 0.15
"""Of a weight, as the network reads it without a neutral face: what calm frames of a take differ by
(regress.runtime.headset.person.neutral)."""

RESTING_FRAMES = 16
"""Of a resting face that are compared with its neutral pictures, at once: each costs a millisecond or two."""


class HeadsetPipeline(Pipeline):
    """Grey pictures at the network's size, cameras in their places, network, filter.

    Parameters
    ----------
    folder
        Of the model, or a ready-made model's name.
    filter_name
        As `filter_of` takes it.
    opened
        Names of the cameras that are there; all of the model's by default.
    """

    least_movement = LEAST_MOVEMENT
    measures_eyes = True

    def __init__(
        self, folder: str | Path, *, filter_name: str, opened: Collection[str] | None = None
    ) -> None:
        self._predictor = load_headset_predictor(folder)
        self._opened = [name for name in self.cameras if opened is None or name in opened]
        self.mark = ModelMark(kind="headset", sha256=self._predictor.model.network_sha256)
        self._reader = EyeReader(self._predictor)
        self._alone: tuple[str, ...] = ()
        """Cameras that have no neutral picture while others have."""
        seen = {name for camera in self._opened for name in part_of(camera)}
        self.faces = tuple(name for name, face in FACES.items() if not face.shapes or seen & {*face.shapes})
        self.stages = {"grey": Grey()}
        self.use_placement({})
        # what training's pictures looked like says nothing of pictures that are not levelled yet
        self.stages |= {
            "exchange": ExchangeWatch(),
            "upright": UprightWatch(self.cameras),
            "networks": self._networks,
        }
        smoothing = filter_of(filter_name)
        if smoothing is not None:
            self.stages["filter"] = smoothing

    @property
    def cameras(self) -> tuple[str, ...]:
        """Of the model, in its order."""
        return tuple(self._predictor.sizes)

    def signature(self, sample: Sample) -> np.ndarray | None:
        """The weights (k,) that the cameras see which have a picture and are in their place."""
        counted = counted_pictures(sample)
        if not counted or np.isnan(sample.weights).any():
            return None
        return sample.weights[seen_shapes(counted)]

    def calibrated_by(self, sample: Sample) -> Sample:
        """What the cameras see that count; NaN of the rest, and no word of cameras that were never there."""
        counted, unseen = counted_pictures(sample), np.array(self.unseen_eyes(sample))
        weights, eyes, gaze = sample.weights, sample.eyes, sample.gaze
        if weights is not None:
            weights = np.where(seen_shapes(counted), weights, np.nan)
        if eyes is not None:
            eyes = replace(
                eyes,
                openness_mm=np.where(unseen, np.nan, eyes.openness_mm),
                openness=np.where(unseen, np.nan, eyes.openness),
            )
        if gaze is not None and unseen.all():
            gaze = np.full(4, np.nan)
        faults = {name: fault for name, fault in sample.faults.items() if name in self._opened}
        return replace(sample, pictures=counted, weights=weights, eyes=eyes, gaze=gaze, faults=faults)

    def unseen_eyes(self, sample: Sample) -> tuple[bool, bool]:
        """Eyes whose cameras all count for nothing; of both, where no camera's name says a side, there is none."""
        counted = counted_pictures(sample)
        left, right = (
            any(of_side) and not any(name in counted for name in of_side)
            for of_side in (
                [name for name in self.cameras if is_of_one_eye(name) and side_of(name) == side]
                for side in ("left", "right")
            )
        )
        return left, right

    def neutral_of(self, samples: Sequence[Sample]) -> NeutralFace:
        """The frame that is nearest to the median of all: a mean of pictures would be blurred."""
        weights = np.array([each.weights for each in samples])
        weights = weights[:, np.isfinite(weights).all(axis=0)]
        nearest = samples[int(np.argmin(np.abs(weights - np.median(weights, axis=0)).sum(axis=1)))]
        return NeutralFace(
            pictures={
                name: base64_of(cv2.imencode(".png", picture)[1].tobytes())
                for name, picture in nearest.pictures.items()
            }
        )

    def rests_of(self, samples: Sequence[Sample]) -> dict[str, float]:
        """Medians of the weights, compared with the neutral pictures in use; gaze is centred by itself."""
        chosen = [samples[row] for row in even_rows(len(samples), RESTING_FRAMES)]
        pictures = {
            name: np.array([sample.pictures[name] for sample in chosen]) for name in chosen[0].pictures
        }
        seen = np.isfinite(chosen[0].weights)
        middle = np.median(self._networks.compared(pictures), axis=0)
        return {
            name: float(min(value, HIGHEST_REST))
            for name, value, is_seen in zip(BLENDSHAPES, middle, seen, strict=True)
            if is_seen and value > 0 and not name.startswith("eyeLook")
        }

    def use_eyes(self, eyes: Mapping[str, OwnEye]) -> None:
        """Measure openness between the person's own ends."""
        self._reader.use_person(Person(eyes=dict(eyes)))

    def eyes_with(
        self, eyes: Mapping[str, OwnEye], face: str, samples: Sequence[Sample]
    ) -> dict[str, OwnEye]:
        """Own ends of the lids: at rest, shut and wide."""
        field = {"neutral": "rest_mm", "eyes_shut": "shut_mm", "eyes_wide": "wide_mm"}.get(face)
        seen = [sample.eyes.openness_mm for sample in samples if sample.eyes is not None]
        if field is None or not seen:
            return dict(eyes)
        found = {name: eyes.get(name, OwnEye()) for name in self._reader.sides}
        for name, side in self._reader.sides.items():
            known_mm = [one[side] for one in seen if np.isfinite(one[side])]
            if known_mm:
                found[name] = replace(found[name], **{field: kept_openness(np.median(known_mm))})
        return found

    def use_neutral(self, neutral: NeutralFace) -> None:
        """Compare pictures with these; those of cameras without one are seen alone."""
        if not neutral.pictures:
            raise InputError(
                "the profile's neutral face is of points, and this model takes a headset's pictures"
            )
        known = [name for name in self._opened if name in neutral.pictures]
        if not known:
            raise InputError(
                f"the profile has no neutral picture of {', '.join(self._opened)}; calibrate again"
            )
        pictures = {name: self._picture(name, neutral) for name in known}
        self._networks.reseated.clear()
        self._networks.use_neutral(pictures)
        self._alone = tuple(name for name in self._opened if name not in known)

    def _picture(self, name: str, neutral: NeutralFace) -> np.ndarray:
        width, height = self._predictor.sizes[name]
        return unpacked_picture(
            neutral.pictures[name], width=width, height=height, of=f"{name} of the profile"
        )

    def points(self, sample: Sample) -> Mapping[str, np.ndarray]:
        """What the network traced in each picture of the last frame."""
        return {
            name: points for name, points in self._networks.traced.items() if name in (sample.pictures or {})
        }

    def sentences(self, sample: Sample) -> dict[str, str]:
        """Faults by camera, eyes that are not upright, and a seat that changed."""
        found = {**self.stages["upright"].told, **super().sentences(sample)}
        for name, (width, height) in self.stages["soundness"].whole.items():
            if name in (sample.pictures or {}) and name not in found:
                found[name] = (
                    f"{name}: {width}x{height} is another shape than the network's; all of each picture is seen, and "
                    f"`regress headset check` finds a better --placement"
                )
        for name in self.stages["soundness"].barred:
            if name in (sample.pictures or {}):
                # beside what else is to be said of the camera
                found[f"bars of {name}"] = (
                    f"{name}: its pictures have bars, which are seen as a part of the face; `regress headset check` "
                    f"finds a --placement that leaves them out"
                )
        for name in self._alone:
            if name in (sample.pictures or {}):
                found.setdefault(
                    name,
                    f"{name}: it gave no picture when your neutral face was taken, so its movements are guessed; "
                    f"calibrate neutral again",
                )
        for name in (name for name, fault in sample.faults.items() if fault is Fault.SHAPE):
            found[name] += f"; {RESHAPE}"
        if self._networks.reseated:
            found["seat"] = "the headset has moved since it was calibrated; a new neutral face sets it right"
        return found

    def read_placement(self, path: Path) -> dict[str, CameraPlacement]:
        """See `Pipeline`."""
        return read_placement(path, self._predictor.model)

    def accepts_placement_of(self, mark: ModelMark) -> bool:
        """See `Pipeline`: of one that this was adapted from it is."""
        model = self._predictor.model
        # one that only began as the other may be of another headset, and profiles do not say of which theirs was
        adapted = replace(model, training=replace(model.training, began_as=""))
        return Placement(network_sha256=mark.sha256).suits(adapted)

    def use_placement(self, placement: Mapping[str, CameraPlacement]) -> None:
        """See this of each camera's pictures, at these levels; all of it, at its own levels, of those left out."""
        levels = Levels(self._predictor.model.looks, placement)
        # a profile is its person's: another seat's neutral picture is worth more than none
        self._networks = HeadsetNetworks(
            self._predictor, levels=levels, keep_neutral=True, reader=self._reader
        )
        self.stages["soundness"] = Soundness(self._predictor.sizes, placement)
        if "networks" in self.stages:
            self.stages["networks"] = self._networks
            self.stages["upright"] = UprightWatch(self.cameras)

    @property
    def listens(self) -> bool:
        """Whether the network is one of drawn headsets."""
        return bool(self._predictor.model.camera_terms)

    def use_cameras(self, terms: Mapping[str, Sequence[float]]) -> None:
        """Tell the network where its cameras are; before a placement and a neutral face are given."""
        self._predictor = self._predictor.told({name: np.array(values) for name, values in terms.items()})
        self.use_placement({})

    def forget_neutral(self) -> None:
        """Take frames by themselves, and any seat for the right one."""
        self._networks.use_neutral(None)
        self._networks.reseated.clear()
        self._alone = ()
