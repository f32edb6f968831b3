"""Cameras' pictures one after the other: from folders, films or live cameras, laid side by side frame by frame."""
