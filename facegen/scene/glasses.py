"""Glasses inside a headset: a frame of tubes and two thin lenses, sized from the face and clear of its skin.

Lenses are plano: 2 mm of glass shift what is behind them by 0.7 mm at 45 degrees, all of it alike and along the ray's
plane, so refraction is left out and eye labels hold as they are. Of the light, 8 % is lost at a lens's two faces
(Fresnel, index 1.5), and LEDs are mirrored there (`facegen.labels.glints`). Frames have no nose pads; temples end at
the ears.
"""

from dataclasses import dataclass

import numpy as np
import scipy

from facegen.conventions import Part
from facegen.rigs import EyeGeometry, Rig
from facegen.scene.scene import Mesh
from facegen.scene.strands import strand_tubes

BEFORE_CORNEA_M = 12e-3
"""Least distance of a lens from the cornea, as opticians fit them (12 to 14 mm)."""
BELOW_EYES_M = 2e-3
"""By which lens centres lie below the eyes' (pupils look through the upper half)."""
TILT_RAD = np.radians(6.0)
"""Pantoscopic tilt: the lower rim is nearer to the cheek."""
CLEAR_M = 0.6e-3
"""Least distance between frame and skin."""
CORNEA_M = 13.5e-3
"""From an eye's centre of rotation to its cornea's apex."""
TUBE_SIDES = 8
"""Of a tube's cross-section."""


@dataclass(frozen=True, kw_only=True)
class Glasses:
    """One person's glasses.

    Attributes
    ----------
    half_width_m, half_height_m, squareness
        Half axes of each lens, and the exponent of its outline: 2 is an ellipse, 4 almost a rectangle.
    bridge_m
        Between the lenses.
    rim_radius_m
        Of the frame's tubes.
    base_radius_m
        Radius of the lenses' front surface.
    """

    half_width_m: float
    half_height_m: float
    squareness: float
    bridge_m: float
    rim_radius_m: float
    base_radius_m: float


@dataclass(frozen=True, kw_only=True, eq=False)
class LensMirror:
    """A lens's front surface: part of a sphere.

    Attributes
    ----------
    center, radius
        (3,) and metres, of the sphere.
    middle, axes
        (3,) vertex of the lens, and (3, 3) rows: its x, its y, its outside; head frame.
    half_m, squareness
        Its outline, as in `Glasses`.
    """

    center: np.ndarray
    radius: float
    middle: np.ndarray
    axes: np.ndarray
    half_m: tuple[float, float]
    squareness: float

    def holds(self, points: np.ndarray) -> np.ndarray:
        """Whether points (n, 3) of the sphere lie within the outline; (n,) bool, False for NaN."""
        x, y, z = np.moveaxis((points - self.middle) @ self.axes.T, -1, 0)
        with np.errstate(invalid="ignore"):
            reach = (
                np.abs(x / self.half_m[0]) ** self.squareness + np.abs(y / self.half_m[1]) ** self.squareness
            )
            return (reach < 1.0) & (z > -self.radius)


def draw_glasses(rng: np.random.Generator) -> Glasses:
    """A person's glasses: widths of 46 to 54 mm, heights of 28 to 40 mm, bridges of 15 to 20 mm, all usual ones."""
    width, height, squareness, bridge, rim, base = rng.random(6)
    return Glasses(
        half_width_m=23e-3 + 4e-3 * width,
        half_height_m=14e-3 + 6e-3 * height,
        squareness=2.2 + 2.0 * squareness,
        bridge_m=15e-3 + 5e-3 * bridge,
        rim_radius_m=0.8e-3 + 1.0e-3 * rim**2,
        base_radius_m=80e-3 + 50e-3 * base,
    )


def place_lenses(
    glasses: Glasses, rig: Rig, vertices: np.ndarray, eyes: tuple[EyeGeometry, EyeGeometry]
) -> tuple[LensMirror, LensMirror]:
    """The subject's left and right lens on an evaluated head (V, 3): as near to the eyes as the skin allows."""
    centers = np.stack([eye.center for eye in eyes])
    aside = max(0.5 * (centers[0, 0] - centers[1, 0]), 0.5 * glasses.bridge_m + glasses.half_width_m)
    middle = centers.mean(axis=0) + np.array([0.0, -BELOW_EYES_M, CORNEA_M + BEFORE_CORNEA_M])
    lenses = tuple(_lens(glasses, middle + np.array([side * aside, 0.0, 0.0])) for side in (1.0, -1.0))
    rims = np.concatenate([_outline(lens) for lens in lenses])
    forward = (_skin_before(rig, vertices, rims) + glasses.rim_radius_m + CLEAR_M - rims[:, 2]).max()
    forward = np.array([0.0, 0.0, max(forward, 0.0)])
    return tuple(_lens(glasses, lens.middle + forward) for lens in lenses)


def _lens(glasses: Glasses, middle: np.ndarray) -> LensMirror:
    cosine, sine = np.cos(TILT_RAD), np.sin(TILT_RAD)
    axes = np.array([[1.0, 0.0, 0.0], [0.0, cosine, sine], [0.0, -sine, cosine]])
    return LensMirror(
        center=middle - glasses.base_radius_m * axes[2],
        radius=glasses.base_radius_m,
        middle=middle,
        axes=axes,
        half_m=(glasses.half_width_m, glasses.half_height_m),
        squareness=glasses.squareness,
    )


