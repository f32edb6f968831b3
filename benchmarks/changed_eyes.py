"""Judges how well `regress headset check` finds a real eye in films of other cameras: the two films, changed.

    python -m benchmarks.changed_eyes headset-tracking3 headset-any --real RECORDINGS

Each film comes nearer and farther, moved, turned, mirrored, with other light, noise and blur. At the placement that is
found from the frames alone the traced pupil is compared with the film's marks (`benchmarks/real_eyes.py`: r of x and of
y, and the median error, after an affine fit to the same frames). Errors are in percent of the film's own width, grown
with the eye: a farther eye does not err by less. Film b has no marks, so there it is compared with
what the network traces in the film as it comes: that says how steady it is, not how right. Prints Markdown, which
stands in docs/measurements/headset-networks.md.

    python -m benchmarks.changed_eyes headset-tracking3 headset-any --real RECORDINGS --beyond

has the films from nearer places at the right placement, that of the film as it comes: with what is repeated beyond the
pictures' edges left as streaks, and faded.
"""

import argparse
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from benchmarks.real_eyes import CAMERA, FILMS, Film, answer_to, pupil_figures, read_film
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.placing.found_placement import FoundPlacement
from regress.runtime.headset.placing.placement_search import find_placement

Change = tuple[float, Callable[[Film], Film]]
"""How much wider eyes come out, and what is done to a film."""

NEARER = (1.0, 1.2, 1.35, 1.5, 1.7, 2.0)
"""Of the films' own scale, for `--beyond`."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--real", required=True, type=Path, help="Folder with eyes/film_a and eyes/film_b.")
    parser.add_argument("--beyond", action="store_true", help="streaks and fades beyond the edges alone")
    arguments = parser.parse_args()
    films = [read_film(arguments.real / "eyes" / name) for name in FILMS]
    if arguments.beyond:
        print(
            f"| network | times as near | {' | '.join(f'{film.name}: streaks | fades' for film in films)} |"
        )
        print("|---" * (2 + 2 * len(films)) + "|")
        for model in arguments.models:
            print("\n".join(beyond_rows(model, films)), flush=True)
        return
    print(f"| network | change | {' | '.join(f'{film.name}: r (x, y), error %' for film in films)} |")
    print("|---" * (2 + len(films)) + "|")
    for model in arguments.models:
        predictor = load_headset_predictor(model)
        marked = [with_marks(predictor, film) for film in films]
        for what, (near, change) in changes().items():
            cells = [told(predictor, change(film), near * film.pictures.shape[2]) for film in marked]
            print(f"| {model} | {what} | {' | '.join(cells)} |", flush=True)


def with_marks(predictor: HeadsetPredictor, film: Film) -> Film:
    """A film whose pupils are marked, by what the network traces where nobody marked them."""
    if np.isfinite(film.pupils).any():
        return film
    found = find_placement(predictor, CAMERA, film.pictures)
    traced = answer_to(predictor, film, found.placement).points
    return replace(film, pupils=traced[:, EyePoints.of(predictor, CAMERA).pupil])


def told(predictor: HeadsetPredictor, film: Film, width: float) -> str:
    """A cell: how well pupils are traced, and how the eye is taken to lie where that is not upright.

    Parameters
    ----------
    width
        Pixels that errors are in percent of: of the film as it comes, grown with the eye.
    """
    found = find_placement(predictor, CAMERA, film.pictures)
    traced = answer_to(predictor, film, found.placement).points[:, EyePoints.of(predictor, CAMERA).pupil]
    marked = np.isfinite(film.pupils).all(axis=1)
    r, error = pupil_figures(traced[marked], film.pupils[marked], width)
    return f"{r[0]:.3f}, {r[1]:.3f}, {error:.2f}{''.join(f'; {word}' for word in words(found))}"


def beyond_rows(model: str, films: list[Film]) -> Iterator[str]:
    """Of a network: r (the lower one) and error in percent of the width that the eye's size then has."""
    predictor = load_headset_predictor(model)
    pupil = EyePoints.of(predictor, CAMERA).pupil
    marked = [with_marks(predictor, film) for film in films]
    places = [find_placement(predictor, CAMERA, film.pictures).placement for film in films]
    for near in NEARER:
        cells = []
        for film, place in zip(marked, places, strict=True):
            seen = film if near == 1 else moved(film, near)
            at = replace(
                place, x=0.5 + near * (place.x - 0.5), y=0.5 + near * (place.y - 0.5), size=near * place.size
            )
            known = np.isfinite(seen.pupils).all(axis=1)
            for fades in (False, True):
                traced = answer_to(predictor, seen, at, fades=fades).points[:, pupil]
                r, error = pupil_figures(traced[known], seen.pupils[known], near * film.pictures.shape[2])
                cells.append(f"{r.min():.3f}, {error:.2f}")
        yield f"| {model} | {near:g} | {' | '.join(cells)} |"


def words(found: FoundPlacement) -> Iterator[str]:
    """What is unusual about a placement."""
    if found.lost:
        yield "not found"
    if found.placement.mirror:
        yield "mirrored"
    if abs(found.placement.roll_deg) > 45:
        yield "upside down" if abs(found.placement.roll_deg) > 135 else "on its side"


