"""One rendered sample before it is rendered: its scene, and every label that its pictures will carry."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import Part
from facegen.headsets import Headset, head_from_headset
from facegen.labels.glints import label_glints
from facegen.labels.keypoints import Keypoints, label_keypoints
from facegen.labels.views import ViewLabels, label_view, occluders
from facegen.randomness import stream
from facegen.rigs import EyeGeometry, Rig, evaluate, eye_geometry, neutral_landmarks
from facegen.sampling import Samples
from facegen.scene import Scene, assemble, draw_look, tear_lines
from facegen.spec import Spec

NOSE_BRIDGE = 27
"""Index of the landmark on which a headset rests."""


@dataclass(frozen=True, kw_only=True, eq=False)
class RenderedSample:
    """Everything of one sample that a renderer does not add.

    Attributes
    ----------
    samples, keypoints
        One row each.
    scene
        What to render.
    eyes
        The subject's left and right eye.
    head_from_headset
        (4, 4) how the headset sits.
    views
        Labels by camera name.
    """

    samples: Samples
    keypoints: Keypoints
    scene: Scene
    eyes: tuple[EyeGeometry, EyeGeometry]
    head_from_headset: np.ndarray
    views: dict[str, ViewLabels]


def realised_donning(headset: Headset, samples: Samples) -> np.ndarray:
    """(6,) metres and radians by which the headset sits off: this session's donning plus this frame's slip."""
    limits = headset.tolerances
    donning_sd = np.array([*np.multiply(limits.donning_mm, 1e-3), *np.radians(limits.donning_deg)])
    slip_sd = np.array([*np.multiply(limits.slip_mm, 1e-3), *np.radians(limits.slip_deg)])
    return samples.donning[0] * donning_sd + samples.slip[0] * slip_sd


def label_rendered(spec: Spec, rig: Rig, headset: Headset, samples: Samples) -> RenderedSample:
    """Scene and labels of one sample (a single row of `Samples`)."""
    face = evaluate(rig, samples.identity, samples.weights, samples.gaze)
    left, right = (
        eye_geometry(
            face.eye_center[0, side],
            float(face.eye_radius[0, side]),
            samples.gaze[0, side],
            pupil_radius=float(samples.pupil_radius_m[0, side]),
        )
        for side in (0, 1)
    )
    nose_bridge = neutral_landmarks(rig, samples.identity)[0, NOSE_BRIDGE]
    fit = head_from_headset(headset, nose_bridge, realised_donning(headset, samples))
    look = draw_look(stream(spec.seed, "look", int(samples.person[0])), rig)
    scene = assemble(rig, face.vertices[0], (left, right), headset, fit, look=look)
    occluder = occluders(scene.meshes)
    glint_occluder = occluders(scene.meshes, transparent=(Part.CORNEA,))
    eyes = left, right
    tears = tear_lines(rig, face.vertices[0], face.eye_center[0])
    return RenderedSample(
        samples=samples,
        keypoints=label_keypoints(spec, rig, samples, face),
        scene=scene,
        eyes=eyes,
        head_from_headset=fit,
        views={
            view.name: label_view(
                view,
                face.landmarks[0],
                eyes,
                occluder,
                label_glints(view, scene.lamps, eyes, tears, glint_occluder),
            )
            for view in scene.views
        },
    )
