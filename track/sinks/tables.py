"""Records tables row by row: a CSV of weights, gaze and head, and a recording of the Live Link Face app.

Rows go to the disk as they come, so that an hour takes no more memory than a second.
"""

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np

from facegen.conventions import BLENDSHAPES
from facegen.files import output_errors
from regress.runtime.prediction import Prediction
from regress.runtime.sample import Sample
from regress.runtime.stages.retargeting.matrix import Retargeting
from regress.runtime.stages.retargeting.target_file import read_retargeting
from regress.runtime.writers.csv_table import csv_lines
from regress.runtime.writers.live_link import live_link_at
from track.sinks.recording import Clock, Recording
from track.sinks.rows import Rows
from track.sinks.sink import Sink, Tell, has_face
from track.sinks.targets import Target


class TableSink(Sink):
    """A table that grows by a row a sample.

    Parameters
    ----------
    target
        With a file.
    table
        Text of a whole table of one sample: a line of names, and a row.
    tell
        Takes a sentence where nothing was recorded.
    others
        Names in place of a file that is there at the end; without any, that file is replaced.

    Raises
    ------
    InputError, OutputError
        Where the file cannot be written.
    """

    def __init__(
        self,
        target: Target,
        table: Callable[[Sample], str],
        tell: Tell,
        *,
        others: Iterator[Path] | None = None,
    ) -> None:
        self.title = target.title
        self._target, self._table, self._tell = target, table, tell
        self._recording, self._clock = Recording(target.path, others), Clock()
        with output_errors(target.path):
            self._rows = Rows(self._recording.part)

    def send(self, sample: Sample) -> None:
        """Write a sample's row; of one without a face the cells stay empty."""
        number = self._rows.count
        names, row = self._table(_whole(sample, number, self._clock.of(sample))).splitlines(keepends=True)
        with output_errors(self._recording.path):
            self._rows.add((row if number else names + row).encode())

    def close(self) -> None:
        """Give the file its name; a table without rows leaves none."""
        with output_errors(self._recording.path):
            self._rows.close()
        if self._rows.count:
            self._recording.keep()
            self.kept = True
            self.title = replace(self._target, place=str(self._recording.path)).title
        else:
            self._recording.drop()
            self._tell(f"{self.title}: nothing was recorded, so there is no file")


def open_sink(target: Target, tell: Tell) -> Sink:
    """A table that is being written."""
    if target.name == "livelink-csv":
        return TableSink(target, _live_link_csv, tell)
    names = target.options.get("names")
    return TableSink(
        target, partial(_weights_csv, to=None if names is None else read_retargeting(names)), tell
    )


def open_take(names: Iterator[Path], tell: Tell) -> Sink:
    """A table of weights under the next of these names; where that is taken at the end, under one behind it."""
    target = Target(name="csv", place=str(next(names)))
    return TableSink(target, partial(_weights_csv, to=None), tell, others=names)


def _weights_csv(sample: Sample, to: Retargeting | None) -> str:
    if to is None:
        return "".join(csv_lines([sample], BLENDSHAPES))
    return "".join(csv_lines([replace(sample, weights=to.apply(sample.weights[None])[0])], to.names))


def _live_link_csv(sample: Sample) -> str:
    row = Prediction(samples=(sample,))
    return live_link_at(row, row.known_times_s)


def _whole(sample: Sample, number: int, time_s: float) -> Sample:
    """The sample with a number in every column, NaN where it is not known: a table's columns stay the same."""
    return replace(
        sample,
        label=sample.label or str(number),
        time_s=time_s,
        weights=sample.weights if has_face(sample) else np.full(len(BLENDSHAPES), np.nan),
        gaze=np.full(4, np.nan) if sample.gaze is None else sample.gaze,
        head=np.full(6, np.nan) if sample.head is None else sample.head,
    )
