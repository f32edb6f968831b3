"""Measures how near the points that headset networks trace come to the labels, by part of the face.

    python benchmarks/headset_points.py models/headset* --data datasets/out/headset-test-arrays

Of unseen people, ordinary frames without a neutral picture; a camera and the one that mirrors it count together.
Several models give mean and standard deviation over them. Prints Markdown, which stands in
docs/measurements/headset-networks.md.
"""

import argparse
from pathlib import Path

import numpy as np

from facegen.conventions import LANDMARK_GROUPS, VIEW_POINTS
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import COMBINED
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor

NEAR_DEG = 12.0
"""Of gaze, within which a pupil moves about evenly with it."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--data", required=True, type=Path)
    arguments = parser.parse_args()
    arrays = read_arrays(arguments.data)
    tables = [errors_by_part(load_headset_predictor(path), arrays) for path in arguments.models]
    print("| camera | part | shown % | mean px | median px | 95 % within px |\n|---|---|---|---|---|---|")
    for camera, part in tables[0]:
        errors = [table[camera, part] for table in tables]
        shown = 100 * np.isfinite(errors[0]).mean()
        figures = [[np.nanmean(one), np.nanmedian(one), np.nanpercentile(one, 95)] for one in errors]
        cells = [f"{mean:.2f}" for mean in np.mean(figures, 0)]
        if len(figures) > 1:
            spreads = np.std(figures, 0, ddof=1)
            cells = [f"{mean} ± {spread:.2f}" for mean, spread in zip(cells, spreads, strict=True)]
        print(f"| {camera} | {part} | {shown:.0f} | {' | '.join(cells)} |")
    for camera, side in (("left_eye", "left"), ("right_eye", "right")):
        if camera in arrays.points:
            yaw_px, pitch_px = pupil_motion(arrays, camera, side)
            print(
                f"\n{camera}: a degree of yaw moves the pupil by {yaw_px:.2f} px, one of pitch by {pitch_px:.2f}."
            )


def pupil_motion(arrays: HeadsetArrays, camera: str, side: str) -> np.ndarray:
    """Pixels (2,) by which a degree of an eye's yaw, and one of its pitch, move its pupil.

    Least squares over frames whose gaze is near that of the person's neutral picture in the same seat.
    """
    neutral = arrays.neutral_rows(other_seat=False)
    rows = np.flatnonzero(~arrays.neutral & (neutral >= 0))
    places = arrays.points[camera][:, VIEW_POINTS.index(f"{side}_pupil")]
    moved_px = places[rows] - places[neutral[rows]]
    columns = slice(0, 2) if side == "left" else slice(2, 4)
    turned_deg = np.degrees(arrays.gaze[rows] - arrays.gaze[neutral[rows]])[:, columns]
    near = np.isfinite(moved_px).all(axis=1) & (np.abs(turned_deg) < NEAR_DEG).all(axis=1)
    by_degree = np.linalg.lstsq(turned_deg[near], moved_px[near], rcond=None)[0]
    return np.linalg.norm(by_degree, axis=1)


def errors_by_part(predictor: HeadsetPredictor, arrays: HeadsetArrays) -> dict[tuple[str, str], np.ndarray]:
    """Pixels by encoder's camera and part; NaN where a picture does not show the point."""
    rows = np.flatnonzero((arrays.split == "test") & ~arrays.neutral & (arrays.component != COMBINED))
    found = predictor.graph.trace(
        {name: arrays.pictures[name][rows] for name in predictor.model.camera_names}
    )
    collected: dict[tuple[str, str], list[np.ndarray]] = {}
    for camera in predictor.model.cameras:
        names = predictor.model.points.get(camera.name, ())
        true = arrays.points[camera.name][np.ix_(rows, [VIEW_POINTS.index(name) for name in names])]
        inside = ((true > -0.5) & (true < np.array([camera.width, camera.height]) - 0.5)).all(axis=2)
        errors = np.where(inside, np.linalg.norm(found[camera.name] - true, axis=2), np.nan)
        for column, name in enumerate(names):
            key = (camera.mirrored_of or camera.name, part_of_face(name))
            collected.setdefault(key, []).append(errors[:, column])
    return {key: np.concatenate(parts) for key, parts in collected.items()}


def part_of_face(name: str) -> str:
    """What a view point belongs to, without its side."""
    kind, number = name.split("_", 1)
    if kind != "landmark":
        return " ".join(word for word in number.split("_") if not word.isdigit())
    group = next((group for group, indices in LANDMARK_GROUPS.items() if int(number) in indices), "other")
    return "landmarks, " + group.removeprefix("left_").removeprefix("right_").replace("_", " ")


if __name__ == "__main__":
    main()
