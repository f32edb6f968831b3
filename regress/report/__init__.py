"""Writes a model's report: one HTML page of its figures that opens without a network."""

from pathlib import Path

from facegen.files import output_errors, write_whole
from regress.learning.probes import Measured
from regress.report.page import render_page
from regress.report.probed import probed_of
from regress.report.reading import content_of
from regress.runtime.model import Model

__all__ = ["content_of", "render_page", "write_report"]


def write_report(model: Model, path: Path, measured: Measured | None = None) -> Path:
    """Write a model's report, with what was measured on its dataset if anything was; equal inputs give equal bytes.

    Raises
    ------
    ModelError
        The model has no training record.
    OutputError
        The file cannot be written.
    """
    page = render_page(content_of(model), measured and probed_of(measured))
    with output_errors(path):
        path.parent.mkdir(parents=True, exist_ok=True)
    return write_whole(path, page)
