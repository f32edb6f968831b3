"""What is known of a person and a camera, in one TOML file: neutral face, ranges, gains, gaze, placement."""
