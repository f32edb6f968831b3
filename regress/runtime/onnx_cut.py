"""Cuts an ONNX graph in two: what some inputs alone decide, and the rest, which takes that as inputs.

So what stays the same from frame to frame is computed once. Nothing of the file changes for those who run it whole.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field

from regress.runtime.protobuf import bytes_field, fields, number_field

_GRAPH = 7
"""Field of a model; the numbers are those of onnx.proto."""

_NODE, _INITIALIZER, _INPUT, _OUTPUT, _VALUE_INFO = 1, 5, 11, 12, 13
"""Fields of a graph."""

_NODE_INPUT, _NODE_OUTPUT, _OPERATOR = 1, 2, 4
"""Fields of a node."""

_TENSOR_NAME, _VALUE_NAME = 8, 1

_FLOAT = number_field(1, 1)
"""A tensor's type: float32."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Halves:
    """A graph in two parts.

    Parameters
    ----------
    early
        Graph whose outputs are the values, from all inputs of the whole; it listens to the early ones.
    late
        Graph whose outputs are those of the whole, from its inputs but the early ones, and from the values.
    values
        Names of what the first gives and the second takes.
    """

    early: bytes
    late: bytes
    values: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class _Node:
    raw: memoryview
    operator: str
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]


@dataclass(eq=False)
class _Graph:
    nodes: list[_Node] = field(default_factory=list)
    initializers: dict[str, memoryview] = field(default_factory=dict)
    inputs: dict[str, memoryview] = field(default_factory=dict)
    outputs: dict[str, memoryview] = field(default_factory=dict)
    others: list[memoryview] = field(default_factory=list)


def cut(content: bytes, is_early: Callable[[str], bool], is_late: Callable[[str], bool]) -> Halves | None:
    """Cut a graph where what early inputs decide meets what late ones do.

    A ``Where`` that chooses between an early value and a late one counts as early: the second graph is for frames in
    which the early one is chosen, or in which nothing comes of it.

    Parameters
    ----------
    content
        Bytes of an .onnx file that `regress.runtime.onnx_file.graph_fault` lets through.
    is_early, is_late
        Whether an input is one of them; others count for both.

    Returns
    -------
    Halves or None
        None where there is nothing to cut: no such value, or an output that early inputs alone decide.
    """
    whole, model = _read(content)
    early, late = ({name for name in whole.inputs if belongs(name)} for belongs in (is_early, is_late))
    values: dict[str, None] = {}
    for node in whole.nodes:
        from_early, from_late = ({*node.inputs} & names for names in (early, late))
        if node.operator == "Where" and node.inputs[1] in from_early and node.inputs[2] in from_late:
            early.update(node.outputs)
        elif from_late:
            values |= dict.fromkeys(name for name in node.inputs if name in from_early)
            late.update(node.outputs)
        elif from_early:
            early.update(node.outputs)
    if not values or early & whole.outputs.keys() or early & late:
        return None
    taken = {name: _float(name) for name in values}
    kept = {name: raw for name, raw in whole.inputs.items() if not is_early(name)}
    return Halves(
        early=model(_part(whole, whole.inputs, taken)),
        late=model(_part(whole, kept | taken, whole.outputs)),
        values=tuple(values),
    )


def _read(content: bytes) -> tuple[_Graph, Callable[[bytes], bytes]]:
    """The graph, and what makes a model of another one."""
    around, graph = [], _Graph()
    for one in fields(memoryview(content)):
        if one.number != _GRAPH:
            around.append(bytes(one.raw))
            continue
        for part in fields(one.value):
            if part.number == _NODE:
                graph.nodes.append(_node(part.value, part.raw))
            elif part.number == _INITIALIZER:
                graph.initializers[_text(part.value, _TENSOR_NAME)] = part.raw
            elif part.number == _INPUT:
                graph.inputs[_text(part.value, _VALUE_NAME)] = part.value
            elif part.number == _OUTPUT:
                graph.outputs[_text(part.value, _VALUE_NAME)] = part.value
            # shapes of values are hints, and some would be of the other part
            elif part.number != _VALUE_INFO:
                graph.others.append(part.raw)
    return graph, lambda part: b"".join([*around, bytes_field(_GRAPH, part)])


def _node(node: memoryview, raw: memoryview) -> _Node:
    return _Node(
        raw, _text(node, _OPERATOR), tuple(_texts(node, _NODE_INPUT)), tuple(_texts(node, _NODE_OUTPUT))
    )


def _texts(message: memoryview, number: int) -> Iterator[str]:
    return (bytes(one.value).decode() for one in fields(message) if one.number == number)


def _text(message: memoryview, number: int) -> str:
    return next(_texts(message, number), "")


def _float(name: str) -> bytes:
    """Description of a value of floats, of any shape."""
    return bytes_field(_VALUE_NAME, name.encode()) + bytes_field(2, bytes_field(1, _FLOAT))


def _part(
    whole: _Graph, inputs: dict[str, bytes | memoryview], outputs: dict[str, bytes | memoryview]
) -> bytes:
    """The graph of the nodes that these outputs need, where these inputs are given."""
    needed, nodes = set(outputs), []
    for node in reversed(whole.nodes):
        if needed & (set(node.outputs) - inputs.keys()):
            nodes.append(node.raw)
            needed.update(node.inputs)
    initializers = [raw for name, raw in whole.initializers.items() if name in needed or name in inputs]
    return b"".join(
        [
            *map(bytes, reversed(nodes)),
            *map(bytes, whole.others),
            *map(bytes, initializers),
            *(bytes_field(_INPUT, value) for value in inputs.values()),
            *(bytes_field(_OUTPUT, value) for value in outputs.values()),
        ]
    )
