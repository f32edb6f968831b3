"""Evaluators of exported files, written from the files' own documentation and from nothing else in ``regress``.

Each gives ``predict(points, neutral=None)`` and the names; points (n, 68, 2), a neutral face (68, 2).
"""

import atexit
import ctypes
import json
import re
import subprocess
import textwrap
from pathlib import Path

import numpy as np
import onnxruntime

from regress.exporters import npz_archive


def read_json(paths: tuple[Path, ...]):
    """Follow the five steps that ``json_text`` documents, in float64."""
    document = json.loads(paths[0].read_text())
    assert (document["format"], document["version"]) == ("regress-networks", 5)
    sets = [document, *([document["calibrated"]] if "calibrated" in document else [])]
    tables = [network for known in sets for network in known["networks"]]
    for numbers in tables + [known["denoising"] for known in sets if known["denoising"]]:
        # once, and not for each face: lists are slow
        numbers |= {key: np.array(value) for key, value in numbers.items() if key not in ("name", "outputs")}

    def features(known: dict, face: np.ndarray) -> np.ndarray:
        face = face - np.outer(known["depth"], np.array(known["turn"]) @ face)
        middle = face[known["anchors"]].mean(axis=0)
        anchors, reference = face[known["anchors"]] - middle, np.array(known["reference"])
        matrix = np.eye(2)
        if known["alignment"] == "affine":
            matrix = np.linalg.inv(anchors.T @ anchors) @ anchors.T @ reference
        if known["alignment"] == "stable":
            (px, py), (rx, ry) = anchors.T, reference.T
            c, s = np.sum(px * rx + py * ry), np.sum(px * ry - py * rx)
            return ((face - middle) @ (np.array([[c, s], [-s, c]]) / np.sum(px * px + py * py))).ravel()

        def length(pair):
            return np.linalg.norm((face[pair[1]] - face[pair[0]]) @ matrix)

        return np.array([length(edge) for edge in known["edges"]]) / length(known["width_landmarks"])

    def answer(known: dict, feature: np.ndarray) -> list[float]:
        if (denoising := known["denoising"]) is not None:
            measured = np.mean((np.array(denoising["noise_axes"]) @ feature) ** 2)
            place = np.array(denoising["axes"]) @ feature
            surplus = np.sum(denoising["surplus"] * place**2) - denoising["usual"]
            noise = max(measured, surplus) + denoising["least"]
            signal = np.array(denoising["signal"])
            feature = (place + denoising["offset"]) * signal / (signal + noise)
        values = dict(document["constant"])
        for network in known["networks"]:
            hidden = np.tanh(np.array(network["hidden_weights"]) @ feature + network["hidden_bias"])
            result = np.array(network["output_weights"]) @ hidden + network["output_bias"]
            values.update(zip(network["outputs"], np.clip(result, *document["weight_range"]), strict=True))
        return [values[name] for name in document["names"]]

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        faces = points.astype(np.float64)
        if neutral is None:
            return np.array(
                [answer(document, features(document, face) - document["feature_mean"]) for face in faces]
            )
        known = document["calibrated"]
        rest = features(known, neutral.astype(np.float64))
        return np.array(
            [answer(known, features(known, face) - rest - known["feature_mean"]) for face in faces]
        )

    return predict, tuple(document["names"])


def read_npz(paths: tuple[Path, ...]):
    """Run the very lines that ``npz_archive`` documents, in float64."""
    z = dict(np.load(paths[0], allow_pickle=False))
    text = textwrap.dedent(npz_archive.__doc__.partition("::\n")[2].partition("``names`` says")[0])
    before, _, after = text.partition("Where there are arrays")
    alone, calibrated = (textwrap.dedent(lines) for lines in (before, after.partition("::\n")[2]))

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        given = {"z": z, "numpy": np, "points": points.astype(np.float64)}
        exec(alone, given)
        if neutral is not None:
            given["neutral"] = neutral[None].astype(np.float64)
            exec(calibrated, given)
        return given["weights"]

    return predict, tuple(map(str, z["names"]))


def read_onnx(paths: tuple[Path, ...]):
    """onnxruntime on the CPU, one thread; one neutral face for the batch, or one for each face."""
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    session = onnxruntime.InferenceSession(paths[0], options, providers=["CPUExecutionProvider"])
    names = json.loads(session.get_modelmeta().custom_metadata_map["names"])
    compares = len(session.get_inputs()) == 2

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        feed = {"points": points.astype(np.float32)}
        if compares:
            feed["neutral"] = (
                np.zeros((1, 68, 2), np.float32) if neutral is None else neutral.astype(np.float32)
            )
            feed["neutral"] = feed["neutral"].reshape(-1, 68, 2)
        return session.run(["weights"], feed)[0]

    return predict, tuple(names)


