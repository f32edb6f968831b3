"""Measures winks: one eye is shut, and the other eye's blink should stay at rest."""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, LANDMARK_GROUPS
from regress.learning.probes.faces import ProbeFaces, frontal
from regress.learning.probes.methods import Method
from regress.targets import OUTPUTS

SHUT = 0.9
"""Both blinks reach this in the faces that lend their lids."""

_SIDES = (("Left", "Right"), ("Right", "Left"))


@dataclass(frozen=True, kw_only=True)
class Winks:
    """Blinks that one method sees on frontal faces of which one eye is shut.

    The face is a person's neutral one with the lids of one eye from a face of the same person with both eyes shut:
    lids close on the ball, which no sum of displacements gives, and few people of a dataset wink.

    Shut lids do not say how far past contact a weight went: of the default dataset's faces with an eye shut the blink
    is 0.66 in the mean, as looking down closes lids too. So ``shut`` is to be held against ``both``, not ``true``.

    Parameters
    ----------
    method : str
    calibrated : bool
    count : int
        Faces with both eyes shut, each of which gives two winks.
    true, shut, leak : float
        Mean true weight of the shut eye's blink, what is said of it, and what is said of the open eye's; NaN where
        nobody shuts the eyes.
    both : float
        What is said of either blink where both eyes of the same neutral faces are shut so.
    """

    method: str
    calibrated: bool
    count: int
    true: float
    shut: float
    leak: float
    both: float


def winks(method: Method, faces: ProbeFaces, neutral: ProbeFaces) -> Winks:
    """Let everyone wink who shuts both eyes in ``faces``; ``neutral`` are the same people's neutral faces."""
    both = np.minimum(*(faces.weights[:, BLENDSHAPE_INDEX[f"eyeBlink{side}"]] for side, _ in _SIDES))
    rows = np.flatnonzero(both >= SHUT)
    faces, neutral = faces.take(rows), neutral.take(rows)
    blinks = {"true": [], "shut": [], "leak": [], "both": []}

    def outputs(*sides: str) -> dict[str, np.ndarray]:
        """What is said of the blinks of neutral faces with the lids of some sides shut."""
        lids = [landmark for side in sides for landmark in LANDMARK_GROUPS[f"{side.lower()}_eye"]]
        points_m = neutral.points_m.copy()
        points_m[:, lids] = faces.points_m[:, lids]
        weights = method.predict(frontal(points_m, neutral), frontal(neutral.points_m, neutral))
        return {side: weights[:, OUTPUTS.index(f"eyeBlink{side}")] for side, _ in _SIDES}

    blink = outputs("Left", "Right") if len(rows) else {}
    for side, other in _SIDES if len(rows) else ():
        wink = outputs(side)
        blinks["true"].append(faces.weights[:, BLENDSHAPE_INDEX[f"eyeBlink{side}"]])
        blinks["shut"].append(wink[side])
        blinks["leak"].append(wink[other])
        blinks["both"].append(blink[side])
    means = {name: float(np.mean(values)) if values else float("nan") for name, values in blinks.items()}
    return Winks(method=method.name, calibrated=method.calibrated, count=len(rows), **means)
