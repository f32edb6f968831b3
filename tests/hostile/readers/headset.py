"""Readers of headset pictures, of arrays of them and of networks that see them."""

from pathlib import Path

import numpy as np

from tests.hostile.readers.reader import Reader
from tests.hostile.workshop import ROOT, Workshop, copied, reseal_headset

_TAKE = "--left-eye in/take/left_eye --right-eye in/take/right_eye --mouth in/take/mouth"


def _take(folder: Path, workshop: Workshop) -> None:
    from tests.regress.headset.takes import pictures, write_take

    means = np.linspace(60, 180, 4)
    write_take(folder / "take", {name: pictures(means, seed=seed) for seed, name in enumerate(_CAMERAS)})


_CAMERAS = ("left_eye", "right_eye", "mouth")


def _neutral(folder: Path, workshop: Workshop) -> None:
    from tests.regress.headset.takes import pictures, write_pictures

    _take(folder, workshop)
    for name in _CAMERAS:
        write_pictures(folder / "neutral", pictures([90.0]), name=f"{name}.png")


def _placement(folder: Path, workshop: Workshop) -> None:
    _take(folder, workshop)
    lines = ["version = 1", 'model = "tiny"', "[cameras.left_eye]", "x = 0.45", "y = 0.5", "size = 1.2"]
    lines += ["roll_deg = -4.0", "mirror = true", "low = 30.0", "high = 200.0"]
    (folder / "placement.toml").write_text("\n".join(lines) + "\n")


def _person(folder: Path, workshop: Workshop) -> None:
    _take(folder, workshop)
    from regress.runtime.headset.network.predictor import load_headset_predictor
    from regress.runtime.headset.person.person import OwnEye, Person, packed_picture, write_person

    model = load_headset_predictor(workshop.headset_model).model
    person = Person(
        network_sha256=model.network_sha256,
        rest={"jawOpen": 0.02, "mouthPucker": 0.05},
        full={"jawOpen": 0.7, "eyeBlinkLeft": 0.6},
        eyes={
            "left_eye": OwnEye(shut_mm=1.5, rest_mm=9.0, lids=0.4, direct=((1.0, 0.0, -2.0), (0.0, 1.0, 3.0)))
        },
        neutral={
            one.name: packed_picture(np.full((one.height, one.width), 90, dtype=np.uint8))
            for one in model.cameras
        },
    )
    write_person(folder / "anna.json", person)


def _film(folder: Path, workshop: Workshop) -> None:
    import cv2

    from tests.regress.headset.takes import HEIGHT, WIDTH, pictures

    path = folder / "mouth.avi"
    film = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 30.0, (WIDTH * 4, HEIGHT * 4))
    for picture in pictures(np.linspace(60, 180, 6)):
        film.write(cv2.cvtColor(cv2.resize(picture, (WIDTH * 4, HEIGHT * 4)), cv2.COLOR_GRAY2BGR))
    film.release()


def _model(folder: Path, workshop: Workshop) -> None:
    _take(folder, workshop)
    copied(workshop.headset_model, folder / "model")


def _shipped(folder: Path, workshop: Workshop) -> None:
    copied(ROOT / "regress" / "models" / "headset-tracking3", folder / "model")


def _arrays(folder: Path, workshop: Workshop) -> None:
    copied(workshop.arrays, folder / "arrays")


def _clips(folder: Path, workshop: Workshop) -> None:
    copied(workshop.clips, folder / "arrays")
    copied(workshop.arrays_model, folder / "model")


def _renders(folder: Path, workshop: Workshop) -> None:
    from tests.regress.headset.takes import pictures, write_pictures

    for number in range(2):
        for seed, name in enumerate(_CAMERAS):
            place = folder / "data" / "renders" / "000" / f"{number:06d}"
            write_pictures(place, pictures([90.0 + number], seed=seed), name=f"{name}.png")


def _sealed(path: Path) -> None:
    reseal_headset(path.parent)


_EVALUATE = "regress headset evaluate {arrays_model} in/arrays"

READERS = (
    Reader(
        name="pictures",
        command=f"regress headset predict {{headset_model}} {_TAKE} --out out/weights.csv",
        make=_take,
        target="take/*/*.png",
        kind="png",
    ),
    Reader(
        name="pictures-calibrated",
        command=f"regress headset predict {{headset_model}} {_TAKE} --neutral auto --fps 30 --one-euro 1 --bits 10 "
        "--points out/points.csv --confidence out/trust.csv --out out/weights.csv".replace(
            "--points out/points.csv ", ""
        ),
        make=_take,
        target="take/*/*.png",
        kind="png",
        weight=0.5,
    ),
    Reader(
        name="neutral-pictures",
        command=f"regress headset predict {{headset_model}} {_TAKE} --neutral in/neutral --out out/weights.csv",
        make=_neutral,
        target="neutral/*.png",
        kind="png",
    ),
    Reader(
        name="placement",
        command=f"regress headset predict {{headset_model}} {_TAKE} --placement in/placement.toml --out out/w.csv",
        make=_placement,
        target="placement.toml",
        kind="toml",
        covers=("track:placement",),
    ),
    Reader(
        name="person",
        command=f"regress headset predict {{headset_model}} {_TAKE} --person in/anna.json --out out/w.csv",
        make=_person,
        target="anna.json",
        kind="json",
    ),
    Reader(
        name="film",
        command="regress headset predict {headset_model} --mouth in/mouth.avi --out out/weights.csv",
        make=_film,
        target="mouth.avi",
        kind="binary",
    ),
    Reader(
        name="rendered-pictures",
        command="regress headset predict {headset_model} in/data --out out/weights.csv",
        make=_renders,
        target="data/renders/*/*/*.png",
        kind="png",
    ),
    Reader(
        name="headset-model-json",
        command=f"regress headset predict in/model {_TAKE} --out out/weights.csv",
        make=_model,
        target="model/model.json",
        kind="json",
        covers=("model:headset",),
    ),
    Reader(
        name="headset-network",
        command=f"regress headset predict in/model {_TAKE} --out out/weights.csv",
        make=_model,
        target="model/network.onnx",
        kind="onnx",
        covers=("model:headset",),
        reseal=_sealed,
    ),
    Reader(
        name="headset-export",
        command="regress headset export in/model --out out",
        make=_model,
        target="model/model.json",
        kind="json",
        weight=0.5,
    ),
    Reader(
        name="headset-report",
        command="regress headset report in/model --no-time --out out/report.html",
        make=_shipped,
        target="model/model.json",
        kind="json",
        weight=0.5,
    ),
    Reader(
        name="arrays-json",
        command=_EVALUATE,
        make=_arrays,
        target="arrays/arrays.json",
        kind="json",
        covers=("arrays",),
    ),
    Reader(
        name="arrays-labels", command=_EVALUATE, make=_arrays, target="arrays/labels.parquet", kind="parquet"
    ),
    Reader(name="arrays-pictures", command=_EVALUATE, make=_arrays, target="arrays/mouth.npy", kind="npy"),
    Reader(name="arrays-face", command=_EVALUATE, make=_arrays, target="arrays/face.npz", kind="npz"),
    Reader(
        name="temporal",
        command="regress headset temporal in/model in/arrays",
        make=_clips,
        target="arrays/labels.parquet",
        kind="parquet",
        changes=True,
        weight=0.5,
    ),
)
