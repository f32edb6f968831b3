"""Draws the pictures of docs/headset-networks.md.

    facegen headset preview docs/examples/mine.toml --out mine.png
    facegen generate datasets/headset-other-layout.toml --out datasets/out/headset-other-layout
    python docs/figures/headset_networks.py headset mine.png datasets/out/headset-other-layout
    python docs/figures/headset_networks.py frames TRAINING_ARRAYS
    python docs/figures/headset_networks.py network models/headset ARRAYS

`headset` makes headset-mine.png and headset-mine-views.png, `frames` headset-network-frames.png: a person of whom there
are frames of the most kinds, one of each. `network` makes headset-network-training.png,
headset-network-cameras.png, headset-network-points.png and headset-network-faces.png: of unseen people in the arrays'
test split, the points that the network traces; and the cameras' pictures, the true face and the predicted one, both
drawn on the rig's mean head.
"""

import sys
from pathlib import Path

import cv2
import numpy as np
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from PIL import Image

from facegen.conventions import BLENDSHAPES, VIEW_POINTS
from facegen.preview import pictures, play_weights
from facegen.preview.performance import FACE_M
from facegen.rigs import load_rig
from regress.learning.headset.arrays import read_arrays
from regress.learning.headset.evaluation import Condition, estimate, evaluate
from regress.runtime.headset.network.figures import Evaluation
from regress.runtime.headset.network.predictor import load_headset_predictor

OUT = Path(__file__).resolve().parents[1] / "pictures"
FACES = 7
ORDER = ("right_eye", "left_eye", "mouth")
"""Of the views: the subject's right is at the picture's left."""


def main() -> None:
    """Draw what the first word asks for."""
    what, *arguments = sys.argv[1:]
    if what == "headset":
        draw_headset(*map(Path, arguments))
    elif what == "frames":
        draw_frames(*map(Path, arguments))
    else:
        draw_network(*map(Path, arguments))


def draw_headset(preview: Path, dataset: Path) -> None:
    """The headset round a head; and what its cameras see of six people."""
    Image.open(preview).convert("RGB").save(OUT / "headset-mine.png", optimize=True)
    folders = sorted(dataset.glob("renders/*/*"))
    chosen = [folders[index] for index in np.linspace(2, len(folders) - 1, 6).round().astype(int)]
    columns = [
        np.vstack([cv2.imread(str(one / f"{name}.png"), cv2.IMREAD_GRAYSCALE) for name in ORDER])
        for one in chosen
    ]
    cv2.imwrite(str(OUT / "headset-mine-views.png"), np.hstack(columns))


def draw_frames(arrays: Path) -> None:
    """One frame of each kind of a person: what training is made of."""
    frames = read_arrays(arrays)
    kinds = {person: set(frames.component[frames.person == person]) for person in np.unique(frames.person)}
    person = max(kinds, key=lambda one: (len(kinds[one]), -one))
    of_person = np.flatnonzero((frames.person == person) & ~frames.neutral)
    rows = {"neutral": int(np.flatnonzero((frames.person == person) & frames.neutral)[0])}
    for row in of_person:
        rows.setdefault(str(frames.component[row]), int(row))
    figure = Figure(figsize=(1.5 * len(rows), 4.75), dpi=100)
    FigureCanvasAgg(figure)
    grid = figure.subplots(len(ORDER), len(rows))
    figure.subplots_adjust(left=0.002, right=0.998, top=0.95, bottom=0.005, wspace=0.02, hspace=0.02)
    for column, (kind, row) in enumerate(rows.items()):
        grid[0, column].set_title(kind.replace("_", " "), fontsize=9)
        for axes, name in zip(grid[:, column], ORDER, strict=True):
            axes.imshow(frames.pictures[name][row], cmap="gray", vmin=0, vmax=255)
            axes.set_axis_off()
    figure.savefig(OUT / "headset-network-frames.png")


def draw_network(model: Path, arrays: Path) -> None:
    """How the training went, what each camera sees, and faces."""
    predictor, frames = load_headset_predictor(model), read_arrays(arrays)
    figures = evaluate(predictor.graph, predictor.model, frames)
    draw_training(predictor.model.training.history)
    draw_cameras(figures)
    draw_points(predictor, frames)
    draw_faces(predictor, frames)


def draw_training(history: list[dict[str, float]]) -> None:
    """Validation error by epoch."""
    figure = Figure(figsize=(7.2, 2.6), dpi=110)
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    epochs = np.arange(1, len(history) + 1)
    axes.plot(epochs, [epoch["validation"] for epoch in history], color="#1f6feb", linewidth=1.6)
    axes.axhline(1, color="#8a939a", linestyle=":", linewidth=1)
    axes.text(epochs[-1], 1, "training mean", ha="right", va="bottom", fontsize=8, color="#5d676e")
    axes.set_xlabel("epoch")
    axes.set_ylabel("validation error\n(1: training mean)")
    axes.set_ylim(0, 1.1)
    _save(figure, axes, "headset-network-training.png")


