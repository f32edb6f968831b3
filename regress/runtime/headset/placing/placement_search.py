"""Finds where in a camera's pictures the eye or the mouth lies, by the network's own points and confidence.

A placement is looked for from several sizes, upright and in a mirror; then upside down and on its side, unless the
compass is sure that the eye is upright. That one is taken whose points stay on the same pixels of the picture when the
view is moved, scaled and turned a little, at which, half as much, the network is surest, whose view is most like
training's mean picture, and shows an eye upright by the compass.

Steps may lead out of the picture, eyes as a network has never seen them. What the search holds back at its limits is no
placement, and the whole picture is given instead.

Beyond the edges the search sees plain streaks first, which make wrong places restless. Of an eye that fills its picture
the view is streaks for the most part. Where what was found is doubtful, all is looked for once more, further out, with
streaks that fade. A mouth is looked for there at once, and in no mirror, since it is one in a mirror too.
"""

from dataclasses import replace

import numpy as np

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import HeadsetPredictor
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.mouth_points import MouthPoints
from regress.runtime.headset.placing.placement_steps import Search

_FRAMES, _FRAMES_DRAWN = 16, 64
"""Of a take, evenly chosen, that are looked at; the latter by networks of drawn headsets, which know no usual picture.
By 16 `headset-any` took a film's eye for the other one in 2 of 22 parts of two films, by all in none;
`headset-tracking3` did in none by either."""

_SIZES = (0.7, 1.0, 1.5)
"""Of views over pictures, from which a placement is looked for."""

_CALM, _SETTLED = 0.010, 0.1
"""Unrest and a further step below which frames are such as the network knows, and nothing else is looked for: 32
takes of unseen people with human eyes have .0067 to .024, two thirds below .010, and in a mirror .012 to .035."""

_CLEARLY = 0.9
"""Another start's score over that of the picture as it comes, below which it is taken: soft pictures of a camera that
sits well have a smaller one by chance."""

_DOUBTFUL, _SURER = 0.013, 0.6
"""Doubt from which a placement is doubtful, and what the score of one with fading edges has to be of it. Twenty
rendered takes have .002 to .010, a film that comes near .011 to .028. A network of drawn headsets does not look again:
with fading edges it took two films on their side, or upside down, for upright ones."""

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


CALM_MOUTH, _RESTLESS = 0.017, 0.04
"""Unrest of a mouth below which nothing else is looked for, and from which none is found. Pictures of 16 rendered
people, changed in 16 ways, have .016 or less where a mouth is found, and .027 where they end at the nose; one picture
of a real mouth .024 to .037, and .045 or more where it is not found. Turned ones have .035 or more as they come."""


def find_placement(predictor: HeadsetPredictor, camera: str, pictures: np.ndarray) -> FoundPlacement:
    """The best placement of pictures (n, h, w) uint8 of an eye, or of a mouth.

    Raises
    ------
    InputError
        See `EyePoints.of`, of cameras that do not trace a mouth.
    """
    mouth = MouthPoints.of(predictor, camera)
    points = mouth or EyePoints.of(predictor, camera)
    chosen = pictures[
        even_rows(len(pictures), _FRAMES_DRAWN if predictor.model.of_many_headsets else _FRAMES)
    ]
    if mouth is not None:
        search = Search(predictor, camera, points, chosen, fades=True)
        found = _found(search)
        return found if found.unrest < _RESTLESS else replace(found, placement=search.whole, lost=True)
    plain = _found(Search(predictor, camera, points, chosen, fades=False))
    if predictor.model.of_many_headsets or not (plain.lost or plain.turned or plain.doubt > _DOUBTFUL):
        return plain
    faded = _found(Search(predictor, camera, points, chosen, fades=True))
    upright_again = plain.turned and not faded.turned
    if plain.lost or (not faded.lost and (upright_again or faded.score < _SURER * plain.score)):
        return faded
    return plain


def _found(search: Search) -> FoundPlacement:
    """The best of all starts."""
    as_it_is = search.best(search.whole)
    if as_it_is.unrest < (_CALM if search.of_an_eye else CALM_MOUTH) and as_it_is.unsettled < _SETTLED:
        return as_it_is
    sides = (False, True) if search.of_an_eye else (False,)
    others = [CameraPlacement(mirror=mirror, size=size) for mirror in sides for size in _SIZES]
    upright = [as_it_is, *(search.best(start) for start in others if start != search.whole)]
    best = min(upright[1:], key=_score)
    if best.score > _CLEARLY * as_it_is.score:
        best = as_it_is
    turned_starts = () if search.surely_upright else [start for start in _TURNED if start.mirror in sides]
    turned = min(
        (one for one in map(search.best, turned_starts) if not search.holds(one.placement)),
        key=_score,
        default=best,
    )
    rival = best
    if search.holds(best.placement):  # its score is that of a view in which networks see what they like
        rival = min((one for one in upright if not search.holds(one.placement)), key=_score, default=best)
    found = turned if turned.score < min(best.score, _TURNED_SCORE * rival.score) else best
    if not search.holds(found.placement):
        return found
    return replace(found, placement=replace(search.whole, mirror=found.placement.mirror), lost=True)


def _score(found: FoundPlacement) -> float:
    return found.score
