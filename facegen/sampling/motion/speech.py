"""Speech-like motion: syllables as sequences of visemes whose neighbours shape them (co-articulation).

Each viseme fills its segment of time; each shape passes from one segment to the next within a time of its own, and
weighs the segments that overlap by how much each viseme insists on that shape: the dominance of Cohen & Massaro
1993, "Modeling coarticulation in synthetic visual speech", with passages of finite length.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES
from facegen.expression.acted import draw_uneven
from facegen.expression.sides import draw_sides
from facegen.expression.templates import CLOSING, columns, load_templates
from facegen.sampling.motion.envelopes import memberships

SYLLABLES_PER_S = (4.0, 5.0)
"""Of conversation (Tauroza & Allison 1990, Applied Linguistics 11: 4.3 a second)."""
PASSAGE_S = {"lips": 0.12, "closing": 0.10, "jaw": 0.20, "rounding": 0.20}
"""Visemes set in and fade within about 120 ms (Bailly 1997, as in Edwards et al. 2016, "JALI", ACM TOG 35(4)):
lips that meet are quicker, the jaw is heavy, rounding begins early."""
CONSONANTS = {
    **{"PP": 0.13, "FF": 0.07, "TH": 0.08, "DD": 0.22, "kk": 0.11},
    **{"CH": 0.05, "SS": 0.12, "nn": 0.15, "RR": 0.07},
}
VOWELS = {"aa": 0.22, "E": 0.28, "ih": 0.30, "oh": 0.10, "ou": 0.10}
"""Shares of visemes in English, rounded (after the phoneme counts of Mines et al. 1978, Language and Speech 21)."""
VOWEL_SHARE, CODA = (0.45, 0.65), 0.4
"""Share of a syllable that its vowel takes, and of syllables that end in a consonant."""
PHRASE, PAUSE_S, LENGTHENED = (5, 10), (0.15, 0.45), 1.4
"""Syllables between pauses, the pauses, and how much longer the last syllable before one is (Klatt 1976, JASA 59)."""
STRESS = (0.35, 0.85)
"""Factors on the visemes' jaw from syllable to syllable. In speech the jaw moves by 5 to 15 mm, and by 0.2 m/s at most
(Ostry & Flanagan 1989, Archives of Oral Biology 34); jawOpen = 1 is 40 mm on Apple's face."""
LOUDNESS = (0.3, 0.8)
"""Strength of all visemes of a clip."""

AT_ONCE = 120
"""Frames computed together, with the visemes of that time alone: two minutes take 0.4 s instead of 1.2 s."""

