"""The loops behind `facegen.raster.occlusion`: where rays from a camera's centre first meet a mesh.

Rays are points of the plane z = 1. They are sorted into a grid over the box around them, with a border of cells for
what lies outside. A face of the mesh looks at the cells under its own box only, and most faces of a head find no ray
there.
"""

import numpy as np

from facegen.compilation import compiled

CELLS = 64
"""Cells along each side of the box around the rays. 32 and 128 cost about as much with the 68 landmarks of a face."""
SIDE = CELLS + 2
"""The same with the border."""


@compiled
def cast_rays(
    rays: np.ndarray,
    vertices: np.ndarray,
    transforms: np.ndarray,
    faces: np.ndarray,
    inverse_depth: np.ndarray,
) -> None:
    """Write 1/z of every ray's nearest hit, 0 where it meets nothing.

    Parameters
    ----------
    rays
        (n, p, 2) x/z and y/z of n bundles of rays; NaN for a ray that meets nothing.
    vertices
        (n, V, 3) of n meshes with the same faces.
    transforms
        (n, 4, 4) from the meshes' frame to the cameras'.
    faces
        (F, 4) uint32 quads, cut along their first diagonal; triangles repeat their last corner. Both sides count,
        triangles with a vertex at z <= 0 do not.
    inverse_depth
        (n, p) the result.
    """
    projected, cells = np.empty((vertices.shape[1], 3)), np.empty((vertices.shape[1], 2), np.uint32)
    order, where = np.empty(rays.shape[1], np.int64), np.empty((rays.shape[1], 2))
    begin, above = np.empty(SIDE * SIDE + 1, np.int32), np.zeros((SIDE + 1, SIDE + 1), np.int32)
    near = np.empty(len(faces), np.uint32)
    for mesh in range(len(rays)):
        inverse_depth[mesh] = 0.0
        box = _box(rays[mesh])
        _sort(rays[mesh], box, begin, order, where)
        _add_up(begin, above)
        _project(vertices[mesh], transforms[mesh], box, projected, cells)
        for k in range(_faces_near_rays(faces, cells, above, near)):
            a, b, c, d = faces[near[k], 0], faces[near[k], 1], faces[near[k], 2], faces[near[k], 3]
            left, right, top, bottom = _cells_under(cells, a, b, c, d)
            for row in range(top, bottom):
                for place in range(begin[row * SIDE + left], begin[row * SIDE + right]):
                    x, y = where[place, 0], where[place, 1]
                    found = max(
                        _inverse_depth_in(projected[a], projected[b], projected[c], x, y),
                        _inverse_depth_in(projected[a], projected[c], projected[d], x, y),
                    )
                    inverse_depth[mesh, order[place]] = max(inverse_depth[mesh, order[place]], found)


@compiled
def _cells_under(cells: np.ndarray, a: int, b: int, c: int, d: int) -> tuple[int, int, int, int]:
    """First column, last column + 1, first row and last row + 1 of the cells under four vertices."""
    return (
        min(min(cells[a, 0], cells[b, 0]), min(cells[c, 0], cells[d, 0])),
        max(max(cells[a, 0], cells[b, 0]), max(cells[c, 0], cells[d, 0])) + 1,
        min(min(cells[a, 1], cells[b, 1]), min(cells[c, 1], cells[d, 1])),
        max(max(cells[a, 1], cells[b, 1]), max(cells[c, 1], cells[d, 1])) + 1,
    )


@compiled
def _faces_near_rays(faces: np.ndarray, cells: np.ndarray, above: np.ndarray, near: np.ndarray) -> int:
    """Write which faces have rays in the cells under them, and return how many; without a branch that guesses wrong."""
    count = 0
    for face in range(len(faces)):
        left, right, top, bottom = _cells_under(
            cells, faces[face, 0], faces[face, 1], faces[face, 2], faces[face, 3]
        )
        near[count] = face
        count += above[bottom, right] - above[bottom, left] != above[top, right] - above[top, left]
    return count


