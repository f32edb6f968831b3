"""Glints: mirror images of the LEDs on corneas and scleras, solved instead of rendered.

An LED's image is smaller than a pixel and a thousand times as bright as the iris: path tracing finds it in one
of 40 samples, and a denoiser takes it for an error. So Cycles' eyes do not mirror lamps; the images are computed
here, are labels, and are added to the finished radiance.

References
----------
.. [1] E. Guestrin and M. Eizenman, "General theory of remote gaze estimation", IEEE TBME 53(6), 2006: the
   cornea as a spherical mirror.
.. [2] M. Born and E. Wolf, "Principles of Optics", 1.5: Fresnel's equations.
"""

from dataclasses import dataclass

import numpy as np
from scipy.special import erf

from facegen.conventions import SIDES
from facegen.geometry import Camera, apply_transform, invert_transform, look_at, project, reflect_in_sphere
from facegen.raster import hidden
from facegen.rigs.eyes import CORNEA_INDEX, EyeGeometry
from facegen.scene import Lamp, View

HIDING_M = 3e-5
"""What hides a glint is nearer than its mirror by at least this; closed lids lie 0.35 mm before the cornea."""
LENS_BLUR = 1.1 / 640.0
"""Standard deviation of the lens's blur, of the picture's width: glints of 9 to 17 px at 640 px wide."""
PIXEL_BLUR_PX = 0.3
"""Standard deviation of what a pixel adds to its own box: crosstalk, and the renderer's pixel filter."""
REACH = 5.0
"""Standard deviations to which a glint is drawn; beyond, the brightest is below a grey level."""
SCLERA_SHEEN = (0.3, 0.006)
"""A sclera's tear film lies on uneven tissue: share of the light that forms an image at all, and the blur of
that image in radians at the mirror (both chosen by eye, beside real frames)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Glints:
    """Mirror images of a view's LEDs within its picture; n of them.

    An LED that has none on a surface (because the mirror point would lie off the cornea, say) has no row.

    Attributes
    ----------
    lamps, eyes, surfaces
        n names: of the LED, the eye (``"left"``, ``"right"``) and the mirror (``"cornea"``, ``"sclera"``).
    points_2d, points_camera
        (n, 2) pixels and (n, 3) metres in the camera frame, the mirror's point.
    seen
        (n,) bool, whether light goes from the LED to the mirror and on to the camera, past lids, lashes and nose.
    volume
        (n,) radiance summed over the pixels, W sr-1 m-2 px2.
    sigma_px
        (n,) standard deviation of the spot in pixels.
    """

    lamps: tuple[str, ...]
    eyes: tuple[str, ...]
    surfaces: tuple[str, ...]
    points_2d: np.ndarray
    points_camera: np.ndarray
    seen: np.ndarray
    volume: np.ndarray
    sigma_px: np.ndarray


def label_glints(
    view: View,
    lamps: tuple[Lamp, ...],
    eyes: tuple[EyeGeometry, EyeGeometry],
    occluder: tuple[np.ndarray, np.ndarray],
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
    occluder
        Everything that hides a glint, lashes included, corneas not (`facegen.labels.views.occluders`).
    """
    lit = [lamp for lamp in lamps if lamp.name in view.lamps]
    camera_m = invert_transform(view.camera_from_head)[:3, 3]
    rows = [
        (lamp, side, surface)
        for lamp in lit
        for side in range(len(SIDES))
        for surface in ("cornea", "sclera")
    ]
    if not rows:
        return _chosen((), *(np.zeros((0, k)) for k in (2, 3)), *(np.zeros(0) for _ in range(3)))
    source = np.stack([lamp.position for lamp, _, _ in rows])
    center, radius = (
        np.stack(values)
        for values in zip(*(_sphere(eyes[side], surface) for _, side, surface in rows), strict=True)
    )
    image = reflect_in_sphere(center, radius, source, camera_m)
    in_camera = apply_transform(view.camera_from_head, image.point)
    points_2d = project(view.camera, in_camera)
    exists = np.array(
        [
            _on_surface(eyes[side], surface, point)
            for (_, side, surface), point in zip(rows, image.point, strict=True)
        ]
    )
    keep = np.flatnonzero(exists & (in_camera[:, 2] > 0) & view.camera.contains(points_2d))
    rows = [rows[i] for i in keep]
    sheen, blur_rad = (
        np.array([1.0 if s == "cornea" else SCLERA_SHEEN[0] for _, _, s in rows]),
        np.array([0.0 if s == "cornea" else SCLERA_SHEEN[1] for _, _, s in rows]),
    )
    intensity = np.array(
        [radiant_intensity(lamp, point) for (lamp, _, _), point in zip(rows, image.point[keep], strict=True)]
    )
    px2_per_sr = _pixels_per_steradian(view.camera, in_camera[keep])
    volume = intensity * sheen * fresnel(image.cosine[keep]) * image.gain[keep] * px2_per_sr
    size_m = np.array([lamp.diameter_m / 4.0 for lamp, _, _ in rows])  # standard deviation across a disc
    angle_rad = np.hypot(size_m * image.shrinking[keep], blur_rad)
    sigma = np.sqrt(angle_rad**2 * px2_per_sr + (LENS_BLUR * view.camera.width) ** 2 + PIXEL_BLUR_PX**2)
    seen = _seen(view, rows, image.point[keep], in_camera[keep], occluder)
    return _chosen(tuple(rows), points_2d[keep], in_camera[keep], seen, volume, sigma)


