"""Values of options and arguments: numbers, ranges, names."""

import re

from tests.hostile.readers.assets import _headset, _spec
from tests.hostile.readers.datasets import _logged, _rendered
from tests.hostile.readers.headset import _TAKE, _take
from tests.hostile.readers.landmarks import _openface, _points_3d, _weights
from tests.hostile.readers.reader import Reader
from tests.hostile.workshop import Workshop, copied


def _model(folder, workshop: Workshop) -> None:
    copied(workshop.landmark_model, folder / "model")


_PREDICT = "regress predict {landmark_model} in/take.csv --out out/weights.csv %s"
_HEADSET = f"regress headset predict {{headset_model}} {_TAKE} --out out/weights.csv %s"
_GENERATE = "facegen generate in/spec.toml --out out/data --dry-run %s"
_SUBMIT = "facegen farm submit in/spec.toml --out out/data --engine %s --dry-run"

_OPTIONS = (
    *((_PREDICT, option, "number", _openface) for option in ("--one-euro", "--beta", "--fps", "--smooth")),
    *((_PREDICT, option, "number", _openface) for option in ("--left-right-blend", "--smooth-landmarks")),
    *((_PREDICT, option, "word", _openface) for option in ("--neutral", "--format", "--retarget")),
    *((_HEADSET, option, "number", _take) for option in ("--fps", "--bits", "--amplify-eyes", "--neutral")),
    (_HEADSET, "--camera", "word", _take),
    *((_GENERATE, option, "range", _spec("tiny")) for option in ("--samples", "--shards")),
    *((_GENERATE, option, "number", _spec("tiny")) for option in ("--grace", "--hang-limit", "--view-limit")),
    (_GENERATE, "--workers", "number", _spec("tiny")),
    (_GENERATE, "--progress", "word", _spec("tiny")),
    ("facegen develop in/data --out out/new %s", "--samples", "range", _rendered),
    *(("facegen develop in/data --out out/new %s", option, "number", _rendered) for option in ("--gain", "--noise")),
    *(("facegen develop in/data --out out/new %s", option, "number", _rendered) for option in ("--exposure", "--seed")),
    *(("facegen pack in/data --format keypoints --out out/pack %s", *rest, _rendered) for rest in (
        ("--samples", "range"), ("--columns", "word"), ("--split", "word"), ("--shard-size", "number"))),
    ("facegen pack in/data --out out/pack %s", "--format", "word", _rendered),
    ("facegen pack in/data --format arrays --out out/pack %s", "--views", "word", _rendered),
    ("facegen preview in/data --out out/sheet.png %s", "--samples", "range", _rendered),
    *(("facegen preview --weights in/weights.csv --size 64 --frames 0 --out out/strip.png %s", option, kind, _weights)
      for option, kind in (("--fps", "number"), ("--rig", "word"))),
    ("facegen preview --weights in/weights.csv --size 64 --out out/strip.png %s", "--frames", "range", _weights),
    *((_SUBMIT % "slurm" + " %s", option, kind, _spec("tiny")) for option, kind in (
        ("--samples", "range"), ("--chunk", "number"), ("--steps", "word"), ("--cpus", "number"), ("--mem", "word"),
        ("--time", "word"), ("--max-parallel", "number"), ("--grace", "number"), ("--map", "word"),
        ("--env-setup", "word"), ("--python", "word"), ("--sbatch-arg", "word"))),
    *((_SUBMIT % "openjd" + " %s", option, kind, _spec("tiny")) for option, kind in (
        ("--env-setup", "word"), ("--python", "word"), ("--mem", "word"), ("--time", "word"))),
    ("facegen farm submit in/spec.toml --out out/data --dry-run %s", "--engine", "word", _spec("tiny")),
    ("facegen farm logs in/data %s", "--tail", "number", _logged),
    ("facegen headset preview tracking3 --out out/headset.png %s", "--rig", "word", _headset),
    ("regress export in/model --format c --out out %s", "--name", "word", _model),
    ("regress export in/model --out out %s", "--format", "word", _model),
    ("regress edges in/points.npy --out out/shape.json %s", "--tilt-deg", "number", _points_3d),
)  # fmt: skip


def _arguments():
    yield "facegen farm logs in/data {value}", _logged
    yield "facegen rig info {value}", None
    yield "facegen rig landmarks {value} --out out/points.npy", None
    yield "facegen rig build {value}", None
    yield "facegen headset show {value}", None
    yield "facegen spec check {value}", None
    yield "facegen validate {value}", None
    yield "regress predict {landmark_model} {value} --out out/weights.csv", None
    yield "regress export {value} --out out", None
    yield "regress evaluate {value} {keypoints}", None
    yield "regress headset evaluate {value} {arrays}", None


def _name(command: str, option: str) -> str:
    words = [word for word in command.split() if re.fullmatch(r"[a-z]+", word)]
    return "-".join([*words[1:], option.lstrip("-")])


def _reader(command: str, option: str, kind: str, make) -> Reader:
    engine = "-openjd" if "openjd" in command else ""
    return Reader(
        name=f"option-{_name(command.split(' in/')[0].split(' {')[0], option)}{engine}",
        command=command % f"{option}={{value}}",
        values=kind,
        make=make,
        accepts=(0, 75),
    )


READERS = (
    *(_reader(*entry) for entry in _OPTIONS),
    *(
        Reader(
            name=f"argument-{'-'.join(word for word in command.split()[1:3] if word.isalpha())}",
            command=command,
            values="word",
            make=make or (lambda folder, workshop: None),
            environment={"FACEGEN_RIGS": "out"} if "rig build" in command else {},
        )
        for command, make in _arguments()
    ),
)
