"""Solves refraction at a sphere: where the light of a point inside leaves towards an observer outside.

References
----------
.. [1] M. Born and E. Wolf, "Principles of Optics", 3.3.2: by Fermat's principle the optical length of the path is
   stationary, which is Snell's law.
.. [2] The same, 4.2.3: the sphere of radius R / n about the centre holds the aplanatic points. What lies within it is
   seen from everywhere outside, by one path; further out, total reflection leaves dark directions.
"""

import numpy as np

_STEPS, _STILL = 60, 1e-14
"""Most steps of Newton's method, which halve the bracket where they would leave it, and the last one's size: six do."""


def refract_through_sphere(
    center: np.ndarray, radius: np.ndarray | float, index: float, point: np.ndarray, observer: np.ndarray
) -> np.ndarray:
    """Where observers see points through the surface of balls.

    Parameters
    ----------
    center, point, observer
        (..., 3) metres, any common frame; points lie within the ball, observers outside. They broadcast.
    radius
        (...) metres.
    index
        Refractive index of the ball relative to what is around it, above 1.

    Returns
    -------
    numpy.ndarray
        (..., 3) the place on the ball's surface, metres; NaN where total reflection keeps the light inside.
    """
    to_observer, to_point = np.subtract(observer, center), np.subtract(point, center)
    far = np.linalg.norm(to_observer, axis=-1)
    first = to_observer / far[..., None]
    across = to_point - (to_point * first).sum(axis=-1, keepdims=True) * first
    width = np.linalg.norm(across, axis=-1)
    between = np.arctan2(width, (to_point * first).sum(axis=-1))
    # where both directions agree any second axis will do: the angle along it is 0
    second = across / np.where(width > 0.0, width, 1.0)[..., None]
    angle = _leaving_angle(far / radius, np.linalg.norm(to_point, axis=-1) / radius, between, index)
    normal = np.cos(angle)[..., None] * first + np.sin(angle)[..., None] * second
    return center + np.asarray(radius)[..., None] * normal


def _leaving_angle(observer: np.ndarray, point: np.ndarray, between: np.ndarray, index: float) -> np.ndarray:
    """Angle from the observer's direction at which light leaves, of distances in radii and the angle between them.

    There the slope of the optical path's length is 0. It is the sine of the angle outside less ``index`` times the
    sine inside, so it grows from below 0, straight before the observer, to above 0 at the horizon or over the point.
    """
    observer, point, between = np.broadcast_arrays(observer, point, between)
    low, high = np.zeros(between.shape), np.minimum(between, np.arccos(1.0 / observer))

    def slopes(angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        outside, outside_rate = _length_slopes(observer, angle)
        inside, inside_rate = _length_slopes(point, between - angle)
        return outside - index * inside, outside_rate + index * inside_rate

    with np.errstate(divide="ignore"):  # a level slope: the step leaves the bracket
        exists = slopes(high)[0] >= -1e-12
        angle = 0.5 * (low + high)
        for _ in range(_STEPS):
            slope, rate = slopes(angle)
            low, high = np.where(slope < 0.0, angle, low), np.where(slope < 0.0, high, angle)
            step = angle - slope / rate
            before, angle = angle, np.where((step >= low) & (step <= high), step, 0.5 * (low + high))
            if (np.abs(angle - before) <= _STILL).all():
                break
    return np.where(exists, angle, np.nan)


def _length_slopes(distance: np.ndarray, angle: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First and second derivative by the angle of the length from a point at this distance to the unit circle."""
    length = np.sqrt(1.0 + distance**2 - 2.0 * distance * np.cos(angle))
    slope = distance * np.sin(angle) / length
    return slope, (distance * np.cos(angle) - slope**2) / length
