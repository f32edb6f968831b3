"""Arrays of a headset drawn from formulas: every shape brightens a pattern of its own in the cameras that see it."""

import json
from functools import cache
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPES, CAMERA_TERMS, IRIS_POINTS, VIEW_POINTS, mirrored_name
from regress.runtime.headset.network.parts import part_of

CAMERAS = ("left_eye", "right_eye", "mouth")
SIDE = 24
NEUTRAL_AND_FACES = ("neutral", "upper_face", "lower_face", "dense", "combined")


def write_drawn_arrays(
    folder: Path, *, people: int = 30, sessions: int = 2, seed: int = 4, told: bool = False
) -> Path:
    """Write what ``facegen pack --format arrays`` writes, of drawn pictures; ``told``: of drawn headsets, too."""
    random = np.random.default_rng(seed)
    rows = []
    for person in range(people):
        looks = {camera: 10 * _smooth(random) for camera in CAMERAS}
        for session in range(sessions):
            seat = {camera: 4 * _smooth(random) for camera in CAMERAS}
            for component in NEUTRAL_AND_FACES:
                weights, gaze = _expression(random, component)
                pictures = {
                    camera: _picture(camera, weights, gaze) + looks[camera] + seat[camera]
                    for camera in CAMERAS
                }
                rows.append((person, session, component, weights, gaze, pictures))
    folder.mkdir(parents=True)
    split = ["test" if row[0] % 4 == 0 else "validation" if row[0] % 8 == 1 else "train" for row in rows]
    columns = {
        "sample": np.arange(len(rows)),
        "person": np.array([row[0] for row in rows]),
        "session": np.array([2 * row[0] + row[1] for row in rows]),
        "clip": np.zeros(len(rows), np.int64),
        "frame": np.zeros(len(rows), np.int32),
        "time_s": np.zeros(len(rows)),
        "split": pa.array(split),
        "neutral": np.array([row[2] == "neutral" for row in rows]),
        "component": pa.array([row[2] for row in rows]),
        "weights": _lists(np.stack([row[3] for row in rows])),
        "gaze": _lists(np.stack([row[4] for row in rows])),
        "head_from_headset": _lists(np.tile(np.eye(4).ravel(), (len(rows), 1))),
        "slip": _lists(np.zeros((len(rows), 6))),
        **{
            f"points_{camera}": _lists(np.stack([_points(camera, *row[3:5]) for row in rows]))
            for camera in CAMERAS
        },
    }
    if told:
        columns |= {f"camera_{camera}": _lists(_terms(camera, columns["session"])) for camera in CAMERAS}
    pq.write_table(pa.table(columns), folder / "labels.parquet")
    for camera in CAMERAS:
        pictures = np.stack([row[5][camera] for row in rows])
        np.save(folder / f"{camera}.npy", np.clip(pictures, 0, 255).astype(np.uint8))
    displacement = 0.004 * random.standard_normal((52, 40, 3))
    np.savez(
        folder / "face.npz", displacement=displacement.astype(np.float32), rest=np.zeros((40, 3), np.float32)
    )
    description = {
        "version": 3,
        "headset": "drawn3",
        "cameras": [{"name": camera, "width": SIDE, "height": SIDE} for camera in CAMERAS],
        "rows": len(rows),
        "rig": "drawn",
        "dataset_hash": f"drawn-{seed}",
        "licence": "CC0-1.0",
        "seed": seed,
        **({"drawn": True, "camera_terms": list(CAMERA_TERMS)} if told else {}),
    }
    (folder / "arrays.json").write_text(json.dumps(description))
    return folder


def _terms(camera: str, sessions: np.ndarray) -> np.ndarray:
    """(n, 14) of a camera that stands elsewhere in each session."""
    return np.stack(
        [np.random.default_rng([len(camera), one]).normal(size=len(CAMERA_TERMS)) for one in sessions]
    )


