"""Writes an animation for any VRM avatar (.vrma): expressions, head and gaze.

References
----------
.. [1] VRM Consortium, "VRMC_vrm_animation 1.0": an expression's weight is the x of its node's translation; bones are
   nodes in VRM's T-pose, of which head and others have rotations alone; a gaze is no bone and no expression, but the
   rotation of its own node.
.. [2] VRM Consortium, "VRMC_vrm 1.0", humanoid: the bones that every avatar has; it faces +z, its left is +x.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from facegen.errors import FormatError
from facegen.formats.gltf_additions import Additions
from facegen.formats.gltf_container import BIN, glb_bytes

EXTENSION = "VRMC_vrm_animation"

_BONES: dict[str, tuple[str | None, tuple[float, float, float]]] = {
    "hips": (None, (0.0, 0.95, 0.0)),
    "spine": ("hips", (0.0, 0.1, 0.0)),
    "neck": ("spine", (0.0, 0.38, 0.0)),
    "head": ("neck", (0.0, 0.09, 0.01)),
}
"""Above the head: the bone that carries each, and where it begins in that, in metres, of a person of 1.6 m."""

_SIDES: dict[str, tuple[str, tuple[float, float, float]]] = {
    "UpperLeg": ("hips", (0.09, -0.05, 0.0)),
    "LowerLeg": ("UpperLeg", (0.0, -0.4, 0.0)),
    "Foot": ("LowerLeg", (0.0, -0.42, 0.0)),
    "UpperArm": ("spine", (0.15, 0.32, 0.0)),
    "LowerArm": ("UpperArm", (0.26, 0.0, 0.0)),
    "Hand": ("LowerArm", (0.24, 0.0, 0.0)),
}
"""Bones of each side that every avatar has; the right ones are mirrored."""


def vrm_animation(
    time_s: np.ndarray,
    *,
    presets: Mapping[str, np.ndarray],
    customs: Mapping[str, np.ndarray],
    head: np.ndarray,
    gaze: np.ndarray,
    title: str,
) -> bytes:
    """Bytes of a .vrma file, whose keyframes are interpolated linearly.

    Parameters
    ----------
    time_s : (n,) float
        Seconds, not negative, rising.
    presets, customs : mapping of (n,) float
        Weights from 0 to 1 of VRM 1's own expressions, and of an avatar's.
    head, gaze : (n, 4) float
        Unit quaternions x, y, z, w in glTF's frame, the gaze's in the head's; rows of NaN become no keyframe.
    title
        What the animation is called.

    Raises
    ------
    FormatError
        There are no keyframes, times do not rise, or all is too large for a file.
    """
    path = Path(title)
    if not len(time_s) or time_s[0] < 0 or not (np.diff(time_s.astype("<f4")) > 0).all():
        raise FormatError(f"no animation for {title}: keyframes need times that start at 0 s and grow")
    nodes = _skeleton()
    bones = {node["name"]: {"node": number} for number, node in enumerate(nodes)}
    document: dict[str, Any] = {
        "asset": {"version": "2.0", "generator": "facegen"},
        "extensionsUsed": [EXTENSION],
        "scene": 0,
        "nodes": nodes,
        "buffers": [{"byteLength": 0}],
    }
    file = Additions(document, path)
    file.check_room(len(time_s) * (1 + 3 * (len(presets) + len(customs)) + 4 + 4))
    tracks = _Tracks(file, nodes, time_s)
    kinds = {"preset": presets, "custom": customs}
    expressions = {
        kind: {name: {"node": tracks.weight(name, weights)} for name, weights in given.items()}
        for kind, given in kinds.items()
        if given
    }
    extension: dict[str, Any] = {"specVersion": "1.0", "humanoid": {"humanBones": bones}}
    if expressions:
        extension["expressions"] = expressions
    tracks.turn(bones["head"]["node"], head)
    if np.isfinite(gaze).all(axis=1).any():
        nodes.append({"name": "lookAt"})
        extension["lookAt"] = {"node": len(nodes) - 1, "offsetFromHeadBone": [0.0, 0.06, 0.0]}
        tracks.turn(len(nodes) - 1, gaze)
    carried = {child for node in nodes for child in node.get("children", [])}
    document["scenes"] = [{"nodes": [number for number in range(len(nodes)) if number not in carried]}]
    document["animations"] = [{"name": title, "channels": tracks.channels, "samplers": tracks.samplers}]
    document["extensions"] = {EXTENSION: extension}
    return glb_bytes(document, file.stored([(BIN, b"")]), path)


class _Tracks:
    """Channels and samplers of the one animation."""

    def __init__(self, file: Additions, nodes: list[dict[str, Any]], time_s: np.ndarray) -> None:
        self.channels: list[dict[str, Any]] = []
        self.samplers: list[dict[str, Any]] = []
        self._file, self._nodes, self._time_s = file, nodes, time_s
        self._clock = self._times(time_s)

    def weight(self, name: str, weights: np.ndarray) -> int:
        """Number of a new node that moves along x as an expression's weight does."""
        self._nodes.append({"name": name})
        places = np.zeros((len(weights), 3), "<f4")
        places[:, 0] = np.clip(weights, 0, 1)
        self._add(len(self._nodes) - 1, "translation", self._clock, places, "VEC3")
        return len(self._nodes) - 1

    def turn(self, node: int, rotations: np.ndarray) -> None:
        """Turn a node as far as its rotations (n, 4) are known."""
        known = np.isfinite(rotations).all(axis=1)
        if known.any():
            clock = self._clock if known.all() else self._times(self._time_s[known])
            self._add(node, "rotation", clock, rotations[known].astype("<f4"), "VEC4")

    def _times(self, time_s: np.ndarray) -> int:
        times = time_s.astype("<f4")
        return self._file.accessor(times, min=[float(times[0])], max=[float(times[-1])])

    def _add(self, node: int, path: str, clock: int, values: np.ndarray, kind: str) -> None:
        self.channels.append({"sampler": len(self.samplers), "target": {"node": node, "path": path}})
        output = self._file.accessor(values, kind=kind)
        self.samplers.append({"input": clock, "output": output, "interpolation": "LINEAR"})


def _skeleton() -> list[dict[str, Any]]:
    """Nodes of the bones, standing in VRM's T-pose."""
    bones = dict(_BONES)
    for side, sign in (("left", 1), ("right", -1)):
        for name, (above, (x, y, z)) in _SIDES.items():
            carrier = above if above in _BONES else f"{side}{above}"
            bones[f"{side}{name}"] = (carrier, (sign * x, y, z))
    numbers = {name: number for number, name in enumerate(bones)}
    nodes: list[dict[str, Any]] = [
        {"name": name, "translation": list(place)} for name, (_, place) in bones.items()
    ]
    for name, (above, _) in bones.items():
        if above is not None:
            nodes[numbers[above]].setdefault("children", []).append(numbers[name])
    return nodes
