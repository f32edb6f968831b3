"""Weights of faces by onnxruntime alone: ``python onnx_weights.py face.onnx landmarks.npy`` prints a CSV.

The landmarks are an array (n, 68, 2), pixels, y down. ``regress export models/default --format onnx`` makes face.onnx.
"""

import json
import sys

import numpy as np
import onnxruntime

session = onnxruntime.InferenceSession(sys.argv[1], providers=["CPUExecutionProvider"])
points = np.load(sys.argv[2]).astype(np.float32)
(weights,) = session.run(["weights"], {"points": points})
print(*json.loads(session.get_modelmeta().custom_metadata_map["names"]), sep=",")
for row in weights:
    print(*(f"{weight:.6f}" for weight in row), sep=",")
