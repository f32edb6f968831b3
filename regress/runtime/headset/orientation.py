"""Whether cameras' pictures look as training's did: not turned, not mirrored, not those of another camera."""

from collections.abc import Mapping

import numpy as np

from regress.runtime.headset.footage import Footage
from regress.runtime.headset.parts import is_symmetric, mirror_partner
from regress.runtime.headset.pictures import ASPECT
from regress.runtime.headset.typical import likeness, typical_picture

_ALIKE, _MARGIN = 0.5, 0.1
"""Correlation from which pictures look like others, and how much less it is as they are.

Takes of 364 people (six sets: another headset, other heads, more light and a loose strap among them) never pass the
margin; turned, mirrored or exchanged, 83 to 100 % of them do in each set, but for the mouth in a mirror, which looks
the same, and the mouth upside down in another headset (`benchmarks/headset_orientation.py`).
"""

_QUARTERS = {
    "its own turned by 90° to the left": lambda picture: np.rot90(picture, -1),
    "its own turned by 90° to the right": np.rot90,
}
"""What may have happened to square pictures, and what makes it good; others would be of another shape."""


def told_orientation(footage: Footage, typical: Mapping[str, np.ndarray]) -> list[str]:
    """A sentence for each camera whose pictures look more like something else than like its own of training.

    Parameters
    ----------
    footage
        What was recorded.
    typical
        Of training, by camera (``regress.runtime.headset.typical``); of cameras that are left out nothing is said.
    """
    told = []
    for column, name in enumerate(footage.cameras):
        rows = np.flatnonzero(footage.present[:, column])
        if name not in typical or not len(rows):
            continue
        seen = typical_picture(footage.pictures[name], rows)
        plain = likeness(seen, typical[name])
        found = _likenesses(seen, name, typical, footage)
        what = max(found, key=found.__getitem__)
        if found[what] > _ALIKE and found[what] > plain + _MARGIN:
            told.append(
                f"{name}: its pictures look more like {what} than like those it had in training (correlation "
                f"{found[what]:.2f} against {plain:.2f}); are cameras mixed up, or turned?"
            )
    return told


def _likenesses(
    seen: np.ndarray, name: str, typical: Mapping[str, np.ndarray], footage: Footage
) -> dict[str, float]:
    """Correlation with everything else that pictures of a camera may be."""
    own = typical[name]
    aspects = {
        other: footage.pictures[other].shape[2] / footage.pictures[other].shape[1] for other in typical
    }
    turns = _QUARTERS if abs(aspects[name] - 1) < ASPECT else {}
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
