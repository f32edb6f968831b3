"""Draws how previewed people look: skin, lips, hair and eyes by ancestry, sex and age, so that they are not one man.

Labels know nothing of it: the colours are for people who look at pictures.
"""

from dataclasses import dataclass

import numpy as np

from facegen.avatars.complexion import Complexion

SKINS = np.array([[0.42, 0.285, 0.215], [0.85, 0.69, 0.565], [0.89, 0.715, 0.635]])
"""Middle sRGB colours by ancestry: African, Asian, Caucasian."""
DARK_HAIR = ((0.09, 0.075, 0.07), (0.14, 0.105, 0.09), (0.22, 0.15, 0.115))
ANY_HAIR = (*DARK_HAIR, (0.34, 0.235, 0.16), (0.47, 0.345, 0.22), (0.67, 0.53, 0.34), (0.48, 0.24, 0.13))
GREY_HAIR = (0.64, 0.63, 0.62)
BROWN_EYES = ((0.25, 0.155, 0.10), (0.33, 0.215, 0.135))
ANY_EYES = (*BROWN_EYES, (0.36, 0.46, 0.56), (0.42, 0.50, 0.54), (0.36, 0.44, 0.32), (0.43, 0.375, 0.24))
GREYING_YEARS = (45.0, 75.0)
"""Ages between which hair turns grey."""
WOMENS_HAIR = ("long", "bob", "bun")
MENS_HAIR = ("short", "cropped", "short", "cropped", "bald")


@dataclass(frozen=True, kw_only=True)
class Look:
    """Colours of one person, a haircut (``"bald"``, or a name of `facegen.avatars.haircuts.STYLES`), and a seed."""

    colours: Complexion
    hair: str
    seed: int


def draw_look(
    seed: int, *, female: bool | None = None, age_years: float = 35.0, ancestry: np.ndarray | None = None
) -> Look:
    """The look of a person; the same key gives the same look.

    Parameters
    ----------
    seed
        For example the person's number.
    female, age_years
        None draws a sex.
    ancestry
        (3,) shares of African, Asian and Caucasian ancestry; None draws them.
    """
    rng = np.random.Generator(np.random.PCG64([seed, 31]))
    drawn = rng.dirichlet([0.4] * 3)
    shares = drawn if ancestry is None else np.asarray(ancestry, np.float64)
    shares = shares**2 / (shares**2).sum()  # most people look like some place, not like the mean of all
    female = bool(rng.random() < 0.5) if female is None else female
    skin = np.clip(shares @ SKINS * np.exp(rng.normal(0.0, 0.09)) + rng.normal(0.0, 0.012, 3), 0.16, 0.95)
    fair = rng.random() < shares[2]
    hair = np.array((ANY_HAIR if fair else DARK_HAIR)[rng.integers(len(ANY_HAIR if fair else DARK_HAIR))])
    greyer = np.clip((age_years - GREYING_YEARS[0]) / np.ptp(GREYING_YEARS) + rng.normal(0.0, 0.15), 0.0, 1.0)
    eyes = ANY_EYES if fair else BROWN_EYES
    haircuts = WOMENS_HAIR if female else MENS_HAIR
    lips = skin * [0.88, 0.66, 0.66] + [0.06, 0.0, 0.02] if female else skin * [0.88, 0.72, 0.70]
    return Look(
        colours=Complexion(
            skin=tuple(skin),
            lips=tuple(np.clip(lips, 0.0, 1.0)),
            hair=tuple(hair + greyer * (np.array(GREY_HAIR) - hair)),
            iris=eyes[rng.integers(len(eyes))],
            flush=float(rng.uniform(0.6, 1.4)),
            beard=0.0 if female else float(rng.choice([0.0, 0.0, 0.3, 0.55])),
        ),
        hair=haircuts[rng.integers(len(haircuts))],
        seed=seed,
    )
