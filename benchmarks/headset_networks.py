"""Makes the second paper's tables on exact truth: networks on headset pictures, modular against holistic.

    python benchmarks/headset_networks.py models/headset-* --data ordinary=ARRAYS [--data slip=ARRAYS ...]
        [--drawn 60] [--json FILE]

Models that differ by nothing but their seed are one row, named by what differs from the first model: mean, and
standard deviation over seeds. A modular model's rivals are the holistic ones with the same other settings and seed. The
first data are the main ones. `--drawn` frames are drawn from the front with predicted and with true weights, and
compared as pictures. Prints Markdown; the results stand in docs/measurements/headset-networks.md.
"""

import argparse
import json
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import asdict, replace
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.preview import pictures, play_weights
from facegen.rigs import load_rig
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.comparison import compare
from regress.learning.headset.evaluation import Condition, estimate, evaluate
from regress.runtime.headset.network.figures import evaluation_to_json
from regress.runtime.headset.network.model import HeadsetTraining
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.timing import time_headset

SHOWN_PX, WINDOW_M = 240, (-0.115, 0.115, 0.115, -0.145)
"""Height of the drawn faces."""

Figures = dict[str, dict]

COLUMNS = {
    "mm": ("uncalibrated", "geometry_mm"),
    "R²": ("uncalibrated", "r2"),
    "MAE": ("uncalibrated", "mae"),
    "RMSE": ("uncalibrated", "rmse"),
    "blink R²": ("uncalibrated", "blink_r2"),
    "gaze °": ("uncalibrated", "gaze_deg"),
    "open eyes °": ("uncalibrated", "gaze_open_deg"),
    "calibrated mm": ("same_seat", "geometry_mm"),
    "calibrated R²": ("same_seat", "r2"),
    "reseated mm": ("other_seat", "geometry_mm"),
    "reseated, fallback mm": ("other_seat_fallback", "geometry_mm"),
    "same seat, fallback mm": ("same_seat_fallback", "geometry_mm"),
}
"""Condition and figure of each column of the main table."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("models", nargs="+", type=Path)
    parser.add_argument("--data", action="append", required=True, metavar="NAME=ARRAYS")
    parser.add_argument("--drawn", type=int, default=0)
    parser.add_argument("--json", type=Path)
    arguments = parser.parse_args()
    models = {path: load_headset_predictor(path) for path in arguments.models}
    data = {name: read_arrays(path) for name, path in (pair.split("=", 1) for pair in arguments.data)}
    found = {
        name: {
            path: evaluation_to_json(evaluate(one.graph, one.model, arrays)) for path, one in models.items()
        }
        for name, arrays in data.items()
    }
    groups = defaultdict(list)
    plain = next(iter(models.values())).model.training
    for path, one in models.items():
        groups[label(one, plain)].append(path)
    main_name = next(iter(data))
    print_main(groups, found[main_name], f"{main_name}: ordinary frames")
    print_losses(groups, found[main_name])
    rivals = {name: find_rivals(models, arrays, plain) for name, arrays in data.items()}
    for name, pairs in rivals.items():
        print_rivals(pairs, f"{name}: modular against holistic of the same settings and seed")
    if len(data) > 1:
        print_data(groups, found)
    key, paths = next(iter(groups.items()))
    print_shapes(key, [found[main_name][path] for path in paths])
    print_curve(models, found[main_name])
    drawn = print_drawn(models, groups, data[main_name], arguments.drawn) if arguments.drawn else {}
    times = print_times(models, groups)
    if arguments.json:
        document = {
            "figures": {name: {str(path): one for path, one in by.items()} for name, by in found.items()},
            "rivals": rivals,
            "drawn": drawn,
            "microseconds": times,
        }
        arguments.json.write_text(json.dumps(document, indent=1))


def label(one: HeadsetPredictor, plain: HeadsetTraining) -> str:
    """The architecture, and what else differs from the first model's training but the seed."""
    recipe, usual = recipe_of(one.model.training), recipe_of(plain)
    changed = [
        f"{name.replace('_', ' ')} {value}"
        for name, value in recipe.items()
        if name not in ("architecture", "seed", "people") and value != usual[name]
    ]
    # withholding says already why there are fewer people or frames
    withheld = recipe["withhold"] != usual["withhold"]
    if one.model.training.people != plain.people and not withheld:
        changed.append(f"{one.model.training.people} people")
    return ", ".join([recipe["architecture"], *changed])


