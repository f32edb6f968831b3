"""Sessions: what a person has and wears while the headset is on, drawn once, and the scene of each of their samples."""

from facegen.sessions.sample_scene import SampleScene, build_sample_scene, draw_sample_scene
from facegen.sessions.session import Session, draw_session, draw_unit_of_session

__all__ = [
    "SampleScene",
    "Session",
    "build_sample_scene",
    "draw_sample_scene",
    "draw_session",
    "draw_unit_of_session",
]
