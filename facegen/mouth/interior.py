"""A face's teeth, gums and tongue as meshes: placed behind the lips of its neutral, the lower ones moved by the jaw."""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from facegen.conventions import BLENDSHAPE_INDEX, LOWER_LIP_SEAM, UPPER_LIP_SEAM, Part
from facegen.geometry import apply_transform
from facegen.mouth.arch import course, crowns, half_length, necks, seats
from facegen.mouth.cavity import cavity_surface, has_own_cavity
from facegen.mouth.crowns import LOWER, UPPER
from facegen.mouth.gums import gum_surface
from facegen.mouth.jaw import jaw_motion
from facegen.mouth.tongue import tongue_surface
from facegen.mouth.traits import MouthTraits
from facegen.mouth.wall import Wall, wall_faces
from facegen.raster import triangles_of
from facegen.rigs import Rig, eye_centers, neutral_landmarks
from facegen.scene import Mesh

EYES_M = 62.2e-3
"""Distance of the eyeballs' centres at which teeth have their mean sizes: the default rig's mean."""
CANT_RAD = np.radians(8.0)
"""The plane of the teeth falls towards the front: 9.3 +- 3.8 degrees against the Frankfort plane (W. Downs, "Variations
in facial relationships", Am. J. Orthodontics 34(10), 1948)."""
FREEWAY_M = 2.0e-3
"""Teeth stand apart by this in a face at rest (J. Thompson, "The rest position of the mandible", J. Am. Dental Assoc.
33(3), 1946: 2 to 3 mm)."""
LIP_M = 6.0e-3
"""From the line where lips meet back to the upper incisors' faces."""
GAP_M = 0.35e-3
"""Teeth and gums stay this far behind lips and cheeks."""
DENSE = 800
"""Rigs with more faces of teeth have good ones: 28 crowns need about that many."""


def has_own_teeth(rig: Rig) -> bool:
    """Whether the rig's own mouth is drawn; ICT-FaceKit has modelled teeth, MakeHuman two bare strips."""
    return int((rig.part == Part.TEETH).sum()) > DENSE


@dataclass(frozen=True, kw_only=True, eq=False)
class _Rest:
    """One person's arches in the neutral face: vertices in the head frame and faces, by arch."""

    frame: np.ndarray
    edge: dict[str, np.ndarray]
    teeth: dict[str, tuple[np.ndarray, np.ndarray]]
    gums: dict[str, tuple[np.ndarray, np.ndarray]]
    scale: float

    @cached_property
    def edges(self) -> dict[str, np.ndarray]:
        """Edges (e, 2) of the teeth and of the gums of both arches, as they follow one another."""
        return {name: _edges(_joined(list(getattr(self, name).values()))) for name in ("teeth", "gums")}


def mouth_meshes(
    rig: Rig, traits: MouthTraits, *, identity: np.ndarray, weights: np.ndarray, vertices: np.ndarray
) -> tuple[Mesh, ...]:
    """Teeth, gums and tongue of one face.

    Parameters
    ----------
    rig, traits
        The rig and the person's mouth.
    identity, weights
        (K,) and (52,) of the face.
    vertices
        (V, 3) the evaluated head, head frame, metres; nothing reaches through its lips and cheeks.
    """
    rest = _rest(rig, traits, np.asarray(identity, np.float64).tobytes())
    jaw = jaw_motion(rig, identity, weights)
    motion = {"upper": np.eye(4), "lower": jaw}
    wall = Wall(vertices, wall_faces(rig), rest.frame)
    meshes = []
    for name, part, pieces in (("teeth", Part.TEETH, rest.teeth), ("gums", Part.GUMS, rest.gums)):
        moved = np.concatenate(
            [apply_transform(motion[arch], points) for arch, (points, _) in pieces.items()]
        )
        meshes.append(
            _mesh(name, part, _behind(wall, moved, rest.edges[name]), _joined(list(pieces.values())))
        )
    landmarks = np.einsum("ln,lnc->lc", rig.landmark_weights, vertices[rig.landmark_vertices])
    meshes.append(_mesh("tongue", Part.TONGUE, *_tongue(rest, traits, jaw, weights, landmarks)))
    if not has_own_cavity(rig):
        meshes.append(_mesh("cavity", Part.MOUTH_CAVITY, *cavity_surface(landmarks, rest.scale)))
    return tuple(meshes)


