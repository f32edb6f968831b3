"""Builds a rig without identities from a user's glTF head with ARKit morph targets and a file that marks it up."""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from facegen.conventions import (
    BLENDSHAPES,
    CHIN,
    LANDMARK_COUNT,
    LANDMARK_GROUPS,
    LEFT_JAW_END,
    NOSE_ROOT,
    NOSE_TIP,
    RIGHT_JAW_END,
    Part,
)
from facegen.errors import InputError
from facegen.formats.gltf import read_gltf
from facegen.rigs.gltf_mesh import HeadMesh, contents, eyeballs, join_parts
from facegen.rigs.human_eyes import with_human_eyes
from facegen.rigs.lids import COLUMN_SPACING_M, LEAST_COLUMNS, columns
from facegen.rigs.marking import lid_neighbourhood, lip_faces, paint_brows, shortest_path
from facegen.rigs.markup import HeadMarkup, Margins, read_markup
from facegen.rigs.rig import Rig

EYE_DISTANCE_M = (0.045, 0.085)
"""Eyes lie so far apart on heads in metres: people's 52 to 78 mm, and a little more either way for avatars."""
EYE_RADIUS_M = (0.0105, 0.030)
"""Radii of eyeballs: people's 12 mm, avatars' up to twice that; a human cornea has to fit."""
LIP_DEPTH_M = 0.012
"""The mesh that lies further behind the inner lip's landmarks lines the mouth, it is no lip."""
NEAR_M = 0.010
"""A landmark given as a position lies no further from its vertex."""
_MARGINS = (((42, 43, 44, 45), (42, 47, 46, 45)), ((39, 38, 37, 36), (39, 40, 41, 36)))
"""Landmarks along the upper and lower margin, inner to outer canthus, of the left and the right eye."""


@dataclass(frozen=True, kw_only=True, eq=False)
class AddedHead:
    """A ``rig``, and the names of what its file holds besides (``left_out``)."""

    rig: Rig
    left_out: tuple[str, ...]


def build_head(path: Path, markup_path: Path | None, *, name: str) -> AddedHead:
    """Build rig ``name`` from the glTF file at ``path`` and what `HeadMarkup` says about it.

    Without a markup it is refused, and the refusal says what the file holds.

    Raises
    ------
    InputError
        One of the files is not what it should be; says what was found and what to do.
    """
    parts = read_gltf(path)
    if markup_path is None:
        raise InputError(
            f"{path} holds {contents(parts)}; say what is what in a JSON file given with --landmarks "
            "(docs/adding-a-rig.md)"
        )
    markup = read_markup(markup_path)
    try:
        mesh = join_parts(markup, parts)
        center, radius = eyeballs(markup.eyes, parts)
        origin, scale = center.mean(axis=0), markup.metres_per_unit
        center, radius = scale * (center - origin), scale * radius
        _check_eyes(center, radius)
        vertices, expression = scale * (mesh.vertices - origin), scale * mesh.expression
        landmarks, weights = _landmarks(markup, mesh)
        point = landmarks[np.arange(LANDMARK_COUNT), weights.argmax(axis=1)]
        _check_face(vertices[point])
        mesh = _seen_from_outside(mesh, vertices, point)
        part, (upper, lower) = _parts(mesh, vertices, point), _margins(markup, mesh, vertices, point)
    except InputError as error:
        raise InputError(f"{path} with {markup_path}: {error}") from error
    lids = lid_neighbourhood(vertices, expression, center, radius, margins=np.concatenate([upper, lower], 1))
    outer = np.isin(part, (Part.SKIN, Part.LIPS, Part.BROWS))
    # outer skin first; every landmark and margin touches a face of it
    cage = _used(mesh.faces[outer])
    order = np.concatenate([cage, np.setdiff1d(_used(mesh.faces), cage)])
    row = np.full(len(vertices) + 1, -1)  # the last entry serves the padding
    row[order] = np.arange(len(order))
    rig = Rig(
        name=name,
        vertices=vertices[order],
        faces=row[mesh.faces].astype(np.int32),
        cage_faces=row[mesh.faces[outer]].astype(np.int32),
        cage_vertices=len(cage),
        uv=mesh.uv,
        part=part,
        identity=np.zeros((0, len(order), 3)),
        identity_from_traits=np.zeros((0, 0)),
        identity_residual=np.zeros((0, 0)),
        traits=(),
        expression=expression[:, order],
        landmark_vertices=row[landmarks],
        landmark_weights=weights,
        eye_center=center,
        eye_center_identity=np.zeros((0, 2, 3)),
        eye_radius=radius,
        eye_radius_identity=np.zeros((0, 2)),
        upper_lid=row[upper],
        lower_lid=row[lower],
        lid_vertices=row[lids],
        licence=markup.licence,
        source=markup.source,
        version=f"{path.name}, SHA-256 {hashlib.sha256(path.read_bytes()).hexdigest()[:16]}",
        missing=tuple(s for s, moved in zip(BLENDSHAPES, expression, strict=True) if not moved.any()),
    )
    return AddedHead(rig=with_human_eyes(rig), left_out=mesh.left_out)


