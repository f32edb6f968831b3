"""Talks to the server that runs cases: starts it, gives it orders, takes their endings."""

import json
import os
import subprocess
import sys
from dataclasses import asdict, dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

MEMORY_BYTES = 1_500_000_000
"""Address space that a command may take beyond its imports: ten times what an honest small input needs."""
CPU_S = 10
"""Processor time of a command whose honest input takes a tenth to a second."""
WALL_S = 150.0
"""Longest wait; far over the processor's time, as tests share busy machines."""
FILE_BYTES = 200_000_000
"""Largest file that a command may write here."""

_ALONE = {
    name: "1"
    for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS", "NUMEXPR_NUM_THREADS")
}
_ENVIRONMENT = _ALONE | {
    "ORT_DISABLE_TELEMETRY": "1",
    "JE_ARROW_MALLOC_CONF": "background_thread:false",
    "PYTHONWARNINGS": "default",
    "PYTHONUTF8": "1",
    "MPLBACKEND": "Agg",
}


@dataclass(frozen=True, kw_only=True)
class Order:
    """One command to run, its files and its limits."""

    program: str
    words: tuple[str, ...]
    folder: str
    stdin: str
    stdout: str
    stderr: str
    environment: dict[str, str] = field(default_factory=dict)
    broken: str | None = None
    memory_bytes: int = MEMORY_BYTES
    cpu_s: int = CPU_S
    wall_s: float = WALL_S
    file_bytes: int = FILE_BYTES


@dataclass(frozen=True, kw_only=True)
class Ending:
    """How a command ended: an exit code, or a signal's negative number."""

    code: int
    overdue: bool
    left_running: bool
    wall_s: float
    cpu_s: float
    peak_bytes: int


class Server:
    """One process that forks for each order."""

    def __init__(self) -> None:
        environment = os.environ | _ENVIRONMENT | {"PYTHONPATH": str(ROOT)}
        self._process = subprocess.Popen(
            [sys.executable, "-m", "tests.hostile.server"],
            cwd=ROOT,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,  # Ctrl-C is for who gives the orders
        )
        self._answer()

    def run(self, order: Order) -> Ending:
        """Run one command to its end."""
        self._process.stdin.write(json.dumps(asdict(order)) + "\n")
        self._process.stdin.flush()
        return Ending(**self._answer())

    def close(self) -> None:
        """End the server."""
        self._process.stdin.close()
        self._process.wait()
        self._process.stdout.close()

    def _answer(self) -> dict:
        line = self._process.stdout.readline()
        if not line:
            raise RuntimeError(f"the server ended with {self._process.wait()}; its errors are above")
        return json.loads(line)
