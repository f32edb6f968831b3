"""Whether cameras' pictures look as training's did: not turned, not mirrored, not those of another camera."""

from collections.abc import Mapping

import numpy as np

from regress.runtime.even_rows import even_rows
from regress.runtime.headset.network.parts import is_of_one_eye, is_symmetric, mirror_partner, side_of
from regress.runtime.headset.pictures.picture_file import ASPECT
from regress.runtime.headset.pictures.typical import likeness, typical_picture
from regress.runtime.headset.placing.compass import QUARTERS, EyeCompass
from regress.runtime.headset.recordings.footage import Footage

_ALIKE, _MARGIN = 0.5, 0.1
"""Correlation from which pictures look like others, and how much less it is as they are.

Takes of 364 people (six sets: another headset, other heads, more light and a loose strap among them) never pass the
margin; turned, mirrored or exchanged, 83 to 100 % of them do in each set, but for the mouth in a mirror, which looks
the same, and the mouth upside down in another headset (`benchmarks/headset_orientation.py`).
"""

_ALIKE_ON_ITS_SIDE = 0.65
"""The same of pictures on their side. Those of rendered people have .84 and more in training's headset, .76 in another,
and one real mouth, upright, .55 for .25 as it is."""

_VIEWS = 64
"""Of a take, evenly chosen, that the compass sees."""

_TURNS = {
    "its own turned by 90° to the left": lambda picture: np.rot90(picture, -1),
    "its own turned by 90° to the right": np.rot90,
}
"""What may have happened to square pictures, and what makes it good; others would be of another shape."""

_SURE = 0.4
"""Logarithm of how many times the share of an eye upright another orientation's has to be, from which it is told.

Of 120 drawn headsets' eyes upright none comes near (-1.6 at most). Two films of real ones, as 14 cameras show them,
pass it once in 28 on their right side, and 24 times in 28 on the wrong one (``python -m benchmarks.eye_compass``).
"""


def told_orientation(footage: Footage, typical: Mapping[str, np.ndarray]) -> list[str]:
    """A sentence for each camera whose pictures look more like something else than like its own of training.

    Parameters
    ----------
    footage
        What was recorded.
    typical
        Of training, by camera (``regress.runtime.headset.pictures.typical``); of those left out nothing is said.
    """
    told = []
    for column, name in enumerate(footage.cameras):
        rows = np.flatnonzero(footage.present[:, column])
        if name not in typical or not len(rows):
            continue
        seen = typical_picture(footage.pictures[name], rows)
        plain = likeness(seen, typical[name])
        found = _likenesses(seen, name, typical, footage)
        least = {what: _ALIKE_ON_ITS_SIDE if what in _TURNS else _ALIKE for what in found}
        alike = [what for what in found if found[what] > max(least[what], plain + _MARGIN)]
        if alike:
            what = max(alike, key=found.__getitem__)
            told.append(
                f"{name}: its pictures look more like {what} than like those it had in training (correlation "
                f"{found[what]:.2f} against {plain:.2f}); are cameras mixed up, or turned?"
            )
    return told


def told_by_compass(footage: Footage, compass: EyeCompass) -> list[str]:
    """A sentence for each camera of one eye whose pictures look more like an eye turned or mirrored, in any headset."""
    told = []
    for column, name in enumerate(footage.cameras):
        rows = np.flatnonzero(footage.present[:, column])
        if not is_of_one_eye(name) or not len(rows):
            continue
        chosen = rows[even_rows(len(rows), _VIEWS)]
        shares = compass.log_shares(footage.pictures[name][chosen], of_right_eye=side_of(name) == "right")
        lying = told_of_shares(name, shares)
        told += [f"{name}: {lying}"] if lying else []
    return told


def told_of_shares(name: str, shares: np.ndarray) -> str | None:
    """What the compass's mean logarithms (8,) say of a camera of one eye, unless that it is upright or nothing sure."""
    best = int(np.argmax(shares))
    if shares[best] <= shares[0] + _SURE:
        return None
    return (
        f"its pictures look more like those of {_lying(best, name)} than like a {side_of(name)} eye upright; are "
        f"cameras mixed up, or turned?"
    )


def _lying(orientation: int, name: str) -> str:
    """How an eye lies in pictures of an orientation, in words."""
    quarter, mirrored = divmod(orientation, 2)
    turned = ("", "on its side", "upside down", "on its side")[quarter % QUARTERS]
    if not mirrored:
        return f"an eye {turned}"
    return f"{mirror_partner(name)} or of an eye in a mirror{turned and ', '}{turned}{turned and ','}"


def _likenesses(
    seen: np.ndarray, name: str, typical: Mapping[str, np.ndarray], footage: Footage
) -> dict[str, float]:
    """Correlation with everything else that pictures of a camera may be."""
    own = typical[name]
    aspects = {
        other: footage.pictures[other].shape[2] / footage.pictures[other].shape[1] for other in typical
    }
    turns = _TURNS if abs(aspects[name] - 1) < ASPECT else {}
    found = {what: likeness(undo(seen), own) for what, undo in turns.items()}
    for other in typical:
        if other != name and abs(aspects[other] / aspects[name] - 1) < ASPECT:
            found[f"those of {other}"] = likeness(seen, typical[other])
    mirrored, turned, flipped = (likeness(one, own) for one in (seen[:, ::-1], seen[::-1, ::-1], seen[::-1]))
    # Faces are symmetric: a mouth turned is a mouth in a mirror, and one eye in a mirror is the other.
    if is_symmetric((name,)):
        return found | {"its own upside down": max(turned, flipped), "its own in a mirror": mirrored}
    found |= {"its own turned by 180°": turned, "its own upside down in a mirror": flipped}
    other = f"those of {mirror_partner(name)}"
    if other not in found:
        return found | {"its own in a mirror": mirrored}
    return found | {f"{other} or its own in a mirror": max(mirrored, found.pop(other))}
