"""Finds where in a camera's pictures the eye lies, by the network's own points and confidence.

A network's points lean towards where they lie in training: of an eye that is too large in the view it traces one that
is a little too large. So a single look says too little, and a placement is looked for at which the eye, as traced, is
just as large, as upright and in the place as in training; there the leaning stops. In training on drawn headsets eyes
are of every size, and what lies among them is left where it is. It is looked for from several sizes, upright and in a
mirror, then upside down and on its side, and that placement is taken whose points stay on the same pixels of the
picture when the view is moved, scaled and turned a little, and, half as much, at which the network is surest.

Steps may lead out of the picture, eyes as a network has never seen them. What the search holds back at its limits is no
placement, and the whole picture is given instead.
"""

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from regress.runtime.headset.eye_points import EyePoints
from regress.runtime.headset.levels import level_table
from regress.runtime.headset.looks import levels_of
from regress.runtime.headset.placement import CameraPlacement
from regress.runtime.headset.predictor import HeadsetPredictor

_FRAMES = 16
"""Of a take, evenly chosen, that are looked at."""

_STEPS = 6
"""In which a placement is refined from a start; a film of a real eye settles in five."""

_SIZES = (0.7, 1.0, 1.5)
_SMALLEST, _LARGEST, _EDGE = 0.3, 1.7, 0.1
"""Sizes of views over pictures (the largest over a picture's longer side), and how near to a picture's edge the middle
of a view may lie: beyond, the view shows repeated edges for the most part, in which networks see what they like."""

_AT_LIMIT = 0.01
"""How near to these a placement counts as held by them."""

_MOVES = ((0.0, 0.0, 1.0, 0.0), (-0.06, 0.03, 1.1, 6.0), (0.06, -0.03, 0.91, -6.0))
"""By how much the view is moved (of its width), scaled and turned to see whether points stay."""

_DRAWN_SIZES, _DRAWN_PLACES, _DRAWN_ROLL_DEG = 1.45, 0.17, 30.0
"""How far nine drawn eyes in ten lie from the usual one at most: times its iris, of the view's width, and degrees. A
network of drawn headsets knows them all, and is only led to what lies further out: led to the usual size it saw two
films of real eyes 1.5 and 1.7 times as small as they came, and traced both worse."""

_CALM, _SETTLED = 0.010, 0.1
"""Unrest and a further step below which frames are such as the network knows, and nothing else is looked for: 32
takes of unseen people with human eyes have .0067 to .024, two thirds below .010, and in a mirror .012 to .035."""

_CLEARLY = 0.9
"""Another start's score over that of the picture as it comes, below which it is taken: soft pictures of a camera that
sits well have a smaller one by chance."""

_TURNED = tuple(
    CameraPlacement(mirror=mirror, roll_deg=roll_deg, size=size)
    for roll_deg, size in ((180.0, 1.0), (-90.0, 1.0), (-90.0, 1.5), (90.0, 1.0), (90.0, 1.5))
    for mirror in (False, True)
)
"""Starts for cameras that stand upside down or lie on their side; then a picture is often higher than wide."""

_TURNED_SCORE = 0.75
"""A turned view's score over the best upright one's, below which it is taken: cameras are seldom so, and a network
that has not seen such eyes is now and then surer of them. Eight upright takes of rendered eyes have 1.0 or more by
either network, two films of real ones 1.1 or more. Turned, rendered ones have .21 to .67 by headset-tracking3, where no
upright start turned by itself, and .13 to .96 by headset-any, which misses three of eight upside down (one probe)."""


@dataclass(frozen=True, kw_only=True)
class FoundPlacement:
    """A placement, and how good the network finds what it sees there.

    Parameters
    ----------
    placement
        Without levels.
    deviation
        Mean predicted deviation of the camera's own shapes.
    unrest
        How far points move with the view, as a share of the traced eye's width; 0.06 is about half of the moves
        themselves. Of the usual eye's width it would fall with the size of the view alone.
    unsettled
        How far a further step would go if nothing held it: of the size, of the view's width, or of a radian.
    lost
        Whether the search was held at its limits: the placement is then that of the whole picture.
    """

    placement: CameraPlacement
    deviation: float
    unrest: float
    unsettled: float
    lost: bool = False

    @property
    def score(self) -> float:
        """The smaller, the better."""
        # of 20 drawn cameras 19 were told from their mirror images so, and 17 by the deviation itself
        return self.deviation**0.5 * self.unrest * (1 + 6 * self.unsettled)


