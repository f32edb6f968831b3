"""Beards and stubble: single strands from a map of moustache, chin, cheeks and neck that landmarks span on any rig."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.spatial import cKDTree

from facegen.conventions import MIRRORED_LANDMARKS, Part
from facegen.rigs import Rig
from facegen.scene.scene import Strands

KINDS = ("stubble", "moustache", "goatee", "full")
ROOTS = 11000
"""Places on the whole map; a full beard grows from some 8,000 of them (these strands stand for the 30 to 90
hairs that men have on a square centimetre of cheek, lip and chin [1]_).

.. [1] G. Szabo, "The regional frequency and distribution of hair follicles in human skin", Adv. Biol. Skin 9, 1969.
"""
DENSER = 2.0
"""Of lip and chin beside cheeks and neck [1]_."""
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
OFF_LIPS_M = 1.2e-3
"""Between the red of the lips and the nearest root."""
EDGE_M = 2.5e-3
"""Standard deviation by which single hairs stand outside a beard's outline, or are missing inside it."""
CLUMP = 7
"""Strands to a lock of a long beard."""
CLEAR_M = 0.2e-3
"""Strands stay this far from the skin past their roots."""
NEAR_M = 0.14
"""Of the middle of the jaw: what may bear a beard, and the cheeks and the neck about it."""
LINING_M = 7e-3
"""What lies this much further in than its neighbours is the lining of a mouth or a nose."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Beard:
    """Where the n strands of one person's beard grow in one session.

    Attributes
    ----------
    kind, length_m
        One of `KINDS`, and the length of its longest strands.
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


@dataclass(frozen=True, kw_only=True, eq=False)
class BeardMap:
    """Skin of a rig's mean face on which beards may grow.

    Attributes
    ----------
    triangles, share
        (t, 3) vertex numbers and (t,) how many of the roots each bears, up to a factor.
    skin
        Triangles (s, 3) of skin and lips round it that strands must not enter.
    landmarks
        (68, 3), made symmetric, metres.
    """

    triangles: np.ndarray
    share: np.ndarray
    skin: np.ndarray
    landmarks: np.ndarray


def draw_beard(person: np.random.Generator, session: np.random.Generator, rig: Rig) -> Beard:
    """A bearded person's beard in one session: their own kind, or three days of stubble.

    Parameters
    ----------
    person
        A stream of the person's: kind, outline, density, and each root.
    session
        A stream of the session's: how long the hair is.
    """
    own = KINDS[int(person.choice(len(KINDS), p=(0.4, 0.12, 0.18, 0.3)))]
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

    inside, below_lip = _margins(map_.landmarks, root)
    margin = np.maximum.reduce([inside[name] for name in _REGIONS[kind]])
    grows = (margin + outline + fringe > 0.0) & (chance < density) & (inside["anything"] > 0.0)
    reach = length * (0.6 + 0.4 * age)
    # cut above the lip; what hangs from elsewhere has nothing to enter
    reach = np.minimum(
        reach, np.where(inside["moustache"] > -2.0 * EDGE_M, np.maximum(below_lip, 1e-3), np.inf)
    )
    comb = _comb(map_.landmarks, root) + turn
    lock = np.arange(grows.sum())
    if length >= SHORT_M and len(lock) > CLUMP:
        leaders = lock[::CLUMP]
        lock = leaders[cKDTree(root[grows][leaders]).query(root[grows])[1]]
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


_REGIONS = {
    "stubble": ("moustache", "chin", "beside", "cheeks"),
    "moustache": ("moustache",),
    "goatee": ("moustache", "chin", "beside"),
    "full": ("moustache", "chin", "beside", "cheeks"),
}


def _draw_roots(rng: np.random.Generator, map_: BeardMap) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (n, 3) and weights (n, 3) of `ROOTS` places, spread evenly over the map."""
    edges = np.cumsum(map_.share)
    index = np.searchsorted(edges, rng.random(ROOTS) * edges[-1], side="right")
    a, b = rng.random((2, ROOTS))
    a, b = np.where(a + b > 1.0, 1.0 - a, a), np.where(a + b > 1.0, 1.0 - b, b)
    return map_.triangles[np.minimum(index, len(edges) - 1)], np.stack([1.0 - a - b, a, b], axis=-1)


@lru_cache(maxsize=4)
def beard_map(rig: Rig) -> BeardMap:
    """Where beards may grow on a rig: outer skin within 8 mm of the largest one's outline."""
    landmarks = (rig.landmark_weights[..., None] * rig.vertices[rig.landmark_vertices]).sum(axis=1)
    landmarks = 0.5 * (landmarks + landmarks[list(MIRRORED_LANDMARKS)] * (-1.0, 1.0, 1.0))
    triangles, part = _outer_triangles(rig, landmarks)
    corners = rig.vertices[triangles]
    inside, _ = _margins(landmarks, corners.mean(axis=1))
    margin = np.maximum.reduce([inside[name] for name in _REGIONS["full"]])
    near, around = (part == Part.SKIN) & (margin > -8e-3), margin > -25e-3
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    dense = np.maximum.reduce([inside[name] for name in _REGIONS["goatee"]]) > -EDGE_M
    share = np.linalg.norm(across, axis=-1) * np.where(dense, DENSER, 1.0)
    return BeardMap(triangles=triangles[near], share=share[near], skin=triangles[around], landmarks=landmarks)


