"""Specs: what a dataset is, in TOML."""

from facegen.number_ranges import format_ranges, format_runs, listed, sample_numbers, sample_ranges, without
from facegen.spec.distribution import Distribution, draw
from facegen.spec.idle_keys import idle_note
from facegen.spec.layout_ranges import LayoutRanges
from facegen.spec.loading import LABEL_VERSION, load_spec, parse_spec, spec_hash, spec_schema, spec_table
from facegen.spec.reference import spec_reference
from facegen.spec.rigs import shares_of
from facegen.spec.spec import Expression, Gaze, Landmarks, Looks, Playback, Spec

__all__ = [
    "LABEL_VERSION",
    "Distribution",
    "Expression",
    "Gaze",
    "Landmarks",
    "LayoutRanges",
    "Looks",
    "Playback",
    "Spec",
    "draw",
    "format_ranges",
    "format_runs",
    "idle_note",
    "listed",
    "load_spec",
    "parse_spec",
    "sample_numbers",
    "sample_ranges",
    "shares_of",
    "spec_hash",
    "spec_reference",
    "spec_schema",
    "spec_table",
    "without",
]
