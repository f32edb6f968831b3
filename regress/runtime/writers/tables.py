"""The table of table formats."""

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from regress.runtime.prediction import Prediction


@dataclass(frozen=True, kw_only=True)
class TableWriter:
    """One format in which weights leave as text.

    Parameters
    ----------
    description
        For people.
    function
        Module and function that give a take's whole table; imported when it is written, as NumPy takes long.
    needs_times
        Whether every frame must have a time.
    arkit_only
        Whether it has columns for the 52 ARKit shapes alone.
    has_head
        Whether it has columns for the head's pose, asked for or not.
    """

    description: str
    function: str
    needs_times: bool = False
    arkit_only: bool = False
    has_head: bool = False

    def text(self, prediction: "Prediction") -> str:
        """A take's whole table."""
        module, _, function = self.function.partition(".")
        writer = importlib.import_module(f"regress.runtime.writers.{module}")
        return getattr(writer, function)(prediction)


TABLES: dict[str, TableWriter] = {
    "csv": TableWriter(description="a column a shape", function="csv_table.weights_csv"),
    "livelink": TableWriter(
        description="the columns of the Live Link Face app",
        function="live_link.live_link_text",
        needs_times=True,
        arkit_only=True,
        has_head=True,
    ),
}
