"""Describes a network's graph for programs that run it without this package: inputs, outputs, shapes, points."""

from typing import Any

from regress.runtime.headset.network.estimates import (
    CAMERA_INPUT,
    GRAPH_OUTPUTS,
    POINTS,
    TERMS_TOLD,
    points_output,
)
from regress.runtime.headset.network.model import HeadsetModel

FORMAT = "regress-headset"


def interface_of(model: HeadsetModel, *, graph: str) -> dict[str, Any]:
    """The graph's inputs and outputs as JSON data, for n frames.

    Parameters
    ----------
    graph
        File name of the graph.
    """
    cameras = [
        {"name": camera.name, "width": camera.width, "height": camera.height} for camera in model.cameras
    ]
    neutral = "the person's neutral pictures from the same seat of the headset; 0 where there are none"
    calibrated = "1 where neutral pictures are given, otherwise 0"
    if model.calibration == "none":
        neutral = calibrated = (
            "give 0: the network was trained without neutral pictures and does not look at them"
        )
    inputs: dict[str, Any] = {}
    for kind, meaning in (("pictures", "grey pictures, row by row from the top"), ("neutral", neutral)):
        for camera in model.cameras:
            inputs[f"{kind}_{camera.name}"] = {
                "type": "uint8",
                "shape": ["n", camera.height, camera.width],
                "meaning": meaning,
            }
    inputs["present"] = {
        "type": "float32",
        "shape": ["n", len(cameras)],
        "meaning": "1 where a camera's picture counts, 0 where it is missing; cameras in the order given here",
    }
    inputs["calibrated"] = {
        "type": "float32",
        "shape": ["n"],
        "meaning": calibrated,
    }
    if model.camera_terms:
        inputs[CAMERA_INPUT] = {
            "type": "float32",
            "shape": [len(cameras), TERMS_TOLD],
            "meaning": "may be left out: for each camera camera_terms and then 1, or zeros where they are not known",
        }
    return {
        "format": FORMAT,
        "version": 1,
        "graph": graph,
        "sha256": model.network_sha256,
        "headset": model.headset,
        "cameras": cameras,
        "shapes": list(model.weights),
        "camera_terms": list(model.camera_terms),
        "points": {name: list(points) for name, points in model.points.items()},
        "levels": {
            name: {
                "low": [looks.low[0], looks.low[-1]],
                "high": [looks.high[0], looks.high[-1]],
                "middle": [looks.low[1], looks.high[1]],  # what a placement's low and high become
            }
            for name, looks in model.looks.items()
        },
        "temporal": _temporal(model),
        "inputs": inputs,
        "outputs": _outputs(model),
        "calibration": model.calibration,
        "licences": list(model.licences),
    }


def _outputs(model: HeadsetModel) -> dict[str, Any]:
    counts = {"cameras": len(model.cameras), "shapes": len(model.weights)}
    table = {name: (output, counts) for name, output in GRAPH_OUTPUTS.items()}
    for camera in model.camera_names:
        table[points_output(camera)] = (POINTS, {"points": len(model.points.get(camera, ()))})
    outputs = {}
    for name in model.outputs:
        output, sizes = table[name]
        uncalibrated = output.uncalibrated if model.calibration == "none" else None
        outputs[name] = {
            "type": "float32",
            "shape": [sizes.get(size, size) for size in output.shape],
            "meaning": uncalibrated or output.meaning,
        }
    return outputs


def _temporal(model: HeadsetModel) -> dict[str, Any] | None:
    if model.temporal is None:
        return None
    return {
        "fps": model.temporal.fps,
        "taps": model.temporal.taps,
        "meaning": "output i, of the shapes and then of the gaze, is the sum over k of taps[i][k] times output i of k "
        "frames before, shapes kept from 0 to 1; the first frame stands for those before it",
    }
