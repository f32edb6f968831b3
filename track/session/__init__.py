"""One person before the cameras: from pictures to answers, with calibration, fading and what went wrong on the way."""
