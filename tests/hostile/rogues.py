"""Commands that break each promise, and checks that are taken out: what the harness has to see.

Each runs in the command's process in place of it, or before it.
"""

import os
import signal
import subprocess
import sys
import time


def crash() -> None:
    """A traceback."""
    raise KeyError("x")


def unforeseen() -> None:
    """The exit code for what nobody foresaw."""
    sys.stderr.write("regress: internal error\n")
    sys.exit(70)


def abort() -> None:
    """A signal of its own."""
    os.abort()


def eat() -> None:
    """More memory than there is."""
    kept = []
    while True:
        kept.append(bytearray(100_000_000))


def spin() -> None:
    """Processor time without end."""
    while True:
        pass


def sleep() -> None:
    """No end, and no processor time either."""
    time.sleep(1_000)


def babble() -> None:
    """A refusal of two lines."""
    sys.stderr.write("regress: in/faces.npy is bad\nvery bad\n")
    sys.exit(2)


def drone() -> None:
    """A refusal without end."""
    sys.stderr.write(f"regress: in/faces.npy {'x' * 600}\n")
    sys.exit(2)


def mumble() -> None:
    """A refusal that names nothing."""
    sys.stderr.write("regress: something is wrong\n")
    sys.exit(2)


def litter() -> None:
    """A refusal after something was written."""
    with open("out/weights.csv", "w") as file:
        file.write("half")
    sys.stderr.write("regress: in/faces.npy is bad\n")
    sys.exit(2)


def hide() -> None:
    """Success that leaves what is half-made."""
    with open("out/.weights.123.csv", "w") as file:
        file.write("half")
    sys.exit(0)


def spoil() -> None:
    """A change of the input."""
    with open("in/faces.npy", "ab") as file:
        file.write(b"x")
    sys.exit(0)


def haunt() -> None:
    """A process that stays behind."""
    subprocess.Popen(["sleep", "100"])
    sys.exit(0)


def invent() -> None:
    """An exit code of its own."""
    sys.exit(7)


def warn() -> None:
    """A library's warning."""
    sys.stderr.write("somewhere.py:3: RuntimeWarning: overflow encountered in multiply\n")
    sys.exit(0)


def refuse() -> None:
    """What is promised."""
    sys.stderr.write("regress: in/faces.npy is bad\n")
    sys.exit(2)


def die() -> None:
    """Killed as for want of memory."""
    os.kill(os.getpid(), signal.SIGKILL)


def unbounded_json() -> None:
    """Takes out the check of JSON's nesting and numbers."""
    import json

    import facegen.documents

    facegen.documents.parse_json = lambda text, *, where: json.loads(text)


def unbounded_arrays() -> None:
    """Takes out the check of what .npy headers claim."""
    import numpy as np

    import facegen.archives
    import regress.runtime.inputs.arrays as arrays

    arrays.load_npy = facegen.archives.load_npy = lambda path, **_: np.load(path)
