"""Names of the materials, near infra-red, and the parameters they have if a scene says nothing.

Albedos are diffuse reflectances at about 850 nm. Melanin hardly absorbs there, so skins of all colours lie
close together and lips are almost as grey as skin [1]_; teeth follow [2]_, gums and tongue [3]_. Lengths are in metres.

References
----------
.. [1] R. R. Anderson and J. A. Parrish, "The optics of human skin", J. Invest. Dermatol. 77(1), 1981:
   reflectance of 0.5 to 0.7 between 800 and 1,000 nm, scattering deeper than in visible light.
.. [2] D. Fried et al., "Nature of light scattering in dental enamel and dentin at visible and near-infrared
   wavelengths", Applied Optics 34(7), 1995: enamel hardly absorbs and scatters less than in visible light, the dentine
   behind it scatters strongly; teeth stay the lightest thing in the mouth, a little under the skin's upper range.
.. [3] A. Bashkatov et al., "Optical properties of human skin, subcutaneous and mucous tissues in the wavelength range
   from 400 to 2000 nm", J. Physics D 38(15), 2005: mucosa scatters less than skin does; gums, tongue and the mouth's
   lining are set below the skin's 0.56 for it (chosen, not measured).
"""

from facegen.errors import InputError

MATERIALS: dict[str, dict[str, float]] = {
    "skin": {
        "albedo": 0.608,
        "roughness": 0.48,
        "specular": 0.35,
        "scatter_m": 3.0e-3,
        "mottle": 0.09,
        "bump_m": 4e-5,
        "crease": 0.6,
        "crease_m": 5.0e-3,
        "liner": 0.0,
    },
    "lips": {
        "albedo": 0.525,
        "roughness": 0.5,
        "specular": 0.3,
        "scatter_m": 3.0e-3,
        "mottle": 0.15,
        "bump_m": 8e-5,
        "crease": 0.0,
        "crease_m": 1.0,
        "liner": 0.0,
    },
    "cavity": {"albedo": 0.28, "roughness": 0.5},
    "conjunctiva": {"albedo": 0.5, "roughness": 0.3},
    "caruncle": {"albedo": 0.45, "roughness": 0.22, "scatter_m": 1.5e-3},
    "sclera": {
        "albedo": 0.45,
        "roughness": 0.25,
        "scatter_m": 1.5e-3,
        "mottle": 0.05,
        "vessels": 0.12,
        "limbus": 0.35,
    },
    "iris": {"albedo": 0.278, "contrast": 0.55, "limbus": 0.5, "collarette": 0.25, "pattern": 0.0},
    "pupil": {"albedo": 0.1},
    "cornea": {"index": 1.336},
    "teeth": {"albedo": 0.62, "roughness": 0.2, "scatter_m": 1.0e-3},
    "gums": {"albedo": 0.45, "roughness": 0.3, "scatter_m": 2.0e-3},
    "tongue": {"albedo": 0.42, "roughness": 0.4, "scatter_m": 2.0e-3},
    "lashes": {"albedo": 0.08},
    "hair": {"albedo": 0.15},
    "frame": {"albedo": 0.08, "roughness": 0.35},
    "lens": {"transmission": 0.92},
    "headset": {},
    "emitter": {"radiance": 1.0},
}
"""Every material and the parameters it knows, with their defaults.

``mottle``
    Relative depth of the albedo's fine variation.
``limbus``
    How far the albedo falls at the limbus: iris and sclera shade into each other there.
``contrast``, ``collarette``, ``pattern``
    Depth of the iris's fibres, height of its lighter inner zone, and a number that picks the fibre pattern.
``crease``, ``crease_m``
    Depth of the lid's crease, 1 being 0.5 mm, and its distance from the lid's margin.
``liner``
    Share of the light that eyeliner along the upper lashes absorbs.
``transmission``
    Share of the light that passes a lens; what is lost is mirrored, and added as glints.
``vessels``
    How much of the sclera's albedo a vessel takes away.
"""


def material_values(name: str, given: dict[str, float]) -> dict[str, float]:
    """Parameters of a material with defaults filled in.

    Raises
    ------
    InputError
        Where the material or a parameter does not exist.
    """
    if name not in MATERIALS:
        raise InputError(f"there is no material {name!r}; known are {', '.join(MATERIALS)}")
    unknown = sorted(set(given) - set(MATERIALS[name]))
    if unknown:
        known = ", ".join(MATERIALS[name])
        raise InputError(f"material {name!r} has no parameter {unknown[0]!r}; known are {known}")
    return {**MATERIALS[name], **given}