_JAW = BLENDSHAPE_INDEX["jawOpen"]
_ROUND = [BLENDSHAPE_INDEX["mouthFunnel"], BLENDSHAPE_INDEX["mouthPucker"]]
_MEETING = [
    CLOSING,
    *(column for name in ("mouthPress", "mouthRollLower", "mouthRollUpper") for column in columns(name)),
]
_PARTS = {"closing": _MEETING, "jaw": [_JAW], "rounding": _ROUND}
_PARTS["lips"] = sorted(
    set(range(len(BLENDSHAPES))) - {column for part in _PARTS.values() for column in part}
)
_TONGUE = dict.fromkeys(("TH", "DD", "kk", "SS", "nn"), 0.3)
_INSIST = {
    "lips": _TONGUE,
    "jaw": _TONGUE,
    "closing": _TONGUE | {"PP": 5.0, "FF": 3.0},
    "rounding": _TONGUE | {"ou": 2.0, "oh": 1.5, "CH": 2.0, "RR": 1.5},
}
"""How much more than others a viseme insists on shapes: lips always meet for p, b, m and touch teeth for f, v; sounds
that the tongue makes leave lips and jaw to their neighbours (Cohen & Massaro's dominance of the lips)."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Utterance:
    """k + 1 visemes in time.

    Attributes
    ----------
    edges_s
        (k,) times between them.
    viseme
        (k + 1,) rows of ``load_templates("visemes")``.
    stress
        (k + 1,) factors on the jaw.
    """

    edges_s: np.ndarray
    viseme: np.ndarray
    stress: np.ndarray


@cache
def _index(name: str) -> int:
    return load_templates("visemes").names.index(name)


def draw_utterance(
    rng: np.random.Generator, spans_s: list[tuple[float, float]], *, syllables_per_s: float
) -> Utterance:
    """Syllables within each span (start, end) of a clip, silence before, between and after them."""
    edges, visemes, stress = [], [_index("sil")], [1.0]

    def silence(at_s: float) -> None:
        edges.append(at_s)
        visemes.append(_index("sil"))
        stress.append(1.0)

    for start, end in spans_s:
        now, left = start, int(rng.integers(*PHRASE))
        while True:
            length = np.exp(0.25 * rng.standard_normal()) / syllables_per_s
            last = left <= 1 or now + (1 + LENGTHENED) * length > end
            length *= LENGTHENED if last else 1.0
            if now + length > end:
                break
            names, shares = _draw_syllable(rng)
            edges.extend(now + length * np.concatenate([[0], np.cumsum(shares)[:-1]]))
            visemes.extend(map(_index, names))
            stress.extend([STRESS[0] + (STRESS[1] - STRESS[0]) * rng.random()] * len(names))
            now, left = now + length, left - 1
            if last:
                silence(now)
                now, left = (
                    now + PAUSE_S[0] + (PAUSE_S[1] - PAUSE_S[0]) * rng.random(),
                    int(rng.integers(*PHRASE)),
                )
        if visemes[-1] != _index("sil"):
            silence(now)
    return Utterance(edges_s=np.array(edges), viseme=np.array(visemes), stress=np.array(stress))


def _draw_syllable(rng: np.random.Generator) -> tuple[list[str], list[float]]:
    """Visemes of a syllable and their shares of its time."""

    def one(table: dict[str, float]) -> str:
        return str(rng.choice(list(table), p=list(table.values())))

    vowel = VOWEL_SHARE[0] + (VOWEL_SHARE[1] - VOWEL_SHARE[0]) * rng.random()
    if rng.random() < CODA:
        return [one(CONSONANTS), one(VOWELS), one(CONSONANTS)], [(1 - vowel) / 2, vowel, (1 - vowel) / 2]
    return [one(CONSONANTS), one(VOWELS)], [1 - vowel, vowel]


def draw_visemes(rng: np.random.Generator, *, correlation: float) -> np.ndarray:
    """Visemes (15, 52) as one person speaks them in one clip; lips that must meet do."""
    visemes = load_templates("visemes").weights
    loudness = LOUDNESS[0] + (LOUDNESS[1] - LOUDNESS[0]) * rng.random()
    sides = loudness * (1 + 0.2 * (draw_sides(rng, 1, correlation=correlation) - 0.5))
    poses = draw_uneven(rng, visemes, np.repeat(sides, len(visemes), axis=0), correlation=correlation)
    poses[:, CLOSING] = visemes[:, CLOSING]
    return poses


def speech_course(utterance: Utterance, visemes: np.ndarray, time_s: np.ndarray) -> np.ndarray:
    """Weights (n, 52) of an utterance at times (n,), spoken with visemes (15, 52); `CLOSING` holds the closing."""
    weights = np.empty((len(time_s), len(BLENDSHAPES)))
    keys = visemes[utterance.viseme]
    keys[:, _JAW] = np.minimum(keys[:, _JAW] * utterance.stress, 1.0)
    for part, part_columns in _PARTS.items():
        insist = np.ones(len(visemes))
        for name, value in _INSIST.get(part, {}).items():
            insist[_index(name)] = value
        width = PASSAGE_S[part]
        for start in range(0, len(time_s), AT_ONCE):
            rows = slice(start, start + AT_ONCE)
            now = time_s[rows]
            first, last = np.searchsorted(utterance.edges_s, (now[0] - width / 2, now[-1] + width / 2))
            near = slice(first, last + 1)  # all others have no share at these times
            shares = memberships(now, utterance.edges_s[first:last], width) * insist[utterance.viseme[near]]
            shares /= shares.sum(axis=1, keepdims=True)
            weights[rows, part_columns] = np.einsum("nk,kc->nc", shares, keys[near][:, part_columns])
    return weights
