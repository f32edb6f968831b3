"""Readers of landmarks, and of what else `regress predict` takes."""

import json
from pathlib import Path

import numpy as np

from tests.hostile.readers.reader import Reader
from tests.hostile.workshop import ROOT, Workshop, copied, reseal_landmarks

SAMPLES = ROOT / "docs" / "samples"


def _pts(folder: Path, workshop: Workshop) -> None:
    from facegen.formats import write_pts

    folder.mkdir(exist_ok=True)
    write_pts(folder / "face.pts", workshop.faces[0])


def _pts_folder(folder: Path, workshop: Workshop) -> None:
    from facegen.formats import write_pts

    (folder / "faces").mkdir(parents=True)
    for number, face in enumerate(workshop.faces[:3]):
        write_pts(folder / "faces" / f"frame_{number}.pts", face)


def _ck_plus(folder: Path, workshop: Workshop) -> None:
    (folder / "faces" / "S005" / "001").mkdir(parents=True)
    for number, face in enumerate(workshop.faces[:2], start=1):
        np.savetxt(folder / "faces" / "S005" / "001" / f"S005_001_{number:08d}_landmarks.txt", face)


def _npy(folder: Path, workshop: Workshop) -> None:
    np.save(folder / "faces.npy", workshop.faces)


def _dlib(folder: Path, workshop: Workshop) -> None:
    boxes = "".join(
        f"<image file='{number}.jpg'><box top='1' left='1' width='9' height='9'>"
        + "".join(f"<part name='{index:02d}' x='{x:.0f}' y='{y:.0f}'/>" for index, (x, y) in enumerate(face))
        + "</box></image>\n"
        for number, face in enumerate(workshop.faces[:2])
    )
    text = f"<?xml version='1.0' encoding='UTF-8'?>\n<dataset><images>\n{boxes}</images></dataset>\n"
    (folder / "faces.xml").write_text(text)


def _coco(folder: Path, workshop: Workshop) -> None:
    annotations = [
        {
            "id": number,
            "image_id": number,
            "keypoints": np.column_stack([face, np.full(68, 2)]).ravel().tolist(),
        }
        for number, face in enumerate(workshop.faces[:2])
    ]
    images = [{"id": number, "file_name": f"{number}.jpg"} for number in range(2)]
    (folder / "faces.json").write_text(json.dumps({"images": images, "annotations": annotations}))


def _openpose(folder: Path, workshop: Workshop) -> None:
    (folder / "faces").mkdir(parents=True)
    for number, face in enumerate(workshop.faces[:2]):
        triples = np.column_stack([np.concatenate([face, face[:2]]), np.full(70, 0.9)])
        people = [{"person_id": [-1], "face_keypoints_2d": triples.ravel().tolist()}]
        (folder / "faces" / f"{number:06d}_keypoints.json").write_text(json.dumps({"people": people}))


def _openface(folder: Path, workshop: Workshop) -> None:
    (folder / "take.csv").write_text(
        "\n".join((SAMPLES / "talking-face.csv").read_text().splitlines()[:6]) + "\n"
    )


def _pyfeat(folder: Path, workshop: Workshop) -> None:
    names = ["frame", *(f"{axis}_{index}" for axis in "xy" for index in range(68))]
    rows = [
        [str(row), *(f"{value:.3f}" for value in face.T.ravel())] for row, face in enumerate(workshop.faces)
    ]
    (folder / "take.csv").write_text("\n".join(",".join(row) for row in [names, *rows]) + "\n")


def _lines(folder: Path, workshop: Workshop) -> None:
    rows = [" ".join(f"{value:.3f}" for value in face.ravel()) for face in workshop.faces]
    (folder / "lines.txt").write_text("\n".join(rows) + "\n")


def _with_take(more):
    def make(folder: Path, workshop: Workshop) -> None:
        _npy(folder, workshop)
        more(folder, workshop)

    return make


def _adjustment(folder: Path, workshop: Workshop) -> None:
    shapes = {"jawOpen": {"gain": 1.3, "low": 0.0, "high": 0.9}, "*": {"dead_zone": 0.05, "offset": 0.01}}
    (folder / "adjust.json").write_text(json.dumps({"format": "regress-adjustment", "shapes": shapes}))


def _target(folder: Path, workshop: Workshop) -> None:
    (folder / "target.toml").write_text(
        'title = "two"\nsource = "drawn"\n[shapes]\nOpen = { jawOpen = 1.0, mouthClose = -0.5 }\nBlink = {}\n'
        "[limits]\nOpen = [0, 100]\n"
    )


def _weights(folder: Path, workshop: Workshop) -> None:
    lines = (SAMPLES / "talking-face.weights.csv").read_text().splitlines()
    (folder / "weights.csv").write_text("\n".join(lines[:5]) + "\n")


def _live_link(folder: Path, workshop: Workshop) -> None:
    from facegen.formats.live_link import live_link_csv

    weights = np.random.default_rng(0).random((4, 52))
    (folder / "weights.csv").write_text(live_link_csv(weights, np.arange(4) / 60))


def _points_3d(folder: Path, workshop: Workshop) -> None:
    from regress.runtime.features import load_reference_shape

    points = load_reference_shape().points
    np.save(folder / "points.npy", points)
    (folder / "points.json").write_text(json.dumps(points.tolist()))


