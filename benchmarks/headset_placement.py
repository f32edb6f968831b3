"""Measures how well the place of an eye in unknown pictures is found, and what placing is worth.

    python -m benchmarks.headset_placement headset-tracking3 --data datasets/out/headset-test-arrays
    python -m benchmarks.headset_placement headset-any --data datasets/out/headset-any-test-arrays

Each eye's camera of a person, or of a drawn headset, gives a take. The take is cut out anew as another camera would
show it: of another size and shape, moved, turned, in half of the takes mirrored. `find_placement` gets these alone.
For a network of one headset the true placement is the one at which the labels lie as in training. A network of drawn
headsets may leave eyes where they are, so it has no true one, only a side. Both are judged by what placing is for: the
traced pupil's error, as a share of the eye's width, in the picture as it was rendered, at the placement that was found,
and without any. Prints Markdown, which stands in docs/measurements/headset-networks.md.
"""

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np

from benchmarks.any_headset import headset_of_rows
from facegen.conventions import VIEW_POINTS
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.pictures.placement import CameraPlacement
from regress.runtime.headset.placing.levels import levels_in
from regress.runtime.headset.placing.placement_search import find_placement
from regress.runtime.headset.placing.placement_steps import placement_of_points

EYES = ("left_eye", "right_eye")
SHAPES = ((160, 120), (128, 128), (144, 108), (200, 150))
FEWEST = 8
"""Frames of a take that say where an eye usually lies."""


@dataclass(frozen=True, kw_only=True)
class Take:
    """Pictures (n, h, w) uint8 of one eye's camera, and its traced points' labels (n, P, 2), NaN where hidden."""

    camera: str
    pictures: np.ndarray
    labels: np.ndarray


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+")
    parser.add_argument("--data", required=True)
    parser.add_argument("--takes", type=int, default=20)
    arguments = parser.parse_args()
    arrays = read_arrays(arguments.data)
    print(
        "| network | takes | side right | place within 3 % | size within 5 %, median | "
        "pupil's error % of the eye's width: as rendered, placed, not placed |\n|---|---|---|---|---|---|"
    )
    for name in arguments.models:
        predictor = load_headset_predictor(name)
        takes = [take for _, take in zip(range(arguments.takes), takes_of(arrays, predictor), strict=False)]
        print(judged(name, predictor, takes, np.random.default_rng(0)))


def takes_of(arrays: HeadsetArrays, predictor: HeadsetPredictor) -> Iterator[Take]:
    """Of each person, or of each drawn headset, both eyes."""
    rows = np.arange(len(arrays.person))
    groups = headset_of_rows(arrays, rows) if arrays.drawn else arrays.person
    for group in np.unique(groups):
        for camera in EYES:
            columns = [VIEW_POINTS.index(name) for name in predictor.model.points[camera]]
            chosen = rows[groups == group]
            if len(chosen) >= FEWEST:
                yield Take(
                    camera=camera,
                    pictures=np.array(arrays.pictures[camera][chosen]),
                    labels=arrays.points[camera][np.ix_(chosen, columns)],
                )


def draw_crop(rng: np.random.Generator) -> tuple[CameraPlacement, tuple[int, int]]:
    """Where a view of the new pictures would lie to show what was rendered, and the new pictures' size."""
    crop = CameraPlacement(
        x=rng.uniform(0.42, 0.58),
        y=rng.uniform(0.42, 0.58),
        size=float(np.exp(rng.uniform(np.log(0.75), np.log(1.3)))),
        roll_deg=rng.uniform(-12, 12),
        mirror=bool(rng.random() < 0.5),
    )
    return crop, SHAPES[rng.integers(len(SHAPES))]


def judged(name: str, predictor: HeadsetPredictor, takes: list[Take], rng: np.random.Generator) -> str:
    """A line of the table."""
    right, places, sizes, errors = [], [], [], []
    for take in takes:
        crop, (width, height) = draw_crop(rng)
        view = predictor.sizes[take.camera]
        wide = crop.picture_from_view(view, (width, height))
        flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
        seen = np.stack(
            [
                cv2.warpAffine(one, wide, (width, height), flags=flags, borderMode=cv2.BORDER_REPLICATE)
                for one in take.pictures
            ]
        )
        found = find_placement(predictor, take.camera, seen).placement
        right.append(found.mirror == crop.mirror)
        rendered = np.vstack([wide, [0, 0, 1]])
        if right[-1] and not predictor.model.camera_terms:
            points = EyePoints.of(predictor, take.camera)
            true = placement_of_points(CameraPlacement(), take.labels, points, picture=view, view=view)
            straight = true.picture_from_view(view, view)
            through = rendered[:2] @ np.vstack([found.picture_from_view((width, height), view), [0, 0, 1]])
            middle = np.append((np.array(view) - 1) / 2, 1.0)
            size = np.sqrt(abs(np.linalg.det(through[:, :2]) / np.linalg.det(straight[:, :2])))
            sizes.append(abs(size - 1))
            places.append(np.linalg.norm(through @ middle - straight @ middle) / view[0])
        errors.append(
            [
                pupil_error(predictor, take, take.pictures, CameraPlacement(), np.eye(3)),
                pupil_error(predictor, take, seen, found, rendered),
                pupil_error(predictor, take, seen, CameraPlacement(mirror=crop.mirror), rendered),
            ]
        )
    placed = (
        [f"{np.sum(np.array(places) <= 0.03)}", f"{np.sum(np.array(sizes) <= 0.05)}, {np.median(sizes):.1%}"]
        if sizes
        else ["", ""]
    )
    cells = [name, str(len(takes)), str(sum(right)), *placed]
    return f"| {' | '.join(cells)} | {', '.join(f'{100 * one:.1f}' for one in np.median(errors, axis=0))} |"


def pupil_error(
    predictor: HeadsetPredictor,
    take: Take,
    pictures: np.ndarray,
    placement: CameraPlacement,
    rendered_from_picture: np.ndarray,
) -> float:
    """Median distance of the traced pupil from its label, over the median distance of the eye's corners."""
    points = EyePoints.of(predictor, take.camera)
    width, height = predictor.sizes[take.camera]
    views = np.stack([placement.view(one, width=width, height=height) for one in pictures])
    views = levels_in([views], predictor.model.looks[take.camera]).apply(views)
    traced = predictor.graph.trace({take.camera: views})[take.camera][:, points.pupil]
    back = placement.picture_from_view((pictures.shape[2], pictures.shape[1]), (width, height))
    at = traced @ back[:, :2].T + back[:, 2]
    at = at @ rendered_from_picture[:2, :2].T + rendered_from_picture[:2, 2]
    eye = np.linalg.norm(take.labels[:, points.upper[0]] - take.labels[:, points.upper[-1]], axis=-1)
    return float(np.nanmedian(np.linalg.norm(at - take.labels[:, points.pupil], axis=1)) / np.nanmedian(eye))


if __name__ == "__main__":
    main()
