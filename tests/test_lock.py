"""What `make` installs is what was locked: the versions of constraints.txt, with hashes, and nothing without."""

import re
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
ENTRY = re.compile(
    r"^([A-Za-z0-9._-]+)==(\S+?)(?: ; (?P<marker>.+?))?((?: \\\n    --hash=sha256:[0-9a-f]{64})+)$", re.M
)

PYTORCH = {"torch", "filelock", "fsspec", "mpmath", "networkx", "sympy"}
"""PyTorch and what it alone needs: its builds for processors are other files of the same version."""

TOOLS = {"uv"}
"""Makes the locks; nothing needs it to run."""


def normal(name: str) -> str:
    return re.sub("[-_.]+", "-", name).lower()


def locked(name: str) -> dict[str, str]:
    """Versions of a lock, by name; every line of it belongs to an entry with hashes."""
    text = (ROOT / name).read_text()
    entries = list(ENTRY.finditer(text))
    left = ENTRY.sub("", text)
    assert not [line for line in left.splitlines() if line and not line.startswith("#")]
    return {normal(entry[1]): entry[2] for entry in entries}


@pytest.mark.parametrize("name", ["requirements.lock", "requirements-dev.lock"])
def test_a_lock_holds_the_versions_of_the_constraints(name):
    lines = (ROOT / "constraints.txt").read_text().split()
    constraints = {normal(line.partition("==")[0]): line.partition("==")[2] for line in lines}
    versions = locked(name)
    assert {key: version for key, version in versions.items() if key in constraints} == {
        key: constraints[key] for key in versions if key in constraints
    }
    # colorama and pywin32 are for Windows alone, where constraints.txt was not made
    assert versions.keys() - constraints.keys() <= {"colorama", "pywin32"}
    if name == "requirements-dev.lock":
        assert constraints.keys() - versions.keys() == PYTORCH | TOOLS
        assert locked("requirements.lock").items() <= versions.items()


@pytest.mark.parametrize("target", ["setup", "test"])
def test_make_installs_nothing_whose_hash_it_does_not_know(target, tmp_path):
    commands = subprocess.run(
        ["make", "--dry-run", "--always-make", target], cwd=ROOT, capture_output=True, text=True, check=True
    ).stdout
    installs = [line for line in commands.splitlines() if "pip install" in line]
    assert installs
    for line in installs:
        assert "--no-deps" in line
        assert "--require-hashes" in line or line.endswith("--no-build-isolation --editable ."), line
