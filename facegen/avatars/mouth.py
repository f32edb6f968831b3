"""Teeth, gums, tongue and what lines mouth and eyes: one surface, coloured by its vertices."""

from dataclasses import replace

import numpy as np

from facegen.avatars.shapes import FaceShapes
from facegen.avatars.skin import part_of_face
from facegen.avatars.surface import Material, Surface, vertex_normals
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, Part
from facegen.geometry.grids import facing_back, grid_quads, halves, ring_quads
from facegen.mouth.crowns import AROUND, CAP, LEVELS
from facegen.mouth.interior import has_own_teeth, mouth_meshes
from facegen.mouth.tongue import AROUND as AROUND_TONGUE
from facegen.mouth.traits import MouthTraits
from facegen.raster import triangles_of
from facegen.rigs import eye_geometry
from facegen.scene import Mesh
from facegen.scene.lid_edges import lid_edge_meshes

MATERIAL = Material(name="mouth", roughness=0.6)  # shinier teeth glare white from the side
COLOURS = {
    Part.TEETH: (0.90, 0.87, 0.78),
    Part.GUMS: (0.52, 0.20, 0.19),
    Part.TONGUE: (0.55, 0.20, 0.19),
    Part.MOUTH_CAVITY: (0.36, 0.10, 0.10),
    Part.EYE_CAVITY: (0.60, 0.30, 0.27),
}
"""Linear."""
DEEP_M = (9e-3, 48e-3)
"""Behind the lips: here light begins to fail, and here none is left."""
JAW_FOR_TONGUE = 0.6
"""jawOpen at which tongueOut is taken: put out of a shut mouth, a tongue would lie in the lips."""
TOOTH_COLUMNS = (0, 2, 4, 6, 8, 10, 13, 15, 17)
"""Of a crown's round of vertices, more of them on the outer half."""
TOOTH_RINGS = (1, 4, 6, 8, 10, 12)
GUM_ROWS = (3, 6, 7, 8, 10, 13, 15, 19, 27)
TEETH = 14
EDGE_INTO_M = 1.0e-3
"""The lids' edges end so deep in the eye of the rig: the drawn one is smaller (`facegen.avatars.eyeballs`)."""
EDGE_STILL_M = 0.25e-3
"""What shapes move the edges by less is left out of the file."""


def mouth_surfaces(shapes: FaceShapes, traits: MouthTraits) -> list[Surface]:
    """What is inside the mouth and behind the lids, of the mesh ``"Head"``."""
    lining = [_lid_edges(shapes)]
    if (shapes.part == Part.MOUTH_CAVITY).any():
        lining.append(_own(shapes, Part.MOUTH_CAVITY))
    if has_own_teeth(shapes.rig):
        own = [part for part in (Part.TEETH, Part.GUMS, Part.TONGUE) if (shapes.part == part).any()]
        return [_joined(lining + [_own(shapes, part) for part in own])]
    return [_joined(lining + _made(shapes, traits))]


def _own(shapes: FaceShapes, part: Part) -> Surface:
    surface, used = part_of_face(shapes, (part,), mesh="Head", material=MATERIAL)
    if part != Part.MOUTH_CAVITY:
        normals = vertex_normals(surface.positions, surface.triangles)
        surface = replace(surface, normals=normals, turned=_turned(surface))
    colours = np.tile([*COLOURS[part], 1.0], (len(used), 1))
    colours[:, :3] *= _light(shapes, surface.positions)[:, None]
    return replace(surface, colours=colours)


