"""Names of morph targets: extras of the mesh hold them, or with some exporters those of its first primitive.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification": 3.7.2.2, whose implementation note suggests ``mesh.extras.targetNames``.
"""

from typing import Any


def target_names(mesh: Any) -> list[str]:
    """Names in the targets' order, none where there are none; ``mesh`` is a record, or pygltflib's of one."""
    primitives = _of(mesh, "primitives")
    first = primitives[0] if isinstance(primitives, list) and primitives else None
    for place in (mesh, first):
        extras = _of(place, "extras")
        names = extras.get("targetNames") if isinstance(extras, dict) else None
        if isinstance(names, list) and names:
            return list(map(str, names))
    return []


def _of(record: Any, key: str) -> Any:
    return record.get(key) if isinstance(record, dict) else getattr(record, key, None)
