"""The card of a headset's network, of figures measured on drawn arrays."""

from dataclasses import replace
from pathlib import Path

import pytest

from regress.errors import ModelError
from regress.learning.headset.arrays import HeadsetArrays
from regress.learning.headset.evaluation import evaluate
from regress.model_card import card_markdown, describe_model
from regress.runtime.headset.network.folder import describe_headset_model
from regress.runtime.headset.network.predictor import load_headset_predictor
from tests.regress.headset.drawn import SIDE
from tests.regress.headset.tiny import write_tiny_model


def test_a_card_has_the_figures_of_the_test_split(arrays: HeadsetArrays, tmp_path: Path):
    folder = write_tiny_model(tmp_path / "tiny", width=SIDE, height=SIDE)
    predictor = load_headset_predictor(folder)
    scores = evaluate(predictor.graph, predictor.model, arrays)
    describe_headset_model(replace(predictor.model, scores=scores), folder)
    card, text = describe_model("tiny", folder), card_markdown("tiny", folder)
    assert card.kind == "headset"
    assert card.sees == "tracking3: left_eye, right_eye, mouth"
    alone = scores.conditions["uncalibrated"]
    assert card.figures.startswith(f"{alone.geometry_mm:.2f} mm with no neutral picture")
    assert f"| no neutral picture | {alone.geometry_mm:.2f} | {alone.r2:.3f} | {alone.gaze_deg:.1f} |" in text
    assert f"On {alone.rows:,} frames of {scores.people} synthetic people" in text
    assert f"A resting face, always, errs by {scores.floors['rest'].geometry_mm:.2f} mm" in text
    assert card.sha256 in text
    assert predictor.model.network_sha256 == card.sha256


def test_a_network_that_was_not_judged_has_no_card(tmp_path: Path):
    with pytest.raises(ModelError, match="was not judged"):
        describe_model("tiny", write_tiny_model(tmp_path / "tiny"))