def draw_cameras(figures: Evaluation) -> None:
    """R2 of each shape with all cameras, without and with a neutral picture, and with one camera only."""
    series = {
        "all cameras, neutral picture": [
            getattr(figures.shapes[name].get("same_seat"), "r2", None) for name in BLENDSHAPES
        ],
        "all cameras": [figures.shapes[name]["uncalibrated"].r2 for name in BLENDSHAPES],
        **{f"{camera.replace('_', ' ')} only": list(of.values()) for camera, of in figures.cameras.items()},
    }
    table = np.array([[np.nan if value is None else value for value in row] for row in series.values()])
    shown = ~np.isnan(table[1])
    figure = Figure(figsize=(11, 2.9), dpi=110)
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    drawn = axes.imshow(np.clip(table[:, shown], 0, 1), cmap="Blues", vmin=0, vmax=1, aspect="auto")
    names = [name for name, there in zip(BLENDSHAPES, shown, strict=True) if there]
    axes.set_xticks(range(len(names)), names, rotation=90, fontsize=7)
    axes.set_yticks(range(len(series)), list(series), fontsize=8)
    figure.colorbar(drawn, ax=axes, pad=0.01, fraction=0.03).set_label("R²", fontsize=8)
    _save(figure, axes, "headset-network-cameras.png")


def draw_points(predictor, frames) -> None:
    """What is traced in a left eye's pictures and the mouth's, from small errors of the iris to large ones."""
    rows = np.flatnonzero((frames.split == "test") & ~frames.neutral)
    cameras = ("left_eye", "mouth")
    found = predictor.graph.trace({name: frames.pictures[name][rows] for name in cameras})
    names = {name: predictor.model.points[name] for name in cameras}
    true = {
        name: frames.points[name][np.ix_(rows, [VIEW_POINTS.index(point) for point in names[name]])]
        for name in cameras
    }
    iris = [column for column, point in enumerate(names["left_eye"]) if "_iris_" in point]
    errors = np.linalg.norm(found["left_eye"] - true["left_eye"], axis=2)[:, iris].mean(axis=1)
    known = np.flatnonzero(np.isfinite(errors))
    order = known[np.argsort(errors[known])]
    chosen = order[np.linspace(0, len(order) - 1, FACES + 2).round().astype(int)[1:-1]]
    figure = Figure(figsize=(14, 4.2), dpi=100)
    FigureCanvasAgg(figure)
    grid = figure.subplots(len(cameras), FACES)
    figure.subplots_adjust(left=0.002, right=0.998, top=0.94, bottom=0.005, wspace=0.02, hspace=0.02)
    for column, place in enumerate(chosen):
        for axes, name in zip(grid[:, column], cameras, strict=True):
            axes.imshow(frames.pictures[name][rows[place]], cmap="gray", vmin=0, vmax=255)
            shown = np.isfinite(true[name][place]).all(axis=1)
            axes.scatter(*true[name][place].T, s=26, facecolors="none", edgecolors="#ffd33d", linewidths=0.7)
            axes.scatter(*found[name][place][shown].T, s=5, color="#2dd4ff", linewidths=0)
            axes.set_xlim(-0.5, 95.5)
            axes.set_ylim(95.5, -0.5)
            axes.set_axis_off()
        grid[0, column].set_title(f"iris {errors[place]:.2f} px", fontsize=9)
    figure.savefig(OUT / "headset-network-points.png")


def draw_faces(predictor, frames) -> None:
    """Frames of the test split at even places of the errors' order, from the best to the worst."""
    rows = np.flatnonzero((frames.split == "test") & ~frames.neutral)
    conditions = [Condition(), Condition(calibration="same_seat")]
    said = [estimate(predictor.graph, predictor.model, frames, rows, one).weights for one in conditions]
    errors = frames.face.error_mm(said[0], frames.weights[rows])
    order = np.argsort(errors, kind="stable")
    order = order[frames.weights[rows][order].sum(axis=1) > 1.5]  # faces that do something
    chosen = order[np.linspace(0, len(order) - 1, FACES + 2).round().astype(int)[1:-1]]
    rig = load_rig(frames.description["rig"])
    strips = [frames.weights[rows[chosen]], *(np.clip(one[chosen], 0, 1) for one in said)]
    figure = Figure(figsize=(11, 9.2), dpi=100)
    FigureCanvasAgg(figure)
    grid = figure.subplots(len(ORDER) + len(strips), FACES, gridspec_kw={"height_ratios": [1] * 6})
    figure.subplots_adjust(left=0.075, right=0.995, top=0.96, bottom=0.005, wspace=0.03, hspace=0.03)
    for column, place in enumerate(chosen):
        for row, name in enumerate(ORDER):
            grid[row, column].imshow(frames.pictures[name][rows[place]], cmap="gray", vmin=0, vmax=255)
        grid[0, column].set_title(f"{errors[place]:.2f} mm", fontsize=9)
    for number, weights in enumerate(strips):
        played = play_weights(rig, weights.astype(np.float64), np.arange(FACES) / 30, title="faces")
        for column, picture in enumerate(pictures(played, height_px=190, landmarks=False, window_m=FACE_M)):
            grid[len(ORDER) + number, column].imshow(picture)
    for row, words in enumerate(
        ("right eye", "left eye", "mouth", "true", "predicted", "with neutral\npicture")
    ):
        grid[row, 0].set_ylabel(words, fontsize=9)
    for axes in grid.flat:
        axes.set_xticks([])
        axes.set_yticks([])
        for spine in axes.spines.values():
            spine.set_visible(False)
    path = OUT / "headset-network-faces.png"
    figure.savefig(path)
    Image.open(path).convert("RGB").quantize(160, dither=Image.Dither.NONE).save(path, optimize=True)


def _save(figure: Figure, axes, name: str) -> None:
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)
    figure.tight_layout()
    figure.savefig(OUT / name)


if __name__ == "__main__":
    main()
