"""How good the tracking is by another's word: a phone's face beside the camera, aligned in time, shape by shape."""
