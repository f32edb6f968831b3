"""room: people meet as avatars in the browser, with faces, gaze, voice and gestures."""

__version__ = "0.1.0"
