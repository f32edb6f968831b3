"""The ground that programs on users' machines stand on imports NumPy and the standard library, and no more."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]

PROGRAM = """
import importlib, pkgutil, sys
before = set(sys.modules)
for name in ("facegen", "facegen.formats", "facegen.geometry"):
    package = importlib.import_module(name)
    inner = pkgutil.iter_modules(package.__path__, name + ".")
    for module in inner if name != "facegen" else [m for m in inner if not m.ispkg]:
        if module.name not in ("facegen.__main__", "facegen.compilation"):
            importlib.import_module(module.name)
loaded = {name.partition(".")[0] for name in set(sys.modules) - before}
print(*sorted(loaded - set(sys.stdlib_module_names) - {"facegen"}))
"""


def test_the_ground_imports_numpy_alone():
    done = subprocess.run([sys.executable, "-c", PROGRAM], cwd=ROOT, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    libraries = [name for name in done.stdout.split() if not name.startswith(("_", "cython"))]
    assert libraries == ["numpy"]
