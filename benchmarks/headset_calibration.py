"""Measures what a guided minute and adapted heads are worth, on rendered people whom the network has never seen.

    python benchmarks/headset_calibration.py headset-tracking3 --minute datasets/out/headset-guided-arrays \
        --others datasets/out/headset-test-arrays --adapt

People of `datasets/headset-guided.toml` do what `headset-guided.csv` says, in a seat of the headset; they are the same
people as those of `headset-test.toml`, who sit otherwise there. Each person's minute is calibrated as
`regress headset calibrate` does it. Errors are of the sixteen faces behind the minute in the same seat, and of ordinary
frames of the other dataset in two other seats. Glances are read behind the frames of the look,
as live at 30 a second. Shut eyes and rest are the minute's own frames: after the minute these figures are of a fit, and
say nothing of later frames. `--soft` blurs all pictures first, as a camera out of focus does. How far people open their
eyes at rest is compared over people, as traced and as labelled. Prints Markdown, which stands in
docs/measurements/headset-networks.md.
"""

import argparse
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, VIEW_POINTS
from regress.learning.headset.accuracy import gaze_error_deg
from regress.learning.headset.adaptation import adapted_graph, changes, judge, read_heads
from regress.learning.headset.arrays import HeadsetArrays, read_arrays
from regress.learning.headset.evaluation import COMBINED
from regress.learning.headset.known_frames import known_frames
from regress.runtime.headset.answers.eye_reader import EyeReader
from regress.runtime.headset.answers.traced_eyes import eye_features
from regress.runtime.headset.eyes.eye_points import EyePoints
from regress.runtime.headset.guided.minute import FACES, LOOK, REST, GuidedTake, person_of
from regress.runtime.headset.network.graph import HeadsetGraph
from regress.runtime.headset.network.predictor import HeadsetPredictor, load_headset_predictor
from regress.runtime.headset.person.person import OwnEnds, Person
from regress.runtime.ready_made import model_folder
from regress.runtime.stages.frame_clock import USUAL_FPS

MINUTE = ((REST, 4), *((face, 2) for face in FACES if face not in (REST, LOOK)), (LOOK, 9))
"""Frames of headset-guided.csv; eight glances and sixteen faces follow."""

TARGETS_DEG = [(yaw, pitch) for pitch in (12, 0, -12) for yaw in (-18, 0, 18)]
DISTANCE_M = 0.8
FIVE, NINE = (1, 3, 4, 5, 7), tuple(range(9))
GLANCES, JUDGED = 8, 16
BLINKS = ("eyeBlinkLeft", "eyeBlinkRight")
OPEN = 0.5


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("model")
    parser.add_argument("--minute", required=True, type=Path)
    parser.add_argument("--others", type=Path, help="the same people in other seats")
    parser.add_argument("--adapt", action="store_true", help="adapt last layers too")
    parser.add_argument("--soft", type=float, default=0.0, help="standard deviation of a blur in pixels")
    arguments = parser.parse_args()
    predictor, minute = load_headset_predictor(arguments.model), softened(arguments.minute, arguments.soft)
    others = None if arguments.others is None else softened(arguments.others, arguments.soft)
    graph = (model_folder(arguments.model) / "network.onnx").read_bytes() if arguments.adapt else None
    found: dict[tuple[str, str], list[float]] = defaultdict(list)
    people = np.unique(minute.person)
    for number in people:
        measure(predictor, minute, int(number), others, found, graph)
    openness = np.array([resting_openness(predictor, minute, int(number)) for number in people])
    places = list(dict.fromkeys(place for place, _ in found if "mm" in place))
    print(f"{len(people)} people; means over them.\n")
    print("| mean vertex error, mm | " + " | ".join(place.removesuffix(", mm") for place in places) + " |")
    print("|---|" + "---|" * len(places))
    for what in dict.fromkeys(what for place, what in found if place in places):
        print(f"| {what} | " + " | ".join(f"{np.mean(found[place, what]):.3f}" for place in places) + " |")
    print("\n| what | value |\n|---|---|")
    for (place, what), values in found.items():
        if place not in places:
            print(f"| {what} | {np.mean(values):.2f} ({min(values):.2f} to {max(values):.2f}) |")
    r = np.corrcoef(openness[..., 0].ravel(), openness[..., 1].ravel())[0, 1]
    print(f"| r over people of how far eyes are open at rest, both eyes, traced against labelled | {r:.2f} |")


