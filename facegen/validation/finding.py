"""Describes one thing that a check found wrong."""

from dataclasses import dataclass
from typing import Literal

FindingKind = Literal[
    "missing-file",
    "extra-file",
    "extra-sample",
    "extra-shard",
    "unreadable",
    "checksum",
    "spec-hash",
    "label",
    "range",
    "pixels",
]
"""Kinds of findings, for programs:

missing-file, extra-file
    A rendered sample lacks a file, or something lies in ``renders/`` or ``keypoints/`` that no dataset holds.
extra-sample, extra-shard
    Data that the spec does not ask for: beyond its last sample, or under another sample's name.
unreadable
    A file does not decode, or is not what its name says.
checksum
    A file's bytes are not those that were written.
spec-hash
    A sample was made from another spec, rig, headset or version of the labels.
label
    A label is not what (spec, sample number) gives.
range
    A label or a pixel's value that cannot be, whatever the spec.
pixels
    A label and its picture do not agree.
"""


@dataclass(frozen=True, order=True)
class Finding:
    """One thing that is wrong.

    Attributes
    ----------
    where
        File, sample or label, below the dataset's folder.
    what
        What was found, and what should be there.
    kind
        One of `FindingKind`.
    remove
        What ``--repair`` removes, below the dataset's folder: a shard, a whole rendered sample, or an extra.
    """

    where: str
    what: str
    kind: FindingKind
    remove: str

    def __str__(self) -> str:
        return f"{self.where}: {self.what}"
