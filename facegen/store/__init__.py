"""Datasets on disk."""

from facegen.store.beginning import begin, check_folder_is_free, holds_dataset
from facegen.store.blocks import draw_block, label_block
from facegen.store.dataset import Dataset
from facegen.store.description import read_description
from facegen.store.folder import (
    LICENCES,
    DatasetFolder,
    commit_file,
    commit_folder,
    read_json,
    shard_samples,
    shards_of,
    write_json,
)
from facegen.store.images import parse_png, png_bytes, read_exr, read_png, write_exr
from facegen.store.keypoint_table import (
    column_array,
    keypoint_schema,
    keypoint_table,
    read_shard,
    write_shard,
)
from facegen.store.licences import licences, licences_of_sources, put_licences, recording_of
from facegen.store.likeness import differing_rows
from facegen.store.merging import Merged, merge
from facegen.store.opening import open_dataset, resolve
from facegen.store.record import sample_record
from facegen.store.reference import labels_reference
from facegen.store.stage import staging, sweep
from facegen.store.versions import check_renderer, version_note

__all__ = [
    "LICENCES",
    "Dataset",
    "DatasetFolder",
    "Merged",
    "begin",
    "check_folder_is_free",
    "check_renderer",
    "column_array",
    "commit_file",
    "commit_folder",
    "differing_rows",
    "draw_block",
    "holds_dataset",
    "keypoint_schema",
    "keypoint_table",
    "label_block",
    "labels_reference",
    "licences",
    "licences_of_sources",
    "merge",
    "open_dataset",
    "parse_png",
    "png_bytes",
    "put_licences",
    "read_description",
    "read_exr",
    "read_json",
    "read_png",
    "read_shard",
    "recording_of",
    "resolve",
    "sample_record",
    "shard_samples",
    "shards_of",
    "staging",
    "sweep",
    "version_note",
    "write_exr",
    "write_json",
    "write_shard",
]
