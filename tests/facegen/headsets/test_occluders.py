"""Occluders: closed solids with outward faces, that say what lies in them; wrong ones are refused by key."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from facegen.errors import InputError
from facegen.headsets import HeadsetOccluder
from facegen.raster import triangles_of
from tests.facegen.headsets.test_headset_files import SMALL, parse

lengths = st.floats(1.0, 90.0)
vectors = st.tuples(*[st.floats(-80.0, 80.0)] * 3)


@st.composite
def occluders(draw):
    shape = draw(st.sampled_from(["ring", "cylinder", "box"]))
    place = {"name": "o", "shape": shape, "position_mm": draw(vectors), "turn_deg": draw(vectors)}
    if shape == "box":
        return HeadsetOccluder(**place, size_mm=(draw(lengths), draw(lengths), draw(lengths)))
    place |= {"radii_mm": (draw(lengths), draw(lengths)), "depth_mm": draw(lengths)}
    if shape == "ring":
        place["rim_mm"] = draw(st.floats(0.1, 0.9)) * min(place["radii_mm"])
    return HeadsetOccluder(**place)


def volume_mm3(occluder: HeadsetOccluder) -> float:
    if occluder.shape == "box":
        return float(np.prod(occluder.size_mm))
    a, b = occluder.radii_mm
    hole = (a - occluder.rim_mm) * (b - occluder.rim_mm) if occluder.shape == "ring" else 0.0
    return np.pi * (a * b - hole) * occluder.depth_mm


@given(occluder=occluders())
@settings(max_examples=20, deadline=None)
def test_faces_enclose_the_solids_volume_and_look_outwards(occluder):
    vertices, faces = occluder.mesh()
    a, b, c = np.moveaxis(vertices[triangles_of(faces)] * 1e3 - occluder.position_mm, 1, 0)
    # the divergence theorem: inward faces would count negative
    enclosed = np.einsum("ni,ni->", a, np.cross(b, c)) / 6.0
    assert enclosed == pytest.approx(volume_mm3(occluder), rel=2e-3)


@given(occluder=occluders(), unit=st.tuples(*[st.floats(-1.0, 1.0)] * 3))
@settings(max_examples=25, deadline=None)
def test_contains_agrees_with_the_winding_number_of_the_mesh(occluder, unit):
    vertices, faces = occluder.mesh()
    point = np.multiply(occluder.position_mm, 1e-3) + np.multiply(unit, np.ptp(vertices, axis=0) / 2)
    a, b, c = np.moveaxis(vertices[triangles_of(faces)] - point, 1, 0)
    la, lb, lc = (np.linalg.norm(corner, axis=-1) for corner in (a, b, c))
    if min(la.min(), lb.min(), lc.min()) < 1e-4:
        return  # on a corner
    # solid angles of van Oosterom and Strackee add up to 4 pi inside and to 0 outside
    above = np.einsum("ni,ni->n", a, np.cross(b, c))
    below = la * lb * lc + (a * b).sum(-1) * lc + (b * c).sum(-1) * la + (c * a).sum(-1) * lb
    turns = np.arctan2(above, below).sum() / (2 * np.pi)
    if abs(turns - round(turns)) < 1e-6 and not _near_round_wall(occluder, point):
        assert occluder.contains(point) == (round(turns) == 1)


def _near_round_wall(occluder: HeadsetOccluder, point: np.ndarray) -> bool:
    """Within the sagitta of a wall's flat segments, or of a cylinder's closed hole."""
    if occluder.shape == "box":
        return False
    x, y, _ = (point * 1e3 - occluder.position_mm) @ occluder._turn
    a, b = occluder.radii_mm
    rim = occluder.rim_mm if occluder.shape == "ring" else 0.0
    far = [abs(np.hypot(x / max(p, 1e-3), y / max(q, 1e-3)) - 1.0) for p, q in ((a, b), (a - rim, b - rim))]
    return min(far) < 2e-3 or (occluder.shape == "cylinder" and np.hypot(x, y) < 1e-2)


RING = """
[[occluders]]
name = "rim"
shape = "ring"
position_mm = [32, 0, 50]
radii_mm = [30, 30]
rim_mm = 5
depth_mm = 6
"""


@pytest.mark.parametrize(
    ("was", "becomes", "says"),
    [
        ("rim_mm = 5", "", r"occluders\[0\]: a ring needs rim_mm; its keys are radii_mm, rim_mm, depth_mm"),
        ("rim_mm = 5", "rim_mm = 30", r"occluders\[0\]: rim_mm is 30, but must be below both radii_mm"),
        ('"ring"', '"box"', r"occluders\[0\]: a box has no radii_mm; its keys are size_mm"),
        (
            '"ring"',
            '"torus"',
            r"occluders\[0\]\.shape = \"torus\": must be 'ring', 'cylinder' or 'box'",
        ),
        ("depth_mm = 6", "depth_mm = -6", r"occluders\[0\]\.depth_mm = -6: must be greater than 0"),
        (
            "[32, 0, 50]",
            "[66, 10, 41]",
            r"leds\[0\]\.position_mm is \[40.0, 10.0, 40.0\], inside the occluder 'rim'",
        ),
        (
            "rim_mm = 5",
            "rim_mm = 5\ncolour = 1",
            r"unknown key 'occluders\[0\]\.colour'; .*Known keys here: name, shape",
        ),
    ],
)
def test_occluders_that_cannot_be_are_refused_with_their_key(was, becomes, says):
    assert was in RING
    parse(SMALL + RING)
    with pytest.raises(InputError, match=says):
        parse(SMALL + RING.replace(was, becomes))
