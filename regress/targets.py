"""Lists what is predicted: 31 networks grouped by face region, and which shapes 68 points can show."""

import re
from dataclasses import dataclass

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES

_WORD = re.compile(r"[a-z][a-z0-9_]{0,39}")
"""What a region or a network is called: exports, tables and records have these names."""


@dataclass(frozen=True, kw_only=True)
class Network:
    """One small network and the blendshapes it gives.

    Parameters
    ----------
    region
        Region of the face, for example ``"eyes"``.
    name
        Name within the region, for example ``"blink"``; ``squint`` and ``sideways`` exist in two regions.
    outputs
        ARKit names, left before right.
    """

    region: str
    name: str
    outputs: tuple[str, ...]

    def __post_init__(self) -> None:
        """Refuse names that are no words, and shapes that nobody knows or that come twice."""
        for word in (self.region, self.name):
            if not _WORD.fullmatch(word):
                raise ValueError(
                    f"{word[:60]!r} is no name of a region or a network: up to 40 small letters, digits and "
                    f"underscores, a letter first"
                )
        unknown = [name for name in self.outputs if name not in BLENDSHAPE_INDEX]
        if unknown:
            raise ValueError(f"network {self.key} gives {unknown[0][:60]!r}, which is none of the 52 shapes")
        if not self.outputs or len(set(self.outputs)) < len(self.outputs):
            raise ValueError(f"network {self.key} gives no shape, or one of them twice")

    @property
    def key(self) -> str:
        """Name that is unique among the 31, for example ``"eyes.blink"``."""
        return f"{self.region}.{self.name}"


def _both(stem: str) -> tuple[str, str]:
    return (f"{stem}Left", f"{stem}Right")


_OUTPUTS: dict[str, dict[str, tuple[str, ...]]] = {
    "eyes": {
        "blink": _both("eyeBlink"),
        "look_down": _both("eyeLookDown"),
        "look_in": _both("eyeLookIn"),
        "look_out": _both("eyeLookOut"),
        "look_up": _both("eyeLookUp"),
        "squint": _both("eyeSquint"),
        "wide": _both("eyeWide"),
    },
    "jaw": {
        "open": ("jawOpen",),
        "forward": ("jawForward",),
        "sideways": _both("jaw"),
    },
    "mouth": {
        "close": ("mouthClose",),
        "funnel": ("mouthFunnel",),
        "pucker": ("mouthPucker",),
        "sideways": _both("mouth"),
        "smile": _both("mouthSmile"),
        "frown": _both("mouthFrown"),
        "stretch": _both("mouthStretch"),
    },
    "lips": {
        "roll_lower": ("mouthRollLower",),
        "roll_upper": ("mouthRollUpper",),
        "shrug_lower": ("mouthShrugLower",),
        "shrug_upper": ("mouthShrugUpper",),
        "press": _both("mouthPress"),
        "lower_down": _both("mouthLowerDown"),
        "upper_up": _both("mouthUpperUp"),
        "dimple": _both("mouthDimple"),
    },
    "brows": {
        "down": _both("browDown"),
        "inner_up": ("browInnerUp",),
        "outer_up": _both("browOuterUp"),
    },
    "cheeks": {
        "puff": ("cheekPuff",),
        "squint": _both("cheekSquint"),
    },
    "nose": {
        "sneer": _both("noseSneer"),
    },
}

NETWORKS: tuple[Network, ...] = tuple(
    Network(region=region, name=name, outputs=outputs)
    for region, networks in _OUTPUTS.items()
    for name, outputs in networks.items()
)
"""The 31 networks, region by region."""

REGIONS: tuple[str, ...] = tuple(_OUTPUTS)

OUTPUTS: tuple[str, ...] = tuple(output for network in NETWORKS for output in network.outputs)
"""The 51 predicted shapes in the networks' order (every table that leaves is in ``BLENDSHAPES`` order)."""

NOT_OBSERVABLE: tuple[str, ...] = ("tongueOut",)
"""Shapes that move none of the 68 points: always 0, no network."""

VISIBLE_SHAPES: tuple[str, ...] = tuple(
    name
    for name in BLENDSHAPES
    if name
    in {
        *(
            "jawOpen",
            "jawLeft",
            "jawRight",
            "mouthClose",
            "mouthLeft",
            "mouthRight",
            "mouthFunnel",
            "mouthPucker",
        ),
        *("mouthRollLower", "mouthRollUpper", "mouthShrugUpper", "browInnerUp"),
        *(
            side
            for stem in ("noseSneer", "mouthSmile", "mouthDimple", "mouthStretch")
            for side in _both(stem)
        ),
        *(side for stem in ("mouthUpperUp", "browDown", "browOuterUp", "eyeBlink") for side in _both(stem)),
        *_both("eyeLookDown"),
    }
)
"""The 30 shapes that 68 points show well enough for bars on accuracy (measured with 1 % noise)."""


def observability(blendshape: str) -> str:
    """``"visible"``, ``"weak"`` (predicted, without a bar) or ``"not_observable"`` (always 0)."""
    if blendshape in NOT_OBSERVABLE:
        return "not_observable"
    return "visible" if blendshape in VISIBLE_SHAPES else "weak"
