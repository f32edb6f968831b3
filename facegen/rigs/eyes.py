"""Shapes the eye: a scleral sphere with a corneal cap, the iris inside it, and the line of sight.

Eyes have human size on every rig, whatever its source draws (`facegen.rigs.human_eyes`), because pictures, pupil
labels and every angle computed from them depend on it. An eye's centre is its centre of rotation, `GLOBE_AHEAD_M`
behind the sphere's. Lids (`facegen.rigs.lids`) and eye meshes (`facegen.scene`) rest on the same surface,
`lid_support_radius`.

References
----------
.. [1] F. Rüfer et al., "White-to-white corneal diameter", Cornea 24(3), 2005: 11.71 +- 0.42 mm across.
.. [2] Gullstrand-Le Grand schematic eye, in D. Atchison and G. Smith, "Optics of the Human Eye", 2000: anterior cornea
   7.8 mm, cornea 0.55 mm thick, anterior chamber 3.05 mm deep, refractive index 1.376 (cornea), 1.336 (aqueous).
.. [3] E. Guestrin and M. Eizenman, "General theory of remote gaze estimation", IEEE TBME 53(6), 2006: the visual axis
   lies about 5 degrees nasal of and 1.5 degrees above the optical axis.
.. [4] G. Fry and W. Hill, "The center of rotation of the eye", Am. J. Optometry 39(11), 1962: 13.5 mm behind the
   cornea's apex in emmetropes.
"""

from dataclasses import dataclass

import numpy as np

IRIS_RADIUS_M = 5.9e-3
"""Radius of the visible iris, which is the limbus circle where the cornea meets the sclera [1]_."""
CORNEA_RADIUS_M = 7.8e-3
"""Radius of curvature of the cornea's front [2]_."""
IRIS_DEPTH_M = 3.6e-3
"""Iris plane behind the cornea's apex: corneal thickness and anterior chamber [2]_."""
CORNEA_INDEX = 1.336
"""Refractive index between air and iris; the aqueous humour's, as the thin cornea barely bends [2]_."""
GLOBE_AHEAD_M = 0.353e-3
"""The sphere's centre lies this far before the centre of rotation, which in an eye of 12 mm is then 13.5 mm behind the
cornea's apex [4]_."""
KAPPA_NASAL_RAD = np.radians(5.0)
KAPPA_UP_RAD = np.radians(1.5)
"""Visual axis against the optical axis, mean of people [3]_."""


@dataclass(frozen=True, kw_only=True, eq=False)
class EyeGeometry:
    """One eye, ready to be meshed. Head frame, metres.

    Attributes
    ----------
    center
        (3,) centre of rotation; offsets count from here.
    radius, sclera_center_offset
        Scleral sphere: its radius, and how far along the axis its centre lies.
    axis
        (3,) unit optical axis, out of the face.
    limbus_radius
        Radius of the circle where cornea and sclera meet, equal to the visible iris's.
    limbus_offset
        Distance of the limbus plane from the centre, along the axis.
    cornea_center_offset, cornea_radius
        The corneal cap is the part of a sphere of this radius, centred this far along the axis, beyond the
        limbus.
    iris_plane_offset
        Distance of the iris plane from the centre, along the axis.
    pupil_radius
        Radius of the (physical, unrefracted) pupil.
    """

    center: np.ndarray
    radius: float
    sclera_center_offset: float
    axis: np.ndarray
    limbus_radius: float
    limbus_offset: float
    cornea_center_offset: float
    cornea_radius: float
    iris_plane_offset: float
    pupil_radius: float


def limbus_offset(eye_radius: np.ndarray) -> np.ndarray:
    """Distance of the limbus plane from the centre of eyeballs of the given radii (...), in metres."""
    return GLOBE_AHEAD_M + np.sqrt(np.square(eye_radius) - IRIS_RADIUS_M**2)


def cornea_center_offset(eye_radius: np.ndarray) -> np.ndarray:
    """Distance of the cornea's centre of curvature from the centre of eyeballs of the given radii (...)."""
    return limbus_offset(eye_radius) - np.sqrt(CORNEA_RADIUS_M**2 - IRIS_RADIUS_M**2)


def eye_geometry(
    center: np.ndarray, radius: float, axis: np.ndarray, *, pupil_radius: float = 2.0e-3
) -> EyeGeometry:
    """Shape of one eye at ``center`` (3,) that looks along ``axis`` (3,), in the head frame."""
    offset = float(cornea_center_offset(radius))
    return EyeGeometry(
        center=np.asarray(center, np.float64),
        radius=float(radius),
        sclera_center_offset=GLOBE_AHEAD_M,
        axis=np.asarray(axis, np.float64) / np.linalg.norm(axis),
        limbus_radius=IRIS_RADIUS_M,
        limbus_offset=float(limbus_offset(radius)),
        cornea_center_offset=offset,
        cornea_radius=CORNEA_RADIUS_M,
        iris_plane_offset=offset + CORNEA_RADIUS_M - IRIS_DEPTH_M,
        pupil_radius=float(pupil_radius),
    )


def lid_support_radius(direction: np.ndarray, eye_radius: np.ndarray, axis: np.ndarray) -> np.ndarray:
    """Distance from the eyeball's centre to the eye's outer surface, the union of sclera and corneal cap.

    Parameters
    ----------
    direction
        (..., 3) unit directions from the centre.
    eye_radius
        (...) radii of the scleral spheres, in metres.
    axis
        (..., 3) unit optical axes. The three arguments broadcast.

    Returns
    -------
    numpy.ndarray
        (...) distances in metres: about ``eye_radius`` outside the limbus, up to about 1.5 mm more on the cornea's
        apex.
    """
    cosine = np.einsum("...i,...i->...", direction, axis)
    sine_square = 1.0 - np.square(cosine)
    sclera = cosine * GLOBE_AHEAD_M + np.sqrt(np.square(eye_radius) - GLOBE_AHEAD_M**2 * sine_square)
    offset = cornea_center_offset(eye_radius)
    # far crossing of the ray with the cornea's sphere; a ray that misses it (negative root) stays on the
    # sclera
    root = CORNEA_RADIUS_M**2 - np.square(offset) * sine_square
    cornea = cosine * offset + np.sqrt(np.maximum(root, 0.0))
    return np.where(root > 0.0, np.maximum(sclera, cornea), sclera)


def visual_axis(optical_axis: np.ndarray) -> np.ndarray:
    """Lines of sight (..., 2, 3) of optical axes (..., 2, 3), the left eye first: nasal and a little up."""
    optical_axis = np.asarray(optical_axis, np.float64)
    nasal = np.array([-1.0, 1.0]) * np.tan(KAPPA_NASAL_RAD)
    # towards the subject's left, seen along the axis
    leftwards = np.cross(np.array([0.0, 1.0, 0.0]), optical_axis)
    leftwards /= np.linalg.norm(leftwards, axis=-1, keepdims=True)
    up = np.cross(optical_axis, leftwards)
    sight = optical_axis + nasal[:, None] * leftwards + np.tan(KAPPA_UP_RAD) * up
    return sight / np.linalg.norm(sight, axis=-1, keepdims=True)