def find_placement(predictor: HeadsetPredictor, camera: str, pictures: np.ndarray) -> FoundPlacement:
    """The best placement of an eye's pictures (n, h, w) uint8.

    Raises
    ------
    InputError
        See `EyePoints.of`.
    """
    points = EyePoints.of(predictor, camera)
    chosen = pictures[np.linspace(0, len(pictures) - 1, min(len(pictures), _FRAMES)).round().astype(int)]
    search = _Search(predictor, camera, points, chosen)
    as_it_is = search.best(CameraPlacement())
    if as_it_is.unrest < _CALM and as_it_is.unsettled < _SETTLED:
        return as_it_is
    others = [CameraPlacement(mirror=mirror, size=size) for mirror in (False, True) for size in _SIZES]
    upright = [as_it_is, *map(search.best, others[:1] + others[2:])]
    best = min(upright[1:], key=_score)
    if best.score > _CLEARLY * as_it_is.score:
        best = as_it_is
    turned = min(
        (one for one in map(search.best, _TURNED) if not search.holds(one.placement)),
        key=_score,
        default=best,
    )
    rival = best
    if search.holds(best.placement):  # its score is that of a view in which networks see what they like
        rival = min((one for one in upright if not search.holds(one.placement)), key=_score, default=best)
    found = turned if turned.score < min(best.score, _TURNED_SCORE * rival.score) else best
    if not search.holds(found.placement):
        return found
    return replace(found, placement=CameraPlacement(mirror=found.placement.mirror), lost=True)


def placement_of_points(
    placement: CameraPlacement,
    seen: np.ndarray,
    points: EyePoints,
    *,
    picture: tuple[int, int],
    view: tuple[int, int],
) -> CameraPlacement:
    """The placement at which points would lie as in training, if they lie so (n, P, 2) in the view of another one.

    The size is the iris's, which is nearly the same in all people; the place is that of the lids' middle, and upright
    is the line between the eye's corners. It may lie anywhere, and be of any size.
    """
    size = np.median(_diameters(seen[:, points.iris])) / _diameters(points.usual[None, points.iris])[0]
    middle = np.nanmedian(seen, axis=0)
    lids = points.upper + points.lower
    corners = [points.upper[0], points.upper[-1]]
    turned = _angle(middle[corners]) - _angle(points.usual[corners])
    turn = size * np.array([[np.cos(turned), -np.sin(turned)], [np.sin(turned), np.cos(turned)]])
    matrix = placement.picture_from_view(picture, view)
    linear = matrix[:, :2] @ turn
    offset = (
        matrix[:, :2] @ (middle[lids].mean(axis=0) - turn @ points.usual[lids].mean(axis=0)) + matrix[:, 2]
    )
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


