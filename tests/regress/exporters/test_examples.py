"""The examples of docs/examples, and what docs/exports.md says, run on what `regress export` writes."""

import json
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from facegen.conventions import BLENDSHAPES
from regress.exporters import export_model
from tests.regress.drawn import drawn_faces

EXAMPLES = Path(__file__).parents[3] / "docs" / "examples"
NEUTRAL, *_ = drawn_faces(np.random.default_rng(13), 1).astype(np.float32).astype(np.float64)
PAGE = (EXAMPLES.parent / "exports.md").read_text(encoding="utf-8")
FACES = drawn_faces(np.random.default_rng(12), 3).astype(np.float32).astype(np.float64)


@pytest.fixture
def folder(quick_model, tmp_path: Path) -> Path:
    export_model(quick_model, tmp_path, name="face", formats=("onnx", "c", "javascript"))
    for example in EXAMPLES.iterdir():
        shutil.copy(example, tmp_path)
    return tmp_path


def _run(folder: Path, *command: object, given: str = "") -> str:
    done = subprocess.run(
        [str(part) for part in command], cwd=folder, input=given, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def _lines(faces: np.ndarray = FACES) -> str:
    return "".join(" ".join(map(repr, face.ravel().tolist())) + "\n" for face in faces)


@pytest.fixture(params=["a neutral face", "zeros"])
def neutral(request) -> np.ndarray:
    return NEUTRAL if request.param == "a neutral face" else np.zeros_like(NEUTRAL)


def _expected(model, neutral: np.ndarray) -> np.ndarray:
    return (model.calibrate(neutral[None]) if neutral.any() else model).predict(FACES)


def _needs(tool: str) -> None:
    if shutil.which(tool) is None:
        pytest.skip(f"no {tool} on this machine")


@pytest.mark.compiler
def test_the_c_program(folder: Path, quick_model, neutral):
    _needs("cc")
    _run(folder, "cc", "-std=c99", "-O2", "-Wall", "-Werror", "main.c", "face.c", "-lm", "-o", "weights")
    out = _run(folder, "./weights", given=_lines(np.stack([neutral, *FACES])))
    rows = [line.split() for line in out.splitlines()]
    assert [row[0] for row in rows] == list(BLENDSHAPES) * len(FACES)
    written = np.array([row[1] for row in rows], dtype=float).reshape(len(FACES), -1)
    np.testing.assert_allclose(written, _expected(quick_model, neutral), atol=1e-4)


def test_the_onnx_script(folder: Path, quick_model, neutral):
    np.save(folder / "landmarks.npy", FACES)
    np.save(folder / "neutral.npy", neutral)
    files = ["face.onnx", "landmarks.npy", *(["neutral.npy"] if neutral.any() else [])]
    header, *rows = _run(folder, sys.executable, "onnx_weights.py", *files).splitlines()
    assert header.split(",") == list(BLENDSHAPES)
    written = np.array([row.split(",") for row in rows], dtype=float)
    np.testing.assert_allclose(written, _expected(quick_model, neutral), atol=1e-4)


def test_the_live_loop(folder: Path, quick_model_folder: Path, quick_model):
    no_faces = np.stack([FACES[0] * [-1, 1], FACES[0] * [1, -1]])
    given = _lines(no_faces) + _lines()
    out = _run(folder, sys.executable, "live.py", quick_model_folder, given=given)
    assert out.startswith("no face\n" * 2), "nor is either taken for the neutral face"
    out = out.removeprefix("no face\n" * 2)
    weights = quick_model.calibrate(FACES[:1]).predict(FACES)
    for line, row in zip(out.splitlines(), weights, strict=True):
        shown = json.loads(line.replace("'", '"'))
        assert set(shown) >= {name for name, weight in zip(BLENDSHAPES, row, strict=True) if weight > 0.06}
        assert all(abs(row[BLENDSHAPES.index(name)] - weight) < 0.011 for name, weight in shown.items())


def test_the_web_page(folder: Path, quick_model, neutral):
    """Its module runs in Node with a stand-in for the page and its server."""
    _needs("node")
    (module,) = re.findall(r'<script type="module">(.*?)</script>', (folder / "page.html").read_text(), re.S)
    (folder / "face.mjs").write_text((folder / "face.js").read_text())
    (folder / "page.mjs").write_text(module.replace("./face.js", "./face.mjs"))
    faces = {"points.json": FACES[0], "neutral.json": neutral}
    files = {name: face.ravel().tolist() for name, face in faces.items()}
    (folder / "stand_in.mjs").write_text(
        "const table = {};"
        "globalThis.document = { getElementById: (id) => (id === 'weights' ? table : null) };"
        f"const files = {json.dumps(files)};"
        "globalThis.fetch = async (name) => ({ json: async () => files[name] });"
        "await import('./page.mjs');"
        "console.log(table.innerHTML);"
    )
    rows = re.findall(r"<tr><td>(\w+)</td><td>([\d.]+)</td>", _run(folder, "node", "stand_in.mjs"))
    assert [name for name, _ in rows] == list(BLENDSHAPES)
    np.testing.assert_allclose(
        [float(weight) for _, weight in rows], _expected(quick_model, neutral)[0], atol=1e-3
    )


def _snippet(language: str, heading: str) -> str:
    """The first of a section of the page."""
    section = PAGE.partition(f"\n## {heading}\n")[2].partition("\n## ")[0]
    return section.partition(f"```{language}\n")[2].partition("```")[0]


def test_the_page_s_faces_to_try(tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "docs").symlink_to(EXAMPLES.parent)
    exec(_snippet("python", "Faces to try"), {})
    faces = np.load("points.npy")
    assert faces.shape == (1800, 68, 2)
    np.testing.assert_array_equal(np.load("neutral.npy"), faces[0])
    np.testing.assert_allclose(np.loadtxt("points.txt").reshape(-1, 68, 2), faces, atol=1e-4)
    for name, face in (("neutral", faces[0]), ("points", faces[700])):
        np.testing.assert_allclose(json.loads(Path(f"{name}.json").read_text()), face.ravel())


def test_the_page_on_onnx(folder: Path, quick_model, neutral, monkeypatch):
    monkeypatch.chdir(folder)
    exports = folder / "models" / "default" / "exports"
    exports.mkdir(parents=True)
    shutil.copy(folder / "face.onnx", exports)
    np.save(folder / "neutral.npy", neutral)
    np.save(folder / "points.npy", FACES)
    given = {}
    exec(_snippet("python", "ONNX"), given)
    np.testing.assert_allclose(given["weights"], _expected(quick_model, neutral), atol=1e-4)
    assert json.loads(given["names"]) == list(BLENDSHAPES)


def test_the_page_on_javascript(folder: Path, quick_model, neutral):
    _needs("node")
    (folder / "points.json").write_text(json.dumps(FACES[0].tolist()))
    (folder / "neutral.json").write_text(json.dumps(neutral.ravel().tolist()))
    (folder / "package.json").write_text('{"type": "module"}')  # face.js is one, whatever the version of Node
    show = "console.log(JSON.stringify(Array.from(weights)));"
    (folder / "weights.mjs").write_text(_snippet("js", "JavaScript") + show)
    shown, weights = _run(folder, "node", "weights.mjs").splitlines()
    np.testing.assert_allclose(json.loads(weights), _expected(quick_model, neutral)[0], atol=1e-4)
    assert shown.split()[0] == "jawOpen"


@pytest.mark.compiler
def test_the_page_on_c(folder: Path, quick_model, neutral):
    _needs("cc")
    arrays, player, *calls = _snippet("c", "C").strip().splitlines()
    (folder / "snippet.c").write_text(
        '#include <stdio.h>\n#include "face.h"\n'
        f"{arrays}\n{player}\n"
        "static void read_face(float face[FACE_POINTS][2]) {\n"
        "  for (int i = 0; i < FACE_POINTS; i++)\n"
        '    if (scanf("%f %f", &face[i][0], &face[i][1]) != 2) face[i][0] = 0;\n'
        "}\n"
        "int main(void) {\n"
        "  read_face(neutral); read_face(points);\n" + "\n".join(calls) + "\n"
        '  for (int i = 0; i < FACE_WEIGHTS; i++) printf("%.6f\\n", weights[i]);\n'
        "  return 0;\n}\n"
    )
    _run(folder, "cc", "-std=c99", "-O2", "-Wall", "-Werror", "snippet.c", "face.c", "-lm", "-o", "snippet")
    out = _run(folder, "./snippet", given=_lines(np.stack([neutral, FACES[0]])))
    np.testing.assert_allclose(
        np.array(out.split(), dtype=float), _expected(quick_model, neutral)[0], atol=1e-4
    )


def test_the_unity_component_names_the_shapes_in_the_exports_order():
    source = (EXAMPLES / "FaceWeights.cs").read_text(encoding="utf-8")
    names = source[source.index("Names =") : source.index("};")]
    assert tuple(re.findall(r'"(\w+)"', names)) == BLENDSHAPES
