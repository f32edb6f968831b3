"""Neutral faces that are none, on one line, in a mirror, or with y upward: exports refuse those that predict does."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

from regress.exporters import export_model
from regress.runtime.inputs import Fault, face_faults
from tests.regress.drawn import drawn_faces
from tests.regress.exporters.conftest import random_model
from tests.regress.exporters.readers import read_onnx
from tests.regress.exporters.test_exporters import skip_without_tool

LINES = np.stack([np.linspace(0, 100, 68), np.linspace(0, 100, 68) * 0.3 + 5], axis=1)


def drawn_neutral_faces() -> np.ndarray:
    """(n, 68, 2): faces as they are, in a mirror, with y upward, on a line, flat, sheared, turned and in profile."""
    rng = np.random.default_rng(71)
    (face,) = drawn_faces(rng, 1)
    maps = [
        np.eye(2),
        np.diag([-1, 1]),
        np.diag([1, -1]),
        np.diag([-1, -1]),
        np.diag([0.02, 1]),
        np.diag([1, 0]),
    ]
    maps += list(rng.normal(size=(120, 2, 2)))
    drawn = (face - face.mean(axis=0)) @ np.array(maps) + rng.uniform(-500, 500, (len(maps), 1, 2))
    return np.concatenate([drawn, LINES[None]]).astype(np.float32)


@pytest.fixture(scope="module")
def exported(tmp_path_factory) -> Path:
    folder = tmp_path_factory.mktemp("exported")
    model = random_model(np.random.default_rng(5), turned=False, calibrated="stable")
    export_model(model, folder, name="face", formats=("onnx", "c", "javascript"))
    return folder


def taken_by_onnx(folder: Path, faces: np.ndarray) -> list[bool]:
    predict, _ = read_onnx((folder / "face.onnx",))
    weights = predict(np.repeat(faces[:1], len(faces), axis=0), faces)
    assert (np.isnan(weights).all(axis=1) == np.isnan(weights).any(axis=1)).all()
    return (~np.isnan(weights).all(axis=1)).tolist()


C_PROGRAM = """
#include <stdio.h>
#include "face.h"

int main(void)
{
    static float points[FACE_POINTS][2], weights[FACE_WEIGHTS];
    face_player player = {0}, before;
    int i = 0;
    while (scanf("%f %f", &points[i % FACE_POINTS][0], &points[i % FACE_POINTS][1]) == 2)
        if (++i % FACE_POINTS == 0) {
            before = player;
            printf("%d\\n", face_neutral(&player, (const float (*)[2])points));
            if (player.known != before.known && !player.known) return 1;
        }
    return 0;
}
"""


def taken_by_c(folder: Path, faces: np.ndarray) -> list[bool]:
    skip_without_tool("c")
    (folder / "neutral.c").write_text(C_PROGRAM.replace(", weights[FACE_WEIGHTS]", ""))
    flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion", "-Wshadow"]
    built = ["cc", *flags, "neutral.c", "face.c", "-o", "neutral", "-lm"]
    subprocess.run(built, cwd=folder, check=True, capture_output=True, text=True)
    given = " ".join(repr(float(value)) for value in faces.ravel())
    done = subprocess.run([folder / "neutral"], input=given, capture_output=True, text=True, check=True)
    return [line == "1" for line in done.stdout.split()]


JAVASCRIPT_PROGRAM = """
import { player } from "./face.js";
import { readFileSync } from "node:fs";

const said = (face) => {
  try { player(face); return "taken"; } catch (error) { return `${error.name}: ${error.message}`; }
};
const faces = JSON.parse(readFileSync(0));
const forms = (face) => [face, face.flat(), Float32Array.from(face.flat()), face.map(([x, y]) => [x, y, 7])];
console.log(JSON.stringify(faces.map((face) => forms(face).map(said))));
"""


def taken_by_javascript(folder: Path, faces: np.ndarray) -> list[bool]:
    skip_without_tool("javascript")
    (folder / "package.json").write_text('{"type": "module"}')
    (folder / "neutral.js").write_text(JAVASCRIPT_PROGRAM)
    given = json.dumps(faces.astype(float).tolist())
    done = subprocess.run(
        ["node", "neutral.js"], cwd=folder, input=given, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    said = json.loads(done.stdout)
    assert all(len(set(of_forms)) == 1 for of_forms in said), (
        "pairs, numbers, a typed array, points with depth"
    )
    assert {words for words, *_ in said} - {"taken"} == {
        "RangeError: the neutral face is no face: its points are on one line, in a mirror, or have y upward"
    }
    return [words == "taken" for words, *_ in said]


TAKERS = {"onnx": taken_by_onnx, "c": taken_by_c, "javascript": taken_by_javascript}


@pytest.mark.parametrize("chosen", ["onnx", "javascript", pytest.param("c", marks=pytest.mark.compiler)])
def test_exports_refuse_the_neutral_faces_that_predict_refuses(chosen, exported):
    faces = drawn_neutral_faces()
    faults = face_faults(faces.astype(np.float64))
    assert {None, Fault.MIRRORED, Fault.COLLAPSED} == set(faults)
    assert min(faults.count(fault) for fault in set(faults)) >= 3
    assert TAKERS[chosen](exported, faces) == [fault is None for fault in faults]
