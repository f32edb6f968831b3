"""Finds faces with MediaPipe's Face Landmarker, which runs on this machine and asks no other one."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from facegen.console import silent_stderr
from regress.runtime.inputs.mesh import VERTICES, irises_of, landmarks_of
from regress.runtime.sample import Sample
from regress.runtime.stages.stage import Stage
from track.detectors.faults import FaceFault
from track.detectors.following import Following
from track.detectors.head import seen_head
from track.detectors.mediapipe_head import NO_HEAD, NO_IRISES, NO_POINTS, head_of
from track.detectors.model_file import model_file
from track.errors import InputError

FACES = 3
"""Looked for in a picture. To look for one takes 1.6 ms less a frame, and follows whoever is found first."""

_NOTHING = np.zeros((64, 64, 3), dtype=np.uint8)


class MediapipeDetector(Stage):
    """Gives samples 68 points, irises and head of the face in their one picture.

    Parameters
    ----------
    file
        MediaPipe's model file; by default the pinned one (`track.detectors.model_file`).
    blendshapes
        Whether MediaPipe's own 52 weights are wanted: `own_weights` has them after each step.

    Raises
    ------
    InputError
        Where the file is none that MediaPipe reads.
    MissingAsset
        Where there is no file, and none can be fetched.
    """

    def __init__(self, file: Path | None = None, *, blendshapes: bool = False) -> None:
        from mediapipe.tasks.python import BaseOptions, vision

        self._following = Following()
        self._last_ms = -1
        file = model_file(file)
        options = vision.FaceLandmarkerOptions(
            base_options=BaseOptions(model_asset_buffer=file.read_bytes()),
            running_mode=vision.RunningMode.VIDEO,
            num_faces=FACES,
            output_face_blendshapes=blendshapes,
            output_facial_transformation_matrixes=True,
        )
        try:
            with silent_stderr():
                self._landmarker = vision.FaceLandmarker.create_from_options(options)
                self._found(_NOTHING, 0.0)  # its threads tell of themselves with their first picture
        except (RuntimeError, ValueError) as error:
            raise InputError(f"{file} is no model file of MediaPipe's Face Landmarker ({error})") from None
        self.own_weights: dict[str, float] | None = None

    def step(self, sample: Sample) -> Sample:
        """The sample with points, irises and head; NaN where there is no picture, or no face in it."""
        self.own_weights = None
        nothing = replace(sample, points=NO_POINTS, irises=NO_IRISES, head=NO_HEAD)
        if not sample.pictures:
            return nothing
        (pixels,) = sample.pictures.values()
        found = self._found(pixels, sample.time_s)
        meshes = np.array([[(each.x, each.y) for each in face] for face in found.face_landmarks])
        # MediaPipe measures from the picture's corner in widths and heights; our (0, 0) is the first pixel's centre
        meshes = meshes.reshape(-1, VERTICES, 2) * pixels.shape[1::-1] - 0.5
        faces = landmarks_of(meshes)
        time_s = self._last_ms / 1000
        chosen = self._following.choose(faces, time_s)
        if len(faces) > 1 or (len(faces) and chosen is None and self._following.others(time_s)):
            nothing = replace(nothing, faults={**sample.faults, "points": FaceFault.OTHERS})
        if chosen is None:
            return nothing
        if found.face_blendshapes:
            self.own_weights = {each.category_name: each.score for each in found.face_blendshapes[chosen]}
        matrix = np.asarray(found.facial_transformation_matrixes[chosen], dtype=np.float64)
        height, width = pixels.shape[:2]
        return replace(
            nothing,
            points=faces[chosen],
            irises=irises_of(meshes[chosen]),
            head=seen_head(head_of(matrix), width=width, height=height),
        )

    def _found(self, pixels: np.ndarray, time_s: float | None) -> Any:
        """What MediaPipe finds; its clock counts whole milliseconds, and refuses one that does not rise."""
        import mediapipe

        convert = cv2.COLOR_GRAY2RGB if pixels.ndim == 2 else cv2.COLOR_BGR2RGB
        picture = mediapipe.Image(image_format=mediapipe.ImageFormat.SRGB, data=cv2.cvtColor(pixels, convert))
        known = time_s is not None and math.isfinite(time_s)
        self._last_ms = max(self._last_ms + 1, round(1000 * time_s) if known else 0)
        return self._landmarker.detect_for_video(picture, self._last_ms)

    def close(self) -> None:
        """Let MediaPipe's threads go; to be called, as at the interpreter's end it is too late for it and it throws."""
        self._landmarker.close()
