"""Judges headset networks on two films of real eyes, beside OpenCV's dark blob and, where installed, pupil-detectors.

    python benchmarks/real_eyes.py headset-tracking3 models/other --real RECORDINGS --sheets OUT

Film a (30 frames of a self-built headset) has its pupils marked by eye, to about 2 % of the picture's width; film b (60
frames of another one) has none, so that its traced points are looked at, frame by frame: `--sheets` draws all of them.
Each network sees the films as `regress headset predict` would show them: at the placement that `regress headset check`
finds from the frames alone, with levels of their own; and, for what is lost without, all of the picture, its middle,
and the picture squeezed into the network's square. A network's right eye is its left one in a mirror, so each film goes
in as either.

The pupil's errors are median distances to the marks: as traced, after an affine fit (six numbers for 28 frames), and
after a fit to all frames but the judged one. r is the correlation of x and of y with the marks, as traced and fitted.
A frame without a pupil is told from the others by eyeBlink and by the traced lids' distance; AUC 1 is without an error.
Film b's eye is shut there. Film a's looks far up, with its white in sight, and eyeBlink has no reason to rise. Prints
Markdown, which stands in docs/your-camera.md.
"""

import argparse
import csv
from collections.abc import Callable
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement, whole_view
from regress.runtime.headset.placing.levels import levels_in
from regress.runtime.headset.placing.placement_search import find_placement

FILMS = ("film_a", "film_b")
SHUT = {"film_a": ("000588", "000616"), "film_b": ("000408",)}
"""Frames with no pupil to be seen between the lids, by eye: film_a's look up under the lid, film_b's is shut."""
HALF = {"film_a": (), "film_b": ("000456", "001152", "001176")}
"""Frames that are neither open nor shut, by eye; they are left out where shut is told from open."""
CAMERA = "left_eye"
_BLINK = BLENDSHAPE_INDEX["eyeBlinkLeft"]


@dataclass(frozen=True, kw_only=True)
class Film:
    """Frames (n, h, w) uint8, their names, and where their pupils were marked (n, 2), NaN where they were not."""

    name: str
    frames: tuple[str, ...]
    pictures: np.ndarray
    pupils: np.ndarray

    @property
    def shut(self) -> np.ndarray:
        """(n,) bool."""
        return np.isin(self.frames, SHUT[self.name])

    @property
    def clear(self) -> np.ndarray:
        """(n,) bool: neither half shut, nor otherwise in between."""
        return ~np.isin(self.frames, HALF[self.name])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--real", required=True, type=Path, help="Folder with eyes/film_a and eyes/film_b.")
    parser.add_argument(
        "--sheets", type=Path, help="Folder for a sheet of each film's frames, of the first model."
    )
    arguments = parser.parse_args()
    films = {name: read_film(arguments.real / "eyes" / name) for name in FILMS}
    print(
        "| film | what | view | pupil r (x, y): as traced; fitted | error % of width: as traced, fitted, left out | "
        "shut told by eyeBlink, lids (AUC) | eyeBlink shut, open |"
    )
    print("|---|---|---|---|---|---|---|")
    for number, model in enumerate(arguments.models):
        predictor = load_headset_predictor(model)
        for film in films.values():
            placed = find_placement(predictor, CAMERA, film.pictures).placement
            print(network_row(f"{model}, placed", predictor, film, placed))
            for what, unplaced in without_placement(
                film, predictor.sizes[CAMERA], mirror=placed.mirror
            ).items():
                print(network_row(f"{model}, {what}", predictor, film, unplaced))
            print(
                network_row(
                    f"{model}, squeezed",
                    predictor,
                    film,
                    CameraPlacement(mirror=placed.mirror),
                    squeezed=True,
                )
            )
            if arguments.sheets and number == 0:
                arguments.sheets.mkdir(parents=True, exist_ok=True)
                cv2.imwrite(str(arguments.sheets / f"{film.name}.png"), sheet(predictor, film, placed))
    for what, find in rivals().items():
        for film in films.values():
            found = np.array([find(picture) for picture in film.pictures])
            print(row(film, what, "", found, None, None))


def without_placement(film: Film, view: tuple[int, int], *, mirror: bool) -> dict[str, CameraPlacement]:
    """What nobody looked for: all of the picture, as `regress headset predict` sees it, and its middle."""
    picture = (film.pictures.shape[2], film.pictures.shape[1])
    whole = replace(whole_view(picture, view), mirror=mirror)
    return {"all of it": whole, "its middle": replace(whole, size=min(1.0, picture[1] / picture[0]))}


