"""Builds the rig ``ict`` from a clone of ICT-FaceKit (light, MIT): a head with its own 100 identity modes.

Not subdivided: the mesh is fine enough. Modes are principal components in units of their standard deviation.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from facegen.assets import assets_folder
from facegen.conventions import BLENDSHAPE_INDEX, BLENDSHAPES, Part
from facegen.documents import load_json, read_text
from facegen.errors import FormatError, InputError
from facegen.rigs.builder import RigBuilder, RigSources
from facegen.rigs.human_eyes import with_human_eyes
from facegen.rigs.identity import fit_sphere
from facegen.rigs.marking import lid_neighbourhood, lip_faces
from facegen.rigs.rig import Rig
from facegen.rigs.versions import VERSIONS

MOST_COMPONENTS = 60
"""Modes taken at most; 60 hold 98.8 % of the variance."""
CENTIMETRE_M = 0.01
LICENCE = "MIT"
SOURCE = "ICT-FaceKit light (USC Institute for Creative Technologies, 2020), github.com/ICT-VGL/ICT-FaceKit"
MOST_OBJ_BYTES = 32 * 1024**2
"""Of one mesh: ICT's have 4 MB."""
_NEUTRAL = "generic_neutral_mesh"
_VERTICES = 26_719  # of every mesh of the light face model, as the parts and landmarks count them
_COMPOSED = ("browInnerUp", "cheekPuff")  # ICT has left and right halves, ARKit one shape
_TEXTURE_TILES = 3  # UDIM tiles 0 to 6, laid out in a grid of 3 by 3


@dataclass(frozen=True, kw_only=True, eq=False)
class _Obj:
    vertices: np.ndarray
    faces: np.ndarray
    uv: np.ndarray


def build_ict(clone: Path, *, components: int = MOST_COMPONENTS) -> Rig:
    """Build the rig ``ict`` from the clone, with as many identity modes as it holds up to ``components``.

    Raises
    ------
    InputError
        The folder is not a clone of ICT-FaceKit.
    """
    folder = clone / "FaceXModel"
    if not (folder / f"{_NEUTRAL}.obj").is_file():
        raise InputError(f"{clone} holds no FaceXModel/{_NEUTRAL}.obj; --path wants a clone of ICT-FaceKit")
    data = assets_folder() / "rigs" / "ict"
    parts, points, gains = (load_json(data / f"{name}.json") for name in ("parts", "landmarks", "gains"))
    mesh = _read_obj(folder / f"{_NEUTRAL}.obj")
    part_of = np.zeros(len(mesh.vertices), np.uint8)
    for name, ranges in parts["parts"].items():
        for first, last in ranges:
            part_of[first : last + 1] = Part[name.upper()]

    modes = _modes(folder, mesh.vertices, components)
    expression, missing = _expression(folder, mesh.vertices)
    for name, gain in gains["gains"].items():
        expression[BLENDSHAPE_INDEX[name]] *= gain
    eyes = np.array([np.arange(first, last + 1) for first, last in parts["eyeballs"]])
    centre, radius = fit_sphere(mesh.vertices[eyes])
    mode_centre, mode_radius = fit_sphere((mesh.vertices + modes)[:, eyes])
    mode_centre, mode_radius = mode_centre - centre, mode_radius - radius
    vertices = mesh.vertices - centre.mean(axis=0)
    modes = modes - mode_centre.mean(axis=1, keepdims=True)

    kept_faces = (np.where(mesh.faces >= 0, part_of[mesh.faces], Part.SKIN) > 0).all(axis=1)
    faces, uv = mesh.faces[kept_faces], mesh.uv[kept_faces]
    part = np.where(faces >= 0, part_of[faces], 0).max(axis=1).astype(np.uint8)
    kept = np.unique(faces[faces >= 0])
    row_of = np.full(len(part_of) + 1, -1)  # the last entry serves the padding
    row_of[kept] = np.arange(len(kept))
    faces, landmarks = row_of[faces], row_of[points["points"]]
    vertices, modes, expression = vertices[kept], modes[:, kept], expression[:, kept]
    _mark_tongue(part, vertices, faces, expression[BLENDSHAPES.index("jawOpen")])
    part[lip_faces(faces, part == Part.SKIN, vertices, landmarks)] = Part.LIPS
    outer = np.isin(part, (Part.SKIN, Part.LIPS))
    centre = centre - centre.mean(axis=0)
    rig = Rig(
        name="ict",
        vertices=vertices,
        faces=faces.astype(np.int32),
        cage_faces=faces[outer].astype(np.int32),
        cage_vertices=int(faces[outer].max()) + 1,
        uv=uv,
        part=part,
        identity=modes,
        identity_from_traits=np.zeros((len(modes), 0)),
        identity_residual=np.eye(len(modes)),
        traits=(),
        expression=expression,
        landmark_vertices=landmarks[:, None],
        landmark_weights=np.ones((len(landmarks), 1)),
        eye_center=centre,
        eye_center_identity=mode_centre - mode_centre.mean(axis=1, keepdims=True),
        eye_radius=radius,
        eye_radius_identity=mode_radius,
        upper_lid=row_of[np.array([parts["upper_lid_left"], parts["upper_lid_right"]])],
        lower_lid=row_of[np.array([parts["lower_lid_left"], parts["lower_lid_right"]])],
        lid_vertices=lid_neighbourhood(vertices, expression, centre, radius),
        licence=LICENCE,
        source=SOURCE,
        version=VERSIONS["ict"],
        missing=missing,
    )
    return with_human_eyes(rig)