@compiled
def _box(rays: np.ndarray) -> tuple[float, float, float, float]:
    """Least x and y of rays (p, 2), and cells per unit of x and y; NaN is left out."""
    low_x, low_y, high_x, high_y = np.inf, np.inf, -np.inf, -np.inf
    for ray in range(len(rays)):
        x, y = rays[ray, 0], rays[ray, 1]
        if x == x and y == y:
            low_x, low_y = min(low_x, x), min(low_y, y)
            high_x, high_y = max(high_x, x), max(high_y, y)
    if high_x < low_x:
        return 0.0, 0.0, 0.0, 0.0
    most = CELLS - 1e-6  # the outermost rays lie within the box, not on its border
    return low_x, low_y, most / max(high_x - low_x, 1e-12), most / max(high_y - low_y, 1e-12)


@compiled
def _sort(
    rays: np.ndarray,
    box: tuple[float, float, float, float],
    begin: np.ndarray,
    order: np.ndarray,
    where: np.ndarray,
) -> None:
    """Sort rays by cell, row by row, so that the rays of neighbouring cells of a row stand together.

    Cell k has the rays ``order[begin[k] : begin[k + 1]]``, which pass the grid at ``where``, in cells.
    """
    low_x, low_y, scale_x, scale_y = box
    cell = np.full(len(rays), -1)
    begin[:] = 0
    for ray in range(len(rays)):
        x, y = rays[ray, 0], rays[ray, 1]
        if x == x and y == y:
            cell[ray] = (int((y - low_y) * scale_y) + 1) * SIDE + int((x - low_x) * scale_x) + 1
            begin[cell[ray] + 1] += 1
    for k in range(SIDE * SIDE):
        begin[k + 1] += begin[k]
    free = begin.copy()
    for ray in range(len(rays)):
        if cell[ray] >= 0:
            place = free[cell[ray]]
            free[cell[ray]] += 1
            order[place] = ray
            where[place, 0], where[place, 1] = (
                (rays[ray, 0] - low_x) * scale_x,
                (rays[ray, 1] - low_y) * scale_y,
            )


@compiled
def _add_up(begin: np.ndarray, above: np.ndarray) -> None:
    """Write how many rays the cells above and left of each cell's corner have: four corners tell if a box is empty."""
    for row in range(SIDE):
        first = begin[row * SIDE]
        for column in range(SIDE + 1):
            above[row + 1, column] = above[row, column] + begin[row * SIDE + column] - first


@compiled
def _project(
    vertices: np.ndarray,
    transform: np.ndarray,
    box: tuple[float, float, float, float],
    projected: np.ndarray,
    cells: np.ndarray,
) -> None:
    """Write where vertices (V, 3) lie on the grid, in cells and whole cells, and 1/z, 0 behind the camera."""
    low_x, low_y, scale_x, scale_y = box
    xx, xy, xz, xt = transform[0]
    yx, yy, yz, yt = transform[1]
    zx, zy, zz, zt = transform[2]
    for k in range(len(vertices)):
        a, b, c = vertices[k, 0], vertices[k, 1], vertices[k, 2]
        z = zx * a + zy * b + zz * c + zt
        inverse = 1.0 / z if z > 0.0 else 0.0
        x = ((xx * a + xy * b + xz * c + xt) * inverse - low_x) * scale_x
        y = ((yx * a + yy * b + yz * c + yt) * inverse - low_y) * scale_y
        projected[k, 0], projected[k, 1], projected[k, 2] = x, y, inverse
        cells[k, 0] = np.uint32(min(max(x + 1.0, 0.0), CELLS + 1.0))
        cells[k, 1] = np.uint32(min(max(y + 1.0, 0.0), CELLS + 1.0))


@compiled
def _inverse_depth_in(a: np.ndarray, b: np.ndarray, c: np.ndarray, x: float, y: float) -> float:
    """1/z at a point of a triangle with corners (x, y, 1/z); 0 outside, edge-on, or with a corner behind the camera."""
    # each edge's term is the exact negative of its neighbour's, so that no ray slips through between two triangles
    at_a = (b[0] - x) * (c[1] - y) - (b[1] - y) * (c[0] - x)
    at_b = (c[0] - x) * (a[1] - y) - (c[1] - y) * (a[0] - x)
    at_c = (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x)
    inside = (at_a >= 0.0 and at_b >= 0.0 and at_c >= 0.0) or (at_a <= 0.0 and at_b <= 0.0 and at_c <= 0.0)
    area = at_a + at_b + at_c
    if not inside or area == 0.0 or min(a[2], b[2], c[2]) == 0.0:
        return 0.0
    return (at_a * a[2] + at_b * b[2] + at_c * c[2]) / area  # 1/z is linear over the image plane
