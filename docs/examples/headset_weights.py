"""Weights of a headset's pictures by onnxruntime alone: ``python headset_weights.py headset.json frame [neutral]``.

``regress headset export models/headset`` makes headset.json and headset.onnx. A frame is a folder with one grey picture
for each camera, ``left_eye.png`` and so on, of the size that headset.json says; neutral is one of the person at rest.
"""

import json
import sys
from pathlib import Path

import cv2
import numpy as np
import onnxruntime

description = Path(sys.argv[1])
headset = json.loads(description.read_text())
session = onnxruntime.InferenceSession(
    description.parent / headset["graph"], providers=["CPUExecutionProvider"]
)
feed = {
    "present": np.ones((1, len(headset["cameras"])), np.float32),
    "calibrated": np.full(1, len(sys.argv) > 3, np.float32),
}
for camera in headset["cameras"]:
    for kind, folder in (("pictures", sys.argv[2]), ("neutral", sys.argv[-1])):
        picture = cv2.imread(str(Path(folder, f"{camera['name']}.png")), cv2.IMREAD_GRAYSCALE)
        if picture is None:
            sys.exit(
                f"{folder} has no picture {camera['name']}.png; a camera without one is given 0 in present"
            )
        feed[f"{kind}_{camera['name']}"] = picture[None]
weights, deviation, gaze, same_seat = session.run(["weights", "deviation", "gaze", "same_seat"], feed)
for name, weight, spread in zip(headset["shapes"], weights[0], deviation[0], strict=True):
    print(f"{name:<20} {weight:.3f} ± {spread:.3f}")
print("gaze in degrees, yaw and pitch of the left and the right eye:", np.degrees(gaze[0]).round(1).tolist())
if len(sys.argv) > 3 and same_seat[0] < 0.5:
    print("the headset sits otherwise than in the neutral pictures: leave them out")
