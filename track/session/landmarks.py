"""From one camera's pictures by a detector's 68 points to weights."""

import hashlib
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np

from facegen.documents import read_bytes
from regress.runtime.even_rows import even_rows
from regress.runtime.features import align_similarity
from regress.runtime.features.alignment import STABLE
from regress.runtime.inputs import Fault
from regress.runtime.model import FastPredictor, Model, load_model
from regress.runtime.ready_made import model_folder
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import Looks
from regress.runtime.stages.head import HeadPose, HeadSettings, HeadSmoothing
from regress.runtime.stages.networks import AutomaticCalibration, LandmarkNetworks
from regress.runtime.stages.one_euro import OneEuro
from regress.runtime.stages.soundness import Soundness
from regress.runtime.stages.stage import Stage
from track.errors import InputError
from track.profile.neutral import NeutralFace, lines_of
from track.profile.profile import ModelMark
from track.session.gaze import IrisGaze
from track.session.pipeline import Pipeline, filter_of, words

KEPT_FRAMES = 16
"""Of a neutral face, evenly chosen: their median has a quarter of one frame's noise."""

LEAST_MOVEMENT = 0.015
"""Face widths, some 2 mm, by which a point moves. Of docs/samples/talking-face.csv the two seconds at rest have .007,
and no two seconds of talking less than .03."""

MOST_MODEL_BYTES = 2**28
"""Of a model's arrays; ours have 2 MB."""


class LandmarkPipeline(Pipeline):
    """Detector, soundness, head or gaze, networks, looks, filter.

    Parameters
    ----------
    folder
        Of the model, or a ready-made model's name.
    detector
        Gives points, and irises and head as far as it can.
    detector_name
        As profiles remember it.
    filter_name
        As `filter_of` takes it.
    auto
        Whether to look for the neutral face while frames come, where none is given.
    say
        Told when it is found.
    """

    least_movement = LEAST_MOVEMENT

    def __init__(
        self,
        folder: str | Path,
        *,
        detector: Stage,
        detector_name: str,
        filter_name: str,
        auto: bool = False,
        say: Callable[[str], None] = lambda message: None,
    ) -> None:
        self._model = load_model(folder)
        self.mark = ModelMark(kind="landmarks", sha256=_hash_of(model_folder(folder)))
        self._detector, self._detector_name = detector, detector_name
        self._mean_shape = self._model.features.mean_shape
        self._own_neutral: tuple[np.ndarray, NeutralFace] | None = None
        self._ahead = np.zeros(4)
        networks = _QuickNetworks(self._model)
        self.stages = {"detector": detector, "soundness": Soundness(needs_times=False)}
        if auto:
            self.stages["auto"] = AutomaticCalibration(networks, say)
        self.stages |= {
            "head": _Head(),
            "networks": networks,
            "looks": Looks(fade=True),
        }
        smoothing = filter_of(filter_name)
        if smoothing is not None:
            self.stages |= {"filter": smoothing, "head filter": HeadSmoothing(OneEuro())}

    def signature(self, sample: Sample) -> np.ndarray | None:
        """The points (136,) laid upon the mean face, in its widths."""
        if sample.points is None or not np.isfinite(sample.points).all():
            return None
        return align_similarity(sample.points[None], self._mean_shape, STABLE).ravel()

    def calibrated_by(self, sample: Sample) -> Sample:
        """Of pictures the sizes alone: sixty of 1920 x 1080 pixels would take 370 MB."""
        pictures = {
            name: np.broadcast_to(np.uint8(0), picture.shape)
            for name, picture in (sample.pictures or {}).items()
        }
        return replace(sample, pictures=pictures)

    def neutral_of(self, samples: Sequence[Sample]) -> NeutralFace:
        """Some of the frames, evenly chosen."""
        rows = even_rows(len(samples), KEPT_FRAMES)
        chosen = [samples[row] for row in rows]
        irises = [
            each.irises for each in chosen if each.irises is not None and np.isfinite(each.irises).all()
        ]
        heads = [each.head for each in chosen if each.head is not None and np.isfinite(each.head).all()]
        picture = next(iter((chosen[0].pictures or {}).values()), None)
        return NeutralFace(
            detector=self._detector_name,
            picture=None if picture is None else (picture.shape[1], picture.shape[0]),
            points=lines_of(np.array([each.points for each in chosen]), places=2),
            irises=lines_of(np.array(irises), places=2) if len(irises) == len(chosen) else None,
            heads=lines_of(np.array(heads), places=4) if len(heads) == len(chosen) else None,
        )

    def use_neutral(self, neutral: NeutralFace) -> None:
        """Calibrate the networks, the head's shape and the eyes."""
        points = neutral.frames("points")
        if points is None:
            raise InputError("the profile's neutral face is of headset pictures, and this model takes points")
        if neutral.detector != self._detector_name:
            raise InputError(
                f"the profile's neutral face is of the detector {neutral.detector}, which puts points elsewhere than "
                f"{self._detector_name}; calibrate again, or name another profile"
            )
        # first, as it refuses points that are no face
        if self._model.calibrated is not None:
            self.stages["networks"] = _QuickNetworks(self._model.calibrate(points))
        self.stages["head"] = _Head(neutral)
        self.stages["head"].use_straight_ahead(self._ahead)
        self.stages.pop("auto", None)

    @property
    def own_neutral(self) -> NeutralFace | None:
        """Of points alone: nobody was asked to look into the camera, so it says nothing of the eyes."""
        auto = self.stages.get("auto")
        if not isinstance(auto, AutomaticCalibration) or auto.neutral is None:
            return None
        if self._own_neutral is None or self._own_neutral[0] is not auto.neutral:
            chosen = auto.neutral[even_rows(len(auto.neutral), KEPT_FRAMES)]
            face = NeutralFace(detector=self._detector_name, points=lines_of(chosen, places=2))
            self._own_neutral = (auto.neutral, face)
        return self._own_neutral[1]

    def use_straight_ahead(self, gaze: np.ndarray) -> None:
        """Let eyes that close go where they look straight ahead, which is taken off behind the pipeline."""
        self._ahead = gaze
        head = self.stages.get("head")
        if isinstance(head, _Head):
            head.use_straight_ahead(gaze)

    def points(self, sample: Sample) -> Mapping[str, np.ndarray]:
        """The landmarks, on the one picture."""
        if sample.points is None or not sample.pictures or not np.isfinite(sample.points).all():
            return {}
        return {name: sample.points for name in list(sample.pictures)[:1]}

    def sentences(self, sample: Sample) -> dict[str, str]:
        """Faults of the camera by its name, of the face as such."""
        found = super().sentences(sample)
        fault = sample.faults.get("points")
        if fault is not None:
            found["points"] = (
                "no face is seen" if fault is Fault.MISSING else f"the picture has {words(fault)}"
            )
        return found

    def close(self) -> None:
        """Let the detector go."""
        close = getattr(self._detector, "close", None)
        if close is not None:
            close()


