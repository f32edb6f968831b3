"""pip gets nothing of what a program reads, and asks nobody anything."""

import os
import subprocess
import sys
from pathlib import Path

_PIP = """
import sys
from pathlib import Path
Path(sys.argv[-1], "a.whl").write_text(repr([sys.argv[1:-1], sys.stdin.read()]))
"""
_CALL = """
import sys
from pathlib import Path
from facegen.wheels import download_wheel
print(download_wheel("a==1", file="a.whl", folder=Path(sys.argv[1]), advice="").read_text())
"""


def test_pip_leaves_the_lines_of_a_detector_alone(tmp_path: Path):
    """`track --camera -` reads points from standard input, and pip may want a password of an index."""
    (tmp_path / "pip").mkdir()
    (tmp_path / "pip" / "__init__.py").touch()
    (tmp_path / "pip" / "__main__.py").write_text(_PIP)
    done = subprocess.run(
        [sys.executable, "-c", _CALL, str(tmp_path)],
        input="a line of points",
        env={**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.getcwd()])},
        capture_output=True,
        text=True,
        check=True,
    )
    assert "--no-input" in done.stdout
    assert "a line of points" not in done.stdout
