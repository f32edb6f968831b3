"""Counts the numbers of which a browser makes arrays for a glTF file, and bounds them."""

from collections.abc import Iterator
from itertools import chain

from room.errors import FormatError
from room.gltf.document import Accessor, Document, Primitive, named

MOST_NUMBERS = 60_000_000
"""In all that a browser makes arrays of, zeros that cost the file nothing among them, and as often as it does: 240 MB.
Our avatars have 2,400,000, nearly all for 52 shapes; VRMs draw ten parts from the same shapes."""

_LAID_OUT = {"POSITION", "NORMAL", "COLOR_0"}
"""What the page's reader takes of shapes; tangents of them it leaves alone."""

COMPONENTS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4, "MAT2": 4, "MAT3": 9, "MAT4": 16}
"""Numbers of each kind of value."""


def check_numbers(told: Document) -> None:
    """Refuse more numbers than browsers should be asked for, also where nothing is ever seen of them.

    Raises
    ------
    FormatError
        If there are, or a shape moves other vertices than its mesh has; it begins behind the name of the file.
    """
    shaped = sum(
        _shaped(told, primitive) for primitive in chain.from_iterable(mesh.primitives for mesh in told.meshes)
    )
    numbers = max(
        sum(_numbers(accessor) for accessor in told.accessors),
        shaped + sum(_numbers(named(told.accessors, index, "accessor")) for index in _read(told)),
    )
    if numbers > MOST_NUMBERS:
        raise FormatError(
            f"has {numbers:,} numbers in its meshes, shapes, bones and movements, and at most {MOST_NUMBERS:,} are "
            "loaded; export it with fewer vertices or shapes, and without animations"
        )


def _numbers(accessor: Accessor) -> int:
    return accessor.count * COMPONENTS[accessor.type]


def _shaped(told: Document, primitive: Primitive) -> int:
    """Numbers of a primitive's shapes: what one of them moves is laid out for all, also where it is not given."""
    words = set(chain.from_iterable(primitive.targets)) & _LAID_OUT
    if not words:
        return 0
    counts = {
        named(told.accessors, index, "accessor").count
        for word in {"POSITION", *words}
        for index in (
            primitive.attributes.get(word),
            *(target[word] for target in primitive.targets if word in target),
        )
        if index is not None
    }
    if len(counts) > 1 or not {"POSITION", *words} <= primitive.attributes.keys():
        raise FormatError("is damaged: one of its shapes moves other vertices than its mesh has")
    return counts.pop() * len(words) * len(primitive.targets) * COMPONENTS["VEC3"]


def _read(told: Document) -> Iterator[int]:
    """The accessors that a reader makes arrays of beside shapes, each as often as it is told to."""
    for primitive in chain.from_iterable(mesh.primitives for mesh in told.meshes):
        yield from primitive.attributes.values()
        if primitive.indices is not None:
            yield primitive.indices
    for skin in told.skins:
        if skin.inverseBindMatrices is not None:
            yield skin.inverseBindMatrices
    for animation in told.animations:
        moved = (named(animation.samplers, channel.sampler, "sampler") for channel in animation.channels)
        for sampler in chain(animation.samplers, moved):
            yield from (sampler.input, sampler.output)
