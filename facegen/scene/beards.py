"""Draws beards and stubble as single strands that grow where a rig's map lets them."""

from dataclasses import dataclass

import numpy as np
import scipy

from facegen.conventions import Part
from facegen.rigs import Rig
from facegen.scene.beard_maps import BEARD_REGIONS, EDGE_M, BeardMap, beard_map, combed, margins
from facegen.scene.scene import Strands

BEARD_KINDS = ("stubble", "moustache", "goatee", "full")
ROOTS = 11000
"""Places on the whole map; a full beard grows from some 8,000 of them (these strands stand for the 30 to 90
hairs that men have on a square centimetre of cheek, lip and chin [1]_).

.. [1] G. Szabo, "The regional frequency and distribution of hair follicles in human skin", Adv. Biol. Skin 9, 1969.
"""
LENGTH_M = {
    "stubble": (0.3e-3, 2e-3),
    "moustache": (4e-3, 9e-3),
    "goatee": (4e-3, 14e-3),
    "full": (4e-3, 20e-3),
}
SHORT_M = 3e-3
"""Shorter beards are straight bristles, which neither clump nor bend."""
POINTS = {"short": 2, "long": 7}
"""Of a strand, from root to tip."""
ROOT_RADIUS_M, TIP_RADIUS_M = 0.06e-3, 0.02e-3
"""Beard hair is 0.1 to 0.15 mm thick, twice as thick as scalp hair."""
CLUMP = 7
"""Strands to a lock of a long beard."""
CLEAR_M = 0.2e-3
"""Strands stay this far from the skin past their roots."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Beard:
    """Where the n strands of one person's beard grow in one session.

    Attributes
    ----------
    kind, length_m
        One of `BEARD_KINDS`, and the length of its longest strands.
    triangle, weight
        (n, 3) vertices of the triangle each root lies in, and their weights.
    comb
        (n, 3) direction in the head frame; a strand takes its part along the skin.
    rise_rad, reach_m, thickness
        (n,) angle between root and skin, length, and thickness relative to `ROOT_RADIUS_M`.
    lock
        (n,) the strand towards which each bends; itself where it stands alone.
    curl
        Sideways swing of long strands, as a share of their length.
    """

    kind: str
    length_m: float
    triangle: np.ndarray
    weight: np.ndarray
    comb: np.ndarray
    rise_rad: np.ndarray
    reach_m: np.ndarray
    thickness: np.ndarray
    lock: np.ndarray
    curl: float


def draw_beard(person: np.random.Generator, session: np.random.Generator, rig: Rig) -> Beard:
    """A bearded person's beard in one session: their own kind, or three days of stubble.

    Parameters
    ----------
    person
        A stream of the person's: kind, outline, density, and each root.
    session
        A stream of the session's: how long the hair is.
    """
    own = BEARD_KINDS[int(person.choice(len(BEARD_KINDS), p=(0.4, 0.12, 0.18, 0.3)))]
    kind, share = ("stubble" if session.random() < 0.2 else own), session.random()
    low, high = LENGTH_M[kind]
    length = low * (high / low) ** share  # short ones are the most frequent
    map_ = beard_map(rig)
    # the same draws for every kind, so that a person's roots stay where they are
    triangle, weight = _draw_roots(person, map_)
    root = (weight[..., None] * rig.vertices[triangle]).sum(axis=1)
    outline, density, curl = person.normal(0.0, 2e-3), person.uniform(0.65, 1.0), person.uniform(0.0, 0.09)
    fringe, chance, age = person.normal(0.0, EDGE_M, ROOTS), person.random(ROOTS), person.random(ROOTS)
    turn, rise = person.normal(0.0, 0.2, (ROOTS, 3)), person.normal(0.0, 0.12, ROOTS)
    thickness = person.uniform(0.7, 1.25, ROOTS)

    inside, below_lip = margins(map_.landmarks, root)
    margin = np.maximum.reduce([inside[name] for name in BEARD_REGIONS[kind]])
    grows = (margin + outline + fringe > 0.0) & (chance < density) & (inside["anything"] > 0.0)
    reach = length * (0.6 + 0.4 * age)
    # cut above the lip; what hangs from elsewhere has nothing to enter
    reach = np.minimum(
        reach, np.where(inside["moustache"] > -2.0 * EDGE_M, np.maximum(below_lip, 1e-3), np.inf)
    )
    comb = combed(map_.landmarks, root) + turn
    lock = np.arange(grows.sum())
    if length >= SHORT_M and len(lock) > CLUMP:
        leaders = lock[::CLUMP]
        lock = leaders[scipy.spatial.cKDTree(root[grows][leaders]).query(root[grows])[1]]
    return Beard(
        kind=kind,
        length_m=float(length),
        triangle=triangle[grows],
        weight=weight[grows],
        comb=comb[grows],
        rise_rad=np.clip(np.radians(30.0) + rise, 0.2, 1.0)[grows],
        reach_m=reach[grows],
        thickness=thickness[grows],
        lock=lock,
        curl=float(curl),
    )


def _draw_roots(rng: np.random.Generator, map_: BeardMap) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (n, 3) and weights (n, 3) of `ROOTS` places, spread evenly over the map."""
    edges = np.cumsum(map_.share)
    index = np.searchsorted(edges, rng.random(ROOTS) * edges[-1], side="right")
    a, b = rng.random((2, ROOTS))
    a, b = np.where(a + b > 1.0, 1.0 - a, a), np.where(a + b > 1.0, 1.0 - b, b)
    return map_.triangles[np.minimum(index, len(edges) - 1)], np.stack([1.0 - a - b, a, b], axis=-1)