def _used(faces: np.ndarray) -> np.ndarray:
    return np.unique(faces[faces >= 0])


def _check_eyes(center: np.ndarray, radius: np.ndarray) -> None:
    apart = center[0, 0] - center[1, 0]
    least, most = EYE_DISTANCE_M
    if apart < 0.0:
        raise InputError(
            "the left eye lies at smaller x than the right one; left is the subject's, at x > 0, of a head that looks "
            "along +z: turn one that looks along -z, as those of VRM 0.x do, by 180 degrees about y"
        )
    if not least < apart < most:
        raise InputError(
            f"the eyes are {1e3 * apart:.3g} mm apart, heads have {1e3 * least:.0f} to {1e3 * most:.0f}; glTF "
            "counts in metres, for another unit set metres_per_unit"
        )
    if not (EYE_RADIUS_M[0] < radius.min() and radius.max() < EYE_RADIUS_M[1]):
        raise InputError(
            f"the eyeballs' radii are {1e3 * radius[0]:.3g} and {1e3 * radius[1]:.3g} mm, "
            f"{1e3 * EYE_RADIUS_M[0]:g} to {1e3 * EYE_RADIUS_M[1]:.0f} are allowed"
        )


def _check_face(points: np.ndarray) -> None:
    """Refuse landmarks (68, 3) in another order than iBUG's, or on a head that looks elsewhere."""
    _, first, index = np.unique(points, axis=0, return_index=True, return_inverse=True)
    for later, earlier in enumerate(first[index.ravel()]):
        if earlier != later:
            raise InputError(f"landmarks.{earlier} and landmarks.{later} are the same vertex; all 68 differ")
    if points[NOSE_TIP, 2] < max(points[RIGHT_JAW_END, 2], points[LEFT_JAW_END, 2]):
        raise InputError(
            "the tip of the nose (landmark 30) lies behind the jaw's ends; glTF heads look along +z"
        )
    if points[CHIN, 1] > points[NOSE_ROOT, 1]:
        raise InputError("the chin (landmark 8) lies above the nose's root (27); y is up")
    if points[RIGHT_JAW_END, 0] > points[LEFT_JAW_END, 0]:
        raise InputError(
            "landmark 0 is the subject's right end of the jaw, at x < 0; it lies left of landmark 16"
        )


def _seen_from_outside(mesh: HeadMesh, vertices: np.ndarray, point: np.ndarray) -> HeadMesh:
    """The mesh, with all faces turned round where the skin at brows and nose looks into the head."""
    before = point[
        [i for group in ("right_brow", "left_brow", "nose_bridge") for i in LANDMARK_GROUPS[group]]
    ]
    skin = mesh.faces[mesh.part == Part.SKIN, :3]
    a, b, c = np.moveaxis(vertices[skin[np.isin(skin, before).any(axis=1)]], 1, 0)
    if np.cross(b - a, c - a)[:, 2].sum() >= 0.0:
        return mesh
    return replace(mesh, faces=mesh.faces[:, [0, 2, 1, 3]], uv=mesh.uv[:, [0, 2, 1, 3]])