class _Search:
    """Looks at a take's frames (n, h, w) at one placement after the other."""

    def __init__(
        self, predictor: HeadsetPredictor, camera: str, points: EyePoints, pictures: np.ndarray
    ) -> None:
        self._predictor, self._camera, self._points, self._pictures = predictor, camera, points, pictures
        self._view = predictor.sizes[camera]
        self._picture = (pictures.shape[2], pictures.shape[1])
        self._largest = _LARGEST * max(self._picture) / self._picture[0]
        names = predictor.model.weights
        self._part = [names.index(name) for name in predictor.model.parts[camera]]

    def best(self, start: CameraPlacement) -> FoundPlacement:
        """The best of the placements through which the steps from a start go."""
        placement, found = start, []
        for _ in range(_STEPS):
            seen, quality = self._look(placement)
            following = placement_of_points(
                placement, seen, self._points, picture=self._picture, view=self._view
            )
            if self._predictor.model.camera_terms and _is_as_drawn(placement, following):
                following = placement
            found.append(
                FoundPlacement(placement=placement, unsettled=_distance(placement, following), **quality)
            )
            placement = self._held(following)
        return min(found, key=lambda one: one.score)

    def _held(self, placement: CameraPlacement) -> CameraPlacement:
        """The nearest placement within the limits."""
        return replace(
            placement,
            x=min(max(placement.x, _EDGE), 1 - _EDGE),
            y=min(max(placement.y, _EDGE), 1 - _EDGE),
            size=min(max(placement.size, _SMALLEST), self._largest),
        )

    def holds(self, placement: CameraPlacement) -> bool:
        """Whether a placement lies at the limits."""
        inside = (
            min(placement.x, placement.y) - _EDGE,
            1 - _EDGE - max(placement.x, placement.y),
            placement.size - _SMALLEST,
            self._largest - placement.size,
        )
        return min(inside) < _AT_LIMIT

    def views(self, placement: CameraPlacement) -> np.ndarray:
        """(n, height, width) uint8, levelled, with plain streaks beyond the edges: they make wrong places restless."""
        width, height = self._view
        views = np.stack(
            [placement.view(one, width=width, height=height, fades=False) for one in self._pictures]
        )
        return level_table(*levels_of(views), self._predictor.model.looks[self._camera])[views]

    def _look(self, placement: CameraPlacement) -> tuple[np.ndarray, dict[str, float]]:
        """Points (n, P, 2) in the view, and how good it is."""
        seen, deviations = [], []
        for moved in _moved(placement):
            estimates, traced = self._predictor.graph.see({self._camera: self.views(moved)})
            seen.append(traced[self._camera])
            deviations.append(estimates.deviation[:, self._part].mean())
        matrices = [moved.picture_from_view(self._picture, self._view) for moved in _moved(placement)]
        lids_and_iris = self._points.upper + self._points.lower + self._points.iris
        at = np.array(
            [
                points[:, lids_and_iris] @ matrix[:, :2].T + matrix[:, 2]
                for points, matrix in zip(seen, matrices, strict=True)
            ]
        )
        unrest = np.sqrt(((at - at.mean(axis=0)) ** 2).sum(axis=-1).mean(axis=(0, 2)))
        # in the picture's pixels, as the unrest; the first lids begin and end with the eye's corners
        upper = len(self._points.upper)
        eye = np.linalg.norm(at[0][:, upper - 1] - at[0][:, 0], axis=-1)
        return seen[0], {
            "deviation": float(np.mean(deviations)),
            "unrest": float(np.median(unrest / np.maximum(eye, 1.0))),
        }


def _score(found: FoundPlacement) -> float:
    return found.score


def _distance(one: CameraPlacement, other: CameraPlacement) -> float:
    """How far two placements are apart: of the size, of the view's width, or of a radian."""
    return max(_apart(one, other))


def _is_as_drawn(one: CameraPlacement, other: CameraPlacement) -> bool:
    """Whether two placements are no further apart than eyes in drawn headsets."""
    limits = (np.log(_DRAWN_SIZES), _DRAWN_PLACES, np.radians(_DRAWN_ROLL_DEG))
    return all(apart <= limit for apart, limit in zip(_apart(one, other), limits, strict=True))


def _apart(one: CameraPlacement, other: CameraPlacement) -> tuple[float, float, float]:
    """By how much two placements differ: logarithm of the size, shares of the view's width, radians."""
    moved = np.hypot(one.x - other.x, one.y - other.y) / one.size
    turned = np.radians((one.roll_deg - other.roll_deg + 180) % 360 - 180)
    return float(abs(np.log(one.size / other.size))), float(moved), float(abs(turned))


def _moved(placement: CameraPlacement) -> Iterator[CameraPlacement]:
    for across, down, scale, turn_deg in _MOVES:
        yield replace(
            placement,
            x=placement.x + across * placement.size,
            y=placement.y + down * placement.size,
            size=placement.size * scale,
            roll_deg=(placement.roll_deg + turn_deg + 180) % 360 - 180,
        )


def _diameters(outlines: np.ndarray) -> np.ndarray:
    """(n,) of irises (n, k, 2): their points lie on ellipses, evenly."""
    return 2 * np.linalg.norm(outlines - outlines.mean(axis=1, keepdims=True), axis=2).mean(axis=1)


def _angle(corners: np.ndarray) -> float:
    across, down = corners[1] - corners[0]
    return float(np.arctan2(down, across))
