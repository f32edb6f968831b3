"""Whether cameras' pictures look as training's did: not turned, not mirrored, not those of another camera."""

from collections.abc import Mapping

import cv2
import numpy as np

from regress.headset.footage import Footage
from regress.headset.parts import mirror_partner

_SIDE = 24
"""Pixels of the squares that are compared: a brow, a lid and a lip are still told apart, and people are not."""

_PICTURES = 1024
"""Evenly chosen, of which a mean is made: more do not change it."""

_ALIKE, _MARGIN = 0.5, 0.1
"""Correlation from which pictures look like others, and how much less it is as they are.

Takes of 364 people (six sets: another headset, other heads, more light and a loose strap among them) never pass the
margin; turned, mirrored or exchanged, 83 to 100 % of them do in each set, but for the mouth in a mirror, which looks
the same, and the mouth upside down in another headset (`benchmarks/headset_orientation.py`).
"""

_TURNS = {
    "turned by 90° to the left": lambda picture: np.rot90(picture, -1),
    "turned by 90° to the right": np.rot90,
    "turned by 180°": lambda picture: picture[::-1, ::-1],
    "turned upside down in a mirror": lambda picture: picture[::-1],
}
"""What may have happened to pictures, and what makes it good."""


def typical_picture(pictures: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Mean of pictures as a small square, by which their camera is known again.

    Parameters
    ----------
    pictures : (n, h, w) uint8
    rows : (k,) int
        Of pictures that count, at least one.

    Returns
    -------
    (24, 24) uint8
    """
    chosen = rows[:: -(-len(rows) // _PICTURES)]
    mean = np.mean(pictures[chosen], axis=0, dtype=np.float32)
    return np.rint(cv2.resize(mean, (_SIDE, _SIDE), interpolation=cv2.INTER_AREA)).astype(np.uint8)


def told_orientation(footage: Footage, typical: Mapping[str, np.ndarray]) -> list[str]:
    """A sentence for each camera whose pictures look more like something else than like its own of training.

    Parameters
    ----------
    footage
        What was recorded.
    typical
        Of training, by camera (``typical_picture``); of cameras that are left out nothing is said.
    """
    told = []
    for column, name in enumerate(footage.cameras):
        rows = np.flatnonzero(footage.present[:, column])
        if name not in typical or not len(rows):
            continue
        seen = typical_picture(footage.pictures[name], rows)
        plain = _correlation(seen, typical[name])
        found = _likenesses(seen, name, typical)
        what = max(found, key=found.__getitem__)
        if found[what] > _ALIKE and found[what] > plain + _MARGIN:
            told.append(
                f"{name}: its pictures look more like {what} than like those it had in training (correlation "
                f"{found[what]:.2f} against {plain:.2f}); are cameras mixed up, or turned?"
            )
    return told


def _likenesses(seen: np.ndarray, name: str, typical: Mapping[str, np.ndarray]) -> dict[str, float]:
    """Correlation with everything else that pictures of a camera may be."""
    found = {f"its own {turn}": _correlation(undo(seen), typical[name]) for turn, undo in _TURNS.items()}
    found |= {f"those of {other}": _correlation(seen, typical[other]) for other in typical if other != name}
    mirrored, partner = _correlation(seen[:, ::-1], typical[name]), mirror_partner(name)
    if partner == name or partner not in typical:
        return found | {"its own in a mirror": mirrored}
    # faces are symmetric: these two are the same to the eye
    return found | {
        f"those of {partner} or its own in a mirror": max(mirrored, found.pop(f"those of {partner}"))
    }


def _correlation(one: np.ndarray, other: np.ndarray) -> float:
    """Of grey levels; 0 where a picture has one only."""
    one, other = (picture - picture.mean(dtype=np.float64) for picture in (one, other))
    size = np.sqrt((one**2).sum() * (other**2).sum())
    return float((one * other).sum() / size) if size > 0 else 0.0