class _QuickNetworks(LandmarkNetworks):
    """The networks in float32, which differ by less than 1e-5 and take a third of the time (`FastPredictor`)."""

    def __init__(self, model: Model) -> None:
        super().__init__(model)
        self._quick = FastPredictor(model)

    def use_model(self, model: Model) -> None:
        super().use_model(model)
        self._quick = FastPredictor(model)

    def step(self, sample: Sample) -> Sample:
        return replace(sample, weights=self._quick.predict_frame(sample.points).astype(np.float64))


class _Head(Stage):
    """Gaze from the detector's own head where it gives one, else head and gaze fitted to the points."""

    def __init__(self, neutral: NeutralFace | None = None) -> None:
        points = None if neutral is None else neutral.frames("points")
        irises = None if neutral is None else neutral.frames("irises")
        self._fitted = HeadPose(HeadSettings(neutral=points, neutral_irises=irises, into_camera=True))
        self._given = IrisGaze(neutral)

    def use_straight_ahead(self, gaze: np.ndarray) -> None:
        """See `HeadPose`."""
        for stage in (self._fitted, self._given):
            stage.use_straight_ahead(gaze)

    def step(self, sample: Sample) -> Sample:
        return (self._fitted if sample.head is None else self._given).step(sample)


def _hash_of(folder: Path) -> str:
    """SHA-256 of a model's arrays."""
    return hashlib.sha256(read_bytes(folder / "weights.npz", most_bytes=MOST_MODEL_BYTES)).hexdigest()
