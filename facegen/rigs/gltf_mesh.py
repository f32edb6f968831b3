"""One mesh out of a glTF head's primitives: joined at seams, with ARKit blendshapes and parts."""

import re
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPES, Part
from facegen.errors import InputError
from facegen.formats.gltf import GltfPart
from facegen.rigs.identity import fit_sphere
from facegen.rigs.markup import Ball, EyeMarks, HeadMarkup

BALL_RESIDUAL = 0.12
"""An eyeball's vertices lie this near its fitted sphere, root mean square, as a share of its radius."""


@dataclass(frozen=True, kw_only=True, eq=False)
class HeadMesh:
    """A joined mesh in the file's frame and unit.

    Attributes
    ----------
    vertices
        (V, 3).
    expression
        (52, V, 3) displacements, zero where the file has no such shape.
    faces, uv, part
        (F, 4) triangles padded with -1, (F, 4, 2), (F,): as in `facegen.rigs.Rig`. The face's mesh is skin, as
        far as the markup calls none of its materials anything else.
    row_of
        (H,) row of each vertex of the face's mesh as the file counts them; -1 for those of eyeballs.
    left_out
        Names of what the file holds besides.
    """

    vertices: np.ndarray
    expression: np.ndarray
    faces: np.ndarray
    uv: np.ndarray
    part: np.ndarray
    row_of: np.ndarray
    left_out: tuple[str, ...]


def join_parts(markup: HeadMarkup, parts: tuple[GltfPart, ...]) -> HeadMesh:
    """Join the primitives that belong to the head.

    What glTF splits becomes one again: vertices at one place that every blendshape moves alike.

    Raises
    ------
    InputError
        A name in the markup is not in the file, or the file has no ARKit blendshape.
    """
    eyes = [name for name in (markup.eyes.left, markup.eyes.right) if isinstance(name, str)]
    called = {Part[kind.upper()]: names for kind, names in markup.parts.items()}
    for name in [*([markup.head] if markup.head else []), *eyes, *(n for ns in called.values() for n in ns)]:
        if not any(_is(part, name) for part in parts):
            raise InputError(f"nothing is called {name!r}; the file holds {contents(parts)}")
    head = markup.head if markup.head is not None else _most_expressive(parts)

    kept, kinds, rows, left_out = [], [], [], []
    count = 0
    for part in parts:
        in_head, eye = _is(part, head), any(_is(part, name) for name in eyes)
        kind = next((k for k, names in called.items() if any(_is(part, name) for name in names)), None)
        kind = Part.SKIN if kind is None and in_head else kind
        if eye or kind is None:
            rows += [np.full(len(part.positions), -1)] * in_head
            left_out += [part.node or part.mesh or part.material] * (not eye)
            continue
        rows += [np.arange(count, count + len(part.positions))] * in_head
        count += len(part.positions)
        kept.append(part)
        kinds.append(kind)

    positions = np.concatenate([part.positions for part in kept])
    expression = np.concatenate([_expression(part) for part in kept], axis=1)
    if not expression.any():
        raise InputError("no morph target has an ARKit name, such as jawOpen (mesh.extras.targetNames)")
    first, joined = _welded(positions, expression)
    starts = np.cumsum([0] + [len(part.positions) for part in kept])
    corners = [part.triangles + start for part, start in zip(kept, starts, strict=False)]
    uv = np.concatenate([part.uv[part.triangles] for part in kept])
    faces = joined[np.concatenate(corners)]
    real = (faces != np.roll(faces, 1, axis=1)).all(axis=1)  # seams pinched to a line are no triangles
    faces, uv = faces[real], uv[real]
    of_head = np.concatenate(rows)
    return HeadMesh(
        vertices=positions[first],
        expression=expression[:, first],
        faces=np.pad(faces, ((0, 0), (0, 1)), constant_values=-1),
        uv=_in_one_tile(uv[:, [0, 1, 2, 0]]),
        part=np.repeat(kinds, [len(part.triangles) for part in kept])[real].astype(np.uint8),
        row_of=np.where(of_head >= 0, joined[of_head], -1),
        left_out=tuple(dict.fromkeys(left_out)),
    )


