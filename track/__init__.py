"""track: live cameras in, avatars out; the networks of `regress`, frame by frame."""

__version__ = "0.1.0"
