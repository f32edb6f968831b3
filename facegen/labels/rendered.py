"""One rendered sample before it is rendered: its scene, and every label that its pictures will carry."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from facegen.conventions import Part, Visibility
from facegen.headsets import Headset, HeadsetCamera, draw_unit, head_from_headset
from facegen.labels.bright_pupils import bright_pupil
from facegen.labels.eye_outlines import outline_eye
from facegen.labels.glints import label_glints
from facegen.labels.keypoints import Keypoints, label_keypoints
from facegen.labels.views import ViewLabels, label_view, occluders
from facegen.mouth import MouthTraits, draw_mouth, has_own_teeth, mouth_meshes
from facegen.randomness import stream
from facegen.rigs import (
    EyeGeometry,
    Rig,
    evaluate,
    eye_geometry,
    lid_gap,
    lid_margins,
    neutral_landmarks,
    open_lid_gap,
)
from facegen.sampling import Samples, Shot, draw_shot
from facegen.scene import Look, Scene, View, assemble, draw_look, made_up, tear_lines
from facegen.scene.accessories import Accessories, draw_accessories, put_on
from facegen.spec import Looks, Spec

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
    lid_gap_m, openness
        (2,) how far their lids stand apart (`facegen.rigs.lid_gap`), and the share that this is of the same person's
        neutral face looking straight ahead; 0 is closed, wide eyes have more than 1.
    accessories
        Beard, glasses and make-up that the person wears in this session.
    headset
        The session's unit of the headset.
    head_from_headset
        (4, 4) how it sits.
    donning, slip
        (6,) by how much it sits off, as `realised_fit` has them; the pose has both in it.
    views, shots
        Labels and circumstances by camera name.
    """

    samples: Samples
    keypoints: Keypoints
    scene: Scene
    eyes: tuple[EyeGeometry, EyeGeometry]
    lid_gap_m: np.ndarray
    openness: np.ndarray
    accessories: Accessories
    headset: Headset
    head_from_headset: np.ndarray
    donning: np.ndarray
    slip: np.ndarray
    views: dict[str, ViewLabels]
    shots: dict[str, Shot]


def realised_fit(spec: Spec, headset: Headset, samples: Samples) -> tuple[np.ndarray, np.ndarray]:
    """Donning and slip (6,) of one sample: metres along the head's x, y, z, radians of yaw, pitch and roll."""
    limits = headset.tolerances
    donning_sd = np.array([*np.multiply(limits.donning_mm, 1e-3), *np.radians(limits.donning_deg)])
    slip_sd = np.array([*np.multiply(limits.slip_mm, 1e-3), *np.radians(limits.slip_deg)])
    return samples.donning[0] * donning_sd, samples.slip[0] * slip_sd * spec.sensor.slip


def session_unit(spec: Spec, headset: Headset, session: int) -> Headset:
    """The unit of a headset that is worn in a session."""
    return _unit(spec.seed, headset, session, spec.sensor.tolerances)


@lru_cache(maxsize=8)
def _unit(seed: int, headset: Headset, session: int, scale: float) -> Headset:
    # kept: a session's samples stand side by side, and checking a new unit takes longer than labelling a view
    return draw_unit(headset, stream(seed, "unit", session), scale=scale)


@lru_cache(maxsize=8)
def _look(seed: int, person: int, rig: Rig) -> Look:
    return draw_look(stream(seed, "look", person), rig)


@lru_cache(maxsize=8)
def _accessories(seed: int, looks: Looks, person: int, session: int, female: bool, rig: Rig) -> Accessories:
    return draw_accessories(
        stream(seed, "accessories", person),
        stream(seed, "session accessories", session),
        rig,
        female=female,
        beard=looks.beard,
        glasses=looks.glasses,
        make_up=looks.make_up,
    )


@lru_cache(maxsize=8)
def _mouth(seed: int, person: int) -> MouthTraits:
    # kept: the arches of a person are laid out once
    return draw_mouth(stream(seed, "mouth", person))


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
    session, sample = int(samples.session[0]), int(samples.sample[0])
    unit = session_unit(spec, headset, session)
    nose_bridge = neutral_landmarks(rig, samples.identity)[0, NOSE_BRIDGE]
    donning, slip = realised_fit(spec, headset, samples)
    fit = head_from_headset(unit, nose_bridge, donning + slip)
    person = int(samples.person[0])
    look = _look(spec.seed, person, rig)
    accessories = _accessories(spec.seed, spec.looks, person, session, bool(samples.female[0]), rig)
    if accessories.make_up is not None:
        look = made_up(look, accessories.make_up)
    worn = put_on(accessories, rig, face.vertices[0], (left, right))
    traits = _mouth(spec.seed, person)
    mouth = ()
    if not has_own_teeth(rig):
        mouth = mouth_meshes(
            rig, traits, identity=samples.identity[0], weights=samples.weights[0], vertices=face.vertices[0]
        )
    scene = assemble(rig, face.vertices[0], (left, right), unit, fit, look=look, mouth=mouth, worn=worn)
    scene = replace(scene, materials={**scene.materials, **traits.materials})
    shots = {
        view.name: draw_shot(spec, view.name, view.lamps, session=session, sample=sample)
        for view in scene.views
    }
    scene = replace(scene, views=tuple(_with_lit_lamps(view, shots[view.name]) for view in scene.views))
    albedo = scene.materials["pupil"]["albedo"]
    scene = replace(
        scene,
        views=tuple(
            replace(view, materials=bright_pupil(view, scene.lamps, (left, right), albedo))
            for view in scene.views
        ),
    )
    occluder = occluders(scene.meshes)
    glint_occluder = occluders(scene.meshes, transparent=(Part.CORNEA, Part.LENS))
    eyes = left, right
    gap = lid_gap(rig, face.vertices[0])
    margins = [[face.vertices[0, line] for line in lid_margins(rig, side)] for side in (0, 1)]
    tears = tear_lines(rig, face.vertices[0], face.eye_center[0])
    views = {}
    for view in scene.views:
        outlines = tuple(outline_eye(view, eye, lids) for eye, lids in zip(eyes, margins, strict=True))
        glints = label_glints(view, scene.lamps, eyes, tears, glint_occluder, worn.lenses)
        labels = label_view(view, face.landmarks[0], eyes, occluder, glints, outlines)
        views[view.name] = behind_aperture(labels, unit.camera(view.name))
    return RenderedSample(
        samples=samples,
        keypoints=label_keypoints(spec, rig, samples, face),
        scene=scene,
        eyes=eyes,
        lid_gap_m=gap,
        openness=gap / open_lid_gap(rig, tuple(samples.identity[0].tolist())),
        accessories=accessories,
        headset=unit,
        head_from_headset=fit,
        donning=donning,
        slip=slip,
        views=views,
        shots=shots,
    )


def _with_lit_lamps(view: View, shot: Shot) -> View:
    return replace(view, lamps=tuple(name for name in view.lamps if name != shot.dropped_led))


def behind_aperture(labels: ViewLabels, camera: HeadsetCamera) -> ViewLabels:
    """Labels of a view whose camera looks through a lens: what its rim covers is hidden."""
    with np.errstate(invalid="ignore"):  # NaN: behind the camera
        covered = camera.inside_aperture_px(labels.points_2d) < 0
    visibility = np.where(
        covered, np.minimum(labels.visibility, Visibility.HIDDEN), labels.visibility
    ).astype(np.uint8)
    seen = labels.glints.seen & (camera.inside_aperture_px(labels.glints.points_2d) >= 0)
    return replace(labels, visibility=visibility, glints=replace(labels.glints, seen=seen))
