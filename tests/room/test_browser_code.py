"""Runs the tests of what the room's page does without a browser: the vectors in TypeScript, and playback."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
WEB = ROOT / "web"
ESBUILD = WEB / "node_modules" / ".bin" / "esbuild"

pytestmark = pytest.mark.skipif(
    not (shutil.which("node") and ESBUILD.exists()), reason="needs Node.js 20, and `npm ci` in web/"
)


@pytest.mark.parametrize("test", sorted(path.name for path in (WEB / "room" / "tests").glob("*.test.ts")))
def test_in_typescript(test: str, tmp_path: Path):
    made = tmp_path / "test.mjs"
    bundle = ("--bundle", "--platform=node", "--format=esm", "--log-level=warning", f"--outfile={made}")
    subprocess.run([ESBUILD, WEB / "room" / "tests" / test, *bundle], check=True, cwd=WEB)
    environment = {
        **os.environ,
        "VECTORS": str(ROOT / "room" / "protocol" / "vectors.json"),
        "FRAMES": str(WEB / "room" / "voice" / "frames.worklet.js"),
        "PLACES": str(ROOT / "room" / "server" / "static" / "places"),
    }
    done = subprocess.run(
        ["node", "--test", made], capture_output=True, text=True, env=environment, timeout=300
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "# fail 0" in done.stdout
    assert "# pass 0" not in done.stdout
