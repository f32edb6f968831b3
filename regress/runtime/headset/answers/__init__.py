"""From a headset's pictures to weights, gaze, confidence and traced points, of a recording or live."""