def changes() -> dict[str, Change]:
    """What is done to films, by its name."""
    noise = np.random.default_rng(0)

    def noisy(picture: np.ndarray) -> np.ndarray:
        return np.clip(picture + noise.normal(0, 12, picture.shape), 0, 255).astype(np.uint8)

    def grey(change: Callable[[np.ndarray], np.ndarray]) -> Change:
        return 1.0, lambda film: lit(film, change)

    return {
        "none": (1.0, lambda film: film),
        "1.35 times as near": (1.35, lambda film: moved(film, 1.35)),
        "1.7 times as near": (1.7, lambda film: moved(film, 1.7)),
        "0.7 times as near": (0.7, lambda film: moved(film, 0.7)),
        "0.5 times as near": (0.5, lambda film: moved(film, 0.5)),
        "0.7, moved by .15 and -.1": (0.7, lambda film: moved(film, 0.7, across=0.15, down=-0.1)),
        "turned by 12°": (1.0, lambda film: moved(film, 1.0, turn_deg=12)),
        "turned by -20°": (1.0, lambda film: moved(film, 1.0, turn_deg=-20)),
        "mirrored": (1.0, lambda film: flipped(film, mirror=True)),
        "upside down": (1.0, lambda film: flipped(flipped(film, mirror=True), mirror=False)),
        "on its side": (1.0, laid),
        "on its other side": (1.0, lambda film: laid(flipped(flipped(film, mirror=True), mirror=False))),
        "gamma 2": grey(lambda picture: (255 * (picture / 255.0) ** 2).astype(np.uint8)),
        "gamma 0.5": grey(lambda picture: (255 * (picture / 255.0) ** 0.5).astype(np.uint8)),
        "a quarter of the contrast": grey(lambda picture: (90 + picture / 4).astype(np.uint8)),
        "half of the light": (1.0, lambda film: lamped(film, np.full(len(film.pictures), 0.5))),
        "a twentieth of the light": (1.0, lambda film: lamped(film, np.full(len(film.pictures), 0.05))),
        "light that falls to a quarter": (
            1.0,
            lambda film: lamped(film, np.linspace(1, 0.25, len(film.pictures))),
        ),
        "light that comes and goes": (
            1.0,
            lambda film: lamped(film, 0.6 + 0.4 * np.sin(0.9 * np.arange(len(film.pictures)))),
        ),
        "noise of 12 grey levels": grey(noisy),
        "blur of 1 % of the width": grey(
            lambda picture: cv2.GaussianBlur(picture, (0, 0), picture.shape[1] / 100)
        ),
        "1.5 times as wide": (1.5, lambda film: warped(film, np.array([[1.5, 0, 0], [0, 1, 0]]), widen=1.5)),
    }


def lit(film: Film, change: Callable[[np.ndarray], np.ndarray]) -> Film:
    """Other grey levels."""
    return replace(film, pictures=np.stack([change(picture) for picture in film.pictures]))


def lamped(film: Film, times: np.ndarray) -> Film:
    """Each picture in so many times its light, as a lamp or the camera's exposure gives it."""
    pictures = np.rint(film.pictures * times[:, None, None]).clip(0, 255).astype(np.uint8)
    return replace(film, pictures=pictures)


def moved(film: Film, scale: float, *, across: float = 0.0, down: float = 0.0, turn_deg: float = 0.0) -> Film:
    """The film from another place; what lies beyond its edges repeats them."""
    height, width = film.pictures.shape[1:]
    matrix = cv2.getRotationMatrix2D((width / 2, height / 2), turn_deg, scale)
    matrix[:, 2] += across * width, down * height
    return warped(film, matrix)


def flipped(film: Film, *, mirror: bool) -> Film:
    """Left and right exchanged, or top and bottom."""
    height, width = film.pictures.shape[1:]
    if mirror:
        return warped(film, np.array([[-1.0, 0, width - 1], [0, 1, 0]]))
    return warped(film, np.array([[1.0, 0, 0], [0, -1, height - 1]]))


def laid(film: Film) -> Film:
    """Turned by a quarter, the picture with it."""
    width = film.pictures.shape[2]
    turned = np.ascontiguousarray(np.rot90(film.pictures, axes=(1, 2)))
    return replace(film, pictures=turned, pupils=film.pupils @ np.array([[0.0, -1], [1, 0]]) + (0, width - 1))


def warped(film: Film, matrix: np.ndarray, *, widen: float = 1.0) -> Film:
    """Pictures and marks through a matrix (2, 3)."""
    height, width = film.pictures.shape[1:]
    pictures = [
        cv2.warpAffine(picture, matrix, (round(widen * width), height), borderMode=cv2.BORDER_REPLICATE)
        for picture in film.pictures
    ]
    return replace(film, pictures=np.stack(pictures), pupils=film.pupils @ matrix[:, :2].T + matrix[:, 2])


if __name__ == "__main__":
    main()