def _landmarks(markup: HeadMarkup, mesh: HeadMesh) -> tuple[np.ndarray, np.ndarray]:
    """(68, n) rows of ``mesh`` and their weights; shorter points repeat their first vertex with weight 0."""
    skin = _used(mesh.faces[mesh.part == Part.SKIN])
    points = []
    for index, point in enumerate(markup.landmarks):
        where = f"landmarks.{index}"
        if isinstance(point, int):
            point = [(point, 1.0)]
        elif isinstance(point, tuple):
            offset = np.linalg.norm(mesh.vertices[skin] - point, axis=1)
            nearest = offset.argmin()
            if offset[nearest] * markup.metres_per_unit > NEAR_M:
                raise InputError(
                    f"{where} lies {1e3 * offset[nearest] * markup.metres_per_unit:.0f} mm from the face, up to "
                    f"{1e3 * NEAR_M:.0f} are allowed; positions are in the file's frame, with y up"
                )
            points.append(([skin[nearest]], [1.0]))
            continue
        rows = _rows([vertex for vertex, _ in point], mesh, skin, where)
        weights = np.array([weight for _, weight in point])
        if not weights.sum() > 0.0:
            raise InputError(f"{where} has weights that add up to {weights.sum():g}; they add up to 1")
        points.append((rows, weights / weights.sum()))
    width = max(len(rows) for rows, _ in points)
    index = np.array([[*rows, *[rows[0]] * (width - len(rows))] for rows, _ in points])
    return index, np.array([np.pad(weights, (0, width - len(weights))) for _, weights in points])


def _rows(vertices: list[int], mesh: HeadMesh, skin: np.ndarray, where: str) -> np.ndarray:
    if max(vertices) >= len(mesh.row_of):
        raise InputError(f"{where} names vertex {max(vertices)}; the face's mesh has {len(mesh.row_of)}")
    rows = mesh.row_of[vertices]
    if not np.isin(rows, skin).all():
        raise InputError(f"{where} names a vertex that is not on the skin, but on an eye or one of the parts")
    return rows


def _parts(mesh: HeadMesh, vertices: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Part (F,) of each face, with lips, brows and the lining of the mouth told from the skin."""
    part = mesh.part.copy()
    lips = lip_faces(mesh.faces, part == Part.SKIN, vertices, point)
    middle = vertices[np.where(mesh.faces >= 0, mesh.faces, mesh.faces[:, :1])].mean(axis=1)
    inner = vertices[point[list(LANDMARK_GROUPS["inner_lip"])], 2].min()
    part[lips] = np.where(middle[lips, 2] > inner - LIP_DEPTH_M, Part.LIPS, Part.MOUTH_CAVITY)
    paint_brows(part, vertices, mesh.faces, point)
    return part


def _margins(
    markup: HeadMarkup, mesh: HeadMesh, vertices: np.ndarray, point: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Upper (2, U) and lower (2, L) lid margins; the shorter of a pair repeats its outer canthus."""
    skin = mesh.faces[mesh.part == Part.SKIN]
    upper, lower = [], []
    for side, (above, below) in zip(("left", "right"), _MARGINS, strict=True):
        if markup.lids is not None:
            given: Margins = getattr(markup.lids, side)
            upper.append(_rows(given.upper, mesh, _used(skin), f"lids.{side}.upper"))
            lower.append(_rows(given.lower, mesh, _used(skin), f"lids.{side}.lower"))
            _check_margins(vertices, side, upper[-1], lower[-1])
            continue
        try:
            upper.append(shortest_path(skin, vertices, point[list(above)]))
            lower.append(shortest_path(skin, vertices, point[list(below)]))
        except ValueError:
            raise InputError(
                f"the landmarks of the {side} eye lie on pieces of the mesh that do not hang together; give lids"
            ) from None
        _check_margins(vertices, side, upper[-1], lower[-1])
    return tuple(
        np.array([[*ring, *[ring[-1]] * (max(map(len, rings)) - len(ring))] for ring in rings])
        for rings in (upper, lower)
    )


def _check_margins(vertices: np.ndarray, side: str, upper: Sequence[int], lower: Sequence[int]) -> None:
    """Refuse margins of one eye that its lids cannot close along; ``vertices`` (V, 3) are in metres."""
    x = vertices[:, 0] if side == "left" else -vertices[:, 0]
    for name, margin in (("upper", upper), ("lower", lower)):
        first, last = x[margin[0]], x[margin[-1]]
        if not first < last:
            raise InputError(
                f"the {name} lid margin of the {side} eye goes from {1e3 * first:.1f} to {1e3 * last:.1f} mm beside "
                f"the middle of the face, but from the inner to the outer corner is outwards; turn lids.{side}.{name} "
                "round, or see whether left (the subject's) and right are swapped"
            )
    count = len(columns(upper, x))
    if count < LEAST_COLUMNS:
        raise InputError(
            f"the upper lid margin of the {side} eye has only {count} vertices away from its corners that lie "
            f"{1e3 * COLUMN_SPACING_M:g} mm apart, at least {LEAST_COLUMNS} are needed; give more of them in "
            f"lids.{side}.upper, or a finer mesh"
        )
