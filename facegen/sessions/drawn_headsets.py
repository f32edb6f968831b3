"""Draws the headset that a person wears, and draws again where it would stand in the face or see too little of it."""

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from pydantic import ValidationError

from facegen.conventions import BLENDSHAPES, LANDMARK_GROUPS, NOSE_ROOT
from facegen.errors import InputError
from facegen.geometry import apply_transform, project
from facegen.headsets import Headset, head_from_headset
from facegen.randomness import stream
from facegen.raster import hidden, triangles_of
from facegen.rigs import Rig, evaluate
from facegen.scene.assembly import headset_views
from facegen.scene.housing import headset_meshes
from facegen.sessions.layouts import draw_layout, headset_of
from facegen.spec import LayoutRanges, Spec

MOST_DRAWS = 200
"""Of one headset: of the default ranges six draws in seven can be built and see enough."""
TRIED_WORN = 10
"""Draws that can be worn tell their share well enough: 1 in 20 is all that a million people need."""
CLEAR_M = 4e-3
"""Cameras and LEDs stand at least so far in front of the mean face's skin; people's faces differ by as much."""
BESIDE_M = 8e-3
"""Skin counts as before or behind a place if it is no farther to the side; vertices of the coarse mesh are as dense."""
HIDDEN_M = 1e-3
SEEN = {
    "left_eye": (tuple(LANDMARK_GROUPS["left_eye"]), 6),
    "right_eye": (tuple(LANDMARK_GROUPS["right_eye"]), 6),
    "mouth": (tuple(LANDMARK_GROUPS["outer_lip"]), 11),
}
"""Landmarks that a camera is to see, and how many of the mean face's it must: all of an eye's, most of the lips'."""
CURE = "widen eye_width_mm and mouth_width_mm, or move the cameras"


@lru_cache(maxsize=8)  # a person's samples stand side by side
def drawn_headset(spec: Spec, rig: Rig, base: Headset, person: int) -> Headset:
    """The headset of a person: what the spec names, or what it draws.

    Raises
    ------
    InputError
        Where the ranges give no headset that sees a face.
    """
    if spec.layout is None:
        return base
    number = person % spec.layout.count if spec.layout.count else person
    rng = stream(spec.seed, "layout", number)
    for _ in range(MOST_DRAWS):
        if (headset := _draw_worn(rng, spec.layout, rig, base)) is not None:
            return headset
    raise InputError(
        f"layout: none of {MOST_DRAWS} draws is a headset that stands clear of the face and sees both eyes and the "
        f"mouth; {CURE}"
    )


def check_layout(spec: Spec, rigs: Sequence[Rig], base: Headset, *, rendered: int) -> None:
    """Refuse ranges that would leave a person without a headset; they cost a second or two, unworn ones twenty.

    Parameters
    ----------
    spec, rigs, base
        The spec, its rigs, and what its headsets are drawn on.
    rendered
        How many samples are rendered: their people alone wear headsets.

    Raises
    ------
    InputError
        Where of so many people at least one is expected to get none; says which share of the draws can be worn.
    """
    if spec.layout is None:
        return
    people = max(1, min(spec.people, spec.layout.count or spec.people, rendered))
    for rig in rigs:
        rng, worn, drawn = stream(spec.seed, "layout tried", 0), 0, 0
        while worn < TRIED_WORN and drawn < MOST_DRAWS:
            worn += _draw_worn(rng, spec.layout, rig, base) is not None
            drawn += 1
        if people * (1.0 - worn / drawn) ** MOST_DRAWS >= 1.0:
            raise InputError(
                f"layout: {worn} of {drawn} drawn headsets stand clear of the face of rig {rig.name!r} and see both "
                f"eyes and the mouth, so of {people} {'person' if people == 1 else 'people'} at least one is expected "
                f"to get none in {MOST_DRAWS} draws; {CURE}"
            )


def _draw_worn(rng: np.random.Generator, ranges: LayoutRanges, rig: Rig, base: Headset) -> Headset | None:
    """One headset of the ranges, or None where it cannot be built or sees too little."""
    try:
        headset = headset_of(draw_layout(rng, ranges), base)
    except ValidationError:  # what a headset's file may not say either
        return None
    return headset if sees_enough(headset, rig) else None


def sees_enough(headset: Headset, rig: Rig) -> bool:
    """Whether cameras and LEDs stand in front of the mean face, and every camera sees its part of it (`SEEN`)."""
    vertices, triangles, landmarks = _mean_head(rig)
    fit = head_from_headset(headset, landmarks[NOSE_ROOT], np.zeros(6))
    places_mm = [thing.position_mm for thing in (*headset.cameras, *headset.leds)]
    places = apply_transform(fit, np.multiply(places_mm, 1e-3))
    if not _are_clear(vertices, places):
        return False
    for mesh in headset_meshes(headset, fit):
        triangles = np.concatenate([triangles, triangles_of(mesh.faces) + len(vertices)])
        vertices = np.concatenate([vertices, mesh.vertices])
    for view in headset_views(headset, fit):
        camera = headset.camera(view.name)
        chosen, least = SEEN[view.name]
        points = apply_transform(view.camera_from_head, landmarks[list(chosen)])
        pixels = project(camera.camera, points)
        seen = camera.camera.contains(pixels) & (camera.inside_aperture_px(pixels) >= 0)
        if seen.sum() < least:
            return False
        mesh = apply_transform(view.camera_from_head, vertices)
        if (seen & ~hidden(points, mesh, triangles, tolerance_m=HIDDEN_M)).sum() < least:
            return False
    return True


@lru_cache(maxsize=8)
def _mean_head(rig: Rig) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Vertices, triangles and landmarks of the mean person at rest, head frame, metres."""
    ahead = np.tile((0.0, 0.0, 1.0), (1, 2, 1))
    face = evaluate(rig, np.zeros((1, rig.components)), np.zeros((1, len(BLENDSHAPES))), ahead)
    # the coarse mesh stands for the head where keypoints are hidden, too; lashes would hide all of an eye's landmarks
    return face.vertices[0, : rig.cage_vertices], triangles_of(rig.cage_faces), face.landmarks[0]


def _are_clear(vertices: np.ndarray, places: np.ndarray) -> bool:
    """Whether places (n, 3) lie in front of all skin that lies behind or before them."""
    near = np.linalg.norm(vertices[:, :2] - places[:, None, :2], axis=-1) < BESIDE_M
    return bool((~near | (vertices[:, 2] + CLEAR_M <= places[:, None, 2])).all())
