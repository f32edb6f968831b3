"""Khronos's glTF validator, where the web folder's development packages are installed."""

import json
import shutil
import subprocess
from pathlib import Path

import pytest

WEB = Path(__file__).parents[3] / "web"
SCRIPT = (
    "const v=require('gltf-validator');v.validateBytes(new Uint8Array(require('fs').readFileSync("
    "process.argv[1])),{maxIssues:0}).then(r=>console.log(JSON.stringify(r.issues.messages)))"
)


def complaints(path: Path) -> list[dict]:
    """Errors, warnings and hints about a file; skips the test where there is no validator."""
    if shutil.which("node") is None or not (WEB / "node_modules" / "gltf-validator").is_dir():
        pytest.skip("gltf-validator is not installed (npm ci in web/)")
    command = ["node", "-e", SCRIPT, str(path)]
    run = subprocess.run(command, cwd=WEB, capture_output=True, text=True, check=True, timeout=60)
    return json.loads(run.stdout)