def recipe_of(training: HeadsetTraining) -> dict[str, object]:
    """A model's recipe; settings that are younger than it have the values that change nothing."""
    return {"skip": 0, "gaze_loss": 1.0, "shut_eyes": 0, "points_loss": 0.0, **training.recipe}


def print_main(groups: dict[str, list[Path]], found: dict[Path, Figures], title: str) -> None:
    rows = [
        [
            key,
            len(paths),
            *(
                spread(found[path]["conditions"].get(c, {}).get(k) for path in paths)
                for c, k in COLUMNS.values()
            ),
        ]
        for key, paths in groups.items()
    ]
    floors = next(iter(found.values()))["floors"]
    for name, figures in floors.items():
        rows.append(
            [
                f"floor: {name}",
                "",
                *(spread([figures[k]] if c == "uncalibrated" else []) for c, k in COLUMNS.values()),
            ]
        )
    print_table(title, ["network", "seeds", *COLUMNS], rows)


def print_losses(groups: dict[str, list[Path]], found: dict[Path, Figures]) -> None:
    """Geometry error with a camera lost, and on rare combinations."""
    lost = [name for name in next(iter(found.values()))["conditions"] if name.startswith("without_")]
    rows = []
    for key, paths in groups.items():
        plain = [found[path]["conditions"]["uncalibrated"]["geometry_mm"] for path in paths]
        cells = [key, spread(plain)]
        for name in lost:
            values = [found[path]["conditions"][name]["geometry_mm"] for path in paths]
            cells.append(f"{spread(values)} ({np.mean(values) / np.mean(plain) - 1:+.1%})")
        held = [found[path]["combined"].get("uncalibrated", {}).get("geometry_mm") for path in paths]
        rows.append([*cells, spread(held)])
    head = ["network", "all cameras", *(name.replace("_", " ") for name in lost), "rare combinations"]
    print_table("Lost cameras and combinations, geometry error in mm", head, rows)


def find_rivals(
    models: dict[Path, HeadsetPredictor], arrays: HeadsetArrays, plain: HeadsetTraining
) -> dict[str, list[Figures]]:
    """Comparisons of modular with holistic models of equal other settings and seed, by the modular one's name."""
    rivals = defaultdict(list)
    for one in models.values():
        for other in models.values():
            mine, theirs = (recipe_of(model.model.training) for model in (one, other))
            if (mine.pop("architecture"), theirs.pop("architecture")) != ("modular", "holistic"):
                continue
            # settings that only one of the two kinds has
            for name in ("modulation", "part_loss", "part_loss_elsewhere", "skip", "hidden"):
                mine.pop(name, None)
                theirs.pop(name, None)
            if mine == theirs and one.model.training.rows == other.model.training.rows:
                rivals[label(one, plain)].append(asdict(compare(one, other, arrays)))
    return rivals


def print_rivals(rivals: dict[str, list[Figures]], title: str) -> None:
    """Geometry errors of both, and shares of frames and people in which the modular one is nearer."""
    rows = []
    for key, pairs in rivals.items():
        for part, condition, what in (
            ("conditions", "uncalibrated", "ordinary"),
            ("conditions", "same_seat", "ordinary, calibrated"),
            ("conditions", "without_left_eye", "left eye lost"),
            ("components", "dense", "dense"),
            ("components", "one_sided", "one-sided, winks"),
            ("combined", "uncalibrated", "rare combinations"),
        ):
            entries = [pair[part][condition] for pair in pairs if condition in pair[part]]
            if not entries:
                continue
            less = [100 * (entry["geometry_mm"] / entry["rival_mm"] - 1) for entry in entries]
            means = (np.mean([entry[name] for entry in entries]) for name in ("geometry_mm", "rival_mm"))
            shares = (spread((100 * entry[name] for entry in entries), 1) for name in ("better", "people"))
            cells = (f"{mean:.3f}" for mean in means)
            rows.append([key, what, entries[0]["rows"], len(entries), *cells, spread(less, 1), *shares])
    head = ["modular network", "frames", "rows", "seeds", "modular mm", "holistic mm", "difference %"]
    print_table(title, [*head, "better frames %", "better people %"], rows)