def eyeballs(eyes: EyeMarks, parts: tuple[GltfPart, ...]) -> tuple[np.ndarray, np.ndarray]:
    """Centres (2, 3) and radii (2,), the subject's left first, in the file's frame and unit.

    Raises
    ------
    InputError
        What a name stands for is no ball.
    """
    centers, radii = [], []
    for side, eye in enumerate((eyes.left, eyes.right)):
        if isinstance(eye, Ball):
            center, radius = np.array(eye.center), eye.radius
        else:
            # primitives of one mesh may share their vertices, the face's among them
            points = np.concatenate(
                [part.positions[np.unique(part.triangles)] for part in parts if _is(part, eye)]
            )
            if eyes.left == eyes.right:
                x = points[:, 0]
                points = points[(x > 0.5 * (x.min() + x.max())) == (side == 0)]
            if len(np.unique(points, axis=0)) < 10:
                raise InputError(f"{eye!r} has {len(points)} vertices; an eyeball is fitted to at least 10")
            try:
                center, radius = fit_sphere(points)
            except np.linalg.LinAlgError:  # a flat disc, of an iris
                center, radius = points[0], 0.0
            residual = np.sqrt(np.mean((np.linalg.norm(points - center, axis=1) - radius) ** 2))
            if not residual < BALL_RESIDUAL * radius:
                raise InputError(
                    f"{eye!r} is no ball; name what holds the eyeball alone, or give its center and radius"
                )
        centers.append(center)
        radii.append(float(radius))
    return np.array(centers), np.array(radii)


def blendshape_sources(names: Iterable[str]) -> dict[str, tuple[str, ...]]:
    """Which of a file's morph targets make each ARKit blendshape that it has.

    Case, separators and a prefix before a dot do not count; sides may be spelt ``Left`` and ``Right`` or ``L``
    and ``R``. Two halves of a shape that ARKit has as one, such as ``browInnerUp_L`` and ``_R``, make it together.
    """
    known = {re.sub("[^a-z0-9]", "", name.rsplit(".", 1)[-1].casefold()): name for name in names}
    targets = {}
    for shape in BLENDSHAPES:
        name = shape.casefold()
        short = re.sub("(l)eft$|(r)ight$", r"\1\2", name)
        halves = [[name + end for end in ends] for ends in (("left", "right"), ("l", "r"))]
        for spelling in ([name], [short], *halves):
            if all(part in known for part in spelling):
                targets[shape] = tuple(known[part] for part in spelling)
                break
    return targets


def contents(parts: tuple[GltfPart, ...]) -> str:
    """What the markup can name, and how many ARKit blendshapes each has."""
    held = []
    for part in parts:
        shapes = len(blendshape_sources(part.morphs))
        with_shapes = f" with {shapes} ARKit shapes" * bool(shapes)
        held.append(f"mesh {part.mesh!r}, node {part.node!r}, material {part.material!r}{with_shapes}")
    return "; ".join(dict.fromkeys(held)) or "no meshes"


def _is(part: GltfPart, name: str) -> bool:
    return name.casefold() in (part.mesh.casefold(), part.node.casefold(), part.material.casefold())


def _most_expressive(parts: tuple[GltfPart, ...]) -> str:
    if not parts:
        raise InputError("the file holds no meshes")
    best = max(parts, key=lambda part: len(blendshape_sources(part.morphs)))
    name = best.mesh or best.node
    if not name:
        raise InputError("the face's mesh has no name; give it one and name it under head")
    return name


def _expression(part: GltfPart) -> np.ndarray:
    expression = np.zeros((len(BLENDSHAPES), *part.positions.shape))
    for shape, sources in blendshape_sources(part.morphs).items():
        expression[BLENDSHAPES.index(shape)] = sum(part.morphs[source] for source in sources)
    return expression


def _welded(positions: np.ndarray, expression: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """First of the vertices that are one, in the file's order, and the new row of each."""
    columns = np.concatenate([positions[None], expression]).transpose(1, 0, 2).reshape(len(positions), -1)
    keys = np.ascontiguousarray(columns.astype(np.float32) + 0.0)  # -0.0 becomes 0.0
    rows = keys.view(np.dtype((np.void, keys.strides[0]))).ravel()
    _, first, inverse = np.unique(rows, return_index=True, return_inverse=True)
    order = np.argsort(first)
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return first[order], rank[inverse.ravel()]


def _in_one_tile(uv: np.ndarray) -> np.ndarray:
    """Texture coordinates (f, 4, 2) moved by whole tiles to [0, 1]: textures repeat."""
    tile = np.floor(uv.mean(axis=1, keepdims=True))
    return np.clip(uv - tile, 0.0, 1.0)
