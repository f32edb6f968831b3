"""room: people meet as avatars in the browser, with faces, gaze, voice and gestures."""