def _outer_triangles(rig: Rig, landmarks: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Triangles (t, 3) of skin and lips that nothing covers, seen from inside the head, and their parts (t,).

    The lining of a mouth lies a centimetre inside the cheek; a user's own head may call it skin.
    """
    chosen = np.isin(rig.part, (Part.SKIN, Part.LIPS))
    quads, part = rig.faces[chosen], rig.part[chosen]
    whole = quads[:, 3] >= 0
    triangles = np.concatenate([quads[:, :3], quads[whole][:, [0, 2, 3]]])
    part = np.concatenate([part, part[whole]])
    inmost = np.array([0.0, landmarks[54, 1], 0.5 * (landmarks[54, 2] + landmarks[16, 2])])
    away = rig.vertices[triangles].mean(axis=1) - inmost
    reach = np.linalg.norm(away, axis=-1)
    near = reach < NEAR_M
    triangles, part, away, reach = triangles[near], part[near], away[near], reach[near]
    neighbours = cKDTree(away / reach[:, None]).query(away / reach[:, None], k=12)[1]
    outer = reach > reach[neighbours].max(axis=1) - LINING_M
    return triangles[outer], part[outer]


def _margins(landmarks: np.ndarray, places: np.ndarray) -> tuple[dict[str, np.ndarray], np.ndarray]:
    """How far places (n, 3) of the mean face lie inside each region, metres (n,), and above the upper lip.

    Regions are bounded by lines that the landmarks span, as barbers know them: a moustache between nose, lip and the
    folds beside them; chin and soul patch below the lower lip; cheeks below a line from ear to mouth; a neck line
    2 cm under the jaw.
    """
    aside, y, z = np.abs(places[:, 0]), places[:, 1], places[:, 2]
    corner, wing, ear, chin = (landmarks[i] for i in (54, 35, 16, 8))
    upper, lower = landmarks[[51, 52, 53, 54]], landmarks[[57, 56, 55, 54]]
    lip_top = np.interp(aside, upper[:, 0], upper[:, 1])
    lip_bottom = np.interp(aside, lower[:, 0], lower[:, 1])
    front = z - (corner[2] - 14e-3)
    beside_lips = aside - corner[0]
    bare_lips = np.maximum.reduce([y - lip_top, lip_bottom - y, beside_lips]) - OFF_LIPS_M

    fold_x = [0.0, wing[0], corner[0] + 9e-3]
    fold = np.interp(aside, fold_x, [landmarks[33, 1] - 4e-3, wing[1] - 4e-3, corner[1] + 4e-3])
    below_nose = np.where(aside < wing[0] + 3e-3, fold + 2e-3 - y, np.inf)
    moustache = np.minimum.reduce([fold - y, y - lip_top, corner[0] + 6e-3 - aside, front])
    # the soul patch reaches the lip, beside it skin is bare
    bare = np.interp(aside, [4e-3, 9e-3], [0.0, 7e-3])
    jaw = landmarks[12:7:-1]  # from its angle to the chin
    jaw_z = np.maximum.accumulate(jaw[:, 2])
    line = np.interp(z, jaw_z, jaw[:, 1])
    neck = y - (line - np.interp(z, jaw_z, [4e-3, 12e-3, 18e-3, 22e-3, 22e-3]))
    chin_width = np.interp(y, [chin[1], lip_bottom.min()], [0.95 * corner[0], 0.8 * corner[0]])
    chin_part = np.minimum.reduce(
        [lip_bottom - bare - y, chin_width - aside, y - (chin[1] - 12e-3), neck, front]
    )
    beside = np.minimum.reduce(
        [5.5e-3 - np.abs(beside_lips - 2e-3), corner[1] + 6e-3 - y, y - (chin[1] + 8e-3), front]
    )
    share = np.clip((corner[2] - 6e-3 - z) / (corner[2] - 6e-3 - (ear[2] + 14e-3)), 0.0, 1.0)
    cheek_line = corner[1] - 2e-3 + (ear[1] - corner[1]) * share**2.2
    # before the ear, and below it as far back as the jaw
    behind = z - (ear[2] + np.where(y > landmarks[13, 1], 5e-3, -4e-3))
    cheeks = np.minimum.reduce([cheek_line - y, neck, behind, aside - 0.75 * corner[0]])
    under = np.minimum.reduce([chin[1] + 4e-3 - y, neck, behind])
    regions = {
        "moustache": moustache,
        "chin": chin_part,
        "beside": beside,
        "cheeks": np.maximum(cheeks, under),
        "anything": np.minimum(bare_lips, below_nose),
    }
    return regions, y - lip_top


def _comb(landmarks: np.ndarray, root: np.ndarray) -> np.ndarray:
    """Directions (n, 3) in which hair lies: down and a little forward, a moustache to its side."""
    corner = landmarks[54]
    above_mouth = np.clip((root[:, 1] - corner[1]) / 6e-3, 0.0, 1.0) * (np.abs(root[:, 0]) < corner[0] + 8e-3)
    aside = 0.9 * above_mouth * np.clip(root[:, 0] / (0.4 * corner[0]), -1.0, 1.0)
    return np.stack([aside, -np.ones(len(root)), np.full(len(root), 0.35)], axis=-1)


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


def _outside(places: np.ndarray, triangles: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """Places (n, k, 3), moved along the normal of the nearest vertex to where they clear the skin."""
    used, renumbered = np.unique(triangles, return_inverse=True)
    skin, corners = vertices[used], renumbered.reshape(triangles.shape)
    a, b, c = (skin[corners[:, i]] for i in range(3))
    across = np.cross(b - a, c - a)
    normal = np.stack(
        [sum(np.bincount(corners[:, i], across[:, axis], len(used)) for i in range(3)) for axis in range(3)],
        axis=-1,
    )
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    nearest = cKDTree(skin).query(places.reshape(-1, 3))[1].reshape(places.shape[:2])
    above = ((places - skin[nearest]) * normal[nearest]).sum(axis=-1)
    return places + np.maximum(CLEAR_M - above, 0.0)[..., None] * normal[nearest]
