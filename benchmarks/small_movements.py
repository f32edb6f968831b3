"""Asks a model about movements that recordings seldom isolate: winks, a turned head, a still face, slight movements.

`real_recordings.py` runs it on people of a rig that the model was not trained on. Every person has a detector's bias,
and every frame its jitter; the neutral face is the median of ten such frames.
"""

from dataclasses import dataclass

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.rigs import Rig, evaluate
from facegen.sampling.gaze import axes_from_weights
from regress import Model
from regress.learning.training.noise import OUTER_EYES, displace, draw_bias
from regress.targets import VISIBLE_SHAPES

OUTER_EYE_PX = 100.0
CAMERA_DISTANCE_M = 0.8
"""Of a person before a webcam."""

YAW_DEG = 20.0
SLIGHT = (0.0, 0.05, 0.1, 0.15, 0.2)
"""True weights of slight movements; rest is among them, so that a slope says what a movement adds to it."""
_REPEATS = 10
_STILL_FRAMES = 60
_NEUTRAL_FRAMES = 10
_SEED = 3
_WINKS = (("eyeBlinkLeft", "eyeBlinkRight"), ("eyeBlinkRight", "eyeBlinkLeft"))
_GUESSED = "eyeLook"


def project(rig: Rig, identity: np.ndarray, weights: np.ndarray, yaw_deg: float = 0.0) -> np.ndarray:
    """Exact points (n, 68, 2), pixels, of one person before the camera; 100 px between the outer eyes at rest."""
    weights = np.concatenate([np.zeros((1, weights.shape[1])), weights])
    who = np.broadcast_to(identity, (len(weights), len(identity)))
    points = evaluate(rig, who, weights, axes_from_weights(weights), cage_only=True).landmarks
    right, left = OUTER_EYES
    ahead = _picture(points[:1])[0]
    scale = OUTER_EYE_PX / np.linalg.norm(ahead[left] - ahead[right])
    angle = np.radians(yaw_deg)
    turn = np.array([[np.cos(angle), 0, np.sin(angle)], [0, 1, 0], [-np.sin(angle), 0, np.cos(angle)]])
    centre = points[0].mean(axis=0)
    return _picture((points[1:] - centre) @ turn.T + centre if yaw_deg else points[1:]) * scale


def _picture(points_m: np.ndarray) -> np.ndarray:
    return points_m[..., :2] * [1, -1] / (CAMERA_DISTANCE_M - points_m[..., 2:])


@dataclass(frozen=True, kw_only=True)
class Seen:
    """One person before a detector of one bias, whose jitter goes on."""

    rig: Rig
    identity: np.ndarray
    bias: np.ndarray
    noise_px: float
    rng: np.random.Generator

    def points(self, weights: np.ndarray, yaw_deg: float = 0.0) -> np.ndarray:
        """Points (n, 68, 2) of weights (n, 52), pixels."""
        exact = project(self.rig, self.identity, weights, yaw_deg)
        biased = displace(exact, np.broadcast_to(self.bias, exact.shape))
        return biased + self.noise_px * self.rng.standard_normal(exact.shape)


