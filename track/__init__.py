"""track: live cameras in, avatars out; the networks of `regress`, frame by frame."""
