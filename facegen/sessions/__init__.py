"""Sessions: the headset, looks and things that a person wears, drawn once, and the scene of each of their samples."""

from facegen.sessions.drawn_headsets import check_layout, drawn_headset, sees_enough
from facegen.sessions.layouts import Layout, LayoutCamera, check_base, draw_layout, headset_of
from facegen.sessions.sample_scene import SampleScene, build_sample_scene, draw_sample_scene
from facegen.sessions.session import Session, draw_session, draw_unit_of_session

__all__ = [
    "Layout",
    "LayoutCamera",
    "SampleScene",
    "Session",
    "build_sample_scene",
    "check_base",
    "check_layout",
    "draw_layout",
    "draw_sample_scene",
    "draw_session",
    "draw_unit_of_session",
    "drawn_headset",
    "headset_of",
    "sees_enough",
]
