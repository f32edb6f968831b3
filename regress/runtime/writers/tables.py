"""The table of table formats."""

from collections.abc import Callable
from dataclasses import dataclass

from regress.runtime.prediction import Prediction
from regress.runtime.writers.csv_table import weights_csv
from regress.runtime.writers.live_link import live_link_text


@dataclass(frozen=True, kw_only=True)
class TableWriter:
    """One format in which weights leave as text.

    Parameters
    ----------
    description
        For people.
    text
        A take's whole table.
    needs_times
        Whether every frame must have a time.
    arkit_only
        Whether it has columns for the 52 ARKit shapes alone.
    """

    description: str
    text: Callable[[Prediction], str]
    needs_times: bool = False
    arkit_only: bool = False


TABLES: dict[str, TableWriter] = {
    "csv": TableWriter(description="a column a shape", text=weights_csv),
    "livelink": TableWriter(
        description="the columns of the Live Link Face app",
        text=live_link_text,
        needs_times=True,
        arkit_only=True,
    ),
}