def _chosen(
    rows: tuple, points_2d: np.ndarray, points_camera: np.ndarray, seen: np.ndarray, *rest: np.ndarray
) -> Glints:
    return Glints(
        lamps=tuple(lamp.name for lamp, _, _ in rows),
        eyes=tuple(SIDES[side] for _, side, _ in rows),
        surfaces=tuple(surface for _, _, surface in rows),
        points_2d=points_2d,
        points_camera=points_camera,
        seen=seen.astype(bool),
        volume=rest[0],
        sigma_px=rest[1],
    )


def _sphere(eye: EyeGeometry, surface: str) -> tuple[np.ndarray, float]:
    if surface == "sclera":
        return eye.center, eye.radius
    return eye.center + eye.cornea_center_offset * eye.axis, eye.cornea_radius


def _on_surface(eye: EyeGeometry, surface: str, point: np.ndarray) -> bool:
    """Whether a point of a surface's sphere belongs to it: the cornea ends, and the sclera begins, at the limbus."""
    before_limbus = (point - eye.center) @ eye.axis > eye.limbus_offset
    return bool(np.isfinite(point).all() and before_limbus == (surface == "cornea"))


def radiant_intensity(lamp: Lamp, point: np.ndarray) -> float:
    """W/sr that an LED sends to a point (3,): Lambert's cosine, cut to its beam as Cycles does.

    Cycles weighs the cosine by 1 - tan(angle) / tan(spread / 2) and keeps the power.
    """
    ray = point - lamp.position
    cosine = float(ray @ lamp.direction / np.linalg.norm(ray))
    if cosine <= 0.0:
        return 0.0
    half = lamp.spread_rad / 2.0
    if half > np.pi / 2 - 1e-6:
        return lamp.power_w / np.pi * cosine
    edge = np.tan(half)
    beam = max(edge - np.sqrt(1.0 - min(cosine, 1.0) ** 2) / cosine, 0.0) / (edge - half)
    return lamp.power_w / np.pi * cosine * beam


def fresnel(cosine: np.ndarray, index: float = CORNEA_INDEX) -> np.ndarray:
    """Share of unpolarised light that a surface of an index mirrors at incidences with these cosines [2]_."""
    inside = np.sqrt(1.0 - (1.0 - np.square(cosine)) / index**2)
    across = (cosine - index * inside) / (cosine + index * inside)
    within = (index * cosine - inside) / (index * cosine + inside)
    return 0.5 * (across**2 + within**2)


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
    rows: list[tuple[Lamp, int, str]],
    points: np.ndarray,
    points_camera: np.ndarray,
    occluder: tuple[np.ndarray, np.ndarray],
) -> np.ndarray:
    if not rows:
        return np.zeros(0, bool)
    camera_m = invert_transform(view.camera_from_head)[:3, 3]
    ends = np.concatenate([points, camera_m[None], *(lamp.position[None] for lamp, _, _ in rows)])
    vertices, triangles = _within(occluder, ends.min(axis=0), ends.max(axis=0))
    in_camera = apply_transform(view.camera_from_head, vertices)
    seen = ~hidden(points_camera, in_camera, triangles, tolerance_m=HIDING_M)
    for i in np.flatnonzero(seen):
        lamp, point = rows[i][0], points[i]
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
    corners = vertices[triangles]
    near = ((corners.max(axis=1) >= low) & (corners.min(axis=1) <= high)).all(axis=-1)
    used, renumbered = np.unique(triangles[near], return_inverse=True)
    return vertices[used], renumbered.reshape(-1, 3)


def with_glints(radiance: np.ndarray, glints: Glints) -> np.ndarray:
    """A view's radiance (h, w) float32 with its seen glints: Gaussian spots integrated over each pixel."""
    height, width = radiance.shape
    total = radiance.astype(np.float64)
    for i in np.flatnonzero(glints.seen):
        profile, window = [], []
        for middle, size in zip(glints.points_2d[i], (width, height), strict=True):
            reach = REACH * glints.sigma_px[i] + 1.0
            edges = np.arange(max(round(middle - reach), 0), min(round(middle + reach), size - 1) + 2) - 0.5
            cumulated = 0.5 * erf((edges - middle) / (glints.sigma_px[i] * np.sqrt(2.0)))
            profile.append(np.diff(cumulated))
            window.append(slice(int(edges[0] + 0.5), int(edges[-1] + 0.5)))
        total[window[1], window[0]] += glints.volume[i] * profile[1][:, None] * profile[0]
    # a view's file holds radiance as 16-bit floats
    return np.minimum(total, np.finfo(np.float16).max).astype(np.float16).astype(np.float32)
