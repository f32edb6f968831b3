"""Readers of specs, headsets, rigs and users' own heads, and of tables of weights that `preview` plays."""

from pathlib import Path

from tests.hostile.readers.landmarks import _live_link, _weights
from tests.hostile.readers.reader import Reader
from tests.hostile.workshop import ROOT, Workshop, copied, reseal_rig

SPECS = ROOT / "datasets"


def _spec(name: str):
    def make(folder: Path, workshop: Workshop) -> None:
        copied(SPECS / f"{name}.toml", folder / "spec.toml")

    return make


def _headset(folder: Path, workshop: Workshop) -> None:
    copied(ROOT / "blender_assets" / "headsets" / "tracking3.toml", folder / "mine.toml")


def _head(folder: Path, workshop: Workshop) -> None:
    glb, markup = workshop.head
    copied(glb, folder / "head.glb")
    copied(markup, folder / "head.json")


def _rig(folder: Path, workshop: Workshop) -> None:
    copied(workshop.rigs, folder / "rigs")


def _clone(folder: Path, workshop: Workshop) -> None:
    """A clone of ICT-FaceKit with one triangle in the place of its 26,719 vertices: honest in form alone."""
    text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n"
    for name in ("generic_neutral_mesh", "identity000", "jawOpen"):
        path = folder / "clone" / "FaceXModel" / f"{name}.obj"
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def _playback(folder: Path, workshop: Workshop) -> None:
    _live_link(folder, workshop)
    (folder / "spec.toml").write_text(
        'version = 1\nkind = "playback"\nseed = 1\npeople = 2\n[playback]\nrecording = "weights.csv"\nfps = 30\n'
    )


_RIGS = {"FACEGEN_RIGS": "in/rigs"}

READERS = (
    Reader(
        name="spec",
        command="facegen spec check in/spec.toml",
        make=_spec("default"),
        target="spec.toml",
        kind="toml",
    ),
    Reader(
        name="spec-show",
        command="facegen spec show in/spec.toml",
        make=_spec("headset"),
        target="spec.toml",
        kind="toml",
    ),
    Reader(
        name="generate",
        names=("render.headset", "rig: "),
        command="facegen generate in/spec.toml --out out/data --dry-run",
        make=_spec("tiny"),
        target="spec.toml",
        kind="toml",
    ),
    Reader(
        name="playback",
        command="facegen generate in/spec.toml --out out/data --dry-run",
        make=_playback,
        target="weights.csv",
        kind="csv",
    ),
    Reader(
        name="submit",
        names=("render.headset", "rig: "),
        command="facegen farm submit in/spec.toml --out out/data --engine slurm --dry-run",
        make=_spec("tiny"),
        target="spec.toml",
        kind="toml",
        covers=("engine:slurm",),
        weight=0.5,
    ),
    Reader(
        name="headset",
        command="facegen headset show in/mine.toml --json",
        make=_headset,
        target="mine.toml",
        kind="toml",
    ),
    Reader(
        name="headset-preview",
        command="facegen headset preview in/mine.toml --out out/headset.png",
        make=_headset,
        target="mine.toml",
        kind="toml",
        only=("number", "replace", "extreme"),
        weight=0.25,
    ),
    Reader(
        name="head",
        command="facegen rig add in/head.glb --landmarks in/head.json --name me",
        make=_head,
        target="head.glb",
        kind="glb",
        environment={"FACEGEN_RIGS": "out"},
        only=("claims", "chunks", "number", "replace", "extreme", "exchange", "flip", "cut"),
        weight=0.25,
    ),
    Reader(
        name="head-markup",
        command="facegen rig add in/head.glb --landmarks in/head.json --name me",
        make=_head,
        target="head.json",
        kind="json",
        environment={"FACEGEN_RIGS": "out"},
        only=("replace", "extreme", "remove", "number", "resize", "exchange", "kind"),
        weight=0.25,
    ),
    Reader(
        name="rig-json",
        command="facegen rig info glb",
        make=_rig,
        target="rigs/glb.json",
        kind="json",
        environment=_RIGS,
    ),
    Reader(
        name="rig-landmarks-json",
        command="facegen rig landmarks glb --out out/points.npy",
        make=_rig,
        target="rigs/glb.json",
        kind="json",
        environment=_RIGS,
    ),
    Reader(
        name="rig-arrays",
        command="facegen rig landmarks glb --out out/points.npy",
        make=_rig,
        target="rigs/glb.npz",
        kind="npz",
        environment=_RIGS,
        reseal=reseal_rig,
    ),
    Reader(
        name="weight-table",
        command="facegen preview --weights in/weights.csv --rig anny --size 64 --frames 0 --out out/strip.png",
        make=_weights,
        target="weights.csv",
        kind="csv",
        weight=0.5,
    ),
    Reader(
        name="live-link",
        command="facegen preview --weights in/weights.csv --rig anny --size 64 --frames 0 --out out/strip.png",
        make=_live_link,
        target="weights.csv",
        kind="csv",
        weight=0.5,
    ),
    Reader(
        name="weights-film",
        command="facegen preview --weights in/weights.csv --rig anny --size 64 --frames 0-2 --out out/film.gif",
        make=_weights,
        target="weights.csv",
        kind="csv",
        only=("cell", "column", "ragged"),
        weight=0.5,
    ),
    Reader(
        name="ict-clone",
        command="facegen rig build ict --path in/clone",
        make=_clone,
        target="clone/FaceXModel/*.obj",
        kind="lines",
        covers=("rig:ict",),
        honest="refused",
        environment={"FACEGEN_RIGS": "out"},
    ),
)
