"""Draws: from (spec, sample number) to everything that differs between samples."""

from facegen.sampling.frames import COMPONENT_NAMES
from facegen.sampling.people import rig_of
from facegen.sampling.plan import Plan, plan_dataset
from facegen.sampling.samples import Samples, draw_samples
from facegen.sampling.shots import Shot, draw_shot, draw_shots

__all__ = [
    "COMPONENT_NAMES",
    "Plan",
    "Samples",
    "Shot",
    "draw_samples",
    "draw_shot",
    "draw_shots",
    "plan_dataset",
    "rig_of",
]