def small_movements(model: Model, rig: Rig, *, people: int, noise_px: float = 1.0) -> dict[str, object]:
    """Figures of the four questions, means over people.

    Returns
    -------
    dict
        ``wink``: own eye, other eye and, by shape, the most of all others; ``yaw``: by shape, the mean weight that a
        head turned by 20 degrees gives a face at rest; ``still``: standard deviation by shape on a still face, per px;
        ``slight``: by shape, slope and r of answers to true weights of 0 to 0.2, and how much an answer of slope 1
        trembles at least, a px: that of least squares which knows that no other shape moves (on the mean face).
    """
    rng = np.random.default_rng(_SEED)
    identities = rng.standard_normal((people, rig.components))
    shapes = [name for name in VISIBLE_SHAPES if not name.startswith(_GUESSED) and name != "mouthClose"]
    winked, yawed, trembled, slight = [], [], [], []
    for identity, bias in zip(identities, draw_bias(rng, people), strict=True):
        seen = Seen(rig=rig, identity=identity, bias=bias, noise_px=noise_px, rng=rng)
        calibrated = model.calibrate(seen.points(np.zeros((_NEUTRAL_FRAMES, len(BLENDSHAPES)))))
        winks = np.repeat([_one(own) for own, _ in _WINKS], _REPEATS, axis=0)
        winked.append(calibrated.predict(seen.points(winks)).reshape(2, _REPEATS, -1).mean(axis=1))
        rest = np.zeros((_REPEATS, len(BLENDSHAPES)))
        yawed.append([calibrated.predict(seen.points(rest, sign * YAW_DEG)).mean(axis=0) for sign in (-1, 1)])
        still = np.zeros((_STILL_FRAMES, len(BLENDSHAPES)))
        trembled.append(calibrated.predict(seen.points(still)).std(axis=0))
        slight.append([_slope(calibrated, seen, name) for name in shapes])
    wink, slopes = np.mean(winked, axis=0), np.mean(slight, axis=0)
    own, other = (
        [wink[row, BLENDSHAPE_INDEX[pair[which]]] for row, pair in enumerate(_WINKS)] for which in (0, 1)
    )
    blinks = {name for pair in _WINKS for name in pair}
    return {
        "wink": {
            "own": float(np.mean(own)),
            "other": float(np.mean(other)),
            "else": {n: float(wink[:, i].max()) for n, i in BLENDSHAPE_INDEX.items() if n not in blinks},
        },
        "yaw": dict(zip(BLENDSHAPES, np.mean(yawed, axis=0).max(axis=0).tolist(), strict=True)),
        "still": dict(zip(BLENDSHAPES, (np.mean(trembled, axis=0) / noise_px).tolist(), strict=True)),
        "slight": {
            name: {"slope": float(slope), "r": float(r), "trembles": float(trembles)}
            for name, (slope, r), trembles in zip(shapes, slopes, _least_tremble(rig, shapes), strict=True)
        },
    }


def _one(name: str) -> np.ndarray:
    weights = np.zeros(len(BLENDSHAPES))
    weights[BLENDSHAPE_INDEX[name]] = 1.0
    return weights


def _slope(calibrated: Model, seen: Seen, name: str) -> tuple[float, float]:
    true = np.repeat(SLIGHT, _REPEATS)
    said = calibrated.predict(seen.points(true[:, None] * _one(name)))[:, BLENDSHAPE_INDEX[name]]
    r = np.corrcoef(true, said)[0, 1] if said.std() > 1e-9 else 0.0
    return np.polyfit(true, said, 1)[0], r


def _least_tremble(rig: Rig, shapes: list[str]) -> np.ndarray:
    """Standard deviation (n,), a px, of the best unbiased answer for each shape where all others are known to rest.

    One over the length of the movement, a unit of weight, over all 136 coordinates (Gauss and Markov). The neutral face
    is off too, by a constant, which trembles no answer.
    """
    moved = np.stack([np.zeros(len(BLENDSHAPES)), *(SLIGHT[-1] * _one(name) for name in shapes)])
    points = project(rig, np.zeros(rig.components), moved)
    movement = (points[1:] - points[0]) / SLIGHT[-1]
    return 1 / np.linalg.norm(movement, axis=(1, 2))


def tell_movements(figures: dict) -> None:
    """Print the figures, in Markdown."""
    wink, guessed = figures["wink"], [name for name in BLENDSHAPES if name.startswith(_GUESSED)]
    print(f"\n## d. Small movements, rig {figures['rig']}\n")
    print("| question | answer |\n|---|---|")
    print(f"| wink: own eye / other eye | {wink['own']:.2f} / {wink['other']:.2f} |")
    for what, values in (
        ("wink: most of other shapes", wink["else"]),
        ("head turned by 20 degrees", figures["yaw"]),
    ):
        for kind, names in (
            ("gaze, guessed from lids", guessed),
            ("others", [n for n in values if n not in guessed]),
        ):
            worst = max(names, key=values.__getitem__)
            print(f"| {what}, {kind} | {worst} {values[worst]:.2f} |")
    still = figures["still"]
    means = (np.mean([still[name] for name in names]) for names in (VISIBLE_SHAPES, list(still)))
    print(
        f"| a still face trembles by, a px (visible / all) | {' / '.join(f'{mean:.4f}' for mean in means)} |"
    )
    bound = [row["trembles"] for row in figures["slight"].values()]
    print(
        f"| an unbiased answer trembles at least by, a px: median (least) | {np.median(bound):.3f} ({min(bound):.3f}) |"
    )
    for key in ("slope", "r"):
        values = [row[key] for row in figures["slight"].values()]
        print(f"| slight movements: {key}, median (least) | {np.median(values):.2f} ({min(values):.2f}) |")
