"""Draws and puts on what a person wears in a session beside the headset: a beard, glasses, make-up."""

from dataclasses import dataclass

import numpy as np

from facegen.rigs import EyeGeometry, Rig
from facegen.scene.beards import Beard, beard_strands, draw_beard
from facegen.scene.glasses import Glasses, LensMirror, draw_glasses, glasses_meshes, place_lenses
from facegen.scene.make_up import MakeUp, draw_make_up
from facegen.scene.scene import Mesh, Strands


@dataclass(frozen=True, kw_only=True, eq=False)
class Accessories:
    """What one person wears in one session; None for what they do not."""

    beard: Beard | None = None
    glasses: Glasses | None = None
    make_up: MakeUp | None = None


@dataclass(frozen=True, kw_only=True, eq=False)
class WornAccessories:
    """Accessories on an evaluated head, for a scene: head frame, metres."""

    meshes: tuple[Mesh, ...] = ()
    strands: tuple[Strands, ...] = ()
    lenses: tuple[LensMirror, ...] = ()


def draw_accessories(
    person: np.random.Generator,
    session: np.random.Generator,
    rig: Rig,
    *,
    female: bool,
    beard: float,
    glasses: float,
    make_up: float,
) -> Accessories:
    """A person's accessories in one session.

    Parameters
    ----------
    person, session
        Streams of their own: who wears what and of which kind is a person's, how long the beard is and what make-up
        is on a session's.
    rig
        The rig that the beard grows on.
    female
        Men may have beards, women make-up.
    beard, glasses, make_up
        Shares of men, of all and of women.
    """
    bearded, seeing, painted = person.random(3)
    spectacles = draw_glasses(person)
    return Accessories(
        beard=draw_beard(person, session, rig) if bearded < beard and not female else None,
        glasses=spectacles if seeing < glasses else None,
        make_up=draw_make_up(session) if painted < make_up and female else None,
    )


def put_on(
    accessories: Accessories, rig: Rig, vertices: np.ndarray, eyes: tuple[EyeGeometry, EyeGeometry]
) -> WornAccessories:
    """Beard and glasses on an evaluated head (V, 3); make-up is part of the look (`facegen.scene.make_up`)."""
    meshes, lenses = (), ()
    if accessories.glasses is not None:
        lenses = place_lenses(accessories.glasses, rig, vertices, eyes)
        meshes = glasses_meshes(accessories.glasses, lenses, rig, vertices)
    beard = accessories.beard
    strands = (beard_strands(beard, rig, vertices),) if beard is not None and len(beard.reach_m) else ()
    return WornAccessories(meshes=meshes, strands=strands, lenses=lenses)
