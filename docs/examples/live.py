"""A live loop: ``detector | python live.py models/default`` prints what moves in each frame.

Each line on standard input is a face, 136 numbers x y x y ...; the first is taken for the neutral face.
"""

import sys

from facegen.conventions import BLENDSHAPES
from regress import load_model
from regress.runtime.inputs import read_lines
from regress.runtime.predict import landmark_chain

model, chain = load_model(sys.argv[1]), None
for sample in read_lines(sys.stdin):
    if chain is None:
        chain = landmark_chain(
            model.calibrate(sample.points[None])
        )  # an Output() besides smooths, mirrors, ...
    weights = chain.step(sample).weights.round(2).tolist()
    print(
        {name: weight for name, weight in zip(BLENDSHAPES, weights, strict=True) if weight > 0.05}, flush=True
    )
