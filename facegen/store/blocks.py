"""Draws and labels the blocks of a dataset, each person on the own rig."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pyarrow as pa

from facegen.conventions import BLOCK
from facegen.labels import label_keypoints
from facegen.rigs import Rig
from facegen.sampling import Samples, draw_samples, rig_of
from facegen.store.arrow_arrays import arrow_array
from facegen.store.columns import RIG
from facegen.store.dataset import Dataset
from facegen.store.keypoint_table import keypoint_table


def widest(rigs: Sequence[Rig]) -> int:
    """Numbers in the column ``identity``: those of the rig with the most, the others are padded with zeros."""
    return max(rig.components for rig in rigs)


def draw_block(dataset: Dataset, block: int) -> dict[str, Samples]:
    """The 1,000 samples of a block as each rig would show them, by its name.

    All of them are drawn on every rig, so that a person's draws do not depend on who else has which rig: they are those
    of the spec with that rig alone.
    """
    return {rig.name: draw_samples(dataset.plan, rig, block) for rig in dataset.rigs}


def label_block(dataset: Dataset, block: int, drawn: dict[str, Samples]) -> pa.Table:
    """Keypoint rows of a drawn block, each of the own rig; those past the dataset's end are cut."""
    spec, real = dataset.spec, min(BLOCK, dataset.plan.samples - block * BLOCK)
    # a row's labels follow from the row alone, so only real rows get them
    if len(dataset.rigs) == 1:
        rig = dataset.rig
        samples = drawn[rig.name].rows(slice(0, real))
        return keypoint_table(spec, samples, label_keypoints(spec, rig, samples))
    whose = rig_of(spec, drawn[dataset.rigs[0].name].person[:real])
    width = widest(dataset.rigs)
    tables, order = [], []
    for index, rig in enumerate(dataset.rigs):
        rows = np.flatnonzero(whose == index)
        if not len(rows):
            continue
        samples = drawn[rig.name].rows(rows)
        keypoints = label_keypoints(spec, rig, samples)
        padded = np.pad(samples.identity, ((0, 0), (0, width - rig.components)))
        table = keypoint_table(spec, replace(samples, identity=padded), keypoints)
        tables.append(table.append_column(RIG, arrow_array(np.full(len(rows), rig.name), RIG.type)))
        order.append(rows)
    return pa.concat_tables(tables).take(arrow_array(np.argsort(np.concatenate(order)), pa.int64()))