@lru_cache(maxsize=8)
def _rest(rig: Rig, traits: MouthTraits, identity_bytes: bytes) -> _Rest:
    identity = np.frombuffer(identity_bytes)
    points = neutral_landmarks(rig, identity[None])[0]
    eyes = eye_centers(rig, identity[None])[0]
    scale = float(np.linalg.norm(eyes[0] - eyes[1])) / EYES_M
    size = scale * traits.size
    seam = (points[UPPER_LIP_SEAM] + points[LOWER_LIP_SEAM]) / 2
    frame = np.eye(4)
    cosine, sine = np.cos(CANT_RAD), np.sin(CANT_RAD)
    frame[:3, :3] = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    frame[:3, 3] = seam - scale * np.array([0.0, traits.display_m, LIP_M + 1e-3 * UPPER[0].face])
    lower = frame.copy()
    apart = np.array([0.0, traits.overbite_m - FREEWAY_M, -traits.overjet_m])
    lower[:3, 3] += frame[:3, :3] @ (scale * apart)
    teeth, gums, edge = {}, {}, {}
    for row, (arch, kinds, pose, up) in enumerate(
        (("upper", UPPER, frame, 1.0), ("lower", LOWER, lower, -1.0))
    ):
        line = course(half_length(kinds, size), traits.ratio)
        arch_seats = seats(
            kinds,
            size,
            turn_rad=traits.turn_rad[row],
            outwards_m=size * traits.forward_m[row],
            down_m=size * traits.down_m[row],
            missing=traits.missing[row],
        )
        points_of, faces, _ = crowns(line, arch_seats)
        gum, quads = gum_surface(
            line,
            necks(arch_seats),
            arch=arch,
            size=size,
            vault_m=scale * (traits.palate_m if row == 0 else 9e-3),
        )
        flip = np.array([1.0, up, 1.0])
        teeth[arch] = apply_transform(pose, points_of * flip), _turned(faces, up)
        gums[arch] = apply_transform(pose, gum * flip), _turned(quads, up)
        edge[arch] = pose[:3, 3]
    axis = frame.copy()
    axis[:3, 3] = frame[:3, 3] - frame[:3, :3] @ np.array([0.0, 0.0, 24e-3 * size])
    return _Rest(frame=axis, edge=edge, teeth=teeth, gums=gums, scale=scale)


def _tongue(
    rest: _Rest, traits: MouthTraits, jaw: np.ndarray, weights: np.ndarray, landmarks: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """The tongue moves with the jaw; put out, it lies on the lower teeth and on the lip as it is."""
    pose = jaw.copy()
    pose[:3, :3] = jaw[:3, :3] @ rest.frame[:3, :3]
    pose[:3, 3] = apply_transform(jaw, rest.edge["lower"][None])[0]
    out = float(np.clip(weights[BLENDSHAPE_INDEX["tongueOut"]], 0.0, 1.0))
    local = (landmarks - pose[:3, 3]) @ pose[:3, :3]
    upper = (rest.edge["upper"] - pose[:3, 3]) @ pose[:3, :3]
    inner, outer = 1e3 * local[66, 1:], 1e3 * local[57, 1:]
    size = rest.scale
    room = max(1e3 * float(upper[1]), 0.0)
    thick = min(0.42 * room, 4.5 * size) + 0.8 * size
    over = max(inner[0], 0.0) + thick
    lip = max(inner[0], 0.0) + thick
    front = max(outer[1], 8.0 * size)
    path = np.array(
        [
            [over, -7.0 * size],
            [lip, max(inner[1], 5.0 * size)],
            [lip - 4.5 * size, front + 8.0 * size],
            [lip - 15.0 * size, front + 17.0 * size],
        ]
    )
    points, faces = tongue_surface(size=size, width=traits.tongue, out=out, path_mm=path, room_mm=room)
    return apply_transform(pose, points), faces


def _behind(wall: Wall, points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """Points (n, 3) drawn back behind the wall, and their neighbours a little with them."""
    back = wall.draw_back(points, gap_m=GAP_M)
    if not back.any():
        return points
    for _ in range(3):
        around = np.zeros(len(points))
        np.maximum.at(around, edges[:, 0], back[edges[:, 1]])
        np.maximum.at(around, edges[:, 1], back[edges[:, 0]])
        back = np.maximum(back, 0.7 * around)
    return wall.drawn(points, back)


def _joined(pieces: list[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """Faces of several meshes as one."""
    starts = np.cumsum([0] + [len(points) for points, _ in pieces])
    return np.concatenate(
        [np.where(f >= 0, f + start, -1) for (_, f), start in zip(pieces, starts, strict=False)]
    )


def _edges(faces: np.ndarray) -> np.ndarray:
    triangles = triangles_of(faces)
    return np.unique(np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1), axis=0)


def _turned(faces: np.ndarray, up: float) -> np.ndarray:
    """Faces of a mesh that was mirrored if ``up`` is negative."""
    if up > 0.0:
        return faces
    return np.where(faces[:, 3:] < 0, faces[:, [1, 0, 2, 3]], faces[:, ::-1])


def _mesh(name: str, part: Part, vertices: np.ndarray, faces: np.ndarray) -> Mesh:
    return Mesh(
        name=name,
        vertices=vertices,
        faces=faces.astype(np.int32),
        part=np.full(len(faces), part, np.uint8),
        materials=(name,),
        face_material=np.zeros(len(faces), np.int32),
    )