def _outline(lens: LensMirror, share: float = 1.0, count: int = 64) -> np.ndarray:
    """Places (count, 3) round a lens, at a share of the way from its middle."""
    turn = np.linspace(0.0, 2.0 * np.pi, count, endpoint=False)
    flat = [
        share * half * np.sign(wave) * np.abs(wave) ** (2.0 / lens.squareness)
        for half, wave in zip(lens.half_m, (np.cos(turn), np.sin(turn)), strict=True)
    ]
    depth = np.sqrt(lens.radius**2 - flat[0] ** 2 - flat[1] ** 2) - lens.radius
    return lens.middle + np.stack([*flat, depth], axis=-1) @ lens.axes


def _skin_before(rig: Rig, vertices: np.ndarray, rim_points: np.ndarray) -> np.ndarray:
    """How far forward (n,) the skin reaches about places (n, 3), metres along z."""
    skin = vertices[np.unique(rig.faces[np.isin(rig.part, (Part.SKIN, Part.BROWS)), :3])]
    skin = skin[(skin[:, 2] > -0.03) & (np.abs(skin[:, 1]) < 0.06)]
    distance, nearest = scipy.spatial.cKDTree(skin[:, :2]).query(rim_points[:, :2], k=6)
    # on the temples, where the skin runs along z, the farthest of a wide ring would be far before the place itself
    return np.where(distance < 4e-3, skin[nearest, 2], -np.inf).max(axis=1)


def glasses_meshes(
    glasses: Glasses, lenses: tuple[LensMirror, LensMirror], rig: Rig, vertices: np.ndarray
) -> tuple[Mesh, Mesh]:
    """Frame and lenses on an evaluated head (V, 3), head frame, metres."""
    rims = [_outline(lens) for lens in lenses]
    straight = [_bridge(glasses, lenses, rig, vertices)]
    straight += [_temple(rim, rig, vertices, side) for rim, side in zip(rims, (1.0, -1.0), strict=True)]
    tubes = [(np.concatenate([rim, rim[:2]]), lenses[0].axes[2]) for rim in rims] + [
        (t, None) for t in straight
    ]
    frame = [
        strand_tubes(line[None], np.full((1, len(line)), glasses.rim_radius_m), sides=TUBE_SIDES, axis=axis)
        for line, axis in tubes
    ]
    rings = [
        np.stack([_outline(lens, share) for share in (1e-3, 0.35, 0.7, 1.0)]).reshape(-1, 3)
        for lens in lenses
    ]
    number = np.arange(4 * 64).reshape(4, 64)
    quads = np.stack(
        [number[:-1], number[1:], np.roll(number[1:], -1, 1), np.roll(number[:-1], -1, 1)], axis=-1
    )
    panes = [(points, quads.reshape(-1, 4).astype(np.int32)) for points in rings]
    return _mesh("glasses", frame, Part.GLASSES, "frame"), _mesh("lenses", panes, Part.LENS, "lens")


def _mesh(name: str, pieces: list[tuple[np.ndarray, np.ndarray]], part: Part, material: str) -> Mesh:
    starts = np.cumsum([0, *(len(points) for points, _ in pieces)])
    faces = np.concatenate([quads + start for (_, quads), start in zip(pieces, starts[:-1], strict=True)])
    return Mesh(
        name=name,
        vertices=np.concatenate([points for points, _ in pieces]),
        faces=faces.astype(np.int32),
        part=np.full(len(faces), part, np.uint8),
        materials=(material,),
        face_material=np.zeros(len(faces), np.int32),
    )


def _bridge(
    glasses: Glasses, lenses: tuple[LensMirror, LensMirror], rig: Rig, vertices: np.ndarray
) -> np.ndarray:
    """Polyline (n, 3) from rim to rim over the nose, arched upwards and as far forward as the nose asks."""
    ends = [
        lens.middle + np.array([side * lens.half_m[0], 0.3 * lens.half_m[1], 0.0])
        for lens, side in zip(lenses, (-1, 1), strict=True)
    ]
    t = np.linspace(0.0, 1.0, 17)[:, None]
    line = ends[0] * (1.0 - t) + ends[1] * t
    arch = np.sin(np.pi * t[:, 0])
    line[:, 1] += 1.5e-3 * arch
    room = _skin_before(rig, vertices, line) + glasses.rim_radius_m + CLEAR_M
    forward = max((room - line[:, 2]).max(), 0.0)
    line[:, 2] += forward * arch**0.5
    line[1:-1, 2] = np.maximum(line[1:-1, 2], room[1:-1])
    return line


def _temple(rim: np.ndarray, rig: Rig, vertices: np.ndarray, side: float) -> np.ndarray:
    """Polyline (n, 3) from a rim's outer upper edge to the ear, outside the widest skin beside it."""
    hinge = rim[(side * rim[:, 0] + 0.5 * rim[:, 1]).argmax()]
    skin = vertices[np.unique(rig.faces[rig.part == Part.SKIN, :3])]
    z = np.linspace(hinge[2], -0.065, 12)
    line = np.stack([np.full(12, hinge[0]), np.full(12, hinge[1]), z], axis=-1)
    for i in range(1, 12):
        beside = skin[(np.abs(skin[:, 1] - hinge[1]) < 6e-3) & (np.abs(skin[:, 2] - z[i]) < 8e-3)]
        reach = max((side * beside[:, 0]).max(initial=0.0) + 2.5e-3, side * line[i - 1, 0])
        line[i, 0] = side * reach
    return line
