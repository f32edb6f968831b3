"""Puts a headset on a rig's mean head, and tells what each of its cameras sees there."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_GROUPS, NOSE_ROOT, Part
from facegen.geometry import apply_transform, project
from facegen.headsets import Headset, head_from_headset
from facegen.preview.portraits import drawn_mesh
from facegen.raster import hidden, nearest_along_z, triangles_of
from facegen.rigs import Rig, evaluate
from facegen.scene import View
from facegen.scene.assembly import headset_views
from facegen.scene.housing import headset_meshes

HIDDEN_M = 1e-3
"""A landmark is hidden where something lies nearer by more than this."""

EDGE = {"pinhole": 0.087, "fisheye": -0.3}
"""Cosine of the angle from a camera's axis beyond which nothing is drawn: a pinhole's pixels run into the millions
there (85 degrees), a fisheye's triangles reach round the picture."""

Mesh = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Vertices (V, 3), triangles (T, 3), part of each triangle."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Wearer:
    """The mean person with a neutral face, who wears a headset without tolerances.

    Attributes
    ----------
    headset
        The headset.
    head_from_headset
        (4, 4) how it sits.
    head, housed
        The bare head, and with the headset's occluders; head frame, metres.
    landmarks
        (68, 3) head frame, metres.
    """

    headset: Headset
    head_from_headset: np.ndarray
    head: Mesh
    housed: Mesh
    landmarks: np.ndarray

    @property
    def views(self) -> list[View]:
        """The cameras with their poses."""
        return headset_views(self.headset, self.head_from_headset)


def put_on(headset: Headset, rig: Rig) -> Wearer:
    """The rig's mean person with that headset."""
    gaze = np.tile((0.0, 0.0, 1.0), (1, 2, 1))
    face = evaluate(rig, np.zeros((1, rig.components)), np.zeros((1, len(BLENDSHAPES))), gaze)
    fit = head_from_headset(headset, face.landmarks[0, NOSE_ROOT], np.zeros(6))
    head = drawn_mesh(rig, face, 0, gaze[0])
    return Wearer(
        headset=headset,
        head_from_headset=fit,
        head=head,
        housed=_with_housing(head, headset, fit),
        landmarks=face.landmarks[0],
    )


def seen_landmarks(wearer: Wearer, view: View) -> tuple[np.ndarray, np.ndarray]:
    """Landmarks in a camera's picture.

    Returns
    -------
    landmarks_px
        (68, 2) pixels of the camera.
    seen
        (68,) bool; inside the picture and its lens circle, and hidden by nothing.
    """
    camera = wearer.headset.camera(view.name)
    vertices, triangles, _ = wearer.housed
    points = apply_transform(view.camera_from_head, wearer.landmarks)
    landmarks_px = project(camera.camera, points)
    seen = camera.camera.contains(landmarks_px) & (camera.inside_aperture_px(landmarks_px) >= 0)
    seen &= ~hidden(points, apply_transform(view.camera_from_head, vertices), triangles, tolerance_m=HIDDEN_M)
    return landmarks_px, seen


def placement_faults(wearer: Wearer) -> list[str]:
    """Sentences about cameras and LEDs that cannot do their work.

    They stand inside the head or behind its face, or a camera sees no landmark, or the eye that its name does not say.
    """
    faults = []
    for index, camera in enumerate(wearer.headset.cameras):
        view = next(view for view in wearer.views if view.name == camera.name)
        place = (wearer.head_from_headset @ camera.headset_from_camera)[:3, 3]
        if inside := _behind_skin(wearer, place):
            faults.append(f"cameras[{index}] ({camera.name}) {inside}")
            continue
        seen = seen_landmarks(wearer, view)[1]
        if not seen.any():
            faults.append(
                f"cameras[{index}] ({camera.name}) sees none of the mean face's 68 landmarks; check target_mm, "
                "roll_deg and fx"
            )
        counts = {side: seen[list(LANDMARK_GROUPS[f"{side}_eye"])].sum() for side in ("left", "right")}
        named = [side for side in counts if camera.name.lower().startswith(side)]
        if named and counts[named[0]] < max(counts.values()):
            faults.append(
                f"cameras[{index}] ({camera.name}) sees more of the other eye; x is positive to the wearer's left, so "
                "check position_mm and target_mm, or its name"
            )
    for index, led in enumerate(wearer.headset.leds):
        place = (wearer.head_from_headset @ np.append(led.position, 1.0))[:3]
        if inside := _behind_skin(wearer, place):
            faults.append(f"leds[{index}] ({led.name}) {inside}")
    return faults


def _behind_skin(wearer: Wearer, place: np.ndarray) -> str | None:
    """What is wrong with a place in the head frame, if it lies behind the face's skin."""
    depth = _skin_depth_m(wearer, place)
    if depth <= place[2]:
        return None
    return (
        f"stands {1e3 * (depth - place[2]):.0f} mm behind the mean face's skin; move position_mm out along z"
    )


def _skin_depth_m(wearer: Wearer, place: np.ndarray) -> float:
    """z of the bare head's front at the x and y of a place, head frame; minus infinity beside the head."""
    vertices, triangles, _ = wearer.head
    depth = nearest_along_z(vertices, triangles, origin=place[:2], step=1e-3, shape=(1, 1))
    return float(depth.value[0, 0])


def _with_housing(head: Mesh, headset: Headset, fit: np.ndarray) -> Mesh:
    vertices, triangles, part = head
    for mesh in headset_meshes(headset, fit):
        added = triangles_of(mesh.faces)
        triangles = np.concatenate([triangles, added + len(vertices)])
        part = np.concatenate([part, np.full(len(added), Part.HEADSET)])
        vertices = np.concatenate([vertices, mesh.vertices])
    return vertices, triangles, part
