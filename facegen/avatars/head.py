"""Puts an avatar's head together: skin, eyes, lashes, brows, mouth and hair of one rig, as a .glb file."""

from dataclasses import replace

import numpy as np

from facegen.avatars.brows import brow_surfaces
from facegen.avatars.complexion import Complexion, paint_skin
from facegen.avatars.eyeballs import eyeballs
from facegen.avatars.glb import avatar_bytes
from facegen.avatars.hair import STYLES, hair_surfaces
from facegen.avatars.lashes import lash_surfaces
from facegen.avatars.mouth import mouth_surfaces
from facegen.avatars.pictures import jpeg
from facegen.avatars.shapes import face_shapes
from facegen.avatars.skeleton import head_bones
from facegen.avatars.skin import OUTSIDE, chart, part_of_face
from facegen.avatars.surface import Material, Surface, cut
from facegen.mouth.traits import draw_mouth
from facegen.raster import triangles_of
from facegen.rigs import Rig

SEED = 7
NECK_END_M = -0.16
"""Height at which the neck is cut."""


def head_bytes(rig: Rig, *, look: Complexion = Complexion(), seed: int = SEED) -> bytes:
    """Bytes of a .glb file with the rig's mean head."""
    shapes = face_shapes(rig)

    def rng(part: int) -> np.random.Generator:
        return np.random.Generator(np.random.PCG64([seed, part]))

    style = STYLES["short"]
    picture = jpeg(paint_skin(shapes, look, style, rng=rng(0)))
    skin, _ = part_of_face(
        shapes, OUTSIDE, mesh="Head", material=Material(name="skin", roughness=0.55, picture=picture)
    )
    skin = _ended(replace(skin, uv=chart(skin.positions)))
    surfaces = [
        skin,
        *mouth_surfaces(shapes, draw_mouth(rng(1))),
        *brow_surfaces(shapes, colour=look.hair, rng=rng(2)),
        *lash_surfaces(shapes, rng=rng(3)),
        *eyeballs(rig, iris=look.iris, rng=rng(4)),
    ]
    outer = triangles_of(rig.faces[np.isin(rig.part, OUTSIDE)])
    surfaces += hair_surfaces(shapes.neutral, outer, style, colour=look.hair, rng=rng(5))
    extras = {
        "licence": rig.licence,
        "source": rig.source,
        "frame": "metres, y up, z out of the face, x to the subject's left; the origin lies midway between the eyes",
    }
    return avatar_bytes(surfaces, head_bones(rig), copyright=f"{rig.licence}: {rig.source}", extras=extras)


def _ended(skin: Surface) -> Surface:
    """The skin with a neck that ends level: what lies below is left out, what crosses is drawn up."""
    low = skin.positions[:, 1] < NECK_END_M
    skin = cut(skin, ~low[skin.triangles].all(axis=1))
    positions = skin.positions.copy()
    positions[:, 1] = np.maximum(positions[:, 1], NECK_END_M)
    return replace(skin, positions=positions)
