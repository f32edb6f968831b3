"""``--help`` of every command is quick: it imports nothing that takes long."""

import subprocess
import sys

import pytest

from regress.cli import app
from tests.facegen.cli.commands import ROOT, sub_commands

HEAVY = {"cv2", "matplotlib", "numpy", "onnx", "onnxruntime", "pyarrow", "scipy", "sklearn", "torch"}
"""pydantic is not among them: Typer itself imports it for a command's options."""

PROGRAM = f"""
import sys
from regress.cli import main
try:
    main()
finally:
    print({HEAVY!r} & set(sys.modules), file=sys.stderr)
"""


@pytest.mark.parametrize("words", sub_commands(app), ids=" ".join)
def test_help_imports_nothing_heavy(words: tuple[str, ...]):
    shown = subprocess.run(
        [sys.executable, "-c", PROGRAM, *words, "--help"], cwd=ROOT, capture_output=True, text=True
    )
    assert shown.returncode == 0
    assert "Usage: " in shown.stdout
    assert shown.stderr.strip() == "set()"
