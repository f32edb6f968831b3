"""What a program must know to run a network's graph without this package."""

from typing import Any

from regress.runtime.headset.model import HeadsetModel, points_output

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
    same_seat = "probability that picture and neutral picture are of one seat of the headset"
    if model.calibration == "none":
        neutral = calibrated = (
            "give 0: the network was trained without neutral pictures and does not look at them"
        )
        same_seat = "means nothing: the network was trained without neutral pictures"
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
    shapes = len(model.weights)
    meanings = {
        "weights": (["n", shapes], "blendshape weights, 0 to 1, named by shapes"),
        "deviation": (["n", shapes], "predicted standard deviation of each weight"),
        "gaze": (
            ["n", 2, 2],
            "yaw and pitch in radians, left eye first; yaw to the subject's left, pitch upwards",
        ),
        "shares": (["n", len(cameras), shapes], "how much each camera had to say"),
        "same_seat": (["n"], same_seat),
    }
    for camera in model.cameras:
        meanings[points_output(camera.name)] = (
            ["n", len(model.points.get(camera.name, ())), 2],
            "pixels of the points named by points, x to the right and y down, 0 in the middle of the first pixel",
        )
    outputs = {
        name: {"type": "float32", "shape": meanings[name][0], "meaning": meanings[name][1]}
        for name in model.outputs
    }
    return {
        "format": FORMAT,
        "version": 1,
        "graph": graph,
        "sha256": model.network_sha256,
        "headset": model.headset,
        "cameras": cameras,
        "shapes": list(model.weights),
        "points": {name: list(points) for name, points in model.points.items()},
        "temporal": _temporal(model),
        "inputs": inputs,
        "outputs": outputs,
        "calibration": model.calibration,
        "licences": list(model.licences),
    }


def _temporal(model: HeadsetModel) -> dict[str, Any] | None:
    if model.temporal is None:
        return None
    return {
        "fps": model.temporal.fps,
        "taps": model.temporal.taps,
        "meaning": "what is said is the sum of taps[k] times the answer k frames before; shapes, then gaze",
    }
