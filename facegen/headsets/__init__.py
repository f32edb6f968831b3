"""Headsets: cameras, LEDs, sensor and fit, read from ``blender_assets/headsets/NAME.toml``."""

from facegen.headsets.headset import (
    Fit,
    Headset,
    HeadsetCamera,
    Led,
    Sensor,
    Tolerances,
    head_from_headset,
)
from facegen.headsets.loading import headset_path, list_headsets, load_headset, parse_headset

__all__ = [
    "Fit",
    "Headset",
    "HeadsetCamera",
    "Led",
    "Sensor",
    "Tolerances",
    "head_from_headset",
    "headset_path",
    "list_headsets",
    "load_headset",
    "parse_headset",
]
