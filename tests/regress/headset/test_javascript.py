"""docs/examples/headset.js in Node, with a stand-in for onnxruntime that says what it was given."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

from regress.exporters.headset_interface import interface_of
from regress.runtime.headset.network.estimates import GRAPH_OUTPUTS
from regress.runtime.headset.network.folder import read_headset_model
from tests.regress.headset.tiny import write_tiny_model

MODULE = Path(__file__).parents[3] / "docs" / "examples" / "headset.js"

STAND_IN = """
import { openHeadset } from "./headset.mjs";
const given = {};
class Tensor {
  constructor(type, data, shape) { Object.assign(this, { type, data: Array.from(data), shape }); }
}
const session = {
  run: async (feed, wanted) => {
    Object.assign(given, { feed, wanted });
    const first = feed.pictures_mouth.data[0];
    const all = {
      weights: Float32Array.from({ length: 52 }, (_, i) => first + i),
      deviation: new Float32Array(52).fill(0.1),
      gaze: Float32Array.from([1, 2, 3, 4]),
      same_seat: Float32Array.from([0.75]),
      points_mouth: Float32Array.from([5, 6]),
    };
    return Object.fromEntries(wanted.map((name) => [name, { data: all[name] }]));
  },
};
const ort = { Tensor, InferenceSession: { create: async (graph) => Object.assign(given, { graph }) && session } };
const headset = HEADSET;
const predict = await openHeadset(ort, headset, headset.graph);
const grey = (value) => new Uint8Array(16 * 12).fill(value);
const answers = [];
for (const asked of ASKED) {
  try {
    const said = await predict(...eval(asked));
    answers.push({ said, ...given });
  } catch (error) {
    answers.push({ error: error.message });
  }
}
console.log(JSON.stringify(answers));
"""


@pytest.fixture
def ask(tmp_path: Path):
    """Answers of ``predict`` to arguments written in JavaScript."""
    if shutil.which("node") is None:
        pytest.skip("no node on this machine")
    model = read_headset_model(write_tiny_model(tmp_path / "model"))
    headset = interface_of(model, graph="headset.onnx") | {"points": {"mouth": ["landmark_8"]}}

    def run(*asked: str) -> list[dict]:
        shutil.copy(MODULE, tmp_path / "headset.mjs")
        text = STAND_IN.replace("HEADSET", json.dumps(headset)).replace("ASKED", json.dumps(asked))
        (tmp_path / "stand_in.mjs").write_text(text)
        done = subprocess.run(
            ["node", "stand_in.mjs"], cwd=tmp_path, capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        return json.loads(done.stdout)

    return run


def test_the_graph_is_given_all_its_inputs_and_answers_by_name(ask):
    (answer,) = ask("[{ left_eye: grey(1), right_eye: grey(2), mouth: grey(3) }]")
    assert answer["graph"] == "headset.onnx"
    feed = answer["feed"]
    assert set(feed) == {
        *("present", "calibrated"),
        *(
            f"{kind}_{name}"
            for kind in ("pictures", "neutral")
            for name in ("left_eye", "right_eye", "mouth")
        ),
    }
    assert feed["pictures_right_eye"] == {"type": "uint8", "data": [2] * 192, "shape": [1, 12, 16]}
    assert feed["neutral_mouth"]["data"] == [0] * 192
    assert feed["present"] == {"type": "float32", "data": [1, 1, 1], "shape": [1, 3]}
    assert feed["calibrated"] == {"type": "float32", "data": [0], "shape": [1]}
    assert set(answer["wanted"]) < set(GRAPH_OUTPUTS), "points cost time: none unless asked for"
    said = answer["said"]
    assert (said["weights"]["eyeBlinkLeft"], said["weights"]["tongueOut"]) == (3, 54)
    assert said["gaze"] == {"left": {"yaw": 1, "pitch": 2}, "right": {"yaw": 3, "pitch": 4}}
    assert (said["sameSeat"], said["points"]) == (None, {})


def test_absent_cameras_neutral_pictures_and_points(ask):
    (answer,) = ask("[{ mouth: grey(3) }, { mouth: grey(9) }, true]")
    feed = answer["feed"]
    assert feed["present"]["data"] == [0, 0, 1]
    assert feed["calibrated"]["data"] == [1]
    assert feed["neutral_mouth"]["data"] == [9] * 192
    assert answer["said"]["sameSeat"] == 0.75
    assert answer["said"]["points"] == {"mouth": {"0": 5, "1": 6}}


def test_what_is_wrong_is_said(ask):
    errors = [
        answer["error"]
        for answer in ask(
            "[{}]",
            "[{ chin: grey(1), mouth: grey(1) }]",
            "[{ mouth: new Uint8Array(10) }]",
            "[{ mouth: grey(1) }, {}]",
            "[{ mouth: grey(1) }, { mouth: new Uint8Array(3) }]",
        )
    ]
    assert errors == [
        "no picture is given of left_eye, right_eye, mouth",
        "chin is no camera of headset.json; it has left_eye, right_eye, mouth",
        "the picture of mouth has 10 grey levels; 16 x 12 are needed",
        "mouth has no neutral picture; every camera with a picture needs one",
        "the neutral picture of mouth has 3 grey levels; 16 x 12 are needed",
    ]
