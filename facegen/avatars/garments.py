"""Clothes: MakeHuman's helper suit and skirt, cut to garments, loosened, and the skin below them left out."""

from dataclasses import dataclass, replace

import numpy as np
from scipy import ndimage, sparse
from scipy.spatial import cKDTree

from facegen.avatars.surface import Material, Surface, trimmed, vertex_normals
from facegen.geometry.grids import facing_back, halves, ring_quads

HIDDEN_M = 18e-3
"""Skin and inner garments this far inside a garment's ends are left out; nearer to them, one could look in."""

SHOE_STATIONS, SHOE_AROUND = 15, 16
SHOE_TOP_M, SOLE_M = 0.02, 8e-3
"""Shoes end this far below the ankle's joint; soles are this thick."""


@dataclass(frozen=True, kw_only=True)
class Garment:
    """A piece of clothing.

    Attributes
    ----------
    name, colour, roughness
        Of its material; the colour is sRGB, 0 to 1.
    source
        ``"helper-tights"`` or ``"helper-skirt"``.
    sleeve, leg, hem, waist
        Where it ends: shares along upper and lower arm (0 to 2) and leg (0 to 2), and heights as shares from the hips
        (0) to the neck (1). None leaves that limb or end out.
    collar
        Depth of the neckline in front, as a share from the neck down to the hips; its width follows.
    loose_m, smooth
        How far it stands off the body, and how often it is evened out.
    """

    name: str
    colour: tuple[float, float, float]
    source: str = "helper-tights"
    roughness: float = 0.85
    sleeve: float = 0.0
    leg: float = 0.0
    hem: float = -9.0
    waist: float = 9.0
    collar: float = 0.0
    loose_m: float = 6e-3
    smooth: int = 6


@dataclass(frozen=True, kw_only=True, eq=False)
class Measures:
    """Places of a body that garments are cut by, metres; the subject's left arm and leg, the right ones mirrored."""

    shoulder: np.ndarray
    elbow: np.ndarray
    wrist: np.ndarray
    hip: np.ndarray
    knee: np.ndarray
    ankle: np.ndarray
    hips: np.ndarray
    neck: np.ndarray


def inside(garment: Garment, points: np.ndarray, body: Measures) -> np.ndarray:
    """How far points (n, 3) lie inside a garment's ends, about in metres; negative beyond them."""
    mirrored = np.abs(points) * [1, 0, 0] + points * [0, 1, 1]
    trunk = np.full(len(points), np.inf)
    height = (points[:, 1] - body.hips[1]) / (body.neck[1] - body.hips[1])
    scale = body.neck[1] - body.hips[1]
    trunk = np.minimum(trunk, (height - garment.hem) * scale)
    trunk = np.minimum(trunk, (garment.waist - height) * scale)
    arm, arm_scale = _along(mirrored, body.shoulder, body.elbow, body.wrist)
    beyond = mirrored[:, 0] - body.shoulder[0] + 0.6 * (body.shoulder[1] - mirrored[:, 1]) > -0.02
    on_arm = beyond & (mirrored[:, 0] > 0.75 * body.shoulder[0]) & (points[:, 1] > body.wrist[1] - 0.2)
    on_arm &= mirrored[:, 0] > body.shoulder[0] - 0.02 + 0.25 * np.clip(body.shoulder[1] - points[:, 1], 0, 1)
    trunk = np.where(on_arm, np.minimum(trunk, (garment.sleeve - arm) * arm_scale), trunk)
    leg, leg_scale = _along(mirrored, body.hip, body.knee, body.ankle)
    on_leg = (points[:, 1] < body.hip[1] - 0.02) & ~on_arm
    trunk = np.where(on_leg, np.minimum(trunk, (garment.leg - leg) * leg_scale), trunk)
    # around the neck it ends on a slant, higher behind
    edge = body.neck[1] + 0.008 - 0.5 * (points[:, 2] - body.neck[2])
    trunk = np.minimum(trunk, np.where(np.abs(points[:, 0]) < body.shoulder[0], edge - points[:, 1], np.inf))
    if garment.collar:
        depth = garment.collar * scale
        front = np.clip((points[:, 2] - body.neck[2] + 0.02) / 0.05, 0.0, 1.0)
        below = body.neck[1] - points[:, 1]
        open_at = np.abs(points[:, 0]) / (0.42 * depth + 0.02) - (1.0 - below / depth)
        trunk = np.minimum(trunk, np.where(front > 0.5, 0.35 * depth * open_at, np.inf))
    return trunk


