"""Weights of faces by onnxruntime alone: ``python onnx_weights.py face.onnx landmarks.npy [neutral.npy]`` prints a CSV.

The landmarks are an array (n, 68, 2), pixels, y down; neutral.npy is the person's neutral face (68, 2).
``regress export models/default --format onnx`` makes face.onnx.
"""

import json
import sys

import numpy as np
import onnxruntime

session = onnxruntime.InferenceSession(sys.argv[1], providers=["CPUExecutionProvider"])
points = np.load(sys.argv[2]).astype(np.float32)
neutral = np.load(sys.argv[3])[None] if len(sys.argv) > 3 else np.zeros((1, 68, 2))  # zeros: not known
(weights,) = session.run(["weights"], {"points": points, "neutral": neutral.astype(np.float32)})
print(*json.loads(session.get_modelmeta().custom_metadata_map["names"]), sep=",")
for row in weights:
    print(*(f"{weight:.6f}" for weight in row), sep=",")
