"""A process that runs commands of regress or facegen in children and ends them: at a step on the disk, or after a time.

The test beside it writes one JSON object a line; an answer is one line. Children are forks, so that 60 of them do not
load every library 60 times. A *step* is what changes names in a folder: a file opened for writing, a folder made, a
name changed, exchanged or removed.
"""

import contextlib
import functools
import json
import os
import signal
import sys
import threading
import time
from pathlib import Path

import facegen.cli
import facegen.packing
import facegen.store.opening
import facegen.work
import regress.cli
import regress.exporters.c_source
import regress.exporters.javascript
import regress.exporters.json_text
import regress.exporters.npz_archive
import regress.learning.training as training
import regress.learning.training.run
import regress.model_card
import regress.report
from facegen.program import commands
from regress.learning.training import Recipe

with contextlib.suppress(ImportError):
    import pandas  # noqa: F401 (PyArrow takes it in with the first table: half of a short child's time)

RECIPE = Recipe(name="default", alphas=(3.0,), steps=2, search_steps=1, search_rows=40, hidden=3)
"""Instead of every recipe: what is tried is how a model is written, not how it is trained."""

load_rig = functools.cache(facegen.store.opening.load_rig)
"""Of facegen's commands: half a second less for every child; the rig is not what is written."""

_NAMES = ("os.mkdir", "os.rename", "os.remove", "os.rmdir", "shutil.rmtree")
_EXCHANGES = ("renameat2", "renamex_np")


class _Steps:
    """Counts steps, and kills this process before the one that it is told."""

    def __init__(self, fatal: int | None) -> None:
        self.count, self._fatal = 0, fatal

    def __call__(self, event: str, arguments: tuple) -> None:
        writes = event == "open" and isinstance(arguments[1], str) and set("wxa+") & set(arguments[1])
        if event in _NAMES or writes or (event == "ctypes.dlsym" and arguments[1] in _EXCHANGES):
            self.count += 1
            if self.count == self._fatal:
                os.kill(os.getpid(), signal.SIGKILL)


def _run(program: str, words: list[str], step: int | None, report: int) -> None:
    """The child: one command, to its exit code."""
    with open(os.devnull, "w") as nowhere:
        os.dup2(nowhere.fileno(), 1)
    sys.argv = [program, *words]
    steps = _Steps(step)
    sys.addaudithook(steps)
    code = 0
    try:
        {"regress": regress.cli, "facegen": facegen.cli}[program].main()
    except SystemExit as left:
        code = int(left.code or 0)
    finally:
        os.write(report, str(steps.count).encode())
    os._exit(code)


def main() -> None:
    """Answer requests of ``words``, ``step``, ``after_s`` and ``signal`` with the code, steps and seconds they took."""
    training.RECIPES.update({name: RECIPE for name in training.RECIPES})
    for program in (regress.cli, facegen.cli):
        commands(program.app)
    for line in sys.stdin:
        request = json.loads(line)
        read, write = os.pipe()
        if request.get("program") == "facegen":
            facegen.store.opening.load_rig = load_rig
            load_rig("anny")
        began = time.monotonic()
        child = os.fork()
        if child == 0:
            try:
                _run(request.get("program", "regress"), request["words"], request.get("step"), write)
            finally:
                os._exit(99)
        os.close(write)
        timer = None
        if request.get("after_s") is not None:
            timer = threading.Timer(
                request["after_s"], os.kill, (child, request.get("signal", signal.SIGKILL))
            )
            timer.start()
        _, status = os.waitpid(child, 0)
        if timer is not None:
            timer.cancel()
        with os.fdopen(read) as counted:
            steps = counted.read()
        answer = {
            "code": os.waitstatus_to_exitcode(status),
            "steps": int(steps or 0),
            "seconds": time.monotonic() - began,
        }
        sys.stdout.write(json.dumps(answer) + "\n")
        sys.stdout.flush()


if __name__ == "__main__":
    sys.path.insert(0, str(Path(__file__).parents[2]))
    main()