def read_film(folder: Path) -> Film:
    """Frames of a folder, with the marks of its pupils.csv where it has one."""
    files = sorted(folder.glob("*.png"))
    marks = folder / "pupils.csv"
    marked = {}
    if marks.is_file():
        for line in csv.DictReader(marks.read_text().splitlines()):
            marked[int(line["frame"])] = [float(line[f"pupil_{axis}"] or "nan") for axis in "xy"]
    return Film(
        name=folder.name,
        frames=tuple(file.stem for file in files),
        pictures=np.stack([cv2.imread(str(file), cv2.IMREAD_GRAYSCALE) for file in files]),
        pupils=np.array([marked.get(int(file.stem), [np.nan, np.nan]) for file in files]),
    )


@dataclass(frozen=True, kw_only=True)
class Answer:
    """A network's points in a film's own pixels (n, P, 2), and its weights (n, 52)."""

    points: np.ndarray
    weights: np.ndarray


def answer_to(
    predictor: HeadsetPredictor,
    film: Film,
    placed: CameraPlacement,
    *,
    squeezed: bool = False,
    fades: bool = True,
) -> Answer:
    """What a network says of a film.

    Parameters
    ----------
    fades
        What lies beyond its edges, as views are; streaks otherwise.
    squeezed
        All of the picture, whatever its shape, in the network's square; only ``placed``'s mirror counts.
    """
    width, height = predictor.sizes[CAMERA]
    picture = (film.pictures.shape[2], film.pictures.shape[1])
    if squeezed:
        seen = [cv2.resize(one, (width, height), interpolation=cv2.INTER_AREA) for one in film.pictures]
        views = np.stack([one[:, ::-1] if placed.mirror else one for one in seen])
        scale = np.diag(np.array(picture) / (width, height))
        mirror = np.diag([-1.0 if placed.mirror else 1.0, 1.0])
        middle = np.array([width - 1, height - 1]) / 2
        linear = scale @ mirror
        matrix = np.column_stack([linear, scale @ (middle + 0.5) - 0.5 - linear @ middle])
    else:
        views = np.stack([placed.view(one, width=width, height=height, fades=fades) for one in film.pictures])
        matrix = placed.picture_from_view(picture, (width, height))
    if CAMERA in predictor.model.looks:
        views = levels_in([views], predictor.model.looks[CAMERA]).apply(views)
    traced = predictor.graph.trace({CAMERA: views})[CAMERA]
    return Answer(
        points=traced @ matrix[:, :2].T + matrix[:, 2], weights=predictor.predict({CAMERA: views}).weights
    )


def network_row(
    what: str, predictor: HeadsetPredictor, film: Film, placed: CameraPlacement, *, squeezed: bool = False
) -> str:
    """A line of the table for a network at a placement."""
    points = EyePoints.of(predictor, CAMERA)
    answer = answer_to(predictor, film, placed, squeezed=squeezed)
    view = (
        "squeezed"
        if squeezed
        else f"{placed.x:.2f}, {placed.y:.2f}, size {placed.size:.2f}, {placed.roll_deg:+.0f}°"
    )
    view += ", mirrored" if placed.mirror else ""
    apart = np.linalg.norm(
        answer.points[:, points.upper].mean(axis=1) - answer.points[:, points.lower].mean(axis=1), axis=1
    )
    return row(film, what, view, answer.points[:, points.pupil], answer.weights[:, _BLINK], apart)


def row(
    film: Film, what: str, view: str, pupils: np.ndarray, blinks: np.ndarray | None, apart: np.ndarray | None
) -> str:
    """A line of the table: NaN pupils are frames in which none was found."""
    cells = [film.name, what, view]
    marked = np.isfinite(film.pupils).all(axis=1)
    if marked.any():
        found = marked & np.isfinite(pupils).all(axis=1)
        width = film.pictures.shape[2]
        raw_r = axis_r(pupils[found], film.pupils[found])
        r, error = pupil_figures(pupils[found], film.pupils[found], width)
        lost = f" ({(marked & ~found).sum()} lost)" if (marked & ~found).any() else ""
        raw = error_percent(pupils[found], film.pupils[found], width)
        left_out = error_percent(fitted_without(pupils[found], film.pupils[found]), film.pupils[found], width)
        cells += [
            f"{raw_r[0]:.3f}, {raw_r[1]:.3f}; {r[0]:.3f}, {r[1]:.3f}",
            f"{raw:.2f}, {error:.2f}, {left_out:.2f}{lost}",
        ]
    else:
        cells += ["", ""]
    if blinks is None or apart is None:
        cells += ["", ""]
    else:
        shut, opened = film.shut, film.clear & ~film.shut
        told = [area_under_curve(one[shut], one[opened]) for one in (blinks, -apart)]
        cells += [
            f"{told[0]:.2f}, {told[1]:.2f}",
            f"{blinks[shut].mean():.2f}, {np.median(blinks[opened]):.2f}",
        ]
    return f"| {' | '.join(cells)} |"


