"""Ways to damage a file, by the kind of file; each takes bytes and a seeded source of chance, and gives bytes."""

from collections.abc import Callable
from random import Random

from tests.hostile.mutators.arrays import NPY, NPZ
from tests.hostile.mutators.octets import OCTETS, TEXT
from tests.hostile.mutators.pictures import PNG
from tests.hostile.mutators.records import ONNX, PARQUET
from tests.hostile.mutators.scenes import GLB, GLTF
from tests.hostile.mutators.tables import CSV, LINES, XML
from tests.hostile.mutators.trees import JSON, TOML

Mutator = Callable[[bytes, Random], bytes]

MUTATORS: dict[str, dict[str, Mutator]] = {
    "json": JSON | TEXT,
    "toml": TOML | TEXT,
    "csv": CSV | TEXT,
    "xml": XML | TEXT,
    "lines": LINES | TEXT,
    "npy": NPY,
    "npz": NPZ,
    "png": PNG,
    "gltf": GLTF,
    "glb": GLB,
    "parquet": PARQUET,
    "onnx": ONNX,
    "binary": {},
}
"""By kind of file: what knows its structure. `OCTETS` goes with all of them."""

FAMILIES = {kind: {**mutators, **OCTETS} for kind, mutators in MUTATORS.items()}
