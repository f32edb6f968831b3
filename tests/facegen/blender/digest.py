"""Renders an eye in its own process and prints the SHA-256 of its files: ``python digest.py THREADS``."""

import hashlib
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[3]))

from facegen.blender import open_renderer
from facegen.headsets import HeadsetSensor
from facegen.sensor import develop
from facegen.store.images import exr_bytes, png_bytes
from tests.facegen.blender.scenes import eye_scene


def digest(renderer) -> str:
    """One hash of both files."""
    layers = renderer.render(eye_scene(), "eye", samples=4, seed=7)
    files = png_bytes(develop(layers.radiance, HeadsetSensor(exposure=0.4, black_level=12))) + exr_bytes(
        layers
    )
    return hashlib.sha256(files).hexdigest()


if __name__ == "__main__":
    print(digest(open_renderer(threads=int(sys.argv[1]))))
