"""Headsets: cameras, LEDs, occluders, sensor and fit, read from ``blender_assets/headsets/NAME.toml``."""

from facegen.headsets.cameras import HeadsetCamera, Lens
from facegen.headsets.headset import (
    Fit,
    Headset,
    Led,
    Sensor,
    Tolerances,
    head_from_headset,
)
from facegen.headsets.loading import headset_path, list_headsets, load_headset, parse_headset
from facegen.headsets.occluders import Occluder
from facegen.headsets.units import draw_unit

__all__ = [
    "Fit",
    "Headset",
    "HeadsetCamera",
    "Led",
    "Lens",
    "Occluder",
    "Sensor",
    "Tolerances",
    "draw_unit",
    "head_from_headset",
    "headset_path",
    "list_headsets",
    "load_headset",
    "parse_headset",
]
