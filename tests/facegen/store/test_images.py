"""Picture files: same arrays, same bytes; what is written is read back; other programs can read them."""

import dataclasses
import errno
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

from facegen.errors import FormatError
from facegen.scene import Layers
from facegen.store.images import EXR_PARTS, png_bytes, read_exr, read_png, write_exr


@pytest.fixture
def layers():
    rng = np.random.default_rng(5)
    size = (24, 40)
    return Layers(
        radiance=rng.random(size).astype(np.float16).astype(np.float32),
        depth=np.where(rng.random(size) < 0.3, np.inf, rng.random(size)).astype(np.float32),
        normal=rng.normal(size=(*size, 3)).astype(np.float16).astype(np.float32),
        part=rng.integers(0, 17, size).astype(np.uint8),
        uv=rng.random((*size, 2)).astype(np.float32),
    )


def test_layers_survive_a_file(layers, tmp_path):
    path = tmp_path / "left_eye.exr"
    write_exr(layers, path)
    back = read_exr(path)
    for field in dataclasses.fields(Layers):
        written, read = getattr(layers, field.name), getattr(back, field.name)
        assert read.dtype == written.dtype
        assert np.array_equal(read, written), field.name


def test_same_arrays_give_same_bytes(layers, tmp_path):
    one, other = tmp_path / "one.exr", tmp_path / "other.exr"
    write_exr(layers, one)
    write_exr(dataclasses.replace(layers, part=layers.part.copy()), other)
    assert one.read_bytes() == other.read_bytes()
    grey = (layers.radiance * 255).astype(np.uint8)
    assert png_bytes(grey) == png_bytes(grey.copy())


def test_headers_tell_no_time_and_no_place(layers, tmp_path):
    path = tmp_path / "a.exr"
    write_exr(layers, path)
    with OpenEXR.File(str(path), separate_channels=True) as file:
        assert [part.name() for part in file.parts] == list(EXR_PARTS)
        keys = {key for part in file.parts for key in part.header}
        ids = file.parts[3].channels["id"].pixels
    assert ids.dtype == np.uint32
    assert not {
        key for key in keys if "date" in key.lower() or "time" in key.lower() or "file" in key.lower()
    }


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="the system has no full device")
def test_a_full_disk_is_told_by_the_systems_own_error(layers):
    """By the time anybody asks the disk the half file is gone, and there is room again."""
    with pytest.raises(OSError, match="No space left") as refusal:
        write_exr(layers, Path("/dev/full"))
    assert refusal.value.errno == errno.ENOSPC


def test_opencv_reads_the_radiance(layers, tmp_path):
    path = tmp_path / "a.exr"
    write_exr(layers, path)
    program = f"import cv2; i = cv2.imread({str(path)!r}, -1); print(i.shape, float(i.max()))"
    # OpenCV reads EXR only where this is set before its import
    environment = os.environ | {"OPENCV_IO_ENABLE_OPENEXR": "1"}
    run = subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, env=environment, check=True
    )
    assert run.stdout.strip() == f"(24, 40) {float(layers.radiance.max())}"


def test_png_round_trip(tmp_path):
    grey = np.arange(256, dtype=np.uint8).reshape(16, 16)
    path = tmp_path / "a.png"
    path.write_bytes(png_bytes(grey))
    assert np.array_equal(read_png(path), grey)


def test_what_is_no_picture_is_refused(layers, tmp_path):
    path = tmp_path / "junk.exr"
    path.write_bytes(b"junk")
    with pytest.raises(FormatError, match="not a readable EXR"):
        read_exr(path)
    with pytest.raises(FormatError, match="there is no file"):
        read_exr(tmp_path / "none.exr")
    header = {"name": "radiance", "type": OpenEXR.scanlineimage, "compression": OpenEXR.ZIP_COMPRESSION}
    OpenEXR.File([OpenEXR.Part(header, {"Y": layers.radiance})]).write(str(path))
    with pytest.raises(FormatError, match=r"has no depth\.Z; a view's EXR has the parts radiance, depth"):
        read_exr(path)
    (tmp_path / "junk.png").write_bytes(b"junk")
    with pytest.raises(FormatError, match="not an 8-bit grey PNG"):
        read_png(tmp_path / "junk.png")
