"""Datasets in the forms that training programs read."""

from facegen.packing.pack import FORMATS, Packed, PackPlan, plan_pack, write_pack
from facegen.packing.plan import Format, Options, Part

__all__ = ["FORMATS", "Format", "Options", "PackPlan", "Packed", "Part", "plan_pack", "write_pack"]
