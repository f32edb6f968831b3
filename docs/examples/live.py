"""A live loop: ``detector | python live.py models/default`` prints what moves in each frame.

Each line on standard input is a face, 136 numbers x y x y ...; the first is taken for the neutral face.
"""

import sys
import time

from facegen.conventions import BLENDSHAPES
from regress import load_model
from regress.runtime.inputs import read_lines
from regress.runtime.predict import landmark_chain
from regress.runtime.stages import OneEuro, Output, Soundness

model = load_model(sys.argv[1])
output = Output(one_euro=OneEuro(cutoff_hz=1.0))
started = time.monotonic()
soundness, chain = Soundness(needs_times=True), None
for sample in read_lines(f"{time.monotonic() - started} {line}" for line in sys.stdin):
    if chain is None:
        chain = landmark_chain(model.calibrate(sample.points[None]), output)
    answer = chain.step(soundness.step(sample))
    shown = zip(BLENDSHAPES, answer.weights.round(2).tolist(), strict=True)
    print({name: weight for name, weight in shown if weight > 0.05}, flush=True)
