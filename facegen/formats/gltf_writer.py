"""Writes glTF 2.0 binary files, record by record, with sparse morph targets.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.6.2 accessors (3.6.2.3 sparse ones, 3.6.2.4 alignment), 3.7.2.2 morph
   targets, 4 the binary container.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from facegen.formats.gltf_container import BIN, glb_bytes

VERTICES, INDICES = 34962, 34963
"""What a buffer view holds, for the graphics card."""
_COMPONENTS = {"float32": 5126, "uint32": 5125, "uint16": 5123, "uint8": 5121}
_KINDS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class GltfWriter:
    """A glTF document that grows; its numbers go to one binary chunk.

    Parameters
    ----------
    copyright
        Goes to ``asset.copyright``.
    extras
        Goes to ``asset.extras``.
    """

    def __init__(self, *, copyright: str, extras: dict[str, Any]) -> None:
        asset = {"version": "2.0", "generator": "facegen", "copyright": copyright, "extras": extras}
        self.document: dict[str, Any] = {"asset": asset}
        self._chunk = bytearray()
        self._nothing: dict[int, int] = {}
        self._rows = bytearray()  # of all sparse accessors: one view, which keeps the JSON short
        self._rows_view = self.add("bufferViews", {})

    def add(self, kind: str, record: dict[str, Any]) -> int:
        """Append a record to one of the document's lists (``"nodes"``, ``"materials"``); its number."""
        records = self.document.setdefault(kind, [])
        records.append(record)
        return len(records) - 1

    def numbers(
        self, values: np.ndarray, *, target: int | None = None, bounds: bool = False, normalized: bool = False
    ) -> int:
        """Add an accessor of ``values`` (n,) or (n, width), whose type is the file's; its number."""
        values = np.ascontiguousarray(values)
        width = 1 if values.ndim == 1 else values.shape[1]
        record: dict[str, Any] = {
            "bufferView": self._view(values.tobytes(), target),
            "componentType": _COMPONENTS[values.dtype.name],
            "count": len(values),
            "type": _KINDS[width],
        }
        if normalized:
            record["normalized"] = True
        if bounds:
            table = values.reshape(len(values), width)
            record |= {"min": _short(table.min(axis=0)), "max": _short(table.max(axis=0))}
        return self.add("accessors", record)

    def sparse(self, rows: np.ndarray, values: np.ndarray, count: int, *, bounds: bool = False) -> int:
        """Add an accessor of ``count`` vectors that are 0 but for ``rows`` (k,), which have ``values`` (k, 3)."""
        if not len(rows):
            if count not in self._nothing:
                # a sparse accessor replaces one row at least
                self._nothing[count] = self.sparse(np.zeros(1, int), np.zeros((1, 3)), count, bounds=True)
            return self._nothing[count]
        values = values.astype("<f4")
        rest = np.zeros((int(len(rows) < count), 3), np.float32)
        bounded = np.concatenate([values, rest])
        kind = np.dtype("<u2" if count <= 65_535 else "<u4")
        record: dict[str, Any] = {
            "componentType": 5126,
            "count": count,
            "type": "VEC3",
            "sparse": {
                "count": len(rows),
                "indices": self._row(rows.astype(kind).tobytes()) | {"componentType": _COMPONENTS[kind.name]},
                "values": self._row(values.tobytes()),
            },
        }
        if bounds:
            record |= {"min": _short(bounded.min(axis=0)), "max": _short(bounded.max(axis=0))}
        return self.add("accessors", record)

    def texture(self, picture: bytes, name: str) -> int:
        """Add a texture of an encoded picture (PNG or JPEG); its number."""
        png = picture.startswith(b"\x89PNG")
        image = {
            "name": name,
            "bufferView": self._view(picture),
            "mimeType": f"image/{'png' if png else 'jpeg'}",
        }
        if "samplers" not in self.document:  # trilinear, repeated around
            self.add("samplers", {"magFilter": 9729, "minFilter": 9987, "wrapS": 10497, "wrapT": 33071})
        return self.add("textures", {"sampler": 0, "source": self.add("images", image)})

    def scene(self, roots: Sequence[int]) -> None:
        """Make the one scene of nodes ``roots``."""
        self.document |= {"scene": 0, "scenes": [{"nodes": list(roots)}]}

    def content(self) -> bytes:
        """Bytes of the .glb file."""
        rows = self._view(bytes(self._rows)) if self._rows else self._view(b"\0")
        self.document["bufferViews"][self._rows_view] = self.document["bufferViews"].pop(rows)
        self.document["buffers"] = [{"byteLength": len(self._chunk)}]
        return glb_bytes(self.document, [(BIN, bytes(self._chunk))], Path("the avatar"))

    def _row(self, content: bytes) -> dict[str, int]:
        self._rows += b"\0" * (-len(self._rows) % 4)
        place = len(self._rows)
        self._rows += content
        return {"bufferView": self._rows_view, "byteOffset": place}

    def _view(self, content: bytes, target: int | None = None) -> int:
        self._chunk += b"\0" * (-len(self._chunk) % 4)
        record = {"buffer": 0, "byteOffset": len(self._chunk), "byteLength": len(content)}
        self._chunk += content
        return self.add("bufferViews", record if target is None else record | {"target": target})


def _short(numbers: np.ndarray) -> list[float] | list[int]:
    """Numbers as JSON has them: of a float32, the shortest decimals that are nearest to it."""
    return [float(str(number)) if numbers.dtype.kind == "f" else int(number) for number in numbers]
