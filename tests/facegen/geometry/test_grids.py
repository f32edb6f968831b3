"""Quads of grids cover every cell once, and their halves face the same way."""

import numpy as np

from facegen.geometry.grids import facing_back, grid_quads, halves, ring_quads


def test_an_open_grid_has_a_quad_for_each_cell():
    quads = grid_quads(3, 4)
    assert quads[0].tolist() == [0, 4, 5, 1]
    assert quads[-1].tolist() == [6, 10, 11, 7]
    assert len(np.unique(quads, axis=0)) == 6


def test_rings_close():
    quads = ring_quads(2, 4)
    assert quads[-1].tolist() == [3, 7, 4, 0]
    assert np.unique(quads, return_counts=True)[1].tolist() == [2] * 8


def test_halves_of_quads_face_as_they_do():
    place = np.array([(x, y) for y in range(3) for x in range(4)], float)

    def turns(corners):
        a, b = (place[corners[:, k]] - place[corners[:, 0]] for k in (1, 2))
        return np.sign(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])

    quads = grid_quads(3, 4)
    assert (turns(halves(quads)) == turns(quads)[0]).all()
    assert (turns(halves(facing_back(quads))) == -turns(quads)[0]).all()
