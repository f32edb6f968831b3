"""Faces drawn with a pencil, so that tests of models need neither a rig nor a dataset."""

from dataclasses import replace

import numpy as np

from facegen.conventions import BLENDSHAPES, LANDMARK_GROUPS
from facegen.geometry import rotation_from_angles
from regress.learning.training import KeypointDataset

SHAPE_MODES_SEED = 11


def drawn_face() -> np.ndarray:
    """68 points of a face of width 2 about the origin, y down."""

    def arc(count, start_deg, stop_deg, centre, radii):
        angles = np.deg2rad(np.linspace(start_deg, stop_deg, count))
        return np.asarray(centre) + np.stack([np.cos(angles), np.sin(angles)], axis=1) * radii

    def ring(count, centre, radii):
        return arc(count + 1, 180, 540, centre, radii)[:-1]

    nose = np.stack([np.zeros(4), np.linspace(-0.25, 0.2, 4)], axis=1)
    return np.concatenate(
        [
            arc(17, 180, 0, (0, -0.1), (1, 1.25)),
            arc(5, 200, 320, (-0.48, -0.42), (0.34, 0.15)),
            arc(5, 220, 340, (0.48, -0.42), (0.34, 0.15)),
            nose,
            arc(5, 170, 10, (0, 0.26), (0.2, 0.09)),
            ring(6, (-0.45, -0.28), (0.17, 0.07)),
            ring(6, (0.45, -0.28), (0.17, 0.07)),
            ring(12, (0, 0.6), (0.36, 0.16)),
            ring(8, (0, 0.6), (0.28, 0.07)),
        ]
    )


def drawn_faces(rng: np.random.Generator, count: int) -> np.ndarray:
    """Faces that differ as people do, rolled and scaled, in pixels, anywhere in a picture."""
    modes = rng.normal(size=(12, 68, 2)) * 0.03
    return in_pictures(rng, drawn_face() + np.einsum("nk,kpd->npd", rng.normal(size=(count, 12)), modes))


def in_pictures(rng: np.random.Generator, faces: np.ndarray) -> np.ndarray:
    """Roll, scale and place faces (n, 68, 2)."""
    roll = rng.normal(size=len(faces)) * 0.2
    turn = np.stack([np.cos(roll), -np.sin(roll), np.sin(roll), np.cos(roll)], axis=1).reshape(-1, 2, 2)
    scale = rng.uniform(40, 300, size=(len(faces), 1, 1))
    return (faces @ turn) * scale + rng.uniform(200, 1700, size=(len(faces), 1, 2))


def drawn_dataset(rng: np.random.Generator, *, people: int, faces_each: int = 4) -> KeypointDataset:
    """A dataset whose weights move the points linearly, but for browInnerUp, which never moves."""
    count = people * faces_each
    modes = np.random.default_rng(SHAPE_MODES_SEED).normal(size=(len(BLENDSHAPES), 68, 2)) * 0.03
    weights = rng.uniform(size=(count, len(BLENDSHAPES))) * (
        rng.uniform(size=(count, len(BLENDSHAPES))) < 0.3
    )
    weights[:, BLENDSHAPES.index("browInnerUp")] = 0
    weights[::faces_each] = 0  # each person's first face is neutral
    faces = drawn_face() + np.einsum("nk,kpd->npd", weights, modes)
    person = np.repeat(np.arange(people), faces_each)
    split = np.array(["train", "train", "train", "validation", "test"])[person % 5]
    return KeypointDataset(
        name="drawn",
        points=in_pictures(rng, faces),
        weights=weights,
        split=split,
        person=person,
        neutral=np.arange(count) % faces_each == 0,
        description={"spec_hash": "5" * 64, "rig": "pencil", "licence": "CC0-1.0"},
        sha256="d" * 64,
    )


def drawn_heads(
    rng: np.random.Generator, *, people: int, faces_each: int = 4
) -> tuple[KeypointDataset, dict[str, np.ndarray]]:
    """The same faces on heads that a camera sees: a dataset, and the columns that only facegen writes.

    Returns
    -------
    dataset : KeypointDataset
    columns : dict of str to array
        ``points_2d``, ``points_3d`` (m), ``camera_from_head`` and ``intrinsics``; every face is on the camera's
        axis, turned at random, and weights move its points in the head linearly.
    """
    flat = drawn_dataset(rng, people=people, faces_each=faces_each)
    count = len(flat.person)
    modes = np.random.default_rng(SHAPE_MODES_SEED).normal(size=(len(BLENDSHAPES), 68, 3)) * 0.03
    # an eye's shapes leave the other eye's lids alone
    for name, mode in zip(BLENDSHAPES, modes, strict=True):
        if name.startswith("eye"):
            mode[list(LANDMARK_GROUPS["right_eye" if name.endswith("Left") else "left_eye"])] = 0
    likeness = np.repeat(rng.normal(size=(people, 68, 3)) * 0.01, faces_each, axis=0)
    face = np.concatenate([drawn_face() * [1, -1], np.zeros((68, 1))], axis=1)
    face[:, 2] = 0.6 - 0.6 * (face**2).sum(axis=1)  # a dome: turning it shifts its middle
    points_m = 0.07 * (face + likeness + np.einsum("nk,kpd->npd", flat.weights, modes))
    yaw, pitch = rng.normal(size=(2, count)) * 0.1
    camera_from_head = np.tile(np.eye(4), (count, 1, 1))
    camera_from_head[:, :3, :3] = np.diag([1.0, -1.0, -1.0]) @ rotation_from_angles(yaw, pitch, 0 * yaw)
    camera_from_head[:, 2, 3] = rng.uniform(0.5, 0.9, size=count)
    in_camera = points_m @ np.swapaxes(camera_from_head[:, :3, :3], 1, 2) + camera_from_head[:, None, :3, 3]
    points_px = 600 * in_camera[..., :2] / in_camera[..., 2:] + [320, 240]
    columns = {
        "points_2d": points_px,
        "points_3d": points_m,
        "camera_from_head": camera_from_head,
        "intrinsics": np.tile([600.0, 600.0, 320.0, 240.0], (count, 1)),
    }
    return replace(flat, points=points_px), columns