def print_data(groups: dict[str, list[Path]], found: dict[str, dict[Path, Figures]]) -> None:
    """Geometry error and R2 on each set of data."""
    head, rows = ["network"], []
    for name in found:
        head += [f"{name} mm", "R²", "gaze °", "calibrated mm"]
    for key, paths in groups.items():
        cells = [key]
        for by in found.values():
            for condition, figure in (
                ("uncalibrated", "geometry_mm"),
                ("uncalibrated", "r2"),
                ("uncalibrated", "gaze_deg"),
                ("same_seat", "geometry_mm"),
            ):
                cells.append(spread(by[path]["conditions"].get(condition, {}).get(figure) for path in paths))
        rows.append(cells)
    floors = [next(iter(by.values()))["floors"]["rest"] for by in found.values()]
    cells = [
        [spread([one["geometry_mm"]]), spread([one["r2"]]), spread([one["gaze_deg"]]), ""] for one in floors
    ]
    rows.append(["floor: rest", *(cell for of in cells for cell in of)])
    first = next(iter(groups.values()))[0]
    cells = [
        [people_error(by[first], "uncalibrated"), "", "", people_error(by[first], "same_seat")]
        for by in found.values()
    ]
    rows.append(["standard error of mm over people", *(cell for of in cells for cell in of)])
    print_table("Other pictures", head, rows)


def people_error(figures: Figures, condition: str) -> str:
    """How far a set of other people would move the mean error of one network, and how many people say so."""
    errors = [person[condition] for person in figures["people_mm"].values() if condition in person]
    return f"{np.std(errors, ddof=1) / np.sqrt(len(errors)):.3f} ({len(errors)} people)" if errors else ""


def print_shapes(key: str, figures: list[Figures]) -> None:
    """R2 of each shape: alone, calibrated, and from each camera by itself; both sides of the face together."""
    cameras = list(figures[0]["cameras"])
    rows = []
    for shape in BLENDSHAPES:
        if (
            shape.endswith("Right")
            and shape.replace("Right", "Left") in BLENDSHAPES
            and not shape.startswith(("jaw", "mouthR"))
        ):
            continue
        cells = [figures[0]["shapes"][shape]["uncalibrated"]["r2"]]
        if cells[0] is None:
            continue
        of = [
            spread((one["shapes"][shape].get(c, {}).get("r2") for one in figures), 2)
            for c in ("uncalibrated", "same_seat")
        ]
        alone = [spread((one["cameras"][camera][shape] for one in figures), 2) for camera in cameras]
        mae = [
            spread((one["shapes"][shape].get(c, {}).get("mae") for one in figures), 3)
            for c in ("uncalibrated", "same_seat")
        ]
        rows.append([shape, *of, *alone, *mae])
    head = [
        "shape",
        "R²",
        "calibrated",
        *(f"{camera.replace('_', ' ')} only" for camera in cameras),
        "MAE",
        "calibrated",
    ]
    print_table(f"What each camera sees: {key} (left shapes stand for both sides)", head, rows)


def print_curve(models: dict[Path, HeadsetPredictor], found: dict[Path, Figures]) -> None:
    """By how many people the models were trained on, where that differs and nothing else does but kind and seed."""
    points, free = defaultdict(list), ("architecture", "seed", "people")
    plain = {k: v for k, v in recipe_of(next(iter(models.values())).model.training).items() if k not in free}
    for path, one in models.items():
        record = one.model.training
        if {k: v for k, v in recipe_of(record).items() if k not in free} != plain:
            continue
        points[(record.people, record.rows, record.recipe["architecture"])].append(found[path]["conditions"])
    if len({people for people, _, _ in points}) < 2:
        return
    titles = ("mm", "R²", "blink R²", "gaze °", "calibrated mm", "calibrated R²")
    rows = [
        [
            architecture,
            people,
            frames,
            *(spread(one.get(c, {}).get(k) for one in of) for c, k in map(COLUMNS.get, titles)),
        ]
        for (people, frames, architecture), of in sorted(points.items())
    ]
    print_table("By people in training", ["network", "people", "frames", *titles], rows)


