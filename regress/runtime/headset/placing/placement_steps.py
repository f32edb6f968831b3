"""Leads a view, step by step, to where an eye or a mouth lies in it as in training, and says how good it is there.

A network's points lean towards where they lie in training: of an eye that is too large in the view it traces one that
is a little too large. So a single look says too little, and a placement is looked for at which the eye, as traced, is
just as large, as upright and in the place as in training; there the leaning stops. In training on drawn headsets eyes
are of every size, and what lies among them is left where it is.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cached_property

import numpy as np

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.pictures.typical import likeness, typical_picture
from regress.runtime.headset.placing.compass import QUARTERS, eye_compass
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.levels import levels_in
from regress.runtime.headset.placing.mouth_points import MouthPoints

_STEPS = 6
"""In which a placement is refined from a start; a film of a real eye settles in five."""

_FEW = 16
"""Frames, evenly chosen, by which steps are taken; what they lead to is judged by all that the search has."""

_SMALLEST, _LARGEST, _EDGE = 0.3, 1.7, 0.1
"""Sizes of views over pictures (the largest over a picture's longer side), and how near to a picture's edge the middle
of a view may lie: beyond, the view shows repeated edges for the most part, in which networks see what they like."""

_LARGEST_FADED, _EDGE_FADED = 2.4, 0.0
"""The same where they fade out."""

_AT_LIMIT = 0.01
"""How near to these a placement counts as held by them."""

_MOVES = ((0.0, 0.0, 1.0, 0.0), (-0.06, 0.03, 1.1, 6.0), (0.06, -0.03, 0.91, -6.0))
"""By how much the view is moved (of its width), scaled and turned to see whether points stay."""

_DRAWN_SIZES, _DRAWN_PLACES, _DRAWN_ROLL_DEG = 1.45, 0.17, 30.0
"""How far nine drawn eyes in ten lie from the usual one at most: times its iris, of the view's width, and degrees. A
network of drawn headsets knows them all, and is only led to what lies further out: led to the usual size it saw two
films of real eyes 1.5 and 1.7 times as small as they came, and traced both worse."""

_WHOLE = (0.7, 1.0, 1.5)
"""Sizes of views over pictures in which the compass looks; an eye fills pictures of cameras more or less."""

_SURELY = 1.0
"""Logarithm of how many times the share of eyes upright has to be that of turned ones, from which none is looked for:
120 drawn headsets' eyes have 2.0 or more; two films of real ones, changed in 15 ways, .1 to 2.3 but for one drawn out
to half again its width (-1.0), and turned -.3 or less (one probe)."""


def placement_of_points(
    placement: CameraPlacement,
    seen: np.ndarray,
    points: EyePoints | MouthPoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
) -> CameraPlacement:
    """The placement at which points would lie as in training, if they lie so (n, P, 2) in the view of another one.

    Points may be NaN where they are hidden, but those that are followed not in all frames. It may lie anywhere, and be
    of any size.
    """
    turn, shift = points.seen_from_usual(seen)
    matrix = placement.picture_from_view(picture, view)
    linear = matrix[:, :2] @ turn
    offset = matrix[:, :2] @ shift + matrix[:, 2]
    at = linear @ ((np.array(view) - 1) / 2) + offset
    x, y = (at + 0.5) / picture
    wide = np.sqrt(abs(np.linalg.det(linear))) * view[0] / picture[0]
    return replace(
        placement,
        x=float(x),
        y=float(y),
        size=float(wide),
        roll_deg=float(np.degrees(np.arctan2(-linear[0, 1], linear[1, 1]))),
    )


class Search:
    """Looks at a take's frames (n, h, w) at one placement after the other."""

    def __init__(
        self,
        predictor: HeadsetPredictor,
        camera: str,
        points: EyePoints | MouthPoints,
        pictures: np.ndarray,
        *,
        fades: bool,
    ) -> None:
        self._predictor, self._camera, self._points = predictor, camera, points
        self._pictures, self._few = pictures, pictures[even_rows(len(pictures), _FEW)]
        self._view = predictor.sizes[camera]
        self._picture = (pictures.shape[2], pictures.shape[1])
        self._aspect = self._picture[0] / self._picture[1]
        self.whole = replace(whole_view(self._picture, self._view), aspect=None)
        self.fades = fades
        largest, self._edge = (_LARGEST_FADED, _EDGE_FADED) if fades else (_LARGEST, _EDGE)
        self._largest = largest * max(self._picture) / self._picture[0]
        names = predictor.model.weights
        self._typical = predictor.typical.get(camera)
        # the compass knows eyes alone, and a mouth in a mirror is a mouth
        self.of_an_eye = isinstance(points, EyePoints)
        self._of_right_eye = self.of_an_eye and predictor.model.points[camera][points.pupil].startswith(
            "right"
        )
        self._part = [names.index(name) for name in predictor.model.parts[camera]]
        self._uprights: dict[tuple[bool, int], float] = {}

    def best(self, start: CameraPlacement) -> FoundPlacement:
        """The best of the placements through which the steps from a start go."""
        placement, found = start, []
        for _ in range(_STEPS):
            seen, quality = self._look(placement, self._few)
            following = placement_of_points(
                placement, seen, self._points, picture=self._picture, view=self._view
            )
            if self._predictor.model.of_many_headsets and _is_as_drawn(placement, following, self._aspect):
                following = placement
            unsettled = max(_apart(placement, following, self._aspect))
            found.append(FoundPlacement(placement=placement, unsettled=unsettled, **quality))
            placement = self._held(following)
        best = min(found, key=lambda one: one.score)
        if len(self._few) == len(self._pictures):
            return best
        _, quality = self._look(best.placement, self._pictures)
        return replace(best, **quality)

    def _held(self, placement: CameraPlacement) -> CameraPlacement:
        """The nearest placement within the limits."""
        return replace(
            placement,
            x=min(max(placement.x, self._edge), 1 - self._edge),
            y=min(max(placement.y, self._edge), 1 - self._edge),
            size=min(max(placement.size, _SMALLEST), self._largest),
        )

    def holds(self, placement: CameraPlacement) -> bool:
        """Whether a placement lies at the limits."""
        inside = (
            min(placement.x, placement.y) - self._edge,
            1 - self._edge - max(placement.x, placement.y),
            placement.size - _SMALLEST,
            self._largest - placement.size,
        )
        return min(inside) < _AT_LIMIT

    @cached_property
    def surely_upright(self) -> bool:
        """Whether the compass is sure, of the pictures as they come, that the eye stands upright, on either side."""
        if not self.of_an_eye:
            return False
        shares = self._log_shares(self.whole)
        return bool(shares[:2].max() > shares[2:].max() + _SURELY)

    def _upright(self, *, mirror: bool, quarter: int) -> float:
        """Of whole pictures that are mirrored and turned so, the logarithm of the share of an eye upright.

        It is the same wherever the view lies: asked of each view, the compass chose among sizes as well.
        """
        if not self.of_an_eye:
            return 0.0
        if (mirror, quarter) not in self._uprights:
            roll_deg = (90.0 * quarter + 180) % 360 - 180
            whole = [CameraPlacement(mirror=mirror, roll_deg=roll_deg, size=size) for size in _WHOLE]
            shares = [
                self._log_shares(moved)[0] for placement in whole for moved in _moved(placement, self._aspect)
            ]
            self._uprights[mirror, quarter] = float(np.mean(shares))
        return self._uprights[mirror, quarter]

    def _log_shares(self, placement: CameraPlacement) -> np.ndarray:
        """(8,) what the compass says of a view of all frames."""
        return eye_compass().log_shares(
            self.views(placement, self._pictures), of_right_eye=self._of_right_eye
        )

    def views(self, placement: CameraPlacement, pictures: np.ndarray) -> np.ndarray:
        """(n, height, width) uint8, levelled."""
        width, height = self._view
        views = np.stack(
            [placement.view(one, width=width, height=height, fades=self.fades) for one in pictures]
        )
        return levels_in([views], self._predictor.model.looks[self._camera]).apply(views)

    def _look(self, placement: CameraPlacement, pictures: np.ndarray) -> tuple[np.ndarray, dict[str, float]]:
        """Points (n, P, 2) in the view, and how good it is."""
        seen, deviations, likenesses = [], [], []
        for moved in _moved(placement, self._aspect):
            views = self.views(moved, pictures)
            estimates, traced = self._predictor.graph.see({self._camera: views})
            seen.append(traced[self._camera])
            deviations.append(estimates.deviation[:, self._part].mean())
            likenesses.append(self._likeness(views))
        matrices = [
            moved.picture_from_view(self._picture, self._view) for moved in _moved(placement, self._aspect)
        ]
        at = np.array(
            [
                points[:, self._points.followed] @ matrix[:, :2].T + matrix[:, 2]
                for points, matrix in zip(seen, matrices, strict=True)
            ]
        )
        unrest = np.sqrt(((at - at.mean(axis=0)) ** 2).sum(axis=-1).mean(axis=(0, 2)))
        # in the picture's pixels, as the unrest
        first, last = (self._points.followed.index(end) for end in self._points.ends)
        width = np.linalg.norm(at[0][:, last] - at[0][:, first], axis=-1)
        return seen[0], {
            "deviation": float(np.mean(deviations)),
            "unrest": float(np.median(unrest / np.maximum(width, 1.0))),
            "likeness": likenesses[0],
            "upright": self._upright(
                mirror=placement.mirror, quarter=round(placement.roll_deg / 90) % QUARTERS
            ),
        }

    def _likeness(self, views: np.ndarray) -> float:
        if self._typical is None:
            return 0.0
        return likeness(typical_picture(views, np.arange(len(views))), self._typical)


def _is_as_drawn(one: CameraPlacement, other: CameraPlacement, aspect: float) -> bool:
    """Whether two placements are no further apart than eyes in drawn headsets."""
    limits = (np.log(_DRAWN_SIZES), _DRAWN_PLACES, np.radians(_DRAWN_ROLL_DEG))
    return all(apart <= limit for apart, limit in zip(_apart(one, other, aspect), limits, strict=True))


def _apart(one: CameraPlacement, other: CameraPlacement, aspect: float) -> tuple[float, float, float]:
    """How far placements are apart in pictures of an aspect: log of the size, shares of the view's width, radians."""
    moved = np.hypot(one.x - other.x, (one.y - other.y) / aspect) / one.size
    turned = np.radians((one.roll_deg - other.roll_deg + 180) % 360 - 180)
    return float(abs(np.log(one.size / other.size))), float(moved), float(abs(turned))


def _moved(placement: CameraPlacement, aspect: float) -> Iterator[CameraPlacement]:
    for across, down, scale, turn_deg in _MOVES:
        yield replace(
            placement,
            x=placement.x + across * placement.size,
            y=placement.y + down * placement.size * aspect,
            size=placement.size * scale,
            roll_deg=(placement.roll_deg + turn_deg + 180) % 360 - 180,
        )