def _model(folder: Path, workshop: Workshop) -> None:
    _npy(folder, workshop)
    copied(workshop.landmark_model, folder / "model")


_PREDICT = "regress predict {landmark_model} in/%s --out out/weights.csv"


def _model_reader(name: str, command: str, target: str, kind: str, **more) -> Reader:
    reseal = None if target.endswith("model.json") else lambda path: reseal_landmarks(path.parent)
    return Reader(
        name=name,
        command=command,
        make=_model,
        target=target,
        kind=kind,
        covers=("model:keypoints",),
        reseal=reseal,
        **more,
    )


READERS = (
    Reader(
        name="pts",
        command=_PREDICT % "face.pts",
        make=_pts,
        target="face.pts",
        kind="lines",
        covers=("input:pts",),
    ),
    Reader(
        name="pts-folder",
        command=_PREDICT % "faces",
        make=_pts_folder,
        target="faces/*.pts",
        kind="lines",
        covers=("input:pts_folder",),
    ),
    Reader(
        name="ck-plus",
        command=_PREDICT % "faces",
        make=_ck_plus,
        target="faces/*/*/*.txt",
        kind="lines",
        covers=("input:ck_plus",),
    ),
    Reader(
        name="openpose",
        command=_PREDICT % "faces",
        make=_openpose,
        target="faces/*.json",
        kind="json",
        covers=("input:openpose_folder",),
    ),
    Reader(
        name="npy",
        command=_PREDICT % "faces.npy",
        make=_npy,
        target="faces.npy",
        kind="npy",
        covers=("input:npy",),
    ),
    Reader(
        name="dlib",
        command=_PREDICT % "faces.xml",
        make=_dlib,
        target="faces.xml",
        kind="xml",
        covers=("input:dlib_xml",),
    ),
    Reader(
        name="coco",
        command=_PREDICT % "faces.json",
        make=_coco,
        target="faces.json",
        kind="json",
        covers=("input:coco",),
    ),
    Reader(
        name="openface",
        command=_PREDICT % "take.csv" + " --one-euro 1",
        make=_openface,
        target="take.csv",
        kind="csv",
        covers=("input:csv",),
    ),
    Reader(
        name="py-feat",
        command=_PREDICT % "take.csv",
        make=_pyfeat,
        target="take.csv",
        kind="csv",
        covers=("input:csv",),
    ),
    Reader(
        name="lines",
        command="regress predict {landmark_model} - --fps 30",
        make=_lines,
        target="lines.txt",
        kind="lines",
        stdin="in/lines.txt",
    ),
    Reader(
        name="neutral",
        command=_PREDICT % "faces.npy" + " --neutral in/face.pts",
        make=_with_take(_pts),
        target="face.pts",
        kind="lines",
    ),
    Reader(
        name="adjustment",
        command=_PREDICT % "faces.npy" + " --adjust in/adjust.json",
        make=_with_take(_adjustment),
        target="adjust.json",
        kind="json",
    ),
    Reader(
        name="retarget",
        command=_PREDICT % "faces.npy" + " --retarget in/target.toml",
        make=_with_take(_target),
        target="target.toml",
        kind="toml",
    ),
    Reader(
        name="avatar-glb",
        command="regress predict {landmark_model} in/faces.npy --fps 30 --gltf in/avatar.glb --out out/moving.glb",
        make=_with_take(lambda folder, workshop: copied(workshop.avatar, folder / "avatar.glb")),
        target="avatar.glb",
        kind="glb",
    ),
    Reader(
        name="avatar-vrm",
        command="regress predict {landmark_model} in/faces.npy --fps 30 --gltf in/avatar.vrm --out out/moving.vrm",
        make=_with_take(lambda folder, workshop: copied(workshop.avatar_text, folder / "avatar.vrm")),
        target="avatar.vrm",
        kind="glb",
    ),
    Reader(
        name="predict-livelink",
        command="regress predict {landmark_model} in/take.csv --format livelink --out out/weights.csv",
        make=_openface,
        target="take.csv",
        kind="csv",
        covers=("table:livelink",),
        weight=0.5,
    ),
    Reader(
        name="edges-npy",
        command="regress edges in/points.npy --out out/shape.json",
        make=_points_3d,
        target="points.npy",
        kind="npy",
    ),
    Reader(
        name="edges-json",
        command="regress edges in/points.json --out out/shape.json",
        make=_points_3d,
        target="points.json",
        kind="json",
    ),
    _model_reader(
        "model-json",
        "regress predict in/model in/faces.npy --out out/weights.csv",
        "model/model.json",
        "json",
    ),
    _model_reader(
        "model-weights",
        "regress predict in/model in/faces.npy --out out/weights.csv",
        "model/weights.npz",
        "npz",
    ),
    _model_reader(
        "export-json", "regress export in/model --format c --out out", "model/model.json", "json", weight=0.5
    ),
    _model_reader(
        "export-weights", "regress export in/model --out out", "model/weights.npz", "npz", weight=0.5
    ),
    _model_reader(
        "report-json", "regress report in/model --out out/report.html", "model/model.json", "json", weight=0.5
    ),
)
