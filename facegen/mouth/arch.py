"""Dental arches: where teeth stand, and the crowns put there.

An arch's frame: x to the subject's left, z forward, both in the plane of the teeth; h from the plane towards the roots
(up for the upper arch, down for the lower); the origin at the middle of the incisors' line of contacts.

References
----------
.. [1] S. Braun et al., "The form of the human dental arch", Angle Orthodontist 68(1), 1998: arches follow the beta
   function ``z = D (4 (1/2 + x/W) (1/2 - x/W))^0.8`` of their width W and depth D.
"""

from dataclasses import dataclass

import numpy as np

from facegen.mouth.crowns import Tooth, crown, neck

POWER = 0.8
POINTS = 2001
CONTACT = 0.93
"""Share of a crown's width from contact to contact: crowns touch inside of the line's curve, and wear flat there."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Course:
    """The line of contacts: places (n, 2) of x and z at arc lengths (n,) from the middle, left positive, metres."""

    length: np.ndarray
    place: np.ndarray

    def at(self, length: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Places (..., 2) and outward unit normals (..., 2) at arc lengths (...); beyond its ends it is straight."""
        length = np.asarray(length, np.float64)
        inside = np.clip(length, self.length[0], self.length[-1])
        place, tangent = (
            np.stack([np.interp(inside, self.length, values[:, axis]) for axis in (0, 1)], axis=-1)
            for values in (self.place, np.gradient(self.place, self.length, axis=0))
        )
        tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
        place = place + (length - inside)[..., None] * tangent
        return place, np.stack([-tangent[..., 1], tangent[..., 0]], axis=-1)


@dataclass(frozen=True, kw_only=True, eq=False)
class Seat:
    """One tooth in its arch: number from the right, arc length at its middle, and how it stands there.

    ``outwards_m`` and ``below_m`` move it off the line of contacts and towards the roots, ``turn_rad`` turns it.
    """

    tooth: Tooth
    left: bool
    size: float
    length_m: float
    outwards_m: float
    below_m: float
    turn_rad: float
    missing: bool


def course(half_length_m: float, ratio: float) -> Course:
    """The beta function [1]_, each half ``half_length_m`` long, with a depth of ``ratio`` times its width."""
    x = 0.5 * np.sin(np.linspace(-0.5 * np.pi, 0.5 * np.pi, POINTS))
    z = ratio * ((4.0 * np.clip((0.5 + x) * (0.5 - x), 0.0, None)) ** POWER - 1.0)
    place = np.stack([x, z], axis=-1)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(place, axis=0), axis=1))])
    scale = half_length_m / (length[-1] / 2)
    return Course(length=scale * (length - length[-1] / 2), place=scale * place)


def seats(
    teeth: tuple[Tooth, ...],
    size: float,
    *,
    turn_rad: np.ndarray,
    outwards_m: np.ndarray,
    down_m: np.ndarray,
    missing: np.ndarray,
) -> tuple[Seat, ...]:
    """Teeth (those of one side, from the midline) side by side; the arrays (14,) count from the subject's right."""
    width = CONTACT * 1e-3 * size * np.array([tooth.width for tooth in teeth])
    middle = np.cumsum(width) - width / 2
    placed = []
    for number in range(2 * len(teeth)):
        left = number >= len(teeth)
        order = number - len(teeth) if left else len(teeth) - 1 - number
        placed.append(
            Seat(
                tooth=teeth[order],
                left=left,
                size=size,
                length_m=float(middle[order] if left else -middle[order]),
                outwards_m=float(outwards_m[number]),
                below_m=float(1e-3 * size * teeth[order].below - down_m[number]),
                turn_rad=float(turn_rad[number]),
                missing=bool(missing[number]),
            )
        )
    return tuple(placed)


def half_length(teeth: tuple[Tooth, ...], size: float) -> float:
    """Arc length that the teeth of one side take, metres."""
    return CONTACT * 1e-3 * size * sum(tooth.width for tooth in teeth)


def crowns(line: Course, arch_seats: tuple[Seat, ...]) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Crowns in the arch's frame.

    Returns
    -------
    vertices : numpy.ndarray
        (V, 3) columns x, h, z.
    faces : numpy.ndarray
        (F, 4) int32, outsides out for the upper arch, where h is y; triangles padded with -1.
    tooth : numpy.ndarray
        (V,) number of each vertex's tooth, from the right.
    """
    vertices, faces, number, start = [], [], [], 0
    for index, seat in enumerate(arch_seats):
        if seat.missing:
            continue
        points, quads = crown(seat.tooth)
        x, d, h = (seat.size * points).T
        # (x, d, h) is right-handed, (x, h, z) of the left side is not
        x, quads = (x, _flipped(quads)) if seat.left else (-x, quads)
        # inclined: what is nearer to the root lies further in
        d = d - np.tan(np.radians(seat.tooth.inclination)) * h
        x, d = (
            np.cos(seat.turn_rad) * x - np.sin(seat.turn_rad) * d,
            np.sin(seat.turn_rad) * x + np.cos(seat.turn_rad) * d,
        )
        place, normal = line.at(seat.length_m)
        along = np.array([normal[1], -normal[0]])
        flat = place + x[:, None] * along + (d + seat.outwards_m)[:, None] * normal
        vertices.append(np.stack([flat[:, 0], h + seat.below_m, flat[:, 1]], axis=-1))
        faces.append(np.where(quads >= 0, quads + start, -1))
        number.append(np.full(len(points), index))
        start += len(points)
    return np.concatenate(vertices), np.concatenate(faces).astype(np.int32), np.concatenate(number)


def necks(arch_seats: tuple[Seat, ...]) -> np.ndarray:
    """Where each tooth leaves the gum, (14, 4): arc length, outer and inner distance from the line, and h, metres."""
    rows = []
    for seat in arch_seats:
        outer, inner = neck(seat.tooth)
        h = 1e-3 * seat.tooth.length * seat.size
        lean = np.tan(np.radians(seat.tooth.inclination)) * h
        off = seat.outwards_m - lean
        rows.append([seat.length_m, seat.size * outer + off, seat.size * inner + off, h + seat.below_m])
    return np.array(rows)


def _flipped(quads: np.ndarray) -> np.ndarray:
    """The same faces seen from the other side; padding stays last."""
    triangle = quads[:, 3:] < 0
    return np.where(triangle, quads[:, [1, 0, 2, 3]], quads[:, ::-1])
