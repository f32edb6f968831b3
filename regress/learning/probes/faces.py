"""Reads exact faces of a dataset that can be turned: points in the head, and the camera that sees them."""

from dataclasses import dataclass, fields
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_COUNT, SHARD_ROWS
from regress.errors import InputError
from regress.learning.labels import Columns, read_labels

_WIDTHS = {
    "weights": len(BLENDSHAPES),
    "points_2d": LANDMARK_COUNT * 2,
    "points_3d": LANDMARK_COUNT * 3,
    "camera_from_head": 16,
    "intrinsics": 4,
}

_FACING = np.array([1.0, -1.0, -1.0])
"""Diagonal of the rotation from a head to a camera that it faces: y goes from up to down, z from out to ahead."""


@dataclass(frozen=True, kw_only=True)
class ProbeFaces:
    """Rows of a dataset with everything that a probe needs.

    Parameters
    ----------
    points_px : (n, 68, 2) float64
        Exact points as the dataset's camera sees them.
    points_m : (n, 68, 3) float64
        The same in the head frame.
    camera_from_head : (n, 4, 4) float64
    intrinsics : (n, 4) float64
        fx, fy, cx, cy in pixels; the keypoint camera is a pinhole.
    weights : (n, 52) float64
    person : (n,) int64
    neutral : (n,) bool
    split : (n,) str
    """

    points_px: np.ndarray
    points_m: np.ndarray
    camera_from_head: np.ndarray
    intrinsics: np.ndarray
    weights: np.ndarray
    person: np.ndarray
    neutral: np.ndarray
    split: np.ndarray

    def take(self, rows: np.ndarray) -> "ProbeFaces":
        """Some of the rows."""
        return ProbeFaces(**{field.name: getattr(self, field.name)[rows] for field in fields(self)})

    def some(self, count: int) -> "ProbeFaces":
        """At most ``count`` rows, evenly apart."""
        rows = np.unique(np.linspace(0, len(self.person) - 1, min(count, len(self.person))).astype(int))
        return self.take(rows)

    @property
    def pose_deg(self) -> tuple[np.ndarray, np.ndarray]:
        """Yaw to the subject's left and pitch upwards of every head (n,), by ``camera_from_head`` alone."""
        rotation = _FACING[:, None] * self.camera_from_head[:, :3, :3]
        yaw = np.arctan2(rotation[:, 0, 2], rotation[:, 2, 2])
        return np.degrees(yaw), np.degrees(np.arcsin(np.clip(rotation[:, 1, 2], -1, 1)))

    def beside_neutral(self, split: str) -> tuple["ProbeFaces", "ProbeFaces"]:
        """Faces of a split that are not neutral, and row by row the first neutral face of the same person."""
        first = {}
        for row in np.flatnonzero(self.neutral):
            first.setdefault(self.person[row], row)
        rows = [
            row for row in np.flatnonzero((self.split == split) & ~self.neutral) if self.person[row] in first
        ]
        if not rows:
            raise InputError(
                f"the dataset has no face of the {split} split beside a neutral one of the same person, which a "
                "report with data needs; a spec's [still] neutral says how many each person has"
            )
        return self.take(np.array(rows)), self.take(np.array([first[self.person[row]] for row in rows]))

    def turned(self, *, yaw_deg: float, pitch_deg: float) -> np.ndarray:
        """The faces on the camera's axis, as far away as they are, turned to one pose.

        Parameters
        ----------
        yaw_deg, pitch_deg
            To the subject's left, and upwards; roll is 0.

        Returns
        -------
        (n, 68, 2) float64
            Pixels. Landmarks are fixed points of the face, so a turned face needs no rig; hidden ones stay.
        """
        depth_m = self.camera_from_head[:, 2, 3]
        return _projected(self.points_m @ _rotation(yaw_deg, pitch_deg).T, depth_m, self.intrinsics)


def frontal(points_m: np.ndarray, camera: ProbeFaces) -> np.ndarray:
    """Faces (n, 68, 3) in their heads, facing the cameras that see the rows of ``camera``; (n, 68, 2) pixels."""
    return _projected(points_m, camera.camera_from_head[:, 2, 3], camera.intrinsics)


def _rotation(yaw_deg: float, pitch_deg: float) -> np.ndarray:
    """Ry(yaw) Rx(-pitch), as a dataset's spec means the two (docs/conventions.md)."""
    (cy, cp), (sy, sp) = np.cos(np.radians([yaw_deg, pitch_deg])), np.sin(np.radians([yaw_deg, pitch_deg]))
    about_y = np.array([[cy, 0, sy], [0, 1, 0], [-sy, 0, cy]])
    about_x = np.array([[1, 0, 0], [0, cp, sp], [0, -sp, cp]])
    return about_y @ about_x


def _projected(points_m: np.ndarray, depth_m: np.ndarray, intrinsics: np.ndarray) -> np.ndarray:
    in_camera_m = points_m * _FACING
    in_camera_m[..., 2] += depth_m[:, None]
    on_plane = in_camera_m[..., :2] / in_camera_m[..., 2:]
    return on_plane * intrinsics[:, None, :2] + intrinsics[:, None, 2:]


def read_faces(folder: Path) -> ProbeFaces:
    """Read all rows of a dataset's keypoints.

    Raises
    ------
    InputError
        Where the folder has no shards, or one is unreadable or lacks a column.
    """
    shards = sorted((Path(folder) / "keypoints").glob("shard-*.parquet"))
    if not shards:
        raise InputError(
            f"{Path(folder) / 'keypoints'} holds no shard-*.parquet; facegen generate writes them"
        )
    columns = Columns(single={"person": "whole", "neutral": "truth", "split": "word"}, lists=_WIDTHS)
    advice = "leave --data out, or give a dataset as facegen generate writes it"
    read = [
        read_labels(
            shard,
            columns,
            most_rows=SHARD_ROWS,
            without=f", which a report with data needs; {advice}",
            damaged=advice,
        )
        for shard in shards
    ]
    labels = {name: np.concatenate([shard[name] for shard in read]) for name in columns.names}
    values = {name: labels[name].astype(np.float64) for name in _WIDTHS}
    return ProbeFaces(
        points_px=values["points_2d"].reshape(-1, LANDMARK_COUNT, 2),
        points_m=values["points_3d"].reshape(-1, LANDMARK_COUNT, 3),
        camera_from_head=values["camera_from_head"].reshape(-1, 4, 4),
        intrinsics=values["intrinsics"],
        weights=values["weights"],
        person=labels["person"],
        neutral=labels["neutral"],
        split=labels["split"],
    )
