"""Looks into the bytes of an .onnx file before anything runs it: which operators it has, and what else it would open.

onnx itself is no part of what runs a model; the field numbers are those of onnx.proto.
"""

from collections.abc import Iterator

from regress.runtime.protobuf import fields

MOST_NODES = 100_000
"""Of a graph: a network has some 800."""

_MODEL = {7: "graph", 25: "function"}
_GRAPH = {1: "node", 5: "tensor", 15: "sparse"}
_NODE = {4: "operator", 5: "attribute", 7: "domain"}
_ATTRIBUTE = {5: "tensor", 6: "subgraph", 10: "tensor", 11: "subgraph", 22: "sparse", 23: "sparse"}
_SPARSE = {1: "tensor", 2: "tensor"}
_TENSOR = {13: "elsewhere", 14: "location"}


def graph_fault(content: bytes) -> str | None:
    """Why a graph of strangers is not run, in words; None where it may be.

    Loops and branches hold graphs of their own and can run for ever, operators outside ONNX's own domain are another
    program's, and tensors that lie in other files would have those read.
    """
    try:
        return _model_fault(memoryview(content))
    except (IndexError, ValueError, UnicodeDecodeError):
        return "is no ONNX file, or is cut"


def _model_fault(model: memoryview) -> str | None:
    graphs = 0
    for what, value in _named(model, _MODEL):
        if what == "function":
            return "defines functions of its own, which headset networks do not"
        graphs += 1
        fault = _graph_fault(value)
        if fault is not None:
            return fault
    return None if graphs == 1 else "is no ONNX file: it has no graph"


def _graph_fault(graph: memoryview) -> str | None:
    nodes = 0
    for what, value in _named(graph, _GRAPH):
        nodes += what == "node"
        fault = _node_fault(value) if what == "node" else _tensor_fault(value, sparse=what == "sparse")
        if fault is not None:
            return fault
    return f"has {nodes:,} nodes; at most {MOST_NODES:,} are run" if nodes > MOST_NODES else None


def _node_fault(node: memoryview) -> str | None:
    entries = list(_named(node, _NODE))
    text = {what: bytes(value).decode() for what, value in entries if what != "attribute"}
    operator, domain = text.get("operator", ""), text.get("domain", "")
    if domain not in ("", "ai.onnx"):
        return f"has an operator {operator[:60]!r} of the domain {domain[:60]!r}; ONNX's own alone are run"
    for _, attribute in (entry for entry in entries if entry[0] == "attribute"):
        for what, value in _named(attribute, _ATTRIBUTE):
            if what == "subgraph":
                return f"has an operator {operator[:60]!r} with a graph of its own, which is not run"
            fault = _tensor_fault(value, sparse=what == "sparse")
            if fault is not None:
                return fault
    return None


def _tensor_fault(tensor: memoryview, *, sparse: bool) -> str | None:
    if sparse:
        return next(
            filter(None, (_tensor_fault(value, sparse=False) for _, value in _named(tensor, _SPARSE))), None
        )
    if any(what == "elsewhere" or value for what, value in _named(tensor, _TENSOR)):
        return "keeps numbers in other files, which are not opened; save it with all of its numbers inside"
    return None


def _named(message: memoryview, names: dict[int, str]) -> Iterator[tuple[str, memoryview | int]]:
    """Fields of a message that have a name here."""
    for field in fields(message):
        name = names.get(field.number)
        if name is None:
            continue
        if isinstance(field.value, int) != (name == "location"):
            raise ValueError("a field of another kind")
        yield name, field.value
