"""A scene as plain data in the head frame: what a renderer takes, and the linear images it gives back."""

from dataclasses import dataclass, field

import numpy as np

from facegen.geometry import Camera


@dataclass(frozen=True, kw_only=True, eq=False)
class Mesh:
    """A surface with one material and one part per face.

    Attributes
    ----------
    name
        Unique within the scene, and the same for the same object in every sample (a renderer may keep and
        move it).
    vertices
        (V, 3) float64, head frame, metres.
    faces
        (F, 4) int32, counter-clockwise seen from outside; triangles are padded with -1.
    part
        (F,) uint8, `facegen.conventions.Part` of each face.
    materials
        Names of the materials, looked up by the renderer.
    face_material
        (F,) index into ``materials``.
    uv
        (F, 4, 2) texture coordinates of each face's corners, or None.
    fields
        (V,) values at the vertices by name, for materials that ask for them.
    """

    name: str
    vertices: np.ndarray
    faces: np.ndarray
    part: np.ndarray
    materials: tuple[str, ...]
    face_material: np.ndarray
    uv: np.ndarray | None = None
    fields: dict[str, np.ndarray] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class Strands:
    """Hair of one material and one part as curves, which cost less than tubes and hide nothing in labels.

    Attributes
    ----------
    name
        As a `Mesh`'s.
    points
        (n, k, 3) n strands from root to tip, head frame, metres.
    radius_m
        (n, k).
    part
        `facegen.conventions.Part` of all.
    material
        Name, looked up by the renderer.
    """

    name: str
    points: np.ndarray
    radius_m: np.ndarray
    part: int
    material: str


@dataclass(frozen=True, kw_only=True, eq=False)
class Lamp:
    """A round infra-red LED.

    Attributes
    ----------
    position, direction
        (3,) head frame, metres; ``direction`` is the unit vector along the middle of its beam.
    diameter_m, power_w, spread_rad
        Size of the emitting disc, radiant power, and full angle of the beam.
    """

    name: str
    position: np.ndarray
    direction: np.ndarray
    diameter_m: float
    power_w: float
    spread_rad: float


@dataclass(frozen=True, kw_only=True, eq=False)
class View:
    """One camera: intrinsics, ``camera_from_head`` (4, 4), and names of the lamps lit while it exposes.

    ``materials`` stand over the scene's in this view alone.
    """

    name: str
    camera: Camera
    camera_from_head: np.ndarray
    lamps: tuple[str, ...] = ()
    materials: dict[str, dict[str, float]] = field(default_factory=dict)


@dataclass(frozen=True, kw_only=True, eq=False)
class Scene:
    """Meshes, lamps and views, and what of the hair is curves.

    ``materials`` holds parameters by material name (for example ``{"iris": {"albedo": 0.3}}``); what it
    leaves out has the defaults of `facegen.scene.materials.MATERIALS`.
    """

    meshes: tuple[Mesh, ...]
    lamps: tuple[Lamp, ...]
    views: tuple[View, ...]
    materials: dict[str, dict[str, float]] = field(default_factory=dict)
    strands: tuple[Strands, ...] = ()


@dataclass(frozen=True, kw_only=True, eq=False)
class Layers:
    """What a renderer gives back for one view; arrays are (height, width, ...), row 0 on top.

    All values are ones that a view's file holds exactly, so what is read back is what was developed: radiance
    and normal are 16-bit floats, depth is in steps of 2**-20 m, uv in steps of 2**-16.

    Attributes
    ----------
    radiance
        (h, w) float32, linear, in W sr-1 m-2 up to one factor that is equal for all pictures.
    depth
        (h, w) float32, metres along the camera's z axis at the pixel's centre; +inf where there is nothing.
        Depth and normal are those of the first surface, which over iris and pupil is the cornea.
    normal
        (h, w, 3) float32, unit, camera frame (OpenCV), smooth; 0 where there is nothing.
    part
        (h, w) uint8, `facegen.conventions.Part` at the pixel's centre, as it appears through the refracting
        cornea: ``CORNEA`` itself never occurs.
    uv
        (h, w, 2) float32, texture coordinates of what ``part`` shows; 0 where there is nothing. Head and eyes
        have their own (`facegen.scene.eyes.eye_meshes`), so read it together with ``part``.
    """

    radiance: np.ndarray
    depth: np.ndarray
    normal: np.ndarray
    part: np.ndarray
    uv: np.ndarray


@dataclass(frozen=True, kw_only=True, eq=False)
class Glimpse:
    """A view without what is true at its pixels' centres: enough to develop a picture, at half the time.

    Attributes
    ----------
    radiance
        As in `Layers`.
    normal
        (h, w, 3) float32, camera frame (OpenCV), averaged over each pixel and so at most of length 1; 0 where there is
        nothing. Through the cornea it is that of the iris.
    albedo
        (h, w) float32, share of the light that surfaces reflect, averaged over each pixel.
    """

    radiance: np.ndarray
    normal: np.ndarray
    albedo: np.ndarray