def _lid_edges(shapes: FaceShapes) -> Surface:
    """The wet edges of the lids, from their margins into the drawn eyes."""
    rig, ahead = shapes.rig, np.array([0.0, 0.0, 1.0])
    eyes = [eye_geometry(c, r, ahead) for c, r in zip(rig.eye_center, rig.eye_radius, strict=True)]

    def edges(vertices: np.ndarray) -> tuple[Mesh, ...]:
        return lid_edge_meshes(rig, vertices, eyes, rows=2, into_m=EDGE_INTO_M)

    def positions(vertices: np.ndarray) -> np.ndarray:
        return np.concatenate([mesh.vertices for mesh in edges(vertices)])

    left, right = edges(shapes.neutral)
    rest = positions(shapes.neutral)
    triangles = triangles_of(np.concatenate([left.faces, right.faces + len(left.vertices)]))
    moved = np.stack([positions(shapes.neutral + one) - rest for one in shapes.moved])
    moved[np.linalg.norm(moved, axis=-1) < EDGE_STILL_M] = 0.0
    return Surface(
        mesh="Head",
        material=MATERIAL,
        positions=rest,
        normals=vertex_normals(rest, triangles),
        triangles=triangles,
        colours=np.tile([*COLOURS[Part.EYE_CAVITY], 1.0], (len(rest), 1)),
        moved=moved,
        turned=np.zeros_like(moved),  # so narrow that nobody sees its shading turn
        bones=("Head", "Neck"),
        shares=np.tile([1.0, 0.0], (len(rest), 1)),
    )


def _made(shapes: FaceShapes, traits: MouthTraits) -> list[Surface]:
    """Teeth, gums and tongue of `facegen.mouth`, thinned out, as the rig's shapes move them."""
    rig, still = shapes.rig, np.zeros(shapes.rig.components)

    def at(weights: np.ndarray, vertices: np.ndarray) -> list[np.ndarray]:
        meshes = mouth_meshes(rig, traits, identity=still, weights=weights, vertices=vertices)
        return [mesh.vertices for mesh in meshes[:3]]

    rest = at(np.zeros(len(BLENDSHAPES)), shapes.neutral)
    moved = []
    for index, name in enumerate(BLENDSHAPES):
        weights, vertices, before = np.zeros(len(BLENDSHAPES)), shapes.neutral, rest
        if name == "tongueOut":
            jaw = BLENDSHAPE_INDEX["jawOpen"]
            weights[jaw] = JAW_FOR_TONGUE
            vertices = vertices + JAW_FOR_TONGUE * shapes.moved[jaw]
            before = at(weights, vertices)
        weights[index] = 1.0
        after = at(weights, vertices + shapes.moved[index])
        moved.append([b - a for a, b in zip(before, after, strict=True)])
    meshes = mouth_meshes(
        rig, traits, identity=still, weights=np.zeros(len(BLENDSHAPES)), vertices=shapes.neutral
    )
    surfaces = []
    for number, (mesh, (kept, triangles)) in enumerate(zip(meshes[:3], _thinned(meshes), strict=True)):
        part = Part(int(mesh.part[0]))
        positions = rest[number][kept]
        colours = np.ones((len(kept), 4))
        colours[:, :3] = np.array(COLOURS[part]) * _light(shapes, positions)[:, None]
        surface = Surface(
            mesh="Head",
            material=MATERIAL,
            positions=positions,
            normals=vertex_normals(positions, triangles),
            triangles=triangles,
            colours=colours,
            moved=np.stack([one[number][kept] for one in moved]),
            bones=("Head", "Neck"),
            shares=np.tile([1.0, 0.0], (len(kept), 1)),
        )
        surfaces.append(replace(surface, turned=_turned(surface)))
    return surfaces


def _turned(surface: Surface) -> np.ndarray:
    at_rest = vertex_normals(surface.positions, surface.triangles)
    return vertex_normals(surface.positions + surface.moved, surface.triangles) - at_rest


def _light(shapes: FaceShapes, positions: np.ndarray) -> np.ndarray:
    """Share (n,) of the light that reaches places in the mouth through the lips."""
    seam = shapes.landmarks()[[62, 66]].mean(axis=0)
    deep = np.clip((seam[2] - positions[:, 2] - DEEP_M[0]) / (DEEP_M[1] - DEEP_M[0]), 0.0, 1.0)
    aside = np.clip((np.abs(positions[:, 0]) - 18e-3) / 16e-3, 0.0, 1.0)
    return (1.0 - 0.9 * deep) * (1.0 - 0.45 * aside)


def _thinned(meshes: tuple[Mesh, ...]) -> list[tuple[np.ndarray, np.ndarray]]:
    """Vertices (k,) that are kept of teeth, gums and tongue, and triangles (t, 3) over them."""
    return [_thin_teeth(meshes[0]), _thin_gums(meshes[1]), _thin_tongue(meshes[2])]


