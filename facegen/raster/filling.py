"""The loop behind `facegen.raster.z_buffer`: triangles are filled pixel by pixel, each in its own box."""

import numpy as np

from facegen.compilation import compiled


@compiled
def fill(
    first: np.ndarray,
    size: np.ndarray,
    across: np.ndarray,
    down: np.ndarray,
    area: np.ndarray,
    values: np.ndarray,
    best: np.ndarray,
    hit: np.ndarray,
) -> None:
    """Write the largest value at every pixel, and the last triangle that has it.

    Operations are those of the NumPy path, in its order: both give the same bytes.

    Parameters
    ----------
    first, size
        (T, 2) first column and row of each triangle's box, and how many columns and rows it has.
    across, down
        (3, T) columns and rows of the corners.
    area
        (T,) twice the triangles' area, signed; NaN of those seen edge on.
    values
        (T, 3) what is compared, at the corners.
    best, hit
        (h, w) the result; -inf and -1 before.
    """
    for k in range(len(area)):
        base = values[k, 0]
        to_b, to_c = values[k, 1] - base, values[k, 2] - base
        for row in range(first[k, 1], first[k, 1] + size[k, 1]):
            ay, by, cy = down[0, k] - row, down[1, k] - row, down[2, k] - row
            for column in range(first[k, 0], first[k, 0] + size[k, 0]):
                ax, bx, cx = across[0, k] - column, across[1, k] - column, across[2, k] - column
                wa, wb = (bx * cy - by * cx) / area[k], (cx * ay - cy * ax) / area[k]
                wc = 1.0 - wa - wb
                if wa >= 0.0 and wb >= 0.0 and wc >= 0.0:
                    here = base + wb * to_b + wc * to_c
                    if here >= best[row, column]:
                        best[row, column], hit[row, column] = here, k
