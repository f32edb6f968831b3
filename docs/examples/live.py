"""A live loop: ``detector | python live.py models/default`` prints what moves in each frame.

Each line on standard input is a face, 136 numbers x y x y ...; the first is taken for the neutral face.
"""

import sys

import numpy as np

import regress
from facegen.conventions import BLENDSHAPES
from regress.runtime.model import FastPredictor

model = regress.load_model(sys.argv[1])
predictor = None
for line in sys.stdin:
    points = np.array(line.split(), dtype=float).reshape(68, 2)
    if predictor is None:
        predictor = FastPredictor(model.calibrate(points[None]))  # made once, and for one thread
    weights = predictor.predict_frame(points)  # about 30 microseconds
    shown = {name: round(float(weight), 2) for name, weight in zip(BLENDSHAPES, weights, strict=True)}
    print({name: weight for name, weight in shown.items() if weight > 0.05}, flush=True)
