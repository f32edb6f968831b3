"""Datasets in the forms that training programs read."""

from facegen.packing.pack import PACK_FORMATS, Packed, PackPlan, check_pack, plan_pack, write_pack
from facegen.packing.plan import Options, PackFile, PackFormat

__all__ = [
    "PACK_FORMATS",
    "Options",
    "PackFile",
    "PackFormat",
    "PackPlan",
    "Packed",
    "check_pack",
    "plan_pack",
    "write_pack",
]
