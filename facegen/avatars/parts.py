"""The parts that every avatar's face has: skin, mouth, brows, lashes, eyes and hair, of one head."""

from dataclasses import dataclass, replace

import numpy as np

from facegen.avatars.brows import draw_brow_surfaces
from facegen.avatars.complexion import Complexion, draw_skin_spots, paint_skin
from facegen.avatars.eyeballs import draw_eye, eyeballs
from facegen.avatars.hair import draw_hair_surfaces
from facegen.avatars.haircuts import STYLES
from facegen.avatars.lashes import draw_lashes, lash_surfaces
from facegen.avatars.mouth import mouth_surfaces
from facegen.avatars.pictures import jpeg
from facegen.avatars.shapes import FaceShapes
from facegen.avatars.skin import OUTSIDE, chart, part_of_face
from facegen.avatars.surface import Material, Surface
from facegen.mouth.traits import draw_mouth
from facegen.raster import triangles_of


@dataclass(frozen=True, kw_only=True, eq=False)
class FaceParts:
    """``skin``, the rig's vertices ``rows`` (V,) of its vertices, and the ``others``, in drawing order."""

    skin: Surface
    rows: np.ndarray
    others: tuple[Surface, ...]


def face_parts(shapes: FaceShapes, look: Complexion, *, hair: str, seed: int) -> FaceParts:
    """The parts of one head; ``hair`` is a name of `facegen.avatars.haircuts.STYLES`."""

    def rng(part: int) -> np.random.Generator:
        return np.random.Generator(np.random.PCG64([seed, part]))

    rig, style = shapes.rig, STYLES[hair]
    picture = jpeg(paint_skin(shapes, look, style, spots=draw_skin_spots(rng(0))))
    material = Material(name="skin", roughness=0.6, picture=picture)
    skin, rows = part_of_face(shapes, OUTSIDE, mesh="Head", material=material)
    outer = triangles_of(rig.faces[np.isin(rig.part, OUTSIDE)])
    return FaceParts(
        skin=replace(skin, uv=chart(skin.positions)),
        rows=rows,
        others=(
            *mouth_surfaces(shapes, draw_mouth(rng(1))),
            *draw_brow_surfaces(shapes, colour=look.hair, rng=rng(2)),
            *lash_surfaces(shapes, picture=draw_lashes(rng(3))),
            *eyeballs(rig, picture=draw_eye(look.iris, float(rig.eye_radius.mean()), rng(4))),
            *draw_hair_surfaces(shapes.neutral, outer, style, colour=look.hair, rng=rng(5)),
        ),
    )