def _expression(random: np.random.Generator, component: str) -> tuple[np.ndarray, np.ndarray]:
    if component == "neutral":
        return np.zeros(52), np.zeros(4)
    weights = random.random(52) * (random.random(52) < 0.4)
    upper = np.array([name.startswith(("eye", "brow", "cheekSquint", "noseSneer")) for name in BLENDSHAPES])
    if component == "upper_face":
        weights[~upper] = 0
    if component == "lower_face":
        weights[upper] = 0
    if component == "combined":
        weights[[BLENDSHAPES.index(name) for name in ("jawOpen", "eyeBlinkLeft", "eyeBlinkRight")]] = 0.7
    weights[BLENDSHAPES.index("tongueOut")] = 0
    gaze = np.zeros(4) if component == "lower_face" else 0.3 * random.standard_normal(4)
    return weights, gaze


def dot_of(camera: str, weights: np.ndarray, gaze: np.ndarray) -> np.ndarray:
    """Pixel (2,) of the dark dot in a picture: an eye's pupil, or the chin."""
    if camera == "mouth":
        return np.array([11.5, 14 + 6 * weights[BLENDSHAPES.index("jawOpen")]])
    yaw, pitch = gaze[:2] if camera == "left_eye" else gaze[2:]
    return np.clip([11.5 + 10 * yaw, 11.5 - 10 * pitch], 1, SIDE - 2)


IRIS_RADIUS = 3.0
DOTS = {"left_eye": "left_pupil", "right_eye": "right_pupil", "mouth": "landmark_8"}


def _points(camera: str, weights: np.ndarray, gaze: np.ndarray) -> np.ndarray:
    """(268,) pixels of all view points; the lens reaches none but the dot, which counts as an eye's pupil and iris."""
    points = np.full((len(VIEW_POINTS), 2), np.nan)
    dot = dot_of(camera, weights, gaze)
    points[VIEW_POINTS.index(DOTS[camera])] = dot
    if camera != "mouth":
        angles = 2 * np.pi * np.arange(IRIS_POINTS) / IRIS_POINTS
        for place, towards in enumerate(np.stack([np.cos(angles), np.sin(angles)], axis=-1)):
            name = DOTS[camera].replace("pupil", f"iris_{place}")
            points[VIEW_POINTS.index(name)] = dot + IRIS_RADIUS * towards
    return points.ravel()


def _picture(camera: str, weights: np.ndarray, gaze: np.ndarray) -> np.ndarray:
    """The right eye's picture is what the left eye's would be of the mirrored face, mirrored."""
    picture = np.full((SIDE, SIDE), 110.0)
    for name in part_of(camera):
        picture += 60 * weights[BLENDSHAPES.index(name)] * _pattern(camera, name)
    if camera != "mouth":
        yaw, pitch = gaze[:2] if camera == "left_eye" else gaze[2:] * (-1, 1)
        turned = 60 * (yaw * _pattern("left_eye", "yaw") + pitch * _pattern("left_eye", "pitch"))
        picture += turned if camera == "left_eye" else turned[:, ::-1]
    down, across = np.indices((SIDE, SIDE))
    x, y = dot_of(camera, weights, gaze)
    return picture - 60 * np.exp(-((across - x) ** 2 + (down - y) ** 2) / 8)


@cache
def _pattern(camera: str, name: str) -> np.ndarray:
    """(SIDE, SIDE) of a shape in a camera; the mirrored shape's in the mirrored camera is its mirror image."""
    if camera == "right_eye" or (camera == "mouth" and name.endswith("Right")):
        partner = "left_eye" if camera == "right_eye" else camera
        return _pattern(partner, mirrored_name(name))[:, ::-1]
    return _smooth(np.random.default_rng([len(camera), *name.encode()]))


def _smooth(random: np.random.Generator) -> np.ndarray:
    y, x = np.mgrid[:SIDE, :SIDE] / SIDE
    waves = random.uniform(0.5, 3.0, (3, 2))
    phases = random.uniform(0, 2 * np.pi, 3)
    return np.mean(
        [np.sin(2 * np.pi * (a * x + b * y) + c) for (a, b), c in zip(waves, phases, strict=True)], 0
    )


def _lists(values: np.ndarray) -> pa.Array:
    return pa.FixedSizeListArray.from_arrays(pa.array(values.astype(np.float32).ravel()), values.shape[1])
