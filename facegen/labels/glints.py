"""Solves for glints, the mirror images of the LEDs on corneas and scleras, instead of rendering them.

An LED's image is smaller than a pixel and a thousand times as bright as the iris: path tracing finds it in one
of 40 samples, and a denoiser takes it for an error. So Cycles' eyes do not mirror lamps; the images are computed
here, are labels, and are added to the finished radiance.

References
----------
.. [1] E. Guestrin and M. Eizenman, "General theory of remote gaze estimation", IEEE TBME 53(6), 2006: the
   cornea as a spherical mirror.
"""

from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

import numpy as np

from facegen.conventions import SIDES, Part
from facegen.geometry import (
    Camera,
    apply_transform,
    fresnel,
    invert_transform,
    look_at,
    project,
)
from facegen.labels.led_images import led_images
from facegen.labels.occluders import occluders
from facegen.labels.view_label import LabelKey
from facegen.raster import hidden
from facegen.rigs import Rig
from facegen.rigs.eyes import CORNEA_INDEX, EyeGeometry
from facegen.scene import Lamp, View, tear_lines
from facegen.scene.glasses import LensMirror
from facegen.scene.lamps import radiant_intensity
from facegen.scene.materials import MATERIALS
from facegen.sessions import SampleScene

HIDING_M = 3e-5
"""What hides a glint is nearer than its mirror by at least this; closed lids lie 0.35 mm before the cornea."""
LENS_BLUR = 0.6 / 640.0
"""Standard deviation of the lens's blur, of the picture's width: glints of 9 to 17 px at 640 px wide."""
PIXEL_BLUR_PX = 0.3
"""Standard deviation of what a pixel adds to its own box: crosstalk, and the renderer's pixel filter."""
SHEEN = {"cornea": 1.0, "sclera": 0.2, "tears": 0.5, "lens": 1.9}
"""Share of the light that forms an image at all: the sclera's tear film lies on uneven tissue (chosen by eye).
A lens mirrors at both of its faces, which are so near each other that one image stands for both."""
CLUMP_RAD = {"cornea": 0.0, "sclera": 0.009, "tears": 0.004}
"""Radians over which an uneven surface scatters its image into a clump of spots (likewise)."""
LENS_INDEX = 1.5
LENS_TRANSMISSION = MATERIALS["lens"]["transmission"]


@dataclass(frozen=True, kw_only=True, eq=False)
class Glints:
    """Mirror images of a view's LEDs within its picture; n of them.

    An LED that has none on a surface (because the mirror point would lie off the cornea, say) has no row.

    Attributes
    ----------
    lamps, eyes, surfaces
        n names: of the LED, the eye (``"left"``, ``"right"``) and the mirror (`facegen.labels.led_images.SURFACES`).
    points_2d, points_camera
        (n, 2) pixels and (n, 3) metres in the camera frame, the mirror's point.
    seen
        (n,) bool, whether light goes from the LED to the mirror and on to the camera, past lids, lashes and nose.
    volume
        (n,) radiance summed over the pixels, W sr-1 m-2 px2.
    sigma_px
        (n,) standard deviation of the spot in pixels.
    clump_px
        (n,) pixels over which an uneven mirror scatters it (`facegen.labels.spots`); 0 on the cornea. The radius of the
        disc that a lens of glasses shows.
    """

    lamps: tuple[str, ...]
    eyes: tuple[str, ...]
    surfaces: tuple[str, ...]
    points_2d: np.ndarray
    points_camera: np.ndarray
    seen: np.ndarray
    volume: np.ndarray
    sigma_px: np.ndarray
    clump_px: np.ndarray

    KEYS: ClassVar = (
        LabelKey(
            name="glints",
            meaning="mirror images of LEDs in the picture: `lamp`, `eye`, `surface` (`cornea`, `sclera`, `tears`, "
            "`lens` of glasses), `point_2d`, `point_camera`, `seen` (for the camera and the LED not behind a lid, a "
            "lash, the nose, the housing or a frame of glasses, and within the rim of the camera's lens); an LED "
            "without an image on a surface has no entry",
            unit="px; m, camera",
        ),
    )

    @classmethod
    def of_sample(cls, rig: Rig, sample: SampleScene) -> dict[str, Self]:
        """Label every view of a sample; what the rim of a camera's lens covers is not seen."""
        occluder = occluders(sample.scene.meshes, transparent=(Part.CORNEA, Part.LENS))
        tears = tear_lines(rig, sample.face.vertices[0], sample.face.eye_center[0])
        labels = {}
        for view in sample.scene.views:
            glints = label_glints(view, sample.scene.lamps, sample.eyes, tears, occluder, sample.lenses)
            inside_px = sample.session.unit.camera(view.name).inside_aperture_px(glints.points_2d)
            labels[view.name] = replace(glints, seen=glints.seen & (inside_px >= 0))
        return labels

    def record(self) -> dict[str, Any]:
        """Values of `KEYS`."""
        return {
            "glints": [
                {
                    "lamp": lamp,
                    "eye": self.eyes[i],
                    "surface": self.surfaces[i],
                    "point_2d": self.points_2d[i],
                    "point_camera": self.points_camera[i],
                    "seen": self.seen[i],
                }
                for i, lamp in enumerate(self.lamps)
            ]
        }


