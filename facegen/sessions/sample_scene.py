"""Builds the scene of one sample: the session's person with the sample's expression, gaze and seat of the headset."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.conventions import NOSE_ROOT
from facegen.headsets import Headset, head_from_headset
from facegen.mouth import has_own_teeth, mouth_meshes
from facegen.rigs import EvaluatedFaces, EyeGeometry, Rig, evaluate, eye_geometry, neutral_landmarks
from facegen.sampling import Samples, Shot, draw_shots
from facegen.scene import Scene, View, assemble
from facegen.scene.accessories import put_on
from facegen.scene.bright_pupils import bright_pupil
from facegen.scene.glasses import LensMirror
from facegen.sessions.session import Session, draw_session
from facegen.spec import Spec


@dataclass(frozen=True, kw_only=True, eq=False)
class SampleScene:
    """One sample as it stands before the cameras.

    Attributes
    ----------
    row
        The sample's one row.
    session
        What the person has and wears.
    shots
        Circumstances of each picture by camera name.
    face
        The evaluated face, one.
    eyes
        The subject's left and right eye.
    donning, slip
        (6,) by how much the headset sits off: metres along the head's x, y, z, radians of yaw, pitch and roll.
    head_from_headset
        (4, 4) how it sits; both are in it.
    lenses
        The left and the right lens of glasses, if there are any.
    scene
        What to render.
    """

    row: Samples
    session: Session
    shots: dict[str, Shot]
    face: EvaluatedFaces
    eyes: tuple[EyeGeometry, EyeGeometry]
    donning: np.ndarray
    slip: np.ndarray
    head_from_headset: np.ndarray
    lenses: tuple[LensMirror, ...]
    scene: Scene


def draw_sample_scene(spec: Spec, rig: Rig, headset: Headset, row: Samples) -> SampleScene:
    """Draw the session and the shots of a sample (a single row), and build its scene."""
    person, session = int(row.person[0]), int(row.session[0])
    worn = draw_session(spec, rig, headset, person=person, session=session, female=bool(row.female[0]))
    shots = draw_shots(spec, worn.unit, session=session, sample=int(row.sample[0]))
    return build_sample_scene(spec, rig, worn, shots, row)


def build_sample_scene(
    spec: Spec, rig: Rig, session: Session, shots: dict[str, Shot], row: Samples
) -> SampleScene:
    """Build the scene of a sample.

    Parameters
    ----------
    spec
        Says how much slip counts.
    rig
        The rig.
    session
        The sample's session.
    shots
        One for each camera of the session's unit, by name.
    row
        A single row.
    """
    face = evaluate(rig, row.identity, row.weights, row.gaze)
    vertices = face.vertices[0]
    left, right = (
        eye_geometry(
            face.eye_center[0, side],
            float(face.eye_radius[0, side]),
            row.gaze[0, side],
            pupil_radius=float(row.pupil_radius_m[0, side]),
        )
        for side in (0, 1)
    )
    donning, slip = _realised_fit(spec, session.unit, row)
    nose_bridge = neutral_landmarks(rig, row.identity)[0, NOSE_ROOT]
    fit = head_from_headset(session.unit, nose_bridge, donning + slip)
    worn = put_on(session.accessories, rig, vertices, (left, right))
    mouth = ()
    if not has_own_teeth(rig):
        mouth = mouth_meshes(
            rig, session.mouth, identity=row.identity[0], weights=row.weights[0], vertices=vertices
        )
    scene = assemble(
        rig, vertices, (left, right), session.unit, fit, look=session.look, mouth=mouth, worn=worn
    )
    materials = {**scene.materials, **session.mouth.materials}
    views = (_with_lit_lamps(view, shots[view.name]) for view in scene.views)
    pupil = materials["pupil"]["albedo"]
    views = tuple(
        replace(view, materials=bright_pupil(view, scene.lamps, (left, right), pupil)) for view in views
    )
    return SampleScene(
        row=row,
        session=session,
        shots=shots,
        face=face,
        eyes=(left, right),
        donning=donning,
        slip=slip,
        head_from_headset=fit,
        lenses=worn.lenses,
        scene=replace(scene, materials=materials, views=views),
    )


def _realised_fit(spec: Spec, headset: Headset, row: Samples) -> tuple[np.ndarray, np.ndarray]:
    """Donning and slip (6,) of one sample."""
    limits = headset.tolerances
    donning_sd = np.array([*np.multiply(limits.donning_mm, 1e-3), *np.radians(limits.donning_deg)])
    slip_sd = np.array([*np.multiply(limits.slip_mm, 1e-3), *np.radians(limits.slip_deg)])
    return row.donning[0] * donning_sd, row.slip[0] * slip_sd * spec.sensor.slip


def _with_lit_lamps(view: View, shot: Shot) -> View:
    return replace(view, lamps=tuple(name for name in view.lamps if name != shot.dropped_led))