def _along(
    points: np.ndarray, start: np.ndarray, middle: np.ndarray, end: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Share (n,) of the way along a limb, 1 at its joint and 2 at its end, and metres of a share (n,)."""
    shares, lengths = [], []
    for a, b in ((start, middle), (middle, end)):
        length = np.linalg.norm(b - a)
        shares.append((points - a) @ (b - a) / length**2)
        lengths.append(length)
    lower = shares[1] > 0.0
    share = np.where(lower, 1.0 + np.maximum(shares[1], 0.0), np.minimum(shares[0], 1.0))
    return share, np.where(lower, lengths[1], lengths[0])


def garment_surface(
    garment: Garment,
    positions: np.ndarray,
    triangles: np.ndarray,
    shares: np.ndarray,
    bones: tuple[str, ...],
    body: Measures,
    *,
    folds: np.ndarray,
    over: tuple[Garment, ...] = (),
) -> Surface:
    """A garment cut out of the helper mesh ``positions`` (V, 3); ``folds`` (V,) about -1 to 1 unsettle the cloth.

    What those worn ``over`` it hide is left out.
    """
    at_rest = inside(garment, positions, body)
    even = _evened(positions, triangles, garment.smooth)
    normals = vertex_normals(even, triangles)
    # what evening took off a limb is given back, so that nothing comes through
    lost = np.clip(np.einsum("vc,vc->v", positions - even, normals), 0.0, None)
    loose = garment.loose_m * (1.0 + 0.35 * folds) + lost
    moved = even + loose[:, None] * normals
    linear = np.array(garment.colour) ** 2.2
    surface = Surface(
        mesh="Clothes",
        material=Material(
            name=garment.name,
            colour=(*(float(x) for x in linear), 1.0),
            roughness=garment.roughness,
            both_sides=True,
        ),
        positions=moved,
        normals=vertex_normals(moved, triangles),
        triangles=triangles,
        colours=np.stack([*(np.clip(0.94 + 0.06 * folds, 0, 1),) * 3, np.ones(len(moved))], axis=-1),
        bones=bones,
        shares=shares,
    )
    hidden = covered(over, positions, body)
    surface = replace(surface, triangles=triangles[~hidden[triangles].all(axis=1)])
    return trimmed(surface, at_rest)


def covered(garments: tuple[Garment, ...], points: np.ndarray, body: Measures) -> np.ndarray:
    """Whether skin at points (n, 3) lies under a garment, away from its ends."""
    under = np.zeros(len(points), bool)
    for garment in garments:
        under |= inside(garment, points, body) > HIDDEN_M
    return under


def shoes(
    positions: np.ndarray,
    shares: np.ndarray,
    bones: tuple[str, ...],
    body: Measures,
    *,
    colour: tuple[float, float, float],
) -> Surface:
    """Plain closed shoes round the feet, whose skin is ``positions`` (V, 3)."""
    linear = np.array(colour) ** 2.2
    lasts = [
        _shoe(positions[side * positions[:, 0] > 0.0], body.ankle[1] - SHOE_TOP_M) for side in (1.0, -1.0)
    ]
    rings = SHOE_STATIONS * SHOE_AROUND
    triangles = [_shoe_triangles() + foot * (rings + 2) for foot in range(2)]
    made, faces = np.concatenate(lasts), np.concatenate(triangles)
    near = cKDTree(positions).query(made)[1]
    return Surface(
        mesh="Clothes",
        material=Material(name="shoes", colour=(*(float(x) for x in linear), 1.0), roughness=0.6),
        positions=made,
        normals=vertex_normals(made, faces),
        triangles=faces,
        bones=bones,
        shares=shares[near],
    )


def _shoe(foot: np.ndarray, top: float) -> np.ndarray:
    """Vertices of one shoe: rings from the heel to the toes, and a middle at either end."""
    flat = foot[:, [0, 2]]
    middle = flat.mean(axis=0)
    along = np.linalg.svd(flat - middle, full_matrices=False)[2][0]
    along *= np.sign(along[1])
    across = np.array([along[1], -along[0]])
    t, s = (flat - middle) @ along, (flat - middle) @ across
    low = foot[:, 1].min() - SOLE_M
    stations = np.linspace(t.min() - 3e-3, t.max() + 7e-3, SHOE_STATIONS)
    window = np.abs(t - np.clip(stations, t.min(), t.max())[:, None]) < 0.022
    left, right = (np.array([one(s[row]) for row in window]) for one in (np.min, np.max))
    height = np.minimum([foot[row, 1].max() for row in window], top)
    left, right, height = (ndimage.gaussian_filter1d(x, 1.0, mode="nearest") for x in (left, right, height))
    # both ends are round, seen from above and from the side
    end = np.clip(np.minimum(stations - stations[0], stations[-1] - stations) / 0.035, 0.0, 1.0)
    round_off = np.sqrt(1.0 - (1.0 - end) ** 2) * 0.72 + 0.28
    half = (0.5 * (right - left) + 4e-3) * round_off
    tall = (np.maximum(height, low + 0.035) + 5e-3 - low) * (0.55 + 0.45 * round_off)
    turn = np.arange(SHOE_AROUND) * (2.0 * np.pi / SHOE_AROUND)
    wide = np.sign(np.cos(turn)) * np.abs(np.cos(turn)) ** 0.7
    up = np.clip(0.5 + 0.55 * np.sign(np.sin(turn)) * np.abs(np.sin(turn)) ** 0.75, 0.0, 1.0)
    place = 0.5 * (left + right)[:, None] + half[:, None] * wide
    ground = middle + stations[:, None, None] * along + place[..., None] * across
    rings = np.stack([ground[..., 0], low + tall[:, None] * up, ground[..., 1]], axis=-1)
    ends = [ring.mean(axis=0) for ring in (rings[0], rings[-1])]
    return np.concatenate([rings.reshape(-1, 3), ends])


def _shoe_triangles() -> np.ndarray:
    sides = halves(facing_back(ring_quads(SHOE_STATIONS, SHOE_AROUND)))
    one = np.arange(SHOE_AROUND)
    other = np.roll(one, -1)
    last, rings = (SHOE_STATIONS - 1) * SHOE_AROUND, SHOE_STATIONS * SHOE_AROUND
    heel = np.stack([np.full_like(one, rings), other, one], axis=-1)
    toe = np.stack([np.full_like(one, rings + 1), last + one, last + other], axis=-1)
    return np.concatenate([sides, heel, toe])


def _evened(positions: np.ndarray, triangles: np.ndarray, times: int) -> np.ndarray:
    """Every vertex drawn half way to the mean of its neighbours, several times; borders only along themselves."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    count = len(positions)
    uses = sparse.coo_matrix((np.ones(len(sides)), sides.T), shape=(count, count)).tocsr()
    uses = uses + uses.T
    border = uses.copy()
    border.data = (border.data == 1.0).astype(float)
    on_border = np.asarray(border.sum(axis=1)).ravel() > 0
    inner = uses.copy()
    inner.data = np.ones_like(inner.data)
    weights = (
        sparse.diags((~on_border).astype(float)) @ inner + sparse.diags(on_border.astype(float)) @ border
    )
    total = np.asarray(weights.sum(axis=1)).ravel()
    weights = sparse.diags(1.0 / np.maximum(total, 1.0)) @ weights
    for _ in range(times):
        mean = weights @ positions
        positions = np.where((total > 0)[:, None], 0.5 * (positions + mean), positions)
    return positions


TEAL, NAVY, GREY, WHITE, WINE = (
    (0.16, 0.42, 0.44),
    (0.13, 0.17, 0.30),
    (0.33, 0.34, 0.36),
    (0.90, 0.90, 0.88),
    (0.42, 0.14, 0.18),
)
OUTFITS: dict[str, tuple[Garment, ...]] = {
    "scrubs": (
        Garment(name="trousers", colour=TEAL, leg=2.03, waist=0.16, loose_m=9e-3, smooth=8),
        Garment(
            name="top", colour=TEAL, sleeve=0.72, leg=0.14, hem=-0.28, collar=0.26, loose_m=14e-3, smooth=10
        ),
    ),
    "shirt": (
        Garment(name="trousers", colour=NAVY, leg=2.03, waist=0.12, loose_m=7e-3, smooth=6),
        Garment(
            name="shirt", colour=GREY, sleeve=1.9, leg=0.1, hem=-0.22, collar=0.10, loose_m=15e-3, smooth=8
        ),
    ),
    "dress": (
        Garment(name="top", colour=WINE, sleeve=0.6, hem=0.05, collar=0.2, loose_m=6e-3, smooth=4),
        Garment(
            name="skirt", colour=WINE, source="helper-skirt", leg=1.35, waist=0.2, loose_m=7e-3, smooth=2
        ),
    ),
    "gown": (
        Garment(name="trousers", colour=TEAL, leg=2.03, waist=0.16, loose_m=8e-3, smooth=8),
        Garment(
            name="skirt", colour=(0.36, 0.55, 0.66), source="helper-skirt", leg=1.25, waist=0.3, loose_m=14e-3
        ),
        Garment(
            name="gown", colour=(0.36, 0.55, 0.66), sleeve=1.9, hem=0.0, collar=0.06, loose_m=15e-3, smooth=10
        ),
    ),
}
"""Clothes by name, inner ones first."""