def label_glints(
    view: View,
    lamps: tuple[Lamp, ...],
    eyes: tuple[EyeGeometry, EyeGeometry],
    tear_lines: tuple[np.ndarray, np.ndarray],
    occluder: tuple[np.ndarray, np.ndarray],
    lenses: tuple[LensMirror, ...] = (),
) -> Glints:
    """Glints of one view.

    Parameters
    ----------
    view
        Camera, ``camera_from_head``, and which lamps are lit.
    lamps
        All of the scene's.
    eyes
        The subject's left and right eye.
    tear_lines
        Their `facegen.scene.lids.tear_lines`.
    occluder
        Everything that hides a glint, lashes included, corneas and lenses not
        (`facegen.labels.occluders.occluders`).
    lenses
        The subject's left and right lens of glasses, if there are any.
    """
    camera_m = invert_transform(view.camera_from_head)[:3, 3]
    lit = [lamp for lamp in lamps if lamp.name in view.lamps]
    mirrors = led_images(eyes, tear_lines, lenses, lit, camera_m)
    images = [
        (lamp, side, surface, reflections[index])
        for index, lamp in enumerate(lit)
        for (side, surface), reflections in mirrors.items()
    ]
    points = np.array([image.point for *_, image in images]).reshape(-1, 3)
    in_camera = apply_transform(view.camera_from_head, points)
    points_2d = project(view.camera, in_camera)
    with np.errstate(invalid="ignore"):  # NaN: no such image
        inside = view.camera.contains(points_2d) & (in_camera[:, 2] > 0)
    images = [image for image, kept in zip(images, inside, strict=True) if kept]
    in_camera, points = in_camera[inside], points[inside]
    px2_per_sr = _pixels_per_steradian(view.camera, in_camera)
    power, size_rad, clump_rad = (np.zeros(len(images)) for _ in range(3))
    for i, (lamp, _, surface, image) in enumerate(images):
        index = LENS_INDEX if surface == "lens" else CORNEA_INDEX
        power[i] = radiant_intensity(lamp, image.point) * fresnel(image.cosine, index) * image.gain
        power[i] *= SHEEN[surface]
        if lenses and surface != "lens":
            power[i] *= LENS_TRANSMISSION**2  # in and out
        if surface == "lens":
            clump_rad[i] = image.shrinking * lamp.diameter_m / 2.0  # an image of several pixels: a disc
        else:
            clump_rad[i] = CLUMP_RAD[surface]
            size_rad[i] = image.shrinking * lamp.diameter_m / 4.0  # a disc's standard deviation
    blur_px = LENS_BLUR * view.camera.width
    return Glints(
        lamps=tuple(lamp.name for lamp, *_ in images),
        eyes=tuple(SIDES[side] for _, side, *_ in images),
        surfaces=tuple(surface for *_, surface, _ in images),
        points_2d=points_2d[inside],
        points_camera=in_camera,
        seen=_seen(view, [lamp for lamp, *_ in images], points, in_camera, occluder),
        volume=power * px2_per_sr,
        sigma_px=np.sqrt(size_rad**2 * px2_per_sr + blur_px**2 + PIXEL_BLUR_PX**2),
        clump_px=clump_rad * np.sqrt(px2_per_sr),
    )


def _pixels_per_steradian(camera: Camera, points_camera: np.ndarray) -> np.ndarray:
    """(n,) square pixels that a steradian takes up in the picture around points (n, 3)."""
    step = 1e-5
    ray = points_camera / np.linalg.norm(points_camera, axis=-1, keepdims=True)
    aside = np.cross(ray, np.where(np.abs(ray[:, :1]) < 0.9, (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)))
    aside /= np.linalg.norm(aside, axis=-1, keepdims=True)
    a, b = (
        (project(camera, ray + step * d) - project(camera, ray - step * d)) / (2.0 * step)
        for d in (aside, np.cross(ray, aside))
    )
    return np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])


def _seen(
    view: View,
    lamps: list[Lamp],
    points: np.ndarray,
    points_camera: np.ndarray,
    occluder: tuple[np.ndarray, np.ndarray],
) -> np.ndarray:
    if not lamps:
        return np.zeros(0, bool)
    camera_m = invert_transform(view.camera_from_head)[:3, 3]
    ends = np.concatenate([points, camera_m[None], *(lamp.position[None] for lamp in lamps)])
    vertices, triangles = _within(occluder, ends.min(axis=0), ends.max(axis=0))
    in_camera = apply_transform(view.camera_from_head, vertices)
    seen = ~hidden(points_camera, in_camera, triangles, tolerance_m=HIDING_M)
    for i in np.flatnonzero(seen):
        lamp, point = lamps[i], points[i]
        upright = abs(point[1] - lamp.position[1]) < 0.9 * np.linalg.norm(point - lamp.position)
        up = (0.0, 1.0, 0.0) if upright else (1.0, 0.0, 0.0)
        lamp_from_head = invert_transform(look_at(lamp.position, point, up=up))
        seen[i] = not hidden(
            apply_transform(lamp_from_head, point[None]),
            apply_transform(lamp_from_head, vertices),
            triangles,
            tolerance_m=HIDING_M,
        )[0]
    return seen


def _within(
    mesh: tuple[np.ndarray, np.ndarray], low: np.ndarray, high: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The part of a mesh that may reach into a box: a tenth of a head, so that 12 lamps cost little."""
    vertices, triangles = mesh
    # a triangle reaches in where, along each axis, some corner is past the low side and some before the high one; six
    # bits a vertex tell, and gathering these costs a fiftieth of gathering corners
    sides = np.concatenate([vertices >= low, vertices <= high], axis=1)
    bits = np.packbits(sides, axis=1, bitorder="little")[:, 0]
    near = (bits[triangles[:, 0]] | bits[triangles[:, 1]] | bits[triangles[:, 2]]) == 0b111111
    used, renumbered = np.unique(triangles[near], return_inverse=True)
    return vertices[used], renumbered.reshape(-1, 3)
