"""``sample.json``: the labels of one rendered sample as JSON."""

from dataclasses import asdict
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, SIDES, SPLITS
from facegen.geometry import Camera, Ellipse
from facegen.labels import EyeOutlines, Glints, Keypoints, RenderedSample, ViewLabels
from facegen.rigs import EyeGeometry, visual_axis
from facegen.sampling import COMPONENT_NAMES, Shot
from facegen.scene import Lamp, View
from facegen.scene.accessories import Accessories


def numbers(array: np.ndarray) -> Any:
    """Nested lists of float32-rounded numbers (None for NaN): what the keypoint shards hold, to the last digit."""
    array = np.asarray(array)
    if array.dtype.kind in "iub":
        return array.tolist()
    # the shortest decimal that reads back as the same float32
    shortest = array.astype(np.float32).astype(str).astype(np.float64)
    return np.where(np.isnan(shortest), None, shortest.astype(object)).tolist()


def sample_record(rendered: RenderedSample, *, dataset_hash: str, rig: str) -> dict:
    """Labels of a rendered sample that follow from (spec, sample number) alone; pictures' checksums come on top."""
    samples, keypoints = rendered.samples, rendered.keypoints
    return {
        "spec_hash": dataset_hash,
        "rig": rig,
        "sample": int(samples.sample[0]),
        "person": int(samples.person[0]),
        "session": int(samples.session[0]),
        "clip": int(samples.clip[0]),
        "frame": int(samples.frame[0]),
        "time_s": float(samples.time_s[0]),
        "split": SPLITS[samples.split[0]],
        "neutral": bool(samples.neutral[0]),
        "component": COMPONENT_NAMES[samples.component[0]],
        "sex": "female" if samples.female[0] else "male",
        "age_years": numbers(samples.age_years[0]),
        "weights": dict(zip(BLENDSHAPES, numbers(samples.weights[0]), strict=True)),
        "identity": numbers(samples.identity[0]),
        "keypoints": {
            "points_2d": numbers(keypoints.points_2d[0]),
            "detected_2d": numbers(keypoints.detected_2d[0]),
            "points_3d": numbers(keypoints.points_3d[0]),
            "visibility": numbers(keypoints.visibility[0]),
            **_contour(keypoints),
            "camera_from_head": samples.camera_from_head[0].tolist(),
            "intrinsics": samples.intrinsics[0].tolist(),
        },
        **_accessories(rendered.accessories),
        "eyes": {
            side: _eye(*values)
            for side, *values in zip(
                SIDES,
                rendered.eyes,
                visual_axis(np.stack([eye.axis for eye in rendered.eyes])),
                rendered.lid_gap_m,
                rendered.openness,
                strict=True,
            )
        },
        "headset": {
            "name": rendered.headset.name,
            "head_from_headset": rendered.head_from_headset.tolist(),
            "donning": rendered.donning.tolist(),
            "slip": rendered.slip.tolist(),
            "lamps": [_lamp(lamp) for lamp in rendered.scene.lamps],
            "sensor": asdict(rendered.headset.sensor),
        },
        "views": {
            view.name: _view(view, rendered.views[view.name], rendered.shots[view.name])
            for view in rendered.scene.views
        },
    }


def _accessories(accessories: Accessories) -> dict:
    """What the person wears; no key where that is nothing, as before there were accessories."""
    worn = {}
    if accessories.beard is not None:
        worn["beard"] = {"kind": accessories.beard.kind, "length_m": accessories.beard.length_m}
    if accessories.glasses is not None:
        worn["glasses"] = asdict(accessories.glasses)
    if accessories.make_up is not None:
        worn["make_up"] = asdict(accessories.make_up)
    return {"accessories": worn} if worn else {}


def _contour(keypoints: Keypoints) -> dict:
    if not keypoints.contour_2d.shape[1]:
        return {}
    return {name: numbers(getattr(keypoints, name)[0]) for name in ("contour_2d", "contour_3d")}


def _eye(eye: EyeGeometry, sight: np.ndarray, gap_m: float, openness: float) -> dict:
    return {
        "center": numbers(eye.center),
        "radius_m": numbers(eye.radius),
        "optical_axis": numbers(eye.axis),
        "visual_axis": numbers(sight),
        "pupil_radius_m": numbers(eye.pupil_radius),
        "pupil_center": numbers(eye.center + eye.iris_plane_offset * eye.axis),
        "lid_gap_m": numbers(gap_m),
        "openness": numbers(openness),
    }


def _lamp(lamp: Lamp) -> dict:
    return {
        "name": lamp.name,
        "position": numbers(lamp.position),
        "direction": numbers(lamp.direction),
        "diameter_m": lamp.diameter_m,
        "power_w": lamp.power_w,
        "spread_rad": lamp.spread_rad,
    }


def _camera(camera: Camera) -> dict:
    return {
        "model": camera.model,
        "width": camera.width,
        "height": camera.height,
        **{name: float(getattr(camera, name)) for name in ("fx", "fy", "cx", "cy")},
        "distortion": [float(term) for term in camera.coefficients],
    }


def _view(view: View, labels: ViewLabels, shot: Shot) -> dict:
    return {
        "camera": _camera(view.camera),
        "camera_from_head": view.camera_from_head.tolist(),
        "points_2d": numbers(labels.points_2d),
        "points_camera": numbers(labels.points_camera),
        "visibility": numbers(labels.visibility),
        "eye_center_2d": dict(zip(SIDES, numbers(labels.eye_center_2d), strict=True)),
        "pupil_center_2d": dict(zip(SIDES, numbers(labels.pupil_center_2d), strict=True)),
        "pupil_center_camera": dict(zip(SIDES, numbers(labels.pupil_center_camera), strict=True)),
        "gaze_camera": dict(zip(SIDES, numbers(labels.gaze_camera), strict=True)),
        **_outlines(labels.eyes),
        "glints": _glints(labels.glints),
        "shot": asdict(shot),
    }


def _outlines(eyes: tuple[EyeOutlines, EyeOutlines]) -> dict:
    """Outlines of the eyes: label, then side."""
    sides = [
        {
            "pupil_center_refracted_2d": numbers(eye.pupil_center_2d),
            "pupil_ellipse": _ellipse(eye.pupil),
            "pupil_ellipse_bare": _ellipse(eye.pupil_bare),
            "iris_ellipse": _ellipse(eye.iris),
            "upper_lid_2d": numbers(eye.upper_lid_2d),
            "lower_lid_2d": numbers(eye.lower_lid_2d),
        }
        for eye in eyes
    ]
    return {
        name: {side: labels[name] for side, labels in zip(SIDES, sides, strict=True)} for name in sides[0]
    }


def _ellipse(ellipse: Ellipse) -> dict:
    return {
        "center": numbers(ellipse.center),
        "semi_axes": numbers(ellipse.semi_axes),
        "angle_rad": numbers(ellipse.angle),
    }


def _glints(glints: Glints) -> list[dict]:
    return [
        {
            "lamp": lamp,
            "eye": eye,
            "surface": surface,
            "point_2d": point_2d,
            "point_camera": point_camera,
            "seen": seen,
        }
        for lamp, eye, surface, point_2d, point_camera, seen in zip(
            glints.lamps,
            glints.eyes,
            glints.surfaces,
            numbers(glints.points_2d),
            numbers(glints.points_camera),
            glints.seen.tolist(),
            strict=True,
        )
    ]