def pupil_figures(found: np.ndarray, true: np.ndarray, width: float) -> tuple[np.ndarray, float]:
    """Correlation of x and y (2,), and the median error in percent of the width, after an affine fit to them."""
    design = np.column_stack([found, np.ones(len(found))])
    fitted = design @ np.linalg.lstsq(design, true, rcond=None)[0]
    return axis_r(fitted, true), error_percent(fitted, true, width)


def fitted_without(found: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Points (n, 2), each by the affine fit to all the others."""
    design = np.column_stack([found, np.ones(len(found))])
    rows = np.arange(len(found))
    return np.array(
        [design[row] @ np.linalg.lstsq(design[rows != row], true[rows != row], rcond=None)[0] for row in rows]
    )


def axis_r(found: np.ndarray, true: np.ndarray) -> np.ndarray:
    """Correlation of x and of y (2,)."""
    return np.array([np.corrcoef(found[:, axis], true[:, axis])[0, 1] for axis in (0, 1)])


def error_percent(found: np.ndarray, true: np.ndarray, width: float) -> float:
    """Median error in percent of the width."""
    return 100 * float(np.median(np.linalg.norm(found - true, axis=1))) / width


def area_under_curve(high: np.ndarray, low: np.ndarray) -> float:
    """Probability that one of ``high`` is above one of ``low``; ties count half."""
    pairs = high[:, None] - low
    return float(((pairs > 0) + 0.5 * (pairs == 0)).mean())


def rivals() -> dict[str, Callable[[np.ndarray], np.ndarray]]:
    """What finds pupils without having learned any, by name."""
    found: dict[str, Callable[[np.ndarray], np.ndarray]] = {"OpenCV's dark blob": dark_blob}
    if find_spec("pupil_detectors") is not None:
        from pupil_detectors import Detector2D

        detector = Detector2D()

        def ellipse(picture: np.ndarray) -> np.ndarray:
            # its sizes are for pictures of 320 pixels and more
            times = 3
            larger = cv2.resize(picture, None, fx=times, fy=times, interpolation=cv2.INTER_CUBIC)
            answer = detector.detect(np.ascontiguousarray(larger))
            if answer["confidence"] <= 0:
                return np.full(2, np.nan)
            return (np.array(answer["ellipse"]["center"]) + 0.5) / times - 0.5

        found["pupil-detectors 2D"] = ellipse
    return found


def dark_blob(picture: np.ndarray) -> np.ndarray:
    """Middle (2,) of the largest dark spot: below a quarter of the way from the darkest level to the median."""
    calm = cv2.GaussianBlur(picture, (0, 0), 1.5)
    low, middle = np.percentile(calm, [0.5, 50])
    dark = (calm < low + 0.25 * (middle - low)).astype(np.uint8)
    count, _, statistics, middles = cv2.connectedComponentsWithStats(dark)
    if count < 2:
        return np.full(2, np.nan)
    return middles[1 + int(np.argmax(statistics[1:, cv2.CC_STAT_AREA]))]


def sheet(predictor: HeadsetPredictor, film: Film, placed: CameraPlacement, *, across: int = 6) -> np.ndarray:
    """All frames of a film, three times as large, with lids, iris and pupil as they were traced (colour picture)."""
    points, answer = EyePoints.of(predictor, CAMERA), answer_to(predictor, film, placed)
    times, cells = 3, []
    for name, picture, found in zip(film.frames, film.pictures, answer.points, strict=True):
        cell = cv2.cvtColor(
            cv2.resize(picture, None, fx=times, fy=times, interpolation=cv2.INTER_CUBIC), cv2.COLOR_GRAY2BGR
        )
        at = np.rint(16 * (times * (found + 0.5) - 0.5)).astype(np.int32)
        for columns, closed, colour in (
            (points.upper, False, (60, 220, 255)),
            (points.lower, False, (60, 220, 255)),
            (points.iris, True, (255, 190, 60)),
        ):
            cv2.polylines(cell, [at[columns][:, None]], closed, colour, 1, cv2.LINE_AA, 4)
        cv2.circle(cell, tuple(at[points.pupil].tolist()), 3 * 16, (80, 80, 255), -1, cv2.LINE_AA, 4)
        cv2.putText(
            cell,
            name.lstrip("0") or "0",
            (6, 18),
            cv2.FONT_HERSHEY_SIMPLEX,
            0.5,
            (255, 255, 255),
            1,
            cv2.LINE_AA,
        )
        cells.append(cv2.copyMakeBorder(cell, 0, 2, 0, 2, cv2.BORDER_CONSTANT))
    cells += [np.zeros_like(cells[0])] * (-len(cells) % across)
    return np.vstack([np.hstack(cells[at : at + across]) for at in range(0, len(cells), across)])


if __name__ == "__main__":
    main()
