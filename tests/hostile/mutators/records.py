"""Damages files of libraries by the libraries themselves: Parquet's columns, ONNX's nodes."""

import io
from random import Random

import numpy as np


def columns(data: bytes, random: Random) -> bytes:
    """A Parquet table with a column gone, renamed, of another type, with gaps or of other values."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    table = pq.read_table(pa.BufferReader(data))
    at = random.randrange(table.num_columns)
    name, column = table.column_names[at], table.column(at).combine_chunks()
    rows = len(table)
    kind = random.choice(
        ("gone", "renamed", "text", "null", "other", "empty", "rows", "twice", "nan", "more")
    )
    if kind == "gone":
        table = table.drop_columns([name])
    elif kind == "renamed":
        table = table.rename_columns(
            [f"{other}x" if other == name else other for other in table.column_names]
        )
    elif kind == "text":
        table = table.set_column(at, name, pa.array(["x" * random.choice((1, 10_000))] * rows))
    elif kind == "null":
        table = table.set_column(at, name, pa.nulls(rows, column.type))
    elif kind == "other":
        new = random.choice(
            (pa.array(np.full(rows, -1)), pa.array(np.full(rows, np.nan)), pa.array([[1.0]] * rows))
        )
        table = table.set_column(at, name, new)
    elif kind == "empty":
        table = table.slice(0, 0)
    elif kind == "rows":
        table = random.choice((table.slice(1), pa.concat_tables([table, table]), table.slice(0, 1)))
    elif kind == "twice":
        table = table.append_column(name, column)
    elif kind == "nan":
        import pyarrow.types as kinds

        if kinds.is_fixed_size_list(column.type) and kinds.is_floating(column.type.value_type):
            values = np.array(column.flatten())
            values[random.randrange(len(values))] = random.choice((np.nan, np.inf, -np.inf, 1e30))
            new = pa.FixedSizeListArray.from_arrays(pa.array(values), column.type.list_size)
            table = table.set_column(at, pa.field(name, new.type), new)
        elif kinds.is_integer(column.type):
            table = table.set_column(
                at, name, pa.array(np.full(rows, random.choice((-1, 0, 2**31 - 1))), column.type)
            )
    else:
        table = table.append_column("more", pa.array(range(rows)))
    sink = io.BytesIO()
    pq.write_table(table, sink)
    return sink.getvalue()


PARQUET = {"columns": columns}


def nodes(data: bytes, random: Random) -> bytes:
    """An ONNX graph with other inputs, outputs, sizes, constants or operators."""
    import onnx

    model = onnx.load_from_string(data)
    graph = model.graph
    kind = random.choice(
        ("input", "output", "rename", "shape", "drop", "operator", "constant", "version", "outside")
    )
    if kind == "input":
        del graph.input[random.randrange(len(graph.input))]
    elif kind == "output":
        del graph.output[random.randrange(len(graph.output))]
    elif kind == "rename":
        random.choice(random.choice((graph.input, graph.output))).name = random.choice(
            ("", "x", "x" * 10_000)
        )
    elif kind == "shape":
        value = random.choice(random.choice((graph.input, graph.output)))
        shape = value.type.tensor_type.shape
        if shape.dim:
            shape.dim[random.randrange(len(shape.dim))].dim_value = random.choice((0, 1, 7, 10**9, -1))
    elif kind == "drop":
        del graph.node[random.randrange(len(graph.node))]
    elif kind == "operator":
        random.choice(graph.node).op_type = random.choice(("Nothing", "Loop", "Exp", "NonZero", "Expand"))
    elif kind == "constant" and graph.initializer:
        tensor = random.choice(graph.initializer)
        tensor.dims[:] = random.choice(([10**9], [], [-1], [1, 1, 1]))
    elif kind == "version":
        model.opset_import[0].version = random.choice((0, 1, 10**6))
    elif graph.initializer:
        tensor = random.choice(graph.initializer)
        tensor.ClearField("raw_data")
        tensor.data_location = onnx.TensorProto.EXTERNAL
        entry = tensor.external_data.add()
        entry.key, entry.value = "location", random.choice(("/etc/passwd", "../model.json", "none"))
    return model.SerializeToString()


ONNX = {"nodes": nodes}
