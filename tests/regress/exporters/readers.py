"""Evaluators of exported files, written from the files' own documentation and from nothing in ``regress``."""

import atexit
import ctypes
import json
import subprocess
from pathlib import Path

import numpy as np
import onnxruntime


def read_json(paths: tuple[Path, ...]):
    """Follow the five steps that ``json_text`` documents, in float64."""
    document = json.loads(paths[0].read_text())
    assert (document["format"], document["version"]) == ("regress-networks", 4)

    def predict(points: np.ndarray) -> np.ndarray:
        rows = []
        for face in points.astype(np.float64):
            face = face - np.outer(document["depth"], np.array(document["turn"]) @ face)
            matrix = np.eye(2)
            if document["alignment"] == "affine":
                anchors = face[document["anchors"]]
                anchors = anchors - anchors.mean(axis=0)
                matrix = np.linalg.inv(anchors.T @ anchors) @ anchors.T @ np.array(document["reference"])

            def length(pair, face=face, matrix=matrix):
                return np.linalg.norm((face[pair[1]] - face[pair[0]]) @ matrix)

            width = length(document["width_landmarks"])
            feature = (
                np.array([length(edge) / width for edge in document["edges"]]) - document["feature_mean"]
            )
            if (denoising := document["denoising"]) is not None:
                measured = np.mean((np.array(denoising["noise_axes"]) @ feature) ** 2)
                place = np.array(denoising["axes"]) @ feature
                surplus = np.sum(denoising["surplus"] * place**2) - denoising["usual"]
                noise = max(measured, surplus) + denoising["least"]
                signal = np.array(denoising["signal"])
                feature = (place + denoising["offset"]) * signal / (signal + noise)
            values = dict(document["constant"])
            for network in document["networks"]:
                hidden = np.tanh(np.array(network["hidden_weights"]) @ feature + network["hidden_bias"])
                result = np.array(network["output_weights"]) @ hidden + network["output_bias"]
                values.update(
                    zip(network["outputs"], np.clip(result, *document["weight_range"]), strict=True)
                )
            rows.append([values[name] for name in document["names"]])
        return np.array(rows)

    return predict, tuple(document["names"])


def read_npz(paths: tuple[Path, ...]):
    """Run the lines that ``npz_archive`` documents, in float64."""
    z = dict(np.load(paths[0], allow_pickle=False))

    def predict(points: np.ndarray) -> np.ndarray:
        points = points.astype(np.float64)
        points = points - z["depth"][:, None] * (z["turn"] @ points)[:, None]
        a = points[:, z["anchors"]] - points[:, z["anchors"]].mean(1, keepdims=True)
        t = a.swapaxes(1, 2)
        matrix = np.linalg.inv(t @ a) @ (t @ z["reference"]) if z["alignment"] == "affine" else np.eye(2)

        def length(i, j):
            return np.linalg.norm((points[:, j] - points[:, i]) @ matrix, axis=-1)

        i, j = z["width_landmarks"]
        ratio = length(*z["edges"].T) / length([i], [j])
        x = ratio - z["feature_mean"]
        if "axes" in z:
            place = x @ z["axes"].T
            measured, surplus = ((x @ z["noise_axes"].T) ** 2).mean(1), place**2 @ z["surplus"] - z["usual"]
            noise = np.maximum(measured, surplus)[:, None] + z["least"]
            x = (place + z["offset"]) * (z["signal"] / (z["signal"] + noise))
        hidden = np.tanh(x @ z["hidden_weights"].T + z["hidden_bias"])
        return np.clip(hidden @ z["output_weights"].T + z["output_bias"], *z["weight_range"])

    return predict, tuple(map(str, z["names"]))


def read_onnx(paths: tuple[Path, ...]):
    """onnxruntime on the CPU, one thread."""
    options = onnxruntime.SessionOptions()
    options.intra_op_num_threads = 1
    session = onnxruntime.InferenceSession(paths[0], options, providers=["CPUExecutionProvider"])
    names = json.loads(session.get_modelmeta().custom_metadata_map["names"])
    return lambda points: session.run(["weights"], {"points": points.astype(np.float32)})[0], tuple(names)


def read_onnx_networks(paths: tuple[Path, ...]):
    """onnxruntime on features measured here, in float64, as the graph's metadata says."""
    session = onnxruntime.InferenceSession(paths[0], providers=["CPUExecutionProvider"])
    about = session.get_modelmeta().custom_metadata_map
    known = {
        key: json.loads(about[key])
        for key in ("names", "depth", "turn", "anchors", "reference", "edges", "width_landmarks")
    }

    def predict(points: np.ndarray) -> np.ndarray:
        points = points.astype(np.float64)
        points = points - np.array(known["depth"])[:, None] * (known["turn"] @ points)[:, None]
        matrix = np.eye(2)
        if about["alignment"] == "affine":
            anchors = points[:, known["anchors"]]
            anchors = anchors - anchors.mean(axis=1, keepdims=True)
            across = anchors.swapaxes(1, 2)
            matrix = np.linalg.inv(across @ anchors) @ (across @ np.array(known["reference"]))
        first, last = np.array([*known["edges"], known["width_landmarks"]]).T
        lengths = np.linalg.norm((points[:, last] - points[:, first]) @ matrix, axis=-1)
        features = (lengths[:, :-1] / lengths[:, -1:]).astype(np.float32)
        return session.run(["weights"], {"features": features})[0]

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
    float_pointer = ctypes.POINTER(ctypes.c_float)
    function.argtypes, function.restype = [float_pointer, float_pointer], None
    names = (ctypes.c_char_p * 52).in_dll(library, f"{header.stem}_names")

    def predict(points: np.ndarray) -> np.ndarray:
        points = np.ascontiguousarray(points, dtype=np.float32)
        weights = np.full((len(points), 52), -1, dtype=np.float32)
        for face, row in zip(points, weights, strict=True):
            function(face.ctypes.data_as(float_pointer), row.ctypes.data_as(float_pointer))
        return weights

    return predict, tuple(name.decode() for name in names)


def read_javascript(paths: tuple[Path, ...]):
    """Node, started once: a line of faces in, a line of weights out; numbers that are not finite are null."""
    program = (
        f"import {{ names, predict }} from {json.dumps(paths[0].as_uri())};"
        "import { createInterface } from 'node:readline';"
        "const known = (face) => face.map((point) => point.map((value) => value ?? NaN));"
        "console.log(JSON.stringify(names));"
        "for await (const line of createInterface({ input: process.stdin })) {"
        "  const faces = JSON.parse(line).map(known);"
        "  const weights = faces.map((face, i) => predict(i % 2 ? face : face.flat()));"
        "  console.log(JSON.stringify(weights.map((row) => Array.from(row))));"
        "}"
    )
    command = ["node", "--input-type=module", "--eval", program]
    process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
    atexit.register(process.communicate)
    names = tuple(json.loads(process.stdout.readline()))

    def predict(points: np.ndarray) -> np.ndarray:
        faces = np.where(np.isfinite(points), points.astype(np.float64), None).tolist()
        process.stdin.write(json.dumps(faces) + "\n")
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
