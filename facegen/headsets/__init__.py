"""Headsets: cameras, LEDs, occluders, sensor and fit, read from ``blender_assets/headsets/NAME.toml``."""

from facegen.headsets.cameras import HeadsetCamera, Lens
from facegen.headsets.headset import (
    Headset,
    HeadsetFit,
    HeadsetSensor,
    Led,
    Tolerances,
    head_from_headset,
)
from facegen.headsets.loading import headset_path, list_headsets, load_headset, parse_headset
from facegen.headsets.occluders import HeadsetOccluder
from facegen.headsets.told_cameras import told_cameras
from facegen.headsets.units import draw_unit

__all__ = [
    "Headset",
    "HeadsetCamera",
    "HeadsetFit",
    "HeadsetOccluder",
    "HeadsetSensor",
    "Led",
    "Lens",
    "Tolerances",
    "draw_unit",
    "head_from_headset",
    "headset_path",
    "list_headsets",
    "load_headset",
    "parse_headset",
    "told_cameras",
]