def softened(folder: Path, blur_px: float) -> HeadsetArrays:
    """Arrays of a folder, their pictures blurred by a Gaussian."""
    arrays = read_arrays(folder)
    if not blur_px:
        return arrays
    pictures = {
        name: np.array([cv2.GaussianBlur(one, (0, 0), blur_px) for one in seen])
        for name, seen in arrays.pictures.items()
    }
    return replace(arrays, pictures=pictures)


def resting_openness(predictor: HeadsetPredictor, minute: HeadsetArrays, number: int) -> np.ndarray:
    """(2, 2): of each eye at rest, how far it is open in irises, as traced and as labelled."""
    rows = np.flatnonzero(minute.person == number)
    rows = rows[np.argsort(minute.frame[rows])][: MINUTE[0][1]]
    traced = predictor.graph.trace(pictures(minute, rows, predictor))
    found = []
    for camera in ("left_eye", "right_eye"):
        eye = EyePoints.of(predictor, camera)
        columns = [VIEW_POINTS.index(name) for name in predictor.model.points[camera]]
        found.append(
            [
                np.nanmedian(eye_features(points.astype(np.float64), eye)[1])
                for points in (traced[camera], minute.points[camera][rows][:, columns])
            ]
        )
    return np.array(found)


def measure(
    predictor: HeadsetPredictor,
    minute: HeadsetArrays,
    number: int,
    others: HeadsetArrays | None,
    found: dict[tuple[str, str], list[float]],
    graph: bytes | None,
) -> None:
    """Add one person's figures to what is found."""
    rows = np.flatnonzero(minute.person == number)
    rows = rows[np.argsort(minute.frame[rows])]
    spans, first = {}, 0
    for face, count in MINUTE:
        spans[face] = rows[first : first + count]
        first += count
    glances, judged = rows[first : first + GLANCES], rows[first + GLANCES : first + GLANCES + JUDGED]

    def take(face: str, targets: tuple[int, ...]) -> GuidedTake:
        chosen = {row: TARGETS_DEG[row] for row in targets} if face == LOOK else {}
        return GuidedTake(
            pictures=pictures(minute, spans[face], predictor), targets_deg=chosen, distance_m=DISTANCE_M
        )

    takes = {face: take(face, NINE) for face in spans}
    person, _ = person_of(predictor, takes)
    rest = {name: frames[1] for name, frames in takes[REST].pictures.items()}

    def judge_mm(
        place: str, arrays: HeadsetArrays, chosen: np.ndarray, neutral: dict[str, np.ndarray] | None
    ) -> None:
        true = arrays.weights[chosen]
        seen = pictures(arrays, chosen, predictor)
        plain = answers(predictor, seen, None, None)
        compared = answers(predictor, seen, neutral, None)
        own = answers(predictor, seen, neutral, person)
        for what, weights in (
            ("before", plain),
            ("neutral pictures", compared),
            ("after the minute", own),
        ):
            found[f"{place}, mm", what].append(float(arrays.face.error_mm(weights, true).mean()))
        if graph is not None:
            found[f"{place}, mm", "adapted"].append(
                float(arrays.face.error_mm(answers(adapted, seen, neutral, None), true).mean())
            )

    if graph is not None:
        frames = {face: one for face, one in takes.items() if face != LOOK}
        shown, neutral, known = known_frames(predictor, frames)
        heads = read_heads(graph, predictor.model, shown, neutral)
        held = judge(heads, known)
        own_graph = graph
        if held.better:
            own_graph = adapted_graph(
                graph, heads, changes(heads, known, np.arange(len(known.fold)), pull=held.pull)
            )
        adapted = HeadsetPredictor(
            model=predictor.model,
            graph=HeadsetGraph(own_graph, predictor.model.cameras, predictor.model.points),
        )
        found["", "share of people for whom `adapt` writes"].append(float(held.better))
    judge_mm("same seat", minute, judged, rest)
    if others is not None:
        chosen = np.flatnonzero((others.person == number) & ~others.neutral & (others.component != COMBINED))
        judge_mm("other seats, old rest", others, chosen, rest)
        for session in np.unique(others.session[chosen]):
            here = chosen[others.session[chosen] == session]
            own_rest = np.flatnonzero((others.session == session) & others.neutral)[:1]
            judge_mm(
                "other seats, their rest",
                others,
                here,
                {name: one[0] for name, one in pictures(others, own_rest, predictor).items()},
            )
    for what, own in (("before", None), ("after the minute", person)):
        shut, still = (
            answers(predictor, takes[face].pictures, rest if own else None, own) for face in ("shut", REST)
        )
        columns = [BLENDSHAPE_INDEX[name] for name in BLINKS]
        what = what if own is None else f"{what} (fit: the minute's own frames)"
        found["", f"eyeBlink of shut eyes, {what}"].append(float(shut[:, columns].mean()))
        looks = [name.startswith("eyeLook") for name in BLENDSHAPE_INDEX]
        found["", f"largest weight of a resting face, {what}"].append(
            float(np.median(still, axis=0)[~np.array(looks)].max())
        )
    true = minute.gaze[glances].reshape(-1, 2, 2)
    for what, targets in (("before", None), ("5 targets", FIVE), ("9 targets", NINE)):
        own = None if targets is None else person_of(predictor, takes | {LOOK: take(LOOK, targets)})[0]
        # as live, the eyes were seen before
        rows = np.concatenate([spans[LOOK], glances])
        said = gaze(predictor, pictures(minute, rows, predictor), rest, own)[-GLANCES:]
        found["", f"gaze of glances, degrees, {what}"].append(float(gaze_error_deg(said, true).mean()))


