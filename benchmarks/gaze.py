"""Measures gaze: in degrees where irises are seen, and how far a head may turn until lids tell less than nothing.

    python benchmarks/gaze.py irises DATASET
    python benchmarks/gaze.py lids DATASET MODEL

*irises*: people's own eyes look as the dataset says, from its test people's heads; error of the directions of open
eyes, for the mean person's and with the irises of ten neutral frames.
*lids*: people who look straight ahead while their heads turn, beside their own frontal neutral frame: root mean square
of the eight eyeLook weights, which should be 0. DATASET should be of another rig than MODEL's.

docs/gaze.md has a run's tables.
"""

import argparse
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq

from facegen.conventions import BLENDSHAPE_INDEX
from facegen.geometry import apply_transform, project_pinhole
from facegen.rigs import load_rig
from facegen.rigs.eyes import limbus_offset
from regress import load_model
from regress.learning.probes.faces import read_faces
from regress.learning.training.noise import displace, draw_bias
from regress.runtime.heads.camera import CameraSettings
from regress.runtime.sample import Sample
from regress.runtime.stages.gaze import LOOKS
from regress.runtime.stages.head import HeadPose, HeadSettings

YAWS_DEG = (0, 10, 15, 20, 25, 30, 40)
COUNT = 400
FRAMES = 10
"""Neutral frames of a person: one, with jitter of its own each time."""

OPEN = 0.3
"""Most eyeBlink of an open eye."""

JITTER = 0.01
"""Of landmarks and irises, in outer-eye distances."""


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("what", choices=["irises", "lids"])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("model", type=Path, nargs="?")
    arguments = parser.parse_args()
    if arguments.what == "irises":
        irises(arguments.dataset)
    else:
        lids(arguments.dataset, arguments.model)


def irises(dataset: Path) -> None:
    """Print the table of eyes that are seen."""
    columns = (
        "person",
        "neutral",
        "split",
        "identity",
        "gaze",
        "camera_from_head",
        "intrinsics",
        "points_2d",
        "image_size",
        "weights",
    )
    table = pq.read_table(dataset / "keypoints", columns=list(columns)).to_pandas()
    blinks = np.stack(table.weights)[:, [BLENDSHAPE_INDEX["eyeBlinkLeft"], BLENDSHAPE_INDEX["eyeBlinkRight"]]]
    table = table[blinks.max(axis=1) < OPEN]
    resolved = (dataset / "spec.toml").read_text()
    rig = load_rig(next(line.split('"')[1] for line in resolved.splitlines() if line.startswith("rig = ")))
    seen = (
        table[(table.split == "test") & ~table.neutral]
        .iloc[: 10 * COUNT]
        .groupby("person")
        .head(1)
        .iloc[:COUNT]
    )
    first = table[table.neutral].drop_duplicates("person").set_index("person").loc[seen.person].reset_index()
    (faces, eyes, gaze), (calm, calm_eyes, _) = (_seen(rows, rig) for rows in (seen, first))
    width, height = seen.image_size.iloc[0]
    rng = np.random.default_rng(3)
    print("| points | camera | eyes | median | 95 % | yaw | pitch |\n|---|---|---|---|---|---|---|")
    for points, noise in (("exact", 0.0), ("0.3 % of jitter", JITTER / 3), ("1 % of jitter", JITTER)):

        def jittered(faces: np.ndarray, eyes: np.ndarray, noise: float = noise) -> np.ndarray:
            whole = np.concatenate([faces, eyes], axis=1)
            return whole + noise * _size(faces) * rng.normal(size=whole.shape)

        moved = jittered(faces, eyes)
        rest = np.stack([jittered(calm, calm_eyes) for _ in range(FRAMES)], axis=1)
        for known, camera in (
            ("known", CameraSettings(picture_px=(int(width), int(height)))),
            ("unknown", CameraSettings()),
        ):
            for own in (False, True):
                found = [
                    _gaze(now, calmly, camera)
                    for now, calmly in zip(moved, rest if own else len(rest) * [None], strict=True)
                ]
                off = np.degrees(np.abs(np.array(found) - gaze))
                both = np.hypot(off[:, ::2], off[:, 1::2])
                cells = (
                    np.median(both),
                    np.percentile(both, 95),
                    np.median(off[:, ::2]),
                    np.median(off[:, 1::2]),
                )
                eyes_of = "own neutral" if own else "mean"
                print(f"| {points} | {known} | {eyes_of} |", *(f"{cell:.1f} |" for cell in cells))


def _gaze(face: np.ndarray, neutral: np.ndarray | None, camera: CameraSettings) -> np.ndarray:
    """Gaze (4,) of a face (70, 2), beside neutral ones (m, 70, 2)."""
    known = {} if neutral is None else {"neutral": neutral[:, :68], "neutral_irises": neutral[:, 68:]}
    return (
        HeadPose(HeadSettings(camera=camera, **known)).step(Sample(points=face[:68], irises=face[68:])).gaze
    )


def _seen(rows, rig) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Faces (n, 68, 2), irises (n, 2, 2) and gaze (n, 4) of a dataset's rows."""
    identity, gaze, intrinsics, pose = (
        np.stack(rows[name]).astype(float) for name in ("identity", "gaze", "intrinsics", "camera_from_head")
    )
    axes = gaze.reshape(-1, 2, 3)
    middle = rig.eye_center + np.einsum("nk,ked->ned", identity, rig.eye_center_identity)
    radius = rig.eye_radius + identity @ rig.eye_radius_identity
    in_camera = apply_transform(pose.reshape(-1, 4, 4), middle + limbus_offset(radius)[..., None] * axes)
    angles = np.stack([np.arctan2(axes[..., 0], axes[..., 2]), np.arcsin(axes[..., 1])], axis=-1)
    faces = np.stack(rows.points_2d).reshape(-1, 68, 2).astype(float)
    return faces, project_pinhole(in_camera, intrinsics), angles.reshape(-1, 4)


def _size(faces: np.ndarray) -> np.ndarray:
    return np.linalg.norm(faces[:, 45] - faces[:, 36], axis=1)[:, None, None]


def lids(dataset: Path, model: Path) -> None:
    """Print the table of guesses."""
    loaded, faces = load_model(model), read_faces(dataset)
    neutral = faces.take(np.flatnonzero(faces.neutral)).some(COUNT // 2)
    rng = np.random.default_rng(0)
    bias = draw_bias(rng, len(neutral.person))
    print("| points |", *(f"{yaw} |" for yaw in YAWS_DEG))
    print("|---|" + "---|" * len(YAWS_DEG))
    for points, share in (("exact", 0.0), ("detector-like", 1.0)):

        def detected(faces: np.ndarray, share: float = share) -> np.ndarray:
            return displace(faces, share * (bias + JITTER * rng.normal(size=bias.shape)))

        frontal = detected(neutral.turned(yaw_deg=0, pitch_deg=0))
        own = [loaded.calibrate(face[None]) for face in frontal]
        cells = []
        for yaw in YAWS_DEG:
            turned = detected(neutral.turned(yaw_deg=yaw, pitch_deg=0))
            weights = [each.predict(face[None])[0, LOOKS] for each, face in zip(own, turned, strict=True)]
            cells.append(f"{np.sqrt(np.mean(np.square(weights))):.2f} |")
        print(f"| {points} |", *cells)


if __name__ == "__main__":
    main()
