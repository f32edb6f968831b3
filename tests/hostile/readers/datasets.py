"""Readers of data sets: what `regress` reads of them, and what the commands of `facegen` do with them."""

import json
from dataclasses import replace
from pathlib import Path

from tests.hostile.readers.reader import Reader
from tests.hostile.workshop import ROOT, Workshop, copied


def _keypoints(folder: Path, workshop: Workshop) -> None:
    copied(workshop.keypoints, folder / "data")


def _rendered(folder: Path, workshop: Workshop) -> None:
    copied(workshop.rendered, folder / "data")


def _two(folder: Path, workshop: Workshop) -> None:
    _rendered(folder, workshop)
    copied(workshop.rendered, folder / "other")


def _farmed(folder: Path, workshop: Workshop) -> None:
    copied(workshop.farmed, folder / "data")


_SHARD = "data/keypoints/shard-00000.parquet"
_SAMPLE = "data/renders/000/000000"
_SHARE = 0.4
"""Of the cases of other readers: loading the rig takes a fifth of a second."""
_ACCEPTED = (0, 1, 75)
"""Of `validate` and `farm status`: wrong or missing data are what they are asked for."""


def _data(name: str, command: str, target: str, kind: str, **more) -> Reader:
    return Reader(
        name=name, command=command, make=_rendered, target=target, kind=kind, **{"weight": _SHARE, **more}
    )


def _recorded(folder: Path, workshop: Workshop) -> None:
    copied(workshop.recorded, folder / "data")


def _logged(folder: Path, workshop: Workshop) -> None:
    _farmed(folder, workshop)
    log = folder / "data" / "logs" / "000" / "sample-000001-1.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    log.write_text("rendering\nfailed: no memory\n")


def _journal(folder: Path, workshop: Workshop) -> None:
    from dataclasses import asdict

    from facegen.work.journal import Attempt

    _farmed(folder, workshop)
    line = {name: 1 for name in Attempt.__dataclass_fields__} | {"task": "sample-000001", "outcome": "done"}
    assert asdict(Attempt(**line))
    (folder / "data" / "logs").mkdir(exist_ok=True)
    (folder / "data" / "logs" / "run-1.jsonl").write_text(json.dumps(line) + "\n")


def _packed(folder: Path, workshop: Workshop) -> None:
    _recorded(folder, workshop)
    copied(workshop.packed, folder / "pack")


def _developed(folder: Path, workshop: Workshop) -> None:
    _rendered(folder, workshop)
    copied(workshop.developed, folder / "new")


def _begun(folder: Path, workshop: Workshop) -> None:
    copied(ROOT / "datasets" / "tiny.toml", folder / "spec.toml")
    _farmed(folder, workshop)


def _pack(name: str, target: str, kind: str, **more) -> Reader:
    return _data(
        f"pack-{name}",
        f"facegen pack in/data --format {name} --out out/pack",
        target,
        kind,
        covers=(f"pack:{name}",),
        weight=_SHARE,
        **more,
    )