def _thin_teeth(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    rings = len(LEVELS) + len(CAP)
    crown = rings * AROUND + 1
    grid = np.array(TOOTH_RINGS)[:, None] * AROUND + np.array(TOOTH_COLUMNS)
    one, faces = (
        np.append(grid.ravel(), rings * AROUND),
        _grid(len(TOOTH_RINGS), len(TOOTH_COLUMNS), closed=True),
    )
    last = grid.size - len(TOOTH_COLUMNS) + np.arange(len(TOOTH_COLUMNS))
    fan = np.stack([last, np.full(len(last), grid.size), np.roll(last, -1)], axis=-1)
    faces = np.concatenate([faces[:, [0, 2, 1]], fan])
    crowns = len(mesh.vertices) // crown
    seen = [tooth for tooth in range(crowns) if tooth % TEETH not in (0, TEETH - 1)]
    kept = np.concatenate([tooth * crown + one for tooth in seen])
    triangles = np.concatenate([faces + row * len(one) for row in range(len(seen))])
    return kept, _facing(mesh, kept, triangles, len(one))


def _thin_gums(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    arch = len(mesh.vertices) // 2
    rows = GUM_ROWS[-1] + 1
    columns = arch // rows
    some = np.unique(np.append(np.arange(0, columns, 3), columns - 1))
    one = (np.array(GUM_ROWS)[:, None] * columns + some).ravel()
    faces = _grid(len(GUM_ROWS), len(some), closed=False)
    kept = np.concatenate([one, arch + one])
    return kept, _facing(mesh, kept, np.concatenate([faces, faces + len(one)]), len(one))


def _thin_tongue(mesh: Mesh) -> tuple[np.ndarray, np.ndarray]:
    around = AROUND_TONGUE
    rings = (len(mesh.vertices) - 1) // around
    some = np.unique(np.append(np.arange(0, rings, 2), [rings - 2, rings - 1]))
    one = (some[:, None] * around + np.arange(0, around, 2)).ravel()
    faces = _grid(len(some), around // 2, closed=True)
    last = len(one) - around // 2 + np.arange(around // 2)
    fan = np.stack([last, np.roll(last, -1), np.full(len(last), len(one))], axis=-1)
    kept = np.append(one, rings * around)
    return kept, _facing(mesh, kept, np.concatenate([faces, fan]), len(kept))


def _grid(rows: int, columns: int, *, closed: bool) -> np.ndarray:
    """Triangles of a grid of vertices, row by row; closed ones go round."""
    return halves(facing_back(ring_quads(rows, columns) if closed else grid_quads(rows, columns)))


def _facing(mesh: Mesh, kept: np.ndarray, triangles: np.ndarray, piece: int) -> np.ndarray:
    """The triangles turned, piece by piece, so that they face where the mesh does."""
    normals = vertex_normals(mesh.vertices, triangles_of(mesh.faces))[kept]
    corners = mesh.vertices[kept][triangles]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    agrees = (across * normals[triangles].sum(axis=1)).sum(axis=1)
    pieces = triangles[:, 0] // piece
    wrong = np.bincount(pieces, np.sign(agrees))[pieces] < 0
    return np.where(wrong[:, None], triangles[:, [0, 2, 1]], triangles)


def _joined(surfaces: list[Surface]) -> Surface:
    """Several surfaces of one material as one."""
    starts = np.cumsum([0] + [len(surface.positions) for surface in surfaces])
    pairs = list(zip(surfaces, starts, strict=False))
    return replace(
        surfaces[0],
        positions=np.concatenate([surface.positions for surface in surfaces]),
        normals=np.concatenate([surface.normals for surface in surfaces]),
        triangles=np.concatenate([surface.triangles + start for surface, start in pairs]),
        still_m=3e-4,
        upright=0.25,
        colours=np.concatenate([surface.colours for surface in surfaces]),
        moved=np.concatenate([surface.moved for surface in surfaces], axis=1),
        turned=np.concatenate([surface.turned for surface in surfaces], axis=1),
        shares=np.concatenate([surface.shares for surface in surfaces]),
    )
