"""Solves reflections in convex mirrors, spheres and threads: where a source is seen, how bright, and how large.

References
----------
.. [1] The point is the answer to Alhazen's problem; between the tangent planes of source and observer it is
   unique, because the path over the sphere is convex there (Fermat).
.. [2] M. Born and E. Wolf, "Principles of Optics", 4.6: Coddington's equations of an oblique pencil. In
   reflection at radius R and incidence i its curvature grows by 2 / (R cos i) in the plane of incidence and
   by 2 cos i / R across it.
"""

from dataclasses import dataclass

import numpy as np

_STEPS = 40
"""Each either halves the bracket or is a Newton step, which doubles the correct digits."""

THREAD_PLACES = 400
"""Places along a thread that are compared; a lid's margin is 30 mm long."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Reflection:
    """Reflections of point sources in spheres, as seen by observers; NaN where there is none.

    Attributes
    ----------
    point
        (..., 3) on the sphere, metres.
    cosine
        (...) cosine of the angle of incidence.
    gain
        (...) irradiance at the observer, across the ray, of a source of 1 W/sr and a perfect mirror: m**-2.
    shrinking
        (...) radians under which the observer sees a metre of the source (across its ray), the geometric mean
        of both directions.
    """

    point: np.ndarray
    cosine: np.ndarray
    gain: np.ndarray
    shrinking: np.ndarray


def reflect_in_sphere(
    center: np.ndarray, radius: np.ndarray | float, source: np.ndarray, observer: np.ndarray
) -> Reflection:
    """Mirror images in the outside of spheres.

    Parameters
    ----------
    center, source, observer
        (..., 3) metres, any common frame; source and observer lie outside the sphere. They broadcast.
    radius
        (...) metres.
    """
    to_source, to_observer = np.subtract(source, center), np.subtract(observer, center)
    far_source, far_observer = np.linalg.norm(to_source, axis=-1), np.linalg.norm(to_observer, axis=-1)
    first = to_source / far_source[..., None]
    across = to_observer - (to_observer * first).sum(axis=-1, keepdims=True) * first
    width = np.linalg.norm(across, axis=-1)
    between = np.arctan2(width, (to_observer * first).sum(axis=-1))
    # where both directions agree any second axis will do: the angle along it is 0
    second = across / np.where(width > 0.0, width, 1.0)[..., None]
    angle = _mirror_angle(far_source / radius, far_observer / radius, between)
    normal = np.cos(angle)[..., None] * first + np.sin(angle)[..., None] * second
    point = center + np.asarray(radius)[..., None] * normal
    source_ray, observer_ray = source - point, observer - point
    s, t = np.linalg.norm(source_ray, axis=-1), np.linalg.norm(observer_ray, axis=-1)
    cosine = (normal * observer_ray).sum(axis=-1) / t
    # by how much the reflected pencil has widened at the observer, in the plane of incidence and across it
    spread = (1.0 + t * (1.0 / s + 2.0 / (radius * cosine))) * (1.0 + t * (1.0 / s + 2.0 * cosine / radius))
    return _reflection(point, cosine, s, spread)


def reflect_in_thread(
    line: np.ndarray, radii: tuple[float, float], source: np.ndarray, observer: np.ndarray
) -> Reflection:
    """The mirror image in a thin, slightly bent thread; NaN where the shortest path meets one of its ends.

    Parameters
    ----------
    line
        (n, 3) polyline, metres.
    radii
        Of the thread across its length, and of its own bend.
    source, observer
        (3,) metres.
    """
    step = np.linspace(0.0, len(line) - 1.0, THREAD_PLACES)
    line_points = np.stack(
        [np.interp(step, np.arange(len(line)), line[:, axis]) for axis in range(3)], axis=-1
    )
    s, t = (np.linalg.norm(line_points - end, axis=-1) for end in (source, observer))
    best = int((s + t).argmin())
    if best in (0, THREAD_PLACES - 1):
        return Reflection(point=np.full(3, np.nan), cosine=np.nan, gain=np.nan, shrinking=np.nan)
    point, s, t = line_points[best], s[best], t[best]
    # the surface faces the middle between both rays
    cosine = np.sqrt(0.5 * (1.0 + (source - point) @ (observer - point) / (s * t)))
    return _reflection(point, cosine, s, np.prod([1.0 + t * (1.0 / s + 2.0 / radius) for radius in radii]))


def _reflection(
    point: np.ndarray, cosine: np.ndarray, distance: np.ndarray, spread: np.ndarray
) -> Reflection:
    gain = 1.0 / (distance**2 * spread)
    return Reflection(point=point, cosine=cosine, gain=gain, shrinking=np.sqrt(gain))


def fresnel(cosine: np.ndarray, index: float) -> np.ndarray:
    """Share of unpolarised light that a surface of an index mirrors at incidences with these cosines [2]_."""
    inside = np.sqrt(1.0 - (1.0 - np.square(cosine)) / index**2)
    across = (cosine - index * inside) / (cosine + index * inside)
    within = (index * cosine - inside) / (index * cosine + inside)
    return 0.5 * (across**2 + within**2)


def _mirror_angle(source: np.ndarray, observer: np.ndarray, between: np.ndarray) -> np.ndarray:
    """Angle of the mirror point from the source's direction, of distances in radii and the angle between them.

    Incidence equals reflection where g = 0, tan i = s sin a / (s cos a - 1) and likewise for the observer,
    multiplied out.
    """
    source, observer, between = np.broadcast_arrays(source, observer, between)
    low = np.maximum(between - np.arccos(1.0 / observer), 0.0)
    high = np.minimum(np.arccos(1.0 / source), between)
    exists = low <= high
    angle = 0.5 * (low + high)
    for _ in range(_STEPS):
        rest = between - angle
        g = source * observer * np.sin(angle - rest) - source * np.sin(angle) + observer * np.sin(rest)
        slope = (
            2.0 * source * observer * np.cos(angle - rest) - source * np.cos(angle) - observer * np.cos(rest)
        )
        low, high = np.where(g < 0.0, angle, low), np.where(g < 0.0, high, angle)
        step = angle - g / np.where(slope == 0.0, np.inf, slope)
        before, angle = angle, np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
        if np.array_equal(before, angle, equal_nan=True):
            break  # all further steps would find the same: six do, mostly
    return np.where(exists, angle, np.nan)
