"""``--help`` of every command is quick: it imports nothing that takes long."""

import subprocess
import sys

import pytest

from regress.cli import app
from tests.facegen.cli.commands import ROOT, sub_commands

HEAVY = {"cv2", "matplotlib", "onnx", "onnxruntime", "pyarrow", "pydantic", "scipy", "sklearn", "torch"}

PROGRAM = f"""
import sys, time
from regress.cli import main
try:
    main()
finally:
    print({HEAVY!r} & set(sys.modules), time.process_time(), file=sys.stderr)
"""


@pytest.mark.parametrize("words", sub_commands(app), ids=" ".join)
def test_help_imports_nothing_heavy(words: tuple[str, ...]):
    shown = subprocess.run(
        [sys.executable, "-c", PROGRAM, *words, "--help"], cwd=ROOT, capture_output=True, text=True
    )
    assert shown.returncode == 0
    assert "Usage: " in shown.stdout
    imported, seconds = shown.stderr.rsplit(maxsplit=1)
    assert imported == "set()"
    # 0.3 where little else runs; a busy machine may take twice as long, and what is heavy takes a second more
    assert float(seconds) < 0.8
