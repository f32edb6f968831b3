"""A live loop: ``detector | python live.py models/default`` prints what moves in each frame.

Each line on standard input is a face, 136 numbers x y x y ...; the first one without a fault is taken
for the neutral face.
"""

import sys

import numpy as np

from facegen.conventions import BLENDSHAPES
from regress import load_model
from regress.runtime.inputs import face_faults, read_lines
from regress.runtime.predict import landmark_chain

model, chain = load_model(sys.argv[1]), None
for sample in read_lines(sys.stdin):
    if chain is None and face_faults(sample.points[None]) == [None]:
        # an Output() besides smooths, mirrors, ...
        chain = landmark_chain(model.calibrate(sample.points[None]))
    weights = None if chain is None else chain.step(sample).weights
    if weights is None or np.isnan(weights).any():
        print("no face", flush=True)
        continue
    weights = weights.round(2).tolist()
    print(
        {name: weight for name, weight in zip(BLENDSHAPES, weights, strict=True) if weight > 0.05}, flush=True
    )
