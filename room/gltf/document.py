"""Defines the records of a glTF document that a browser allocates by, with whole numbers where the format has them.

References
----------
.. [1] Khronos Group, "glTF 2.0 Specification", 5 properties reference.
"""

from collections.abc import Sequence
from typing import Annotated, Any, Literal, TypeVar

from pydantic import BaseModel, ConfigDict, Field

from room.errors import FormatError

Index = Annotated[int, Field(ge=0)]
Count = Annotated[int, Field(ge=1)]
Found = TypeVar("Found")


class _Record(BaseModel):
    model_config = ConfigDict(extra="ignore", frozen=True, strict=True)


class Buffer(_Record):
    """The file's own binary chunk, or, with a ``uri``, something outside."""

    byteLength: Count


class View(_Record):
    """A part of a buffer, in bytes."""

    buffer: Index
    byteOffset: Index = 0
    byteLength: Count


class Indices(_Record):
    """Which values of a sparse accessor are given."""

    bufferView: Index
    byteOffset: Index = 0
    componentType: int


class Values(_Record):
    """Those values."""

    bufferView: Index
    byteOffset: Index = 0


class Sparse(_Record):
    """Values of an accessor that are not zero, or not its view's."""

    count: Count
    indices: Indices
    values: Values


class Accessor(_Record):
    """So many vectors of a kind; without a view they are zeros that cost the file nothing."""

    bufferView: Index | None = None
    byteOffset: Index = 0
    componentType: int
    count: Count
    type: Literal["SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"]
    sparse: Sparse | None = None


class Primitive(_Record):
    """What is drawn at once."""

    attributes: dict[str, Index]
    indices: Index | None = None
    mode: int = 4
    targets: list[dict[str, Index]] = []


class Mesh(_Record):
    """Primitives that move together."""

    primitives: list[Primitive]


class Node(_Record):
    """A place in the tree, and what hangs there."""

    mesh: Index | None = None
    children: list[Index] = []
    extensions: dict[str, Any] = {}


class Skin(_Record):
    """Bones that bend a mesh, and where they were when it was made."""

    joints: list[Index] = []
    inverseBindMatrices: Index | None = None


class Scene(_Record):
    """Roots of what is seen together."""

    nodes: list[Index] = []


class Sampler(_Record):
    """A movement: when, and what then."""

    input: Index
    output: Index


class Channel(_Record):
    """What a movement moves."""

    sampler: Index


class Animation(_Record):
    """Movements that are played together."""

    samplers: list[Sampler] = []
    channels: list[Channel] = []


class Image(_Record):
    """A picture in a view."""

    bufferView: Index


class Document(_Record):
    """What counts of the whole."""

    buffers: list[Buffer] = []
    bufferViews: list[View] = []
    accessors: list[Accessor] = []
    meshes: list[Mesh] = []
    nodes: list[Node] = []
    images: list[Image] = []
    skins: list[Skin] = []
    scenes: list[Scene] = []
    animations: list[Animation] = []
    extensionsUsed: list[str] = []
    extensionsRequired: list[str] = []
    extensions: dict[str, Any] = {}


def named(found: Sequence[Found], index: int, what: str) -> Found:
    """What a document names by its number.

    Raises
    ------
    FormatError
        If it has none of that number.
    """
    if index >= len(found):
        raise FormatError(f"is damaged: it names {what} {index}, and has {len(found)}")
    return found[index]
