"""Draws how people look in infra-red besides their shape: skin, eyes, hair, and where hair grows."""

from dataclasses import dataclass, field

import numpy as np

from facegen.conventions import Part
from facegen.rigs import Rig
from facegen.scene.brows import Brows, brow_tubes, draw_brows
from facegen.scene.lashes import Lashes, draw_lashes, lash_tubes
from facegen.scene.materials import MATERIALS
from facegen.scene.scene import Mesh


@dataclass(frozen=True, kw_only=True, eq=False)
class Look:
    """One person's looks.

    Attributes
    ----------
    materials
        Parameters by material name, over the defaults of `facegen.scene.materials.MATERIALS`.
    lashes, brows
        Where strands grow.
    """

    lashes: Lashes
    brows: Brows
    materials: dict[str, dict[str, float]] = field(default_factory=dict)


def draw_look(rng: np.random.Generator, rig: Rig) -> Look:
    """The looks of one person, whose own stream ``rng`` is.

    Skins differ little at 850 nm, where melanin hardly absorbs: a reflectance of 0.5 to 0.7 covers all of them, and
    of irises too the brown come close to the blue (`facegen.scene.materials`).
    """
    relative = {name: float(np.clip(rng.normal(1.0, spread), 0.6, 1.5)) for name, spread in _SPREAD.items()}
    uniform = {name: float(rng.uniform(*limits)) for name, limits in _RANGE.items()}
    skin = MATERIALS["skin"]["albedo"] * relative["skin"]
    materials = {
        "skin": {
            "albedo": skin,
            "mottle": uniform["mottle"],
            "bump_m": uniform["bump_m"],
            "crease": uniform["crease"],
            "crease_m": uniform["crease_m"],
        },
        "lips": {"albedo": skin * uniform["lips"]},
        "sclera": {
            "albedo": MATERIALS["sclera"]["albedo"] * relative["sclera"],
            "vessels": uniform["vessels"],
        },
        "iris": {
            "albedo": MATERIALS["iris"]["albedo"] * relative["iris"],
            "contrast": uniform["contrast"],
            "collarette": uniform["collarette"],
            "limbus": uniform["limbus"],
            "pattern": uniform["pattern"],
        },
        "pupil": {"albedo": MATERIALS["pupil"]["albedo"] * relative["pupil"]},
        "lashes": {"albedo": uniform["lashes"]},
        "hair": {"albedo": uniform["hair"]},
    }
    return Look(
        lashes=draw_lashes(rng, rig, density=uniform["lash_density"], length=uniform["lash_length"]),
        brows=draw_brows(rng, rig, density=uniform["brow_density"], width=uniform["brow_width"]),
        materials=materials,
    )


_SPREAD = {"skin": 0.05, "sclera": 0.05, "iris": 0.08, "pupil": 0.08}
"""Relative standard deviations of albedos between people."""
_RANGE = {
    "mottle": (0.05, 0.13),
    "bump_m": (2.5e-5, 6e-5),
    "crease": (0.15, 1.0),
    "crease_m": (3.5e-3, 6.5e-3),
    "lips": (0.88, 0.98),
    "vessels": (0.04, 0.2),
    "contrast": (0.35, 0.7),
    "collarette": (0.1, 0.35),
    "limbus": (0.35, 0.6),
    "pattern": (0.0, 1.0),
    "lashes": (0.05, 0.12),
    "lash_density": (0.75, 1.3),
    "lash_length": (0.76, 1.14),
    "hair": (0.08, 0.3),
    "brow_density": (0.5, 1.4),
    "brow_width": (0.75, 1.25),
}
"""Parameters of materials and of hair that are as likely anywhere between two limits."""


def hair_meshes(look: Look, vertices: np.ndarray) -> tuple[Mesh, ...]:
    """A person's lashes and brows on an evaluated head (V, 3), head frame, metres."""
    meshes = []
    for name, part, (points, quads) in (
        ("lashes", Part.LASHES, lash_tubes(look.lashes, vertices)),
        ("hair", Part.HAIR, brow_tubes(look.brows, vertices)),
    ):
        if len(quads):
            meshes.append(
                Mesh(
                    name=name,
                    vertices=points,
                    faces=quads,
                    part=np.full(len(quads), part, np.uint8),
                    materials=(name,),
                    face_material=np.zeros(len(quads), np.int32),
                )
            )
    return tuple(meshes)