def _modes(folder: Path, neutral: np.ndarray, components: int) -> np.ndarray:
    files = sorted(folder.glob("identity[0-9][0-9][0-9].obj"))[:components]
    if not files:
        raise InputError(f"{folder} holds no identity000.obj; --path wants a whole clone of ICT-FaceKit")
    return np.stack([_read_vertices(file) - neutral for file in files])


def _expression(folder: Path, neutral: np.ndarray) -> tuple[np.ndarray, tuple[str, ...]]:
    """Displacements (52, v, 3) and the names of shapes that the clone does not have, left at zero."""
    expression, missing = np.zeros((len(BLENDSHAPES), *neutral.shape)), []
    for index, name in enumerate(BLENDSHAPES):
        stem = name.replace("Left", "_L").replace("Right", "_R") if name.endswith(("Left", "Right")) else name
        stems = [f"{name}_L", f"{name}_R"] if name in _COMPOSED else [stem]
        # directions, not sides: spelt as ARKit does
        if name in ("jawLeft", "jawRight", "mouthLeft", "mouthRight"):
            stems = [name]
        files = [folder / f"{s}.obj" for s in stems]
        if all(file.is_file() for file in files):
            expression[index] = sum(_read_vertices(file) - neutral for file in files)
        else:
            missing.append(name)
    return expression, tuple(missing)


def _read_vertices(path: Path) -> np.ndarray:
    """Vertices (v, 3) of an OBJ file in metres; the fitted light model lists them before anything else."""
    lines = [line[2:] for line in _lines(path) if line.startswith("v ")]
    try:
        vertices = CENTIMETRE_M * np.array(" ".join(lines).split(), float).reshape(-1, 3)
    except ValueError as error:
        raise FormatError(f"{path}: has vertices that are not three numbers each ({error})") from None
    if len(vertices) != _VERTICES or not np.isfinite(vertices).all():
        raise FormatError(
            f"{path}: has {len(vertices):,} vertices, but ICT-FaceKit's light face model has {_VERTICES:,}, all finite"
        )
    return vertices


def _lines(path: Path) -> list[str]:
    return read_text(path, most_bytes=MOST_OBJ_BYTES).splitlines()


def _read_obj(path: Path) -> _Obj:
    vertices = _read_vertices(path)
    texture, faces, corners = [], [], []
    try:
        for line in _lines(path):
            kind, _, rest = line.partition(" ")
            if kind == "vt":
                texture.append(rest.split()[:2])
            elif kind == "f":
                pairs = [[int(value) - 1 for value in corner.split("/")[:2]] for corner in rest.split()]
                pairs += [[-1, pairs[0][1]]] * (4 - len(pairs))
                faces.append([vertex for vertex, _ in pairs])
                corners.append([uv for _, uv in pairs])
        face, corner = np.array(faces, np.int64).reshape(-1, 4), np.array(corners, np.int64).reshape(-1, 4)
        uv = np.array(texture, float).reshape(-1, 2)[corner]
    except (ValueError, IndexError, OverflowError) as error:
        raise FormatError(
            f"{path}: has faces or texture coordinates that are not an OBJ file's ({error})"
        ) from None
    if not len(face) or face.max() >= _VERTICES or face.min() < -1 or not np.isfinite(uv).all():
        raise FormatError(f"{path}: has no faces, or some of vertices that are not there")
    tile = np.floor(uv[:, :3, 0].mean(axis=1)).astype(int)
    uv[..., 0] += (tile % _TEXTURE_TILES - tile)[:, None]
    uv[..., 1] += (tile // _TEXTURE_TILES)[:, None]
    return _Obj(vertices=vertices, faces=face, uv=uv / _TEXTURE_TILES)


def _mark_tongue(part: np.ndarray, vertices: np.ndarray, faces: np.ndarray, jaw_open: np.ndarray) -> None:
    """Call tongue what moves with the jaw between the lower gums, in place: ICT has both in one piece."""
    corner = np.where(faces >= 0, faces, faces[:, :1])
    middle = vertices[corner].mean(axis=1)
    with_jaw = np.linalg.norm(jaw_open[corner].mean(axis=1), axis=1) > 5e-3
    gums = part == Part.GUMS
    front = middle[gums, 2].max()
    inside = (np.abs(middle[:, 0]) < 0.019) & (middle[:, 2] < front - 0.014)
    part[gums & with_jaw & inside] = Part.TONGUE


def _build(sources: RigSources) -> Rig:
    if sources.path is None:
        raise InputError("Rig 'ict' is built from a clone of ICT-FaceKit; say where it lies with --path DIR")
    if sources.modes is None:
        return build_ict(sources.path)
    if not 1 <= sources.modes <= MOST_COMPONENTS:
        raise InputError(f"--modes {sources.modes} is not allowed: rig 'ict' takes 1 to {MOST_COMPONENTS}")
    rig = build_ict(sources.path, components=sources.modes)
    if rig.components < sources.modes:
        raise InputError(
            f"{sources.path} holds {rig.components} identity modes, fewer than --modes {sources.modes}; "
            "take a whole clone of ICT-FaceKit, or ask for fewer"
        )
    return rig


ICT = RigBuilder(licence=LICENCE, origin="from --path, a clone of ICT-FaceKit", build=_build)
