"""Checks that a dataset is what its spec says: computes labels anew and looks at pixels."""

from facegen.validation.finding import Finding
from facegen.validation.keypoints import check_shard
from facegen.validation.listing import Listing, list_dataset
from facegen.validation.renders import check_renders
from facegen.validation.repair import Repair, repair
from facegen.validation.verdict import Verdict, validate

__all__ = [
    "Finding",
    "Listing",
    "Repair",
    "Verdict",
    "check_renders",
    "check_shard",
    "list_dataset",
    "repair",
    "validate",
]