def read_onnx_networks(paths: tuple[Path, ...]):
    """onnxruntime on features measured here, in float64, as the graph's metadata says."""
    session = onnxruntime.InferenceSession(paths[0], providers=["CPUExecutionProvider"])
    about = session.get_modelmeta().custom_metadata_map
    texts = ("names", "depth", "turn", "anchors", "reference", "edges", "width_landmarks")
    known = {key: json.loads(about[key]) for key in texts} | {"alignment": about["alignment"]}
    compared = json.loads(about.get("calibrated", "null"))

    def features(known: dict, points: np.ndarray) -> np.ndarray:
        points = points.astype(np.float64)
        points = points - np.array(known["depth"])[:, None] * (known["turn"] @ points)[:, None]
        matrix = np.eye(2)
        middle = points[:, known["anchors"]].mean(axis=1, keepdims=True)
        anchors, reference = points[:, known["anchors"]] - middle, np.array(known["reference"])
        across = anchors.swapaxes(1, 2)
        if known["alignment"] == "affine":
            matrix = np.linalg.inv(across @ anchors) @ (across @ reference)
        if known["alignment"] == "stable":
            plane, target = anchors @ [1, 1j], reference @ [1, 1j]
            factor = (plane.conj() @ target) / np.sum(np.abs(plane) ** 2, axis=1)
            laid = ((points - middle) @ [1, 1j]) * factor[:, None]
            return np.stack([laid.real, laid.imag], axis=-1).reshape(len(points), -1)
        first, last = np.array([*known["edges"], known["width_landmarks"]]).T
        lengths = np.linalg.norm((points[:, last] - points[:, first]) @ matrix, axis=-1)
        return lengths[:, :-1] / lengths[:, -1:]

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        feed = {"features": features(known, points)}
        if compared is not None:
            feed["calibrated_features"] = features(compared, points)
            rest = None if neutral is None else features(compared, neutral[None])
            feed["neutral_features"] = (
                np.zeros((1, feed["calibrated_features"].shape[1])) if rest is None else rest
            )
        return session.run(["weights"], {key: values.astype(np.float32) for key, values in feed.items()})[0]

    return predict, tuple(known["names"])


def read_c(paths: tuple[Path, ...]):
    """The system's C compiler, with every warning an error, as a shared library."""
    header, source = paths
    library_path = source.with_suffix(".so")
    flags = ["-std=c99", "-O2", "-Wall", "-Wextra", "-Werror", "-pedantic", "-Wconversion", "-Wshadow"]
    command = ["cc", *flags, "-shared", "-fPIC", str(source), "-o", str(library_path), "-lm"]
    subprocess.run(command, check=True, capture_output=True, text=True)
    library = ctypes.CDLL(str(library_path))
    function = getattr(library, f"{header.stem}_predict")
    function.restype = None
    names = (ctypes.c_char_p * 52).in_dll(library, f"{header.stem}_names")
    kept = re.search(r"double neutral\[(\d+)\];", header.read_text())

    def pointer(values: np.ndarray) -> object:
        return values.ctypes.data_as(ctypes.POINTER(ctypes.c_float))

    def known(neutral: np.ndarray | None) -> object:
        if neutral is None:
            return None  # a null pointer
        player = _player_of(int(kept[1]))()
        points = np.ascontiguousarray(neutral, dtype=np.float32)
        assert getattr(library, f"{header.stem}_neutral")(ctypes.byref(player), pointer(points)) == 1
        return ctypes.byref(player)

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        points = np.ascontiguousarray(points, dtype=np.float32)
        weights = np.full((len(points), 52), -1, dtype=np.float32)
        player = (known(neutral),) if kept else ()
        for face, row in zip(points, weights, strict=True):
            function(*player, pointer(face), pointer(row))
        return weights

    return predict, tuple(name.decode() for name in names)


def _player_of(count: int) -> type:
    """The header's struct of one player."""
    fields = [("known", ctypes.c_int), ("neutral", ctypes.c_double * count)]
    return type("Player", (ctypes.Structure,), {"_fields_": fields})


def read_javascript(paths: tuple[Path, ...]):
    """Node, started once: a line of faces in, a line of weights out; numbers that are not finite are null."""
    program = (
        f"import * as face from {json.dumps(paths[0].as_uri())};"
        "import { createInterface } from 'node:readline';"
        "const known = (face) => face.map((point) => point.map((value) => value ?? NaN));"
        "console.log(JSON.stringify(face.names));"
        "for await (const line of createInterface({ input: process.stdin })) {"
        "  const { points, neutral } = JSON.parse(line);"
        "  const answer = neutral ? face.player(neutral.flat()) : face.predict;"
        "  const weights = points.map(known).map((face, i) => answer(i % 2 ? face : face.flat()));"
        "  console.log(JSON.stringify(weights.map((row) => Array.from(row))));"
        "}"
    )
    command = ["node", "--input-type=module", "--eval", program]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    atexit.register(process.communicate)
    names = tuple(json.loads(process.stdout.readline()))

    def predict(points: np.ndarray, neutral: np.ndarray | None = None) -> np.ndarray:
        faces = np.where(np.isfinite(points), points.astype(np.float64), None).tolist()
        asked = {"points": faces, "neutral": None if neutral is None else neutral.astype(np.float64).tolist()}
        process.stdin.write(json.dumps(asked) + "\n")
        process.stdin.flush()
        return np.array(json.loads(process.stdout.readline()), dtype=np.float64)

    return predict, names


READERS = {
    "json": read_json,
    "npz": read_npz,
    "onnx": read_onnx,
    "onnx-networks": read_onnx_networks,
    "c": read_c,
    "javascript": read_javascript,
}
