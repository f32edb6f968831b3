"""Renders an eye in its own process and prints the SHA-256 of its files: ``python digest.py THREADS``."""

import hashlib
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from facegen.blender import open_renderer
from facegen.headsets import HeadsetSensor
from facegen.sensor import develop
from facegen.store.images import png_bytes, write_exr
from tests.facegen.blender.scenes import eye_scene


def digest(renderer) -> str:
    """One hash of both files."""
    layers = renderer.render(eye_scene(), "eye", samples=4, seed=7)
    files = png_bytes(develop(layers.radiance, HeadsetSensor(exposure=0.4, black_level=12)))
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "eye.exr"
        write_exr(layers, path)
        files += path.read_bytes()
    return hashlib.sha256(files).hexdigest()


if __name__ == "__main__":
    print(digest(open_renderer(threads=int(sys.argv[1]))))