def print_drawn(
    models: dict[Path, HeadsetPredictor], groups: dict[str, list[Path]], arrays: HeadsetArrays, count: int
) -> Figures:
    """RMSE and SSIM of the face drawn from the front with predicted weights against true ones."""
    rows = np.flatnonzero((arrays.split == "test") & ~arrays.neutral)
    rows = rows[np.linspace(0, len(rows) - 1, count).round().astype(int)]
    rig = load_rig(arrays.description["rig"])

    def drawn(weights: np.ndarray) -> list[np.ndarray]:
        played = play_weights(rig, weights.astype(np.float64), np.arange(len(weights)) / 30, title="frames")
        plain = replace(played, look=None)  # as when the figures of docs/measurements were made
        return list(pictures(plain, height_px=SHOWN_PX, landmarks=False, window_m=WINDOW_M))

    true = drawn(arrays.weights[rows])
    result, table = {}, []
    for key, paths in groups.items():
        for path in paths:
            one = models[path]
            conditions = {"uncalibrated": Condition(), "calibrated": Condition(calibration="same_seat")}
            if one.model.calibration == "none":
                conditions.pop("calibrated")
            result[str(path)] = {
                name: picture_errors(
                    true, drawn(np.clip(estimate(one.graph, one.model, arrays, rows, how).weights, 0, 1))
                )
                for name, how in conditions.items()
            }
        cells = [
            spread((result[str(path)].get(name, {}).get(what) for path in paths), 4)
            for name in ("uncalibrated", "calibrated")
            for what in ("rmse", "ssim")
        ]
        table.append([key, len(paths), *cells])
    rest = picture_errors(true, drawn(np.zeros((len(rows), len(BLENDSHAPES)))))
    table.append(["floor: rest", "", f"{rest['rmse']:.4f}", f"{rest['ssim']:.4f}", "", ""])
    head = ["network", "seeds", "RMSE", "SSIM", "calibrated RMSE", "calibrated SSIM"]
    print_table(
        f"Drawn faces: {count} frames, {SHOWN_PX} pixels high, face pixels only, grey levels 0 to 1",
        head,
        table,
    )
    return result


def picture_errors(true: list[np.ndarray], found: list[np.ndarray]) -> dict[str, float]:
    """Means over pictures: RMSE in 0 to 1, and SSIM (Wang et al. 2004), where either picture shows the face."""
    rmse, ssim = [], []
    for one, other in zip(true, found, strict=True):
        grey = [cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY) for picture in (one, other)]
        face = (grey[0] < 255) | (grey[1] < 255)  # the background is white
        rmse.append(np.sqrt(np.mean((grey[0][face] / 255 - grey[1][face] / 255) ** 2)))
        _, likeness = cv2.quality.QualitySSIM_compute(*grey)
        ssim.append(likeness[face].mean())
    return {"rmse": float(np.mean(rmse)), "ssim": float(np.mean(ssim))}


def print_times(
    models: dict[Path, HeadsetPredictor], groups: dict[str, list[Path]]
) -> dict[str, dict[str, float]]:
    result = {
        key: {timing.name: timing.microseconds for timing in time_headset(models[paths[0]])}
        for key, paths in groups.items()
        if key in ("modular", "holistic")
    }
    rows = [[key, *(f"{taken / 1000:.2f}" for taken in times.values())] for key, times in result.items()]
    print_table(
        "Milliseconds a frame, onnxruntime, one core", ["network", *next(iter(result.values()))], rows
    )
    return result


def spread(values: Iterable[float | None], decimals: int = 3) -> str:
    """Mean, and standard deviation where there are several."""
    known = [value for value in values if value is not None]
    if not known:
        return ""
    mean = f"{np.mean(known):.{decimals}f}"
    return mean if len(known) < 2 else f"{mean} ± {np.std(known, ddof=1):.{decimals}f}"


def print_table(title: str, head: list[str], rows: list[list]) -> None:
    if not rows:
        return
    print(f"\n{title}\n")
    print(f"| {' | '.join(head)} |\n|{'---|' * len(head)}")
    for row in rows:
        print(f"| {' | '.join(map(str, row))} |")


if __name__ == "__main__":
    main()
