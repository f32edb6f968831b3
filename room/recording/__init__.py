"""What a room keeps of a meeting where people agreed to it: a file of states, its writer and its reader."""

from room.recording.reader import Survey, check_recording, follow_recording, read_recording
from room.recording.writer import Recorder

__all__ = ["Recorder", "Survey", "check_recording", "follow_recording", "read_recording"]
