"""Judges whether a camera's pictures are such as a network was trained on, in sentences and in a sheet of pictures."""