def beard_strands(beard: Beard, rig: Rig, vertices: np.ndarray) -> Strands:
    """A person's beard on an evaluated head (V, 3), head frame, metres."""
    corners = vertices[beard.triangle]
    root = (beard.weight[..., None] * corners).sum(axis=1)
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    along = beard.comb - (beard.comb * normal).sum(axis=-1, keepdims=True) * normal
    along /= np.linalg.norm(along, axis=-1, keepdims=True)
    long = beard.length_m >= SHORT_M
    t = np.linspace(0.0, 1.0, POINTS["long" if long else "short"])
    rise = beard.rise_rad[:, None] * (1.0 - 0.6 * t if long else np.ones_like(t))
    heading = np.cos(rise)[..., None] * along[:, None] + np.sin(rise)[..., None] * normal[:, None]
    if long:  # hair falls, the longer the more
        heading[..., 1] -= (beard.length_m / 20e-3) * t * 0.9
        heading /= np.linalg.norm(heading, axis=-1, keepdims=True)
    steps = heading[:, :-1] * (beard.reach_m[:, None] / (len(t) - 1))[..., None]
    centres = root[:, None] + np.concatenate([np.zeros_like(steps[:, :1]), np.cumsum(steps, axis=1)], axis=1)
    if long:
        aside = np.cross(along, normal)
        swing = np.sin(2.0 * np.pi * (1.3 * t + beard.thickness[:, None] * 7.0)) * t * beard.curl
        centres += (swing * beard.reach_m[:, None])[..., None] * aside[:, None]
        together = 0.4 * t[:, None] ** 1.5
        centres = centres * (1.0 - together) + together * centres[beard.lock]
        centres[:, 1:] = _outside(centres[:, 1:], beard_map(rig).skin, vertices)
    taper = ROOT_RADIUS_M + (TIP_RADIUS_M - ROOT_RADIUS_M) * (t**2 if long else 0.3 * t)
    return Strands(
        name="beard",
        points=centres,
        radius_m=beard.thickness[:, None] * taper,
        part=Part.HAIR,
        material="hair",
    )


def _outside(points: np.ndarray, triangles: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Points (n, k, 3), moved along the normal of the nearest vertex to where they clear the skin."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    skin, corners = vertices[used], renumbered.reshape(triangles.shape)
    a, b, c = (skin[corners[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    normal = np.stack(
        [sum(np.bincount(corners[:, i], across[:, axis], len(used)) for i in range(3)) for axis in range(3)],
        axis=-1,
    )
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    nearest = scipy.spatial.cKDTree(skin).query(points.reshape(-1, 3))[1].reshape(points.shape[:2])
    above = ((points - skin[nearest]) * normal[nearest]).sum(axis=-1)
    return points + np.maximum(CLEAR_M - above, 0.0)[..., None] * normal[nearest]