_READERS = (
    Reader(
        name="evaluate-dataset",
        command="regress evaluate {landmark_model} in/data",
        make=_keypoints,
        target="data/dataset.json",
        kind="json",
    ),
    Reader(
        name="evaluate-shards",
        command="regress evaluate {landmark_model} in/data",
        make=_keypoints,
        target="data/keypoints/*.parquet",
        kind="parquet",
    ),
    Reader(
        name="report-shards",
        command="regress report {landmark_model} --data in/data --out out/report.html",
        make=_keypoints,
        target="data/keypoints/*.parquet",
        kind="parquet",
        weight=_SHARE,
    ),
    _data(
        "validate-dataset",
        "facegen validate in/data --workers 1",
        "data/dataset.json",
        "json",
        accepts=_ACCEPTED,
        only=("replace", "extreme", "remove"),
        weight=0.25,
    ),
    _data(
        "validate-spec",
        "facegen validate in/data --workers 1",
        "data/spec.toml",
        "toml",
        accepts=_ACCEPTED,
        weight=0.25,
    ),
    _data(
        "validate-sample",
        "facegen validate in/data --workers 1",
        f"{_SAMPLE}/sample.json",
        "json",
        accepts=_ACCEPTED,
        weight=0.25,
    ),
    _data(
        "validate-shard",
        "facegen validate in/data --workers 1",
        _SHARD,
        "parquet",
        accepts=_ACCEPTED,
        only=("columns", "flip", "cut"),
        weight=0.25,
    ),
    _data(
        "validate-picture",
        "facegen validate in/data --workers 1",
        f"{_SAMPLE}/*.png",
        "png",
        accepts=_ACCEPTED,
        only=("claim", "pixels", "flip", "kind"),
        weight=0.25,
    ),
    _data(
        "validate-exr",
        "facegen validate in/data --workers 1",
        f"{_SAMPLE}/*.exr",
        "binary",
        accepts=_ACCEPTED,
        only=("flip", "overwrite", "cut", "kind"),
        weight=0.25,
    ),
    _data("develop-exr", "facegen develop in/data --out out/new", f"{_SAMPLE}/*.exr", "binary"),
    _data("develop-sample", "facegen develop in/data --out out/new", f"{_SAMPLE}/sample.json", "json"),
    _data("develop-headset", "facegen develop in/data --out out/new", "data/headset.toml", "toml"),
    _data(
        "preview-shard",
        "facegen preview in/data --out out/page.html",
        _SHARD,
        "parquet",
        memory_bytes=3_000_000_000,  # matplotlib's figures and the fonts' tables
        only=("columns", "cut"),
        weight=0.25,
    ),
    _data(
        "preview-sample",
        "facegen preview in/data --out out/sheet.png",
        f"{_SAMPLE}/sample.json",
        "json",
        only=("replace", "extreme", "flip"),
        weight=_SHARE,
    ),
    _data(
        "preview-picture",
        "facegen preview in/data --out out/sheet.png",
        f"{_SAMPLE}/*.png",
        "png",
        only=("claim", "flip", "kind"),
        weight=_SHARE,
    ),
    _pack("webdataset", f"{_SAMPLE}/sample.json", "json"),
    _pack("parquet", f"{_SAMPLE}/sample.json", "json"),
    _pack("arrays", f"{_SAMPLE}/*.png", "png"),
    _pack("coco", _SHARD, "parquet"),
    _pack("keypoints", _SHARD, "parquet"),
    *(
        Reader(
            name=f"pack-{name}",
            command=f"facegen pack in/data --format {name} --out out/pack",
            make=_recorded,
            target=_SHARD,
            kind="parquet",
            covers=(f"pack:{name}",),
            weight=_SHARE,
        )
        for name in ("livelink", "openface")
    ),
    Reader(
        name="merge-dataset",
        command="facegen merge in/data in/other --out out/all",
        make=_two,
        target="data/dataset.json",
        kind="json",
        only=("replace", "extreme", "remove", "flip", "kind"),
        weight=_SHARE,
    ),
    Reader(
        name="merge-sample",
        command="facegen merge in/data in/other --out out/all",
        make=_two,
        target=f"{_SAMPLE}/sample.json",
        kind="json",
        only=("replace", "extreme", "rename", "flip", "kind"),
        weight=_SHARE,
    ),
    Reader(
        name="farm-status",
        command="facegen farm status in/data --json",
        make=_farmed,
        target="data/farm/job-001/job.json",
        kind="json",
        accepts=_ACCEPTED,
        covers=("engine:openjd",),
        weight=_SHARE,
    ),
    Reader(
        name="farm-submission",
        command="facegen farm status in/data",
        make=_farmed,
        target="data/farm/job-001/submission.json",
        kind="json",
        accepts=_ACCEPTED,
        weight=_SHARE,
    ),
    Reader(
        name="farm-resume",
        command="facegen farm resume in/data --dry-run",
        make=_farmed,
        target="data/farm/job-001/job.json",
        kind="json",
        changes=True,
        weight=_SHARE,
    ),
    Reader(
        name="farm-cancel",
        command="facegen farm cancel in/data",
        make=_farmed,
        honest="refused",
        names=("job-001",),
        target="data/farm/job-001/job.json",
        kind="json",
        changes=True,
        weight=_SHARE,
    ),
    Reader(
        name="farm-logs",
        command="facegen farm logs in/data sample-000001",
        make=_logged,
        target="data/logs/000/*.log",
        kind="lines",
        weight=0.3,
    ),
    Reader(
        name="farm-journal",
        command="facegen farm status in/data",
        make=_journal,
        target="data/logs/*.jsonl",
        kind="json",
        accepts=_ACCEPTED,
        weight=_SHARE,
    ),
    Reader(
        name="generate-again",
        command="facegen generate in/spec.toml --out in/data --dry-run",
        make=_begun,
        target="data/dataset.json",
        kind="json",
        weight=_SHARE,
    ),
    Reader(
        name="pack-again",
        command="facegen pack in/data --format keypoints --out in/pack",
        make=_packed,
        target="pack/*.json",
        kind="json",
        changes=True,
        weight=_SHARE,
    ),
    Reader(
        name="develop-again",
        command="facegen develop in/data --out in/new",
        make=_developed,
        target="new/develop.json",
        kind="json",
        changes=True,
        weight=_SHARE,
    ),
    Reader(
        name="preview-clip",
        command="facegen preview in/data --clip 0 --frames 0 --size 64 --out out/strip.png",
        make=_recorded,
        target=_SHARD,
        kind="parquet",
        only=("columns", "flip", "cut"),
        weight=_SHARE,
    ),
)

READERS = tuple(replace(reader, refuses=(1, 2, 74)) for reader in _READERS)
"""All of them may find a data set invalid, which is exit code 1."""
