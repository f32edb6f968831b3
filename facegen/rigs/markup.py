"""Reads the JSON file that marks up a user's own head: landmarks, eyes, lids and parts, which no 3D format names."""

from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, FiniteFloat, ValidationError

from facegen.documents import load_json
from facegen.errors import InputError
from facegen.refusals import refusal

Vertex = Annotated[int, Field(ge=0)]
Position = tuple[FiniteFloat, FiniteFloat, FiniteFloat]
Point = Vertex | Annotated[list[tuple[Vertex, FiniteFloat]], Field(min_length=1)] | Position
"""A vertex of the head's mesh, weighted vertices ``[[vertex, weight], ...]``, or the vertex nearest a position."""
PartName = Literal["teeth", "gums", "tongue", "lashes", "mouth_cavity", "eye_cavity"]


class _Model(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Ball(_Model):
    """An eyeball given by its ``center`` and ``radius``, in the file's frame and unit."""

    center: Position
    radius: Annotated[FiniteFloat, Field(gt=0)]


class EyeMarks(_Model):
    """Eyeballs: a ball, or the name of what holds it; a name on both sides holds both, split at the middle."""

    left: str | Ball
    right: str | Ball


class Margins(_Model):
    """Points along the upper and the lower margin of one eye, from the inner to the outer canthus."""

    upper: Annotated[list[Vertex], Field(min_length=4)]
    lower: Annotated[list[Vertex], Field(min_length=4)]


class LidMarks(_Model):
    """Lid margins of both eyes."""

    left: Margins
    right: Margins


class HeadMarkup(_Model):
    """Content of the file that goes with a user's glTF head; docs/adding-a-rig.md explains each key.

    Names are those of a mesh, a node or a material in the file, without regard to case. Vertices count from 0
    over the primitives of the mesh that ``head`` names, in the file's order.

    Attributes
    ----------
    landmarks
        68 points in iBUG order, index 0 the subject's right jaw.
    eyes
        The eyeballs.
    head
        The mesh with the face; where it is not given, the one with the most ARKit shapes.
    lids
        Lid margins; where they are not given, the shortest paths along the mesh through the eye landmarks.
    parts
        What else belongs to the head. Meshes that are not named here are left out.
    metres_per_unit
        1 for a file that follows glTF.
    licence, source
        Terms for pictures of the head, and where it comes from; they go into every dataset.
    """

    landmarks: Annotated[list[Point], Field(min_length=68, max_length=68)]
    eyes: EyeMarks
    head: str | None = None
    lids: LidMarks | None = None
    parts: dict[PartName, list[str]] = Field(default_factory=dict)
    metres_per_unit: Annotated[FiniteFloat, Field(gt=0)] = 1.0
    licence: str = "not stated"
    source: str = "not stated"


def read_markup(path: Path) -> HeadMarkup:
    """Read the JSON file.

    Raises
    ------
    InputError
        It is missing, is no JSON, or a key or value is not allowed; says which.
    """
    try:
        content = load_json(path)
    except InputError as error:
        raise InputError(f"{error}; --landmarks wants a JSON file") from None
    try:
        return HeadMarkup.model_validate(content)
    except ValidationError as error:
        sentence = refusal(error, HeadMarkup)
        raise InputError(f"{path}: {sentence} (docs/adding-a-rig.md lists what is allowed)") from error