def pictures(arrays: HeadsetArrays, rows: np.ndarray, predictor: HeadsetPredictor) -> dict[str, np.ndarray]:
    """Pictures (n, h, w) of rows by camera."""
    return {name: np.asarray(arrays.pictures[name][rows]) for name in predictor.sizes}


def answers(
    predictor: HeadsetPredictor,
    seen: dict[str, np.ndarray],
    neutral: dict[str, np.ndarray] | None,
    person: Person | None,
) -> np.ndarray:
    """Weights (n, 52) as `predict` gives them, with a person's own ends where there is one."""
    estimates, traced = predictor.see(seen, neutral=neutral)
    weights = np.clip(estimates.weights.astype(np.float64), 0, 1)
    if person is None:
        return weights
    reader = EyeReader(predictor, person)
    ends = OwnEnds.of(person, reader.sides)
    for row in range(len(weights)):
        frame, points = ({name: one[row] for name, one in table.items()} for table in (seen, traced))
        eyes, _ = reader.read(0.0, frame, points, estimates.gaze[row].ravel())
        weights[row] = ends.apply(weights[row], eyes)
    return weights


def gaze(
    predictor: HeadsetPredictor,
    seen: dict[str, np.ndarray],
    neutral: dict[str, np.ndarray],
    person: Person | None,
) -> np.ndarray:
    """Gaze (n, 2, 2) in radians; both eyes meet in front."""
    estimates, traced = predictor.see(seen, neutral=neutral)
    reader = EyeReader(predictor, person)
    return np.array(
        [
            reader.read(
                1 / USUAL_FPS,
                {name: one[row] for name, one in seen.items()},
                {name: one[row] for name, one in traced.items()},
                estimates.gaze[row].ravel(),
            )[1].reshape(2, 2)
            for row in range(len(estimates.gaze))
        ]
    )


if __name__ == "__main__":
    main()
