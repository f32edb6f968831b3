"""Imports Blender as a Python module, keeps it quiet, compiles its lens, and chooses its device."""

import contextlib
import hashlib
import os
import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from types import ModuleType

from facegen.errors import InputError, MissingAsset
from facegen.extras import FACTORY, missing_extra

DEBIAN_PACKAGES = {
    "libX11.so": "libx11-6",
    "libXrender.so": "libxrender1",
    "libXfixes.so": "libxfixes3",
    "libXi.so": "libxi6",
    "libxkbcommon.so": "libxkbcommon0",
    "libSM.so": "libsm6",
    "libICE.so": "libice6",
    "libXext.so": "libxext6",
    "libGL.so": "libgl1",
    "libstdc++.so": "libstdc++6",
    "libgcc_s.so": "libgcc-s1",
}
"""Debian and Ubuntu packages of the libraries that bpy links to; the files suffice, no X server runs."""

LENS = Path(__file__).with_name("lens.osl")
"""Source of the camera models."""

GPU_BACKENDS = ("OPTIX", "CUDA", "HIP", "ONEAPI", "METAL")
"""In order of preference."""


def import_bpy() -> ModuleType:
    """Import the ``bpy`` module.

    Raises
    ------
    MissingAsset
        Where it, or a system library it links to, is not installed; names the package that brings it.
    """
    if "bpy" not in sys.modules:
        sys.path[:] = without_blender_scripts(sys.path)
    try:
        import bpy
    except ImportError as error:
        raise MissingAsset(missing_library_sentence(error)) from error
    return bpy


def without_blender_scripts(paths: list[str]) -> list[str]:
    """List import paths without those that a running Blender added.

    A process spawned by one with Blender in it inherits them, and finds the half of ``bpy`` that lies in
    ``bpy/4.5/scripts/modules`` before the whole one ("No module named '_bpy'").
    """
    return [path for path in paths if not {"bpy", "scripts"} <= set(Path(path).parts)]


def missing_library_sentence(error: ImportError) -> str:
    """Say what is missing for Blender and how to get it, from the loader's message."""
    missing = re.search(r"(lib[\w.+-]+?\.so)[\w.]*: cannot open shared object file", str(error))
    if missing:
        library = missing.group(1)
        package = DEBIAN_PACKAGES.get(library)
        remedy = (
            f"install it, on Debian and Ubuntu with `apt-get install --no-install-recommends {package}`"
            if package
            else "install the system package that brings it"
        )
        return f"Blender cannot start because the system library {library} is missing: {remedy}"
    if isinstance(error, ModuleNotFoundError) and (sentence := missing_extra(error, "rendering", (FACTORY,))):
        return sentence
    return f"Blender cannot start: {error}"


@contextlib.contextmanager
def quiet_stdout() -> Iterator[None]:
    """Send file descriptor 1 to nowhere: Blender's C code prints there, past Python's ``sys.stdout``."""
    sys.stdout.flush()
    kept, nowhere = os.dup(1), os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 1)
    try:
        yield
    finally:
        os.dup2(kept, 1)
        os.close(kept)
        os.close(nowhere)


def compile_lens() -> tuple[str, str]:
    """Compile ``lens.osl``: its bytecode and MD5, as a custom camera wants them (25 to 45 ms, once a process)."""
    import_bpy()
    import _cycles

    with tempfile.TemporaryDirectory() as folder:
        compiled = Path(folder) / "lens.oso"
        # the compiler's own search for bundled tools needs no path here: the stock functions ship with Cycles
        if not _cycles.osl_compile(str(LENS), str(compiled)):
            raise InputError(f"Blender could not compile {LENS}")
        bytecode = compiled.read_text()
    return bytecode, hashlib.md5(bytecode.encode()).hexdigest()


def choose_device(want: str = "cpu") -> str:
    """Let Cycles compute on the CPU or on a GPU, and say which it is.

    Only the CPU repeats pictures bit for bit, and of the GPU backends only OptiX knows custom cameras.

    Parameters
    ----------
    want
        ``"cpu"``; ``"auto"``, a GPU if there is one that knows our cameras; or a backend's name, ``"optix"``.

    Returns
    -------
    str
        ``"CPU"``, or the backend's name, for example ``"OPTIX"``.

    Raises
    ------
    InputError
        Where the name is unknown, or a GPU was asked for by name and is not there.
    """
    bpy = import_bpy()
    names = ("cpu", "auto", *(backend.lower() for backend in GPU_BACKENDS))
    if want.lower() not in names:
        raise InputError(f"device is {want!r}, but must be one of {', '.join(names)}")
    preferences = bpy.context.preferences.addons["cycles"].preferences
    backends = {"cpu": (), "auto": ("OPTIX",)}.get(want.lower(), (want.upper(),))
    for backend in backends:
        try:
            preferences.compute_device_type = backend
        except TypeError:  # not built for this system
            continue
        preferences.refresh_devices()
        if any(device.type == backend for device in preferences.devices):
            for device in preferences.devices:
                device.use = device.type == backend
            bpy.context.scene.cycles.device = "GPU"
            return backend
    preferences.compute_device_type = "NONE"
    bpy.context.scene.cycles.device = "CPU"
    if backends and want.lower() != "auto":
        raise InputError(f"device is {want!r}, but no such device was found; use cpu or auto")
    return "CPU"
