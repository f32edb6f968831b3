"""Makes ``sample.json``, the labels of one rendered sample."""

from dataclasses import asdict
from typing import Any

import numpy as np

from facegen.conventions import BLENDSHAPES, SIDES, SPLITS
from facegen.geometry import Camera
from facegen.labels import RenderedSample
from facegen.rigs import EyeGeometry, visual_axis
from facegen.sampling import COMPONENT_NAMES
from facegen.scene import Lamp
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
    sample, keypoints = rendered.sample, rendered.keypoints
    samples, unit = sample.row, sample.session.unit
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
            **{name: numbers(values[0]) for name, values in keypoints.further.items()},
            "camera_from_head": samples.camera_from_head[0].tolist(),
            "intrinsics": samples.intrinsics[0].tolist(),
        },
        **_accessories(sample.session.accessories),
        "eyes": {
            side: _eye(*values)
            for side, *values in zip(
                SIDES,
                sample.eyes,
                visual_axis(np.stack([eye.axis for eye in sample.eyes])),
                rendered.lid_gap_m,
                rendered.openness,
                strict=True,
            )
        },
        "headset": {
            "name": unit.name,
            "head_from_headset": sample.head_from_headset.tolist(),
            "donning": sample.donning.tolist(),
            "slip": sample.slip.tolist(),
            "lamps": [_lamp(lamp) for lamp in sample.scene.lamps],
            "sensor": asdict(unit.sensor),
        },
        "views": {
            view.name: {
                "camera": _camera(view.camera),
                "camera_from_head": view.camera_from_head.tolist(),
                **_plain(rendered.views[view.name].record()),
                "shot": asdict(sample.shots[view.name]),
            }
            for view in sample.scene.views
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


def _plain(values: Any) -> Any:
    """Values with `numbers` in place of every array, in dicts and lists too."""
    if isinstance(values, dict):
        return {key: _plain(value) for key, value in values.items()}
    if isinstance(values, list):
        return [_plain(value) for value in values]
    return numbers(values) if isinstance(values, np.ndarray | np.generic) else values
