"""Trained models as files that run elsewhere: landmarks in, avatar weights out, alignment included.

Every exporter is one function ``export(formula, name) -> {file name: content}`` in a module of its own and
one line in `EXPORTERS`; the tests run over the table. All write the same `Formula` and agree with
``Model.predict`` to 1e-4.
"""

import importlib
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING

from facegen.files import output_errors, refuse_sources, whole_file
from regress.errors import InputError

if TYPE_CHECKING:
    from regress.exporters.formula import Formula
    from regress.runtime.model import Model

__all__ = ["EXPORTERS", "export_model"]

EXPORTERS = {
    "onnx": "onnx_graph.export_onnx",
    "onnx-networks": "onnx_graph.export_onnx_networks",
    "c": "c_source.export_c",
    "json": "json_text.export_json",
    "npz": "npz_archive.export_npz",
    "javascript": "javascript.export_javascript",
}
"""Module and function by format; imported where the format is asked for, since ONNX needs the extra ``learn``."""


def export_model(
    model: "Model",
    folder: Path,
    *,
    name: str,
    formats: Iterable[str] = EXPORTERS,
    sources: Iterable[Path] = (),
) -> tuple[Path, ...]:
    """Write a model in several formats.

    Parameters
    ----------
    model : Model
    folder : Path
        Where the files go; made if it is missing.
    name : str
        What the files are called, without a suffix.
    formats : iterable of str
        Keys of `EXPORTERS`; all by default.
    sources : iterable of Path
        What the model was read from: nothing is written over it.

    Returns
    -------
    tuple of Path
        The files; exporting the same model again gives the same bytes.

    Raises
    ------
    InputError
        An unknown format, a name that a format cannot use, or one of a source; nothing was written.
    OutputError
        The folder cannot be written.
    """
    from regress.exporters.formula import formula_of

    formats = tuple(formats)
    for chosen in formats:
        if chosen not in EXPORTERS:
            raise InputError(f"unknown export format {chosen!r}; known are {', '.join(EXPORTERS)}")
    if not name or Path(name).name != name:
        raise InputError(f"export name {name!r} must be a file name without a folder")
    formula = formula_of(model)
    files = {}
    for chosen in formats:
        files |= _exporter(chosen)(formula, name)
    sources = tuple(sources)
    for file_name in files:
        refuse_sources(folder / file_name, sources, option="export")
    with output_errors(folder):
        folder.mkdir(parents=True, exist_ok=True)
    paths = tuple(folder / file_name for file_name in files)
    with (
        ExitStack() as written
    ):  # names are given when all is written: a header is of its source, types of their module
        parts = [written.enter_context(whole_file(path)) for path in paths]
        for part, content in zip(parts, files.values(), strict=True):
            part.write_bytes(content)
    return paths


def _exporter(chosen: str) -> "Callable[[Formula, str], dict[str, bytes]]":
    module, _, function = EXPORTERS[chosen].partition(".")
    return getattr(importlib.import_module(f"{__name__}.{module}"), function)
